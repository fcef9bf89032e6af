import { element } from "./dom";

/** The one small note that follows the pointer, over the picture and over plots. */
export class Tooltip {
  private readonly box = element("div", { class: "tooltip", hidden: true, "aria-hidden": "true" });

  constructor() {
    document.body.append(this.box);
  }

  /** Shows lines of text near a point of the window, the first as a heading; never beyond the window's edges. */
  show(lines: readonly string[], x: number, y: number): void {
    const { box } = this;
    const shown = [...box.children].map((child) => child.textContent);
    if (shown.length !== lines.length || lines.some((line, index) => line !== shown[index])) {
      box.replaceChildren(...lines.map((line, index) => element(index === 0 ? "strong" : "span", {}, line)));
    }
    box.hidden = false;
    const { width, height } = box.getBoundingClientRect();
    const left = Math.min(x + 14, document.documentElement.clientWidth - width - 6);
    const below = y + 18 + height < window.innerHeight;
    box.style.left = `${Math.max(6, left)}px`;
    box.style.top = `${Math.max(6, below ? y + 18 : y - height - 12)}px`;
  }

  hide(): void {
    this.box.hidden = true;
  }
}

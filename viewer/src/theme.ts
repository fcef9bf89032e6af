import { rgb, type Rgb } from "./colours";

/** Colours of the stage that belong to the page, not to the mechanism. */
export interface Theme {
  readonly dark: boolean;
  readonly background: Rgb;
  readonly shadow: Rgb;
  readonly grid: Rgb;
  readonly lit: Rgb;
}

/** Reads them from the style sheet, which knows about dark pages. Paper is white before the browser says that it prints. */
export function readTheme(host: Element, paper: boolean): Theme {
  const style = getComputedStyle(host);
  const colour = (name: string): Rgb => rgb(style.getPropertyValue(paper ? `${name}-on-paper` : name));
  return {
    dark: !paper && style.getPropertyValue("--dark").trim() === "1",
    background: colour("--stage"),
    shadow: colour("--stage-shadow"),
    grid: colour("--stage-grid"),
    lit: colour("--lit"),
  };
}

/** Calls back when the theme may have changed; at once, because paper does not wait for the next frame. */
export function onThemeChange(listener: (paper: boolean) => void): void {
  const print = window.matchMedia("print");
  print.addEventListener("change", () => listener(print.matches));
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => listener(print.matches));
  window.addEventListener("beforeprint", () => listener(true));
  window.addEventListener("afterprint", () => listener(false));
}

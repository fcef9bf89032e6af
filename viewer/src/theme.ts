import { rgb, type Rgb } from "./colours";

/** Colours of the stage that belong to the page, not to the mechanism. */
export interface Theme {
  readonly dark: boolean;
  readonly background: Rgb;
  readonly shadow: Rgb;
  readonly grid: Rgb;
  readonly lit: Rgb;
}

/** Reads them from the style sheet, which knows about dark pages and paper. */
export function readTheme(host: Element): Theme {
  const style = getComputedStyle(host);
  const colour = (name: string): Rgb => rgb(style.getPropertyValue(name));
  return {
    dark: style.getPropertyValue("--dark").trim() === "1",
    background: colour("--stage"),
    shadow: colour("--stage-shadow"),
    grid: colour("--stage-grid"),
    lit: colour("--lit"),
  };
}

/** Calls back when the theme may have changed; at once, because paper does not wait for the next frame. */
export function onThemeChange(listener: () => void): void {
  for (const query of ["(prefers-color-scheme: dark)", "print"]) {
    window.matchMedia(query).addEventListener("change", listener);
  }
  window.addEventListener("beforeprint", listener);
  window.addEventListener("afterprint", listener);
}

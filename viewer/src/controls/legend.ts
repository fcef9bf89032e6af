import { hex, onPage } from "../colours";
import { element } from "../dom";
import type { Role } from "../page_data";
import type { Player } from "../player";
import { onThemeChange, readTheme } from "../theme";

/** What the colours mean: only those that occur. */
export function legend(player: Player, host: HTMLElement): HTMLElement {
  const root = element("ul", { class: "legend", "aria-label": "Colours" });
  const fill = (paper = false): void => {
    const { dark } = readTheme(host, paper);
    const { palette } = player.data;
    const roles = player.roles();
    const link = (role: Role): boolean =>
      roles?.links.some((found, index) => found === role && index !== player.data.ground) ?? false;
    const joint = (role: Role): boolean => roles?.joints.includes(role) ?? false;
    const links = player.data.links.length > 1 && (roles === null || link("moving") || link("driven"));
    const entries: [shown: boolean, text: string, colours: readonly string[]][] = [
      [true, "ground", [palette.ground]],
      [links, roles === null ? "links" : "moving links", palette.moving_links],
      [joint("driven"), "driven joint", [palette.driven]],
      [roles === null || joint("moving"), roles === null ? "joints" : "moving joints", [palette.moving_joint]],
      [link("locked") || joint("locked"), "locked", [palette.locked]],
      [link("idle") || joint("idle"), "idle: moves without moving anything else", [palette.idle]],
    ];
    root.replaceChildren(
      ...entries.flatMap(([shown, text, colours]) => {
        if (!shown) return [];
        const swatches = colours.map((colour) => {
          const swatch = element("span", { class: "swatch" });
          swatch.style.backgroundColor = hex(onPage(colour, dark));
          return swatch;
        });
        return [element("li", {}, element("span", { class: "swatches", "aria-hidden": "true" }, ...swatches), text)];
      }),
    );
  };
  player.onChange((change) => {
    if (change === "motion") fill();
  });
  onThemeChange(fill);
  fill();
  return root;
}

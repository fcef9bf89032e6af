import { element } from "../dom";
import type { Player } from "../player";
import { tickClass, visit } from "./transport";
import { valueText } from "../variables";

/** Everything met on the way as a list that fingers and screen readers can use: choosing an entry goes there. */
export function eventList(player: Player): HTMLElement {
  const summary = element("summary");
  const list = element("ol");
  const root = element("details", { class: "met" }, summary, list);
  const fill = (): void => {
    const events = player.events();
    root.hidden = events.length === 0;
    summary.textContent = `Met on the way (${events.length})`;
    list.replaceChildren(
      ...events.map((event) => {
        const row = player.motion?.values.subarray(event.sample * player.variables.length);
        const { driven } = player;
        const value = driven === null ? undefined : row?.[driven.column];
        const place =
          driven === null || value === undefined ? "" : ` at ${driven.name} = ${valueText(value, driven.unit, player.data.extent)}`;
        const button = element(
          "button",
          { type: "button" },
          element("span", { class: `tick ${tickClass(event)}`, "aria-hidden": "true" }),
          element("span", {}, event.text, element("small", {}, place)),
        );
        button.addEventListener("click", () => visit(player, event));
        return element("li", {}, button);
      }),
    );
  };
  player.onChange((change) => {
    if (change === "motion") fill();
  });
  fill();
  return root;
}

/** Which variables are held in this motion, where the branch has more freedoms than one. */
export function heldNote(player: Player): HTMLElement {
  const root = element("p", { class: "held" });
  const fill = (): void => {
    const held = player.motion?.held ?? [];
    root.hidden = held.length === 0;
    const texts = held.map(({ column, value }) => {
      const variable = player.variables[column];
      return variable === undefined ? "" : `${variable.name} = ${valueText(value, variable.unit, player.data.extent)}`;
    });
    root.textContent = `Held: ${texts.join(", ")}`;
  };
  player.onChange((change) => {
    if (change === "motion") fill();
  });
  fill();
  return root;
}

import { element } from "../dom";
import type { LoopMode, Player } from "../player";
import type { Stage, ViewName } from "../stage/stage";

/** A row of buttons of which one is down; the browser's own radio buttons, so that arrow keys work in it. */
function choice<T>(
  label: string,
  name: string,
  entries: readonly (readonly [text: string, value: T])[],
  chosen: T,
  choose: (value: T) => void,
): { root: HTMLElement; show: (value: T | null) => void } {
  const inputs = entries.map(([text, value]) => {
    const input = element("input", { type: "radio", name, "aria-label": `${label} ${text}` });
    input.checked = value === chosen;
    input.addEventListener("change", () => choose(value));
    return { input, value, label: element("label", {}, input, element("span", {}, text)) };
  });
  const root = element(
    "fieldset",
    { class: "choice" },
    element("legend", {}, label),
    element("div", { class: "segments" }, ...inputs.map((entry) => entry.label)),
  );
  const show = (value: T | null): void => {
    for (const entry of inputs) entry.input.checked = entry.value === value;
  };
  return { root, show };
}

function selection(
  label: string,
  entries: readonly (readonly [text: string, value: string])[],
  choose: (value: string) => void,
): { root: HTMLElement; select: HTMLSelectElement } {
  const select = element("select", {}, ...entries.map(([text, value]) => element("option", { value }, text)));
  select.addEventListener("change", () => choose(select.value));
  return { root: element("label", { class: "selection" }, element("span", { class: "label" }, label), select), select };
}

/** Which branch is shown: only where there is a choice. */
export function branchChoice(player: Player): HTMLElement | null {
  const { branches } = player.data;
  if (branches.length < 2) return null;
  const { root, show } = choice(
    "Branch",
    "branch",
    branches.map((branch, index) => [branch.name, index] as const),
    player.branch,
    (index) => player.switchBranch(index ?? 0),
  );
  root.classList.add("branches");
  player.onChange((change) => {
    if (change === "motion") show(player.branch);
  });
  return root;
}

/** Which variable is driven: all that any motion of the present branch offers. */
export function driveChoice(player: Player): HTMLElement {
  const { root, select } = selection("Driven", [], (value) => {
    const [motion = -1, column = -1] = value.split(" ").map(Number);
    player.drive(column, motion);
  });
  const fill = (): void => {
    const branch = player.branch === null ? undefined : player.data.branches[player.branch];
    const motions = branch?.motions ?? [];
    const pairs = motions.flatMap((motion) =>
      (player.data.motions[motion]?.drives ?? []).map((column) => ({ motion, column })),
    );
    select.replaceChildren(
      ...pairs.map(({ motion, column }) => {
        const variable = player.variables[column];
        const unit = variable === undefined ? "" : ` (${variable.unit})`;
        const several = motions.length > 1 ? `, motion ${motions.indexOf(motion) + 1}` : "";
        return element(
          "option",
          { value: `${motion} ${column}` },
          `${variable?.name ?? `variable ${column}`}${unit}${several}`,
        );
      }),
    );
    select.value = `${player.motion?.index ?? -1} ${player.column ?? -1}`;
    root.hidden = pairs.length === 0;
  };
  player.onChange((change) => {
    if (change === "motion") fill();
  });
  fill();
  return root;
}

const SPEEDS = [
  ["¼", 0.25],
  ["½", 0.5],
  ["1", 1],
  ["2", 2],
  ["4", 4],
] as const;

export function speedChoice(player: Player): HTMLElement {
  return choice("Speed", "speed", SPEEDS, 1, (speed) => player.setSpeed(speed)).root;
}

const LOOPS: readonly LoopMode[] = ["loop", "back and forth", "once"];

export function loopChoice(player: Player): HTMLElement {
  const { root, select } = selection(
    "Repeat",
    LOOPS.map((loop) => [loop, loop]),
    (value) => player.setLoop(LOOPS.find((loop) => loop === value) ?? "loop"),
  );
  const show = (): void => {
    if (select.value !== player.loop) select.value = player.loop;
  };
  player.onChange((change) => {
    if (change !== "pose") show();
  });
  show();
  return root;
}

const VIEWS: readonly (readonly [text: string, view: ViewName, title: string])[] = [
  ["Home", "home", "View as at first"],
  ["x", "x", "Look along x"],
  ["y", "y", "Look along y"],
  ["z", "z", "Look along z"],
];

export function viewButtons(stage: Stage, gently: () => boolean): HTMLElement {
  const buttons = VIEWS.map(([text, view, title]) => {
    const button = element("button", { type: "button", title, "aria-label": title }, text);
    button.addEventListener("click", () => stage.look(view, gently()));
    return button;
  });
  return group("View", buttons);
}

export function toggles(stage: Stage): HTMLElement {
  const toggle = (text: string, on: () => boolean, set: (on: boolean) => void): HTMLElement => {
    const button = element("button", { type: "button", "aria-pressed": String(on()) }, text);
    button.addEventListener("click", () => {
      set(!on());
      button.setAttribute("aria-pressed", String(on()));
    });
    return button;
  };
  return group("Show", [
    toggle("axes", () => stage.axes, (on) => stage.showAxes(on)),
    toggle("paths", () => stage.paths, (on) => stage.showPaths(on)),
  ]);
}

function group(label: string, buttons: readonly HTMLElement[]): HTMLElement {
  return element(
    "div",
    { class: "choice", role: "group", "aria-label": label },
    element("span", { class: "label", "aria-hidden": "true" }, label),
    element("div", { class: "segments" }, ...buttons),
  );
}

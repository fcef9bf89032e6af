import { element } from "../dom";
import type { Player } from "../player";
import type { Stage } from "../stage/stage";
import { toggle } from "./transport";

/** Part of the motion that one press of an arrow key goes. */
const STEP = 1 / 100;
/** Angle that one press turns the view by. */
const TURN = Math.PI / 24;
const ZOOM = 1.15;

/** Keys while the picture or its controls have the focus. */
export function followKeys(roots: readonly HTMLElement[], player: Player, stage: Stage | null): void {
  const press = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.altKey || event.metaKey || usesItself(event)) return;
    if (act(event, player, stage)) event.preventDefault();
  };
  for (const root of roots) root.addEventListener("keydown", press);
}

/** Buttons, lists and radio buttons need some of the keys for themselves. */
function usesItself(event: KeyboardEvent): boolean {
  const target = event.target;
  if (!(target instanceof HTMLElement)) return false;
  const { key } = event;
  if (target.matches("button, summary")) return key === " " || key === "Enter";
  if (target.matches("select")) return !"[]".includes(key);
  if (target.matches("input[type=radio]")) return key === " " || key.startsWith("Arrow");
  return false;
}

function act(event: KeyboardEvent, player: Player, stage: Stage | null): boolean {
  const { motion } = player;
  if (event.shiftKey && event.key.startsWith("Arrow")) {
    if (stage === null) return false;
    const [aside, over] = TURNS[event.key] ?? [0, 0];
    stage.turn(aside * TURN, over * TURN);
    return true;
  }
  switch (event.key) {
    case " ":
      toggle(player);
      return true;
    case "ArrowLeft":
    case "ArrowRight": {
      if (motion === null) return false;
      const step = STEP * (motion.last - motion.first);
      player.pause();
      player.scrub(player.arclength + (event.key === "ArrowLeft" ? -step : step));
      return true;
    }
    case "Home":
      if (motion === null) return false;
      player.pause();
      player.scrub(motion.arclengths[motion.start] ?? motion.first);
      return true;
    case "[":
    case "]": {
      const count = player.data.branches.length;
      if (count < 2) return false;
      player.switchBranch(((player.branch ?? 0) + (event.key === "[" ? count - 1 : 1)) % count);
      return true;
    }
    case "+":
    case "=":
      stage?.zoom(ZOOM);
      return stage !== null;
    case "-":
      stage?.zoom(1 / ZOOM);
      return stage !== null;
    default:
      return false;
  }
}

const TURNS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

const LIST: readonly (readonly [keys: readonly string[], meaning: string])[] = [
  [["Space"], "play or pause"],
  [["←", "→"], "go back or on a little"],
  [["Home"], "back to the start"],
  [["[", "]"], "previous or next branch"],
  [["+", "−"], "nearer or farther"],
  [["Shift ←", "→", "↑", "↓"], "turn the view"],
];

export function keyList(): HTMLElement {
  return element(
    "details",
    { class: "keys" },
    element("summary", {}, "Keys"),
    element(
      "dl",
      {},
      ...LIST.flatMap(([keys, meaning]) => [
        element("dt", {}, ...keys.flatMap((key) => [element("kbd", {}, key), " "])),
        element("dd", {}, meaning),
      ]),
    ),
  );
}

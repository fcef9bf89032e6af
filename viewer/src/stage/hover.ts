import type { Lights, Thing } from "../lights";
import type { Role } from "../page_data";
import type { Player } from "../player";
import type { Tooltip } from "../tooltip";
import { valueText } from "../variables";
import type { Stage } from "./stage";

/** A finger that moves farther than this turns the view; one that does not has tapped. */
const TAP = 8;

/** Tells what the pointer is on in the picture, and lights it on the page. */
export function followPointer(stage: Stage, player: Player, lights: Lights, tooltip: Tooltip): void {
  const { canvas } = stage;
  let pressed: { x: number; y: number } | null = null;
  let over: { x: number; y: number } | null = null;
  const look = (x: number, y: number, finger: boolean): void => {
    const thing = stage.pick(x, y, finger);
    lights.set(thing === null ? [] : [thing]);
    canvas.classList.toggle("pointing", thing !== null);
    if (thing === null) tooltip.hide();
    else tooltip.show(describe(thing, player), x, y);
  };
  const leave = (): void => {
    over = null;
    lights.set([]);
    tooltip.hide();
  };
  canvas.addEventListener("pointerdown", (event) => {
    pressed = { x: event.clientX, y: event.clientY };
    tooltip.hide();
  });
  canvas.addEventListener("pointermove", (event) => {
    if (event.pointerType !== "mouse") return;
    over = { x: event.clientX, y: event.clientY };
    if (event.buttons === 0) look(over.x, over.y, false);
  });
  canvas.addEventListener("pointerup", (event) => {
    const moved = pressed === null ? Infinity : Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y);
    pressed = null;
    if (event.pointerType !== "mouse" && moved < TAP) look(event.clientX, event.clientY, true);
  });
  canvas.addEventListener("pointerleave", (event) => {
    // A finger that is lifted leaves too; what it tapped stays lit until the next tap.
    if (event.pointerType === "mouse") leave();
  });
  document.addEventListener("pointerdown", (event) => {
    if (event.pointerType !== "mouse" && event.target !== canvas) tooltip.hide();
  });
  player.onChange(() => {
    // What moves away under a resting pointer is no longer pointed at.
    if (over !== null && pressed === null) look(over.x, over.y, false);
  });
}

const ROLE_WORDS: Readonly<Record<Role, string>> = {
  ground: "ground",
  driven: "driven",
  moving: "moves",
  locked: "locked",
  idle: "idle",
};

/** Name, and what is known: the kind of a joint, its freedoms, and its values at present. */
export function describe(thing: Thing, player: Player): string[] {
  const { data } = player;
  const roles = player.roles();
  if (thing.kind === "joint") {
    const joint = data.joints[thing.index];
    if (joint === undefined) return [];
    const role = roles?.joints[thing.index];
    const freedoms = joint.variables.length;
    const lines = [
      joint.name,
      `${joint.class} ${joint.kind}, ${freedoms} ${freedoms === 1 ? "freedom" : "freedoms"}${suffix(role)}`,
    ];
    for (let column = joint.first; column < joint.first + freedoms; column += 1) {
      const variable = player.variables[column];
      const value = player.values[column];
      if (variable === undefined || value === undefined) continue;
      const text = valueText(value, variable.unit, data.extent);
      lines.push(freedoms === 1 ? text : `${variable.name} = ${text}`);
    }
    return lines;
  }
  const link = data.links[thing.index];
  const role = thing.index === data.ground ? "ground" : roles?.links[thing.index];
  return link === undefined ? [] : [link.name, `link${suffix(role)}`];
}

function suffix(role: Role | undefined): string {
  return role === undefined ? "" : `, ${ROLE_WORDS[role]}`;
}

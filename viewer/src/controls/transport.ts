import { element, setText } from "../dom";
import { atMostEvery } from "../frames";
import type { EventData } from "../page_data";
import type { Player } from "../player";
import { valueText } from "../variables";
import { icon } from "./icons";

/** How often figures change while the mechanism plays. */
export const READ_MILLISECONDS = 50;

/** The play button, the scrubber with the marks of what is met on the way, and the value of the driven variable. */
export class Transport {
  readonly root: HTMLElement;
  private readonly button = element("button", { type: "button", class: "play" });
  private readonly scrubber = element("input", {
    type: "range",
    class: "scrubber",
    step: "any",
    "aria-label": "Place along the motion",
  });
  private readonly ticks = element("div", { class: "ticks", "aria-hidden": "true" });
  private readonly name = element("span", { class: "name" });
  private readonly value = element("span", { class: "value" });
  private shownIcon: "play" | "pause" | null = null;

  constructor(private readonly player: Player) {
    const readout = element("div", { class: "readout" }, this.name, this.value);
    const track = element("div", { class: "track" }, this.scrubber, this.ticks);
    this.root = element("div", { class: "transport" }, this.button, track, readout);
    this.button.addEventListener("click", () => toggle(player));
    this.scrubber.addEventListener("input", () => {
      player.pause();
      player.scrub(Number(this.scrubber.value));
    });
    const later = atMostEvery(READ_MILLISECONDS, () => this.refresh());
    player.onChange((change) => {
      if (change === "motion") this.mark();
      if (change === "pose" && player.playing) later();
      else this.refresh();
    });
    this.mark();
    this.refresh();
  }

  private refresh(): void {
    const { player, scrubber } = this;
    this.root.hidden = player.motion === null;
    const wanted = player.playing ? "pause" : "play";
    if (wanted !== this.shownIcon) {
      this.shownIcon = wanted;
      this.button.replaceChildren(icon(wanted));
      this.button.setAttribute("aria-label", player.playing ? "Pause" : "Play");
    }
    const { motion, driven } = player;
    if (motion === null) return;
    if (Number(scrubber.value) !== player.arclength) scrubber.value = String(player.arclength);
    if (driven === null) return;
    const text = valueText(player.values[driven.column] ?? NaN, driven.unit, player.data.extent);
    setText(this.name, driven.name);
    setText(this.value, text);
    const event = player.eventNear(0.004);
    scrubber.setAttribute("aria-valuetext", `${driven.name} = ${text}${event === null ? "" : `; ${event.text}`}`);
  }

  /** Sets the range and a mark for every event. */
  private mark(): void {
    const { motion } = this.player;
    if (motion === null) return;
    this.scrubber.min = String(motion.first);
    this.scrubber.max = String(motion.last);
    this.scrubber.value = String(this.player.arclength);
    const length = motion.last - motion.first || 1;
    this.ticks.replaceChildren(
      ...this.player.events().map((event) => {
        const tick = element("span", { class: `tick ${tickClass(event)}`, title: event.text });
        tick.style.left = `${(100 * (event.arclength - motion.first)) / length}%`;
        tick.addEventListener("click", () => visit(this.player, event));
        return tick;
      }),
    );
  }
}

/** Goes to an event and stays there. */
export function visit(player: Player, event: EventData): void {
  player.pause();
  player.scrub(event.arclength);
}

export function toggle(player: Player): void {
  if (player.playing) player.pause();
  else player.play();
}

/** Kinds of events by how they are marked. */
export function tickClass(event: EventData): string {
  switch (event.kind) {
    case "bifurcation":
    case "tangential":
      return "crossing";
    case "joint_limit":
      return "limit";
    case "dead_centre":
      return "dead-centre";
    default:
      return "singular";
  }
}

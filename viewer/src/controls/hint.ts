import { element, setText } from "../dom";
import { atMostEvery } from "../frames";
import type { EventData } from "../page_data";
import type { Player } from "../player";
import { READ_MILLISECONDS, tickClass } from "./transport";

/** How near an event must be to be told of, in parts of the motion's length. */
const NEAR_CROSSING = 0.035;
const NEAR = 0.012;

/**
 * One line under the scrubber: what is met here, and where branches cross, the way over to the others. It keeps its place
 * when it is empty, so that nothing jumps.
 */
export class Hint {
  readonly root = element("div", { class: "hint" });
  private readonly text = element("span");
  private readonly ways = element("span", { class: "ways" });
  private offered = "";

  constructor(private readonly player: Player) {
    this.root.append(this.text, this.ways);
    const later = atMostEvery(READ_MILLISECONDS, () => this.refresh());
    player.onChange((change) => {
      if (change === "pose" && player.playing) later();
      else this.refresh();
    });
    this.refresh();
  }

  private refresh(): void {
    const { player } = this;
    const crossing = player.eventNear(NEAR_CROSSING, (event) => event.home && isCrossing(event));
    const others = crossing === null ? [] : this.otherBranches();
    const event = others.length > 0 ? crossing : player.eventNear(NEAR);
    this.root.className = `hint${event === null ? "" : ` ${tickClass(event)}`}`;
    const still = player.still;
    if (still !== null) setText(this.text, still);
    else if (others.length > 0) setText(this.text, "Branches cross here:");
    else setText(this.text, event?.text ?? "");
    this.offer(others);
  }

  private otherBranches(): number[] {
    return this.player.data.branches.flatMap((branch, index) =>
      index !== this.player.branch && branch.motions.length > 0 ? [index] : [],
    );
  }

  /** Buttons are made anew only when the offer changes: one that is pressed must not vanish under the finger. */
  private offer(others: readonly number[]): void {
    const key = others.join(" ");
    if (key === this.offered) return;
    this.offered = key;
    this.ways.replaceChildren(
      ...others.map((index) => {
        const name = this.player.data.branches[index]?.name ?? "";
        const way = element("button", { type: "button", class: "way" }, `switch to ${name}`);
        way.addEventListener("click", () => this.player.switchBranch(index));
        return way;
      }),
    );
  }
}

function isCrossing(event: EventData): boolean {
  return event.kind === "bifurcation" || event.kind === "tangential";
}

import { Pace } from "./pace";
import { Motions, columnCount, type EventData, type Motion, type PageData, type Role, type Roles } from "./page_data";
import { nearestSample } from "./nearest_sample";
import { variablesOf, type Variable } from "./variables";

export type LoopMode = "loop" | "back and forth" | "once";

/** What changed: the pose only, or also which motion is shown and by what it is driven, or how it plays. */
export type Change = "pose" | "motion" | "playing";

/**
 * Where the mechanism is and how it moves on: the one state that the picture, the controls and the plots follow.
 */
export class Player {
  readonly variables: readonly Variable[];
  readonly motions: Motions;
  /** Present pose: world_from_link of every link, relative to the page's centre. */
  readonly pose: Float64Array;
  /** Present values of all joint variables; empty where the mechanism stands still. */
  values: Float64Array = new Float64Array(0);
  motion: Motion | null = null;
  branch: number | null = null;
  /** Column of the driven variable. */
  column: number | null = null;
  arclength = 0;
  playing = false;
  speed = 1;
  loop: LoopMode = "loop";

  private direction = 1;
  private pace: Pace | null = null;
  private readonly listeners: ((change: Change) => void)[] = [];

  constructor(readonly data: PageData) {
    this.motions = new Motions(data);
    this.variables = variablesOf(data);
    this.pose = Float64Array.from(data.home.flat());
    const first = data.branches.findIndex((branch) => branch.motions.length > 0);
    const motion = data.branches[first]?.motions[0];
    if (motion !== undefined) {
      this.enter(motion, null);
    } else if (data.branches.length > 0) {
      this.branch = 0;
    }
  }

  onChange(listener: (change: Change) => void): void {
    this.listeners.push(listener);
  }

  /** Why nothing can be shown to move, if so. */
  get still(): string | null {
    if (this.motion !== null) return null;
    const branch = this.branch === null ? undefined : this.data.branches[this.branch];
    return branch?.still ?? this.data.still ?? "No motion is known.";
  }

  /** Position between samples: 3.25 is a quarter of the way from sample 3 to sample 4. */
  get samplePosition(): number {
    if (this.motion === null) return 0;
    const times = this.motion.arclengths;
    const i = this.motion.poseTrack.interval(this.arclength);
    const step = (times[i + 1] ?? times[i]!) - times[i]!;
    return step > 0 ? i + (this.arclength - times[i]!) / step : i;
  }

  get driven(): Variable | null {
    return this.column === null ? null : (this.variables[this.column] ?? null);
  }

  /** Goes to an arclength; beyond the ends it goes round where the motion closes, else to the end. */
  scrub(arclength: number): void {
    const { motion } = this;
    if (motion === null || !Number.isFinite(arclength)) return;
    const length = motion.last - motion.first;
    let wanted = arclength;
    if (motion.closed && length > 0 && (wanted < motion.first || wanted > motion.last)) {
      wanted -= length * Math.floor((wanted - motion.first) / length);
    }
    this.arclength = Math.min(motion.last, Math.max(motion.first, wanted));
    this.interpolate();
    this.tell("pose");
  }

  play(): void {
    const { motion } = this;
    if (motion === null || this.playing) return;
    // From the end of a motion that plays once, it starts again.
    if (this.loop === "once" && this.arclength >= motion.last) this.scrub(motion.first);
    if (this.loop !== "back and forth") this.direction = 1;
    this.playing = true;
    this.tell("playing");
  }

  pause(): void {
    if (!this.playing) return;
    this.playing = false;
    this.tell("playing");
  }

  setLoop(loop: LoopMode): void {
    this.loop = loop;
    if (loop !== "back and forth") this.direction = 1;
    this.tell("playing");
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.tell("playing");
  }

  /** Moves on by a time in seconds. */
  advance(seconds: number): void {
    const { motion, pace } = this;
    if (motion === null || pace === null || !this.playing) return;
    // Half a step with the pace here, to have the pace in the middle of the step.
    const step = this.speed * seconds * this.direction;
    const middle = this.arclength + 0.5 * step * pace.at(this.arclength);
    const next = this.arclength + step * pace.at(Math.min(motion.last, Math.max(motion.first, middle)));
    const outside = next >= motion.last || next <= motion.first;
    if (!outside || (motion.closed && this.loop === "loop")) {
      this.scrub(next);
      return;
    }
    if (this.loop === "back and forth") {
      this.direction = next >= motion.last ? -1 : 1;
      this.scrub(next >= motion.last ? motion.last : motion.first);
    } else if (this.loop === "once") {
      this.scrub(motion.last);
      this.pause();
    } else {
      this.scrub(next >= motion.last ? motion.first : next);
    }
  }

  /** Shows another branch, at the pose nearest to the present one; at a crossing that is the same pose. */
  switchBranch(index: number): void {
    const branch = this.data.branches[index];
    if (branch === undefined || index === this.branch) return;
    const [motion] = branch.motions;
    if (motion === undefined) {
      this.branch = index;
      this.motion = null;
      this.column = null;
      this.pace = null;
      this.playing = false;
      this.values = new Float64Array(0);
      this.pose.set(this.data.home.flat());
      this.tell("motion");
      return;
    }
    this.enter(motion, null);
    this.tell("motion");
  }

  /** Drives another variable, in the motion given or in one of this branch in which it can be driven. */
  drive(column: number, motion?: number): void {
    const branch = this.branch === null ? undefined : this.data.branches[this.branch];
    const has = (index: number): boolean => this.data.motions[index]?.drives.includes(column) ?? false;
    const candidates = [motion, this.motion?.index, ...(branch?.motions ?? [])];
    const wanted = candidates.find((index) => index !== undefined && has(index));
    if (wanted === undefined) return;
    this.enter(wanted, column);
    this.tell("motion");
  }

  /** The roles of links and joints with the variable that is driven now; null where they are not known. */
  roles(): Roles | null {
    const { motion } = this;
    if (motion === null) return this.data.roles ?? null;
    const usual = this.variables[motion.drives[0] ?? -1]?.joint;
    const driven = this.driven?.joint;
    const joints = motion.roles.joints.map((role, joint): Role => {
      if (joint === driven) return "driven";
      return joint === usual && role === "driven" ? "moving" : role;
    });
    return { links: motion.roles.links, joints };
  }

  /** Events that matter with the present driven variable: the dead centres of others are left out. */
  events(): readonly EventData[] {
    return (this.motion?.events ?? []).filter(
      (event) => event.kind !== "dead_centre" || event.column === this.column,
    );
  }

  /** The event within a part of the motion's length from here, the nearest one if there are several. */
  eventNear(share: number, wanted: (event: EventData) => boolean = () => true): EventData | null {
    const { motion } = this;
    if (motion === null) return null;
    const length = motion.last - motion.first;
    let [best, least]: [EventData | null, number] = [null, share * length];
    for (const event of this.events()) {
      let distance = Math.abs(event.arclength - this.arclength);
      if (motion.closed) distance = Math.min(distance, length - distance);
      if (distance <= least && wanted(event)) [best, least] = [event, distance];
    }
    return best;
  }

  private enter(index: number, column: number | null): void {
    const motion = this.motions.get(index);
    const coming = this.motion === null ? motion.start : nearestSample(motion, this.pose, this.data.extent);
    const samePlace = this.motion === motion;
    const shape = (m: Motion | null): boolean | undefined => m?.closed;
    const otherShape = shape(this.motion) !== motion.closed;
    this.motion = motion;
    this.branch = motion.branch;
    this.column = column ?? motion.drives[0] ?? null;
    this.pace = new Pace(motion, this.driven ?? undefined, this.variables, this.data.extent);
    // Going round suits what closes; what has ends goes to and fro.
    if (otherShape && this.loop !== "once") this.loop = motion.closed ? "loop" : "back and forth";
    if (samePlace) return;
    this.direction = 1;
    this.values = new Float64Array(columnCount(this.data));
    this.arclength = motion.arclengths[coming] ?? motion.first;
    this.interpolate();
  }

  private interpolate(): void {
    const { motion, pose } = this;
    if (motion === null) return;
    motion.valueTrack.at(this.arclength, this.values);
    motion.poseTrack.at(this.arclength, pose);
    for (let q = 3; q + 3 < pose.length; q += 7) {
      const norm = Math.hypot(pose[q]!, pose[q + 1]!, pose[q + 2]!, pose[q + 3]!) || 1;
      for (let c = q; c < q + 4; c += 1) pose[c]! /= norm;
    }
  }

  private tell(change: Change): void {
    for (const listener of this.listeners) listener(change);
  }
}

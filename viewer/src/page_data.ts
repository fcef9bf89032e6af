import { decodeFloats } from "./base64";
import { Track, seamOfPoses, seamOfValues } from "./track";

/** What the page says about its mechanism, as written in its JSON element. Lengths in metres. */
export interface PageData {
  readonly schema: string;
  readonly mechanism: string;
  readonly centre: readonly [number, number, number];
  readonly extent: number;
  readonly radius: number;
  readonly view: readonly [number, number, number];
  readonly up: readonly [number, number, number];
  readonly ground: number;
  readonly links: readonly LinkData[];
  readonly joints: readonly JointData[];
  readonly cycles: readonly { readonly name: string; readonly joints: readonly number[] }[];
  readonly shapes: readonly ShapeData[];
  readonly home: readonly (readonly number[])[];
  readonly palette: Palette;
  readonly branches: readonly BranchData[];
  readonly still: string | null;
  readonly motions: readonly MotionData[];
  /** Roles while nothing moves; unknown where left out. */
  readonly roles?: Roles;
  /** Points of links whose paths were asked for. */
  readonly points?: readonly PointData[];
}

export interface PointData {
  readonly name: string;
  readonly link: number;
  /** In the link's drawn frame (m). */
  readonly at: readonly [number, number, number];
}

export interface LinkData {
  readonly name: string;
  /**
   * Where its drawn frame stands in the link's own (m); at its origin where left out. Links whose own frame is far away are
   * drawn by a nearer one, parallel to it, so that single precision suffices; all poses and shapes are told by that.
   */
  readonly origin?: readonly [number, number, number];
}

export interface JointData {
  readonly name: string;
  readonly class: string;
  readonly kind: string;
  readonly links: readonly [number, number];
  /** Column of its first variable. */
  readonly first: number;
  readonly variables: readonly { readonly name: string; readonly unit: "rad" | "m" }[];
}

export type ShapeKind = "box" | "cylinder" | "sphere" | "arrow";

export interface ShapeData {
  readonly link: number;
  readonly joint: number | null;
  readonly axis: boolean;
  readonly kind: ShapeKind;
  readonly size: readonly [number, number, number];
  readonly pose: readonly number[];
}

export type Role = "ground" | "driven" | "moving" | "locked" | "idle";

export interface Roles {
  readonly links: readonly Role[];
  readonly joints: readonly Role[];
}

export interface Palette {
  readonly ground: string;
  readonly locked: string;
  readonly idle: string;
  readonly driven: string;
  readonly moving_joint: string;
  readonly axis: string;
  readonly moving_links: readonly string[];
}

export interface BranchData {
  readonly name: string;
  readonly dimension: number;
  readonly motions: readonly number[];
  readonly still: string | null;
}

export interface EventData {
  readonly arclength: number;
  readonly sample: number;
  readonly kind: string;
  readonly column: number | null;
  readonly home: boolean;
  readonly text: string;
}

interface MotionData {
  readonly branch: number;
  readonly closed: boolean;
  readonly samples: number;
  readonly arclengths: string;
  readonly values: string;
  readonly poses: string;
  readonly start: number;
  readonly drives: readonly number[];
  readonly held: readonly { readonly column: number; readonly value: number }[];
  readonly roles: Roles;
  readonly events: readonly EventData[];
  readonly length_unit: number;
}

/** A motion with its numbers decoded. */
export interface Motion {
  readonly index: number;
  readonly branch: number;
  readonly closed: boolean;
  readonly start: number;
  readonly drives: readonly number[];
  readonly held: MotionData["held"];
  readonly roles: Roles;
  readonly events: readonly EventData[];
  readonly arclengths: Float32Array;
  readonly first: number;
  readonly last: number;
  /** `samples × columns`. */
  readonly values: Float32Array;
  /** `samples × links × 7`. */
  readonly poses: Float32Array;
  readonly valueTrack: Track;
  readonly poseTrack: Track;
}

const SCHEMA = "kutzbach-page-1";

/** The page's data; null where there is none or it is of another kind. */
export function readPageData(): PageData | null {
  const text = document.getElementById("page-data")?.textContent;
  if (!text) return null;
  const data = JSON.parse(text) as PageData;
  return data.schema === SCHEMA ? data : null;
}

/** Decodes motions when they are first asked for: a page may hold many. */
export class Motions {
  private readonly decoded = new Map<number, Motion>();

  constructor(private readonly data: PageData) {}

  get(index: number): Motion {
    const known = this.decoded.get(index);
    if (known !== undefined) return known;
    const motion = decode(this.data, index);
    this.decoded.set(index, motion);
    return motion;
  }
}

/** Number of joint variables. */
export function columnCount(data: PageData): number {
  return data.joints.reduce((count, joint) => Math.max(count, joint.first + joint.variables.length), 0);
}

function decode(data: PageData, index: number): Motion {
  const motion = data.motions[index];
  if (motion === undefined) throw new RangeError(`no motion ${index}`);
  const arclengths = decodeFloats(motion.arclengths);
  const values = decodeFloats(motion.values);
  const poses = decodeFloats(motion.poses);
  const columns = columnCount(data);
  const width = 7 * data.links.length;
  return {
    index,
    branch: motion.branch,
    closed: motion.closed,
    start: motion.start,
    drives: motion.drives,
    held: motion.held,
    roles: motion.roles,
    events: motion.events,
    arclengths,
    first: arclengths[0] ?? 0,
    last: arclengths[arclengths.length - 1] ?? 0,
    values,
    poses,
    valueTrack: new Track(arclengths, values, columns, motion.closed ? seamOfValues(values, columns) : null),
    poseTrack: new Track(arclengths, poses, width, motion.closed ? seamOfPoses(poses, width) : null),
  };
}

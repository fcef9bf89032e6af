import { BufferGeometry, Float32BufferAttribute, LineSegments, type ShaderMaterial } from "three";
import type { Rgb } from "../colours";
import type { Motion, PageData } from "../page_data";
import { rotationOf } from "./rotation";

/** A line that a joint's symbol describes, through every sample of a motion. */
interface Path {
  readonly link: number;
  readonly joint: number;
  /** Three coordinates for each sample, relative to the page's centre in units of its extent. */
  readonly points: Float64Array;
}

/** Up to so many joints, paths are shown without being asked for; beyond, they would hide the mechanism. */
export const PATHS_BY_DEFAULT = 30;

/** Paths shorter than this part of the mechanism's size are not worth a line, and as close together ones are the same. */
const SHORT = 0.01;
const SAME = 0.002;

/** The paths of all joints on links that move, each drawn once even where both its links describe it. */
export function pathsOf(data: PageData, motion: Motion): Path[] {
  const tried = new Set<string>();
  const found: Path[] = [];
  for (const shape of data.shapes) {
    if (shape.joint === null || shape.axis || tried.has(`${shape.joint} ${shape.link}`)) continue;
    tried.add(`${shape.joint} ${shape.link}`);
    const path = { link: shape.link, joint: shape.joint, points: trace(data, motion, shape.link, shape.pose) };
    const known = found.some((other) => other.joint === path.joint && distance(other.points, path.points) < SAME);
    if (!known && lengthOf(path.points) > SHORT) found.push(path);
  }
  return found;
}

function trace(data: PageData, motion: Motion, link: number, place: readonly number[]): Float64Array {
  const samples = motion.arclengths.length;
  const points = new Float64Array(3 * samples);
  const r = new Float64Array(9);
  const [x = 0, y = 0, z = 0] = place;
  for (let sample = 0; sample < samples; sample += 1) {
    const at = 7 * (sample * data.links.length + link);
    rotationOf(motion.poses, at + 3, r);
    for (let row = 0; row < 3; row += 1) {
      const turned = r[3 * row]! * x + r[3 * row + 1]! * y + r[3 * row + 2]! * z;
      points[3 * sample + row] = (turned + motion.poses[at + row]!) / data.extent;
    }
  }
  return points;
}

function lengthOf(points: Float64Array): number {
  let length = 0;
  for (let i = 3; i < points.length; i += 3) length += gap(points, i, points, i - 3);
  return length;
}

function distance(a: Float64Array, b: Float64Array): number {
  let most = 0;
  for (let i = 0; i < a.length; i += 3) most = Math.max(most, gap(a, i, b, i));
  return most;
}

function gap(a: Float64Array, i: number, b: Float64Array, j: number): number {
  return Math.hypot(a[i]! - b[j]!, a[i + 1]! - b[j + 1]!, a[i + 2]! - b[j + 2]!);
}

/** Draws paths as thin lines in the colours of their links. */
export class PathLines {
  readonly lines: LineSegments;
  private paths: readonly Path[] = [];

  constructor(material: ShaderMaterial) {
    this.lines = new LineSegments(new BufferGeometry(), material);
    this.lines.frustumCulled = false;
  }

  set(paths: readonly Path[]): void {
    this.paths = paths;
    const places: number[] = [];
    for (const { points } of paths) {
      for (let i = 3; i < points.length; i += 3) {
        places.push(...points.subarray(i - 3, i), ...points.subarray(i, i + 3));
      }
    }
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry();
    this.lines.geometry.setAttribute("position", new Float32BufferAttribute(places, 3));
    this.lines.geometry.setAttribute("tint", new Float32BufferAttribute(new Float32Array(places.length), 3));
  }

  paint(colourOf: (path: Path) => Rgb): void {
    const tints = this.lines.geometry.getAttribute("tint");
    if (tints === undefined) return;
    let point = 0;
    for (const path of this.paths) {
      const colour = colourOf(path);
      const count = 2 * (path.points.length / 3 - 1);
      for (let i = 0; i < count; i += 1) tints.setXYZ(point + i, ...colour);
      point += count;
    }
    tints.needsUpdate = true;
  }
}

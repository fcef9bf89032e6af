import { BufferGeometry, Float32BufferAttribute, Mesh, type ShaderMaterial } from "three";
import type { Rgb } from "../colours";
import type { Motion, PageData } from "../page_data";
import { rotationOf } from "./rotation";

/** A line that a joint's symbol, or a point that was asked for, describes, through every sample of a motion. */
interface Path {
  readonly link: number;
  readonly joint: number | null;
  /** Three coordinates for each sample, relative to the page's centre in units of its extent. */
  readonly points: Float64Array;
}

/** Up to so many joints, paths are shown without being asked for; beyond, they would hide the mechanism. */
export const PATHS_BY_DEFAULT = 30;

/** Paths shorter than this part of the mechanism's size are not worth a line, and as close together ones are the same. */
const SHORT = 0.01;
const SAME = 0.002;

/** The paths of the points asked for; where there are none, of all joints on links that move, each once even where both its links describe it. */
export function pathsOf(data: PageData, motion: Motion): Path[] {
  const points = data.points ?? [];
  if (points.length > 0) return points.map(({ link, at }) => ({ link, joint: null, points: trace(data, motion, link, at) }));
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

/** Points of a path that lie on the line between their neighbours, to this part of the mechanism's size, are left out. */
const STRAIGHT = 4e-4;

/** Indices of the points that a drawing of the path needs: as far ahead as the points between stay near the chord. */
export function neededPoints(points: Float64Array): number[] {
  const count = points.length / 3;
  const needed = [0];
  let from = 0;
  while (from < count - 1) {
    let to = from + 1;
    while (to + 1 < count && straight(points, from, to + 1)) to += 1;
    needed.push(to);
    from = to;
  }
  return needed;
}

function straight(points: Float64Array, from: number, to: number): boolean {
  const [ax, ay, az] = [points[3 * from]!, points[3 * from + 1]!, points[3 * from + 2]!];
  const [ux, uy, uz] = [points[3 * to]! - ax, points[3 * to + 1]! - ay, points[3 * to + 2]! - az];
  const square = ux * ux + uy * uy + uz * uz;
  for (let i = from + 1; i < to; i += 1) {
    const [px, py, pz] = [points[3 * i]! - ax, points[3 * i + 1]! - ay, points[3 * i + 2]! - az];
    const share = square > 0 ? Math.min(1, Math.max(0, (px * ux + py * uy + pz * uz) / square)) : 0;
    if (Math.hypot(px - share * ux, py - share * uy, pz - share * uz) > STRAIGHT) return false;
  }
  return true;
}

/** Draws paths as thin lines in the colours of their links. */
export class PathLines {
  readonly mesh: Mesh;
  private paths: readonly { readonly path: Path; readonly corners: number }[] = [];

  constructor(material: ShaderMaterial) {
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
  }

  set(paths: readonly Path[]): void {
    const places: number[] = [];
    const along: number[] = [];
    const sides: number[] = [];
    const indices: number[] = [];
    this.paths = paths.map((path) => {
      const { points } = path;
      const needed = neededPoints(points);
      const first = sides.length;
      needed.forEach((point, i) => {
        const [before, after] = [needed[i - 1] ?? point, needed[i + 1] ?? point];
        const tangent = [0, 1, 2].map((c) => 0.05 * (points[3 * after + c]! - points[3 * before + c]!));
        for (const side of [-1, 1]) {
          places.push(...points.subarray(3 * point, 3 * point + 3));
          along.push(...tangent);
          sides.push(side);
        }
        const here = first + 2 * i;
        if (i > 0) indices.push(here - 2, here - 1, here, here, here - 1, here + 1);
      });
      return { path, corners: sides.length - first };
    });
    const geometry = new BufferGeometry();
    geometry.setIndex(indices);
    geometry.setAttribute("position", new Float32BufferAttribute(places, 3));
    geometry.setAttribute("along", new Float32BufferAttribute(along, 3));
    geometry.setAttribute("side", new Float32BufferAttribute(sides, 1));
    geometry.setAttribute("tint", new Float32BufferAttribute(new Float32Array(places.length), 3));
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;
  }

  paint(colourOf: (path: Path) => Rgb): void {
    const tints = this.mesh.geometry.getAttribute("tint");
    if (tints === undefined) return;
    let corner = 0;
    for (const { path, corners } of this.paths) {
      const colour = colourOf(path);
      for (let i = 0; i < corners; i += 1) tints.setXYZ(corner + i, ...colour);
      corner += corners;
    }
    tints.needsUpdate = true;
  }
}

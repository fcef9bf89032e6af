import { Vector3 } from "three";
import type { Motion, PageData, ShapeData } from "../page_data";
import { rotationOf } from "./rotation";

/** Poses looked at in each motion, and shapes looked at in all: enough to know where the mechanism goes. */
const POSES = 40;
const SHAPES = 400;

/**
 * Corners of the shapes in the poses of some motions and at home, relative to the page's centre in units of its extent:
 * what a picture must have room for; with the tips of axes
 * where these are shown.
 */
export function sweptPoints(data: PageData, motions: readonly Motion[], axes: boolean): Vector3[] {
  const bodies = data.shapes.filter((shape) => axes || !shape.axis);
  const every = Math.max(1, Math.ceil(bodies.length / SHAPES));
  const corners = bodies.filter((_, index) => index % every === 0).map(cornersOf(data.extent));
  const points: Vector3[] = [];
  const rotation = new Float64Array(9);
  const add = (pose: ArrayLike<number>, start: number): void => {
    for (const { link, places } of corners) {
      const at = start + 7 * link;
      rotationOf(pose, at + 3, rotation);
      for (const place of places) points.push(turned(rotation, place, pose, at, data.extent));
    }
  };
  add(Float64Array.from(data.home.flat()), 0);
  for (const motion of motions) {
    const samples = motion.arclengths.length;
    const step = Math.max(1, Math.floor(samples / POSES));
    for (let sample = 0; sample < samples; sample += step) add(motion.poses, sample * 7 * data.links.length);
  }
  return points;
}

function turned(r: Float64Array, p: Vector3, pose: ArrayLike<number>, at: number, extent: number): Vector3 {
  return new Vector3(
    r[0]! * p.x + r[1]! * p.y + r[2]! * p.z + pose[at]! / extent,
    r[3]! * p.x + r[4]! * p.y + r[5]! * p.z + pose[at + 1]! / extent,
    r[6]! * p.x + r[7]! * p.y + r[8]! * p.z + pose[at + 2]! / extent,
  );
}

/** In the link's frame: both ends of a rod, all corners of anything stouter. */
function cornersOf(extent: number): (shape: ShapeData) => { link: number; places: Vector3[] } {
  const rotation = new Float64Array(9);
  return (shape) => {
    rotationOf(shape.pose, 3, rotation);
    const [a, b, c] = shape.size.map((size) => size / 2 / extent) as [number, number, number];
    const rod = shape.kind === "cylinder" && c > 4 * a;
    // An arrow starts at its origin: its tip is twice half its length away.
    const signs = shape.kind === "arrow" ? [[0, 0, 2]] : rod ? [[0, 0, -1], [0, 0, 1]] : CORNERS;
    const places = signs.map(([x = 0, y = 0, z = 0]) =>
      turned(rotation, new Vector3(x * a, y * b, z * c), shape.pose, 0, extent),
    );
    return { link: shape.link, places };
  };
}

const CORNERS = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].map((z) => [x, y, z])));

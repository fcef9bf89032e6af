import { BufferGeometry, Float32BufferAttribute, LineSegments, Vector3, Vector4, type ShaderMaterial } from "three";
import type { PageData } from "../page_data";
import { pole } from "./framing";

/** The sheet under or behind the mechanism that takes its shadow and a grid to read sizes by. */
export interface Floor {
  /** Unit normal towards the mechanism, and the offset along it. */
  readonly plane: Vector4;
  /** Direction in which shadows are thrown. */
  readonly light: Vector3;
  /** Width of a cell of the grid in metres. */
  readonly cell: number;
  readonly grid: LineSegments;
}

/** What is flatter than this part of its size lies on a board; anything else stands on the ground. */
const FLAT = 0.25;
const GAP = 0.05;
/** Cells of the grid along the mechanism's size, about. */
const CELLS = 8;
/** Part of a cell's width by which the grid reaches beyond the mechanism. */
const BORDER = 1;

export function floorFor(data: PageData, points: readonly Vector3[], material: ShaderMaterial): Floor {
  const view = new Vector3(...data.view);
  const up = pole(view, new Vector3(...data.up));
  const axes = [0, 1, 2] as const;
  const least = [0, 0, 0];
  const greatest = [0, 0, 0];
  axes.forEach((axis) => {
    const places = points.map((point) => point.getComponent(axis));
    least[axis] = places.reduce((a, b) => Math.min(a, b), Infinity);
    greatest[axis] = places.reduce((a, b) => Math.max(a, b), -Infinity);
  });
  const width = (axis: number): number => (greatest[axis] ?? 0) - (least[axis] ?? 0);
  const widest = Math.max(...axes.map(width));
  const thinnest = axes.reduce<number>((a, b) => (width(b) < width(a) ? b : a), 0);
  const upright = axes.reduce<number>((a, b) => (Math.abs(up.getComponent(b)) > Math.abs(up.getComponent(a)) ? b : a), 0);
  const flat = width(thinnest) < FLAT * widest && Math.abs(view.getComponent(thinnest)) > 0.2;
  const axis = flat ? thinnest : upright;
  const sign = flat ? Math.sign(view.getComponent(axis)) : Math.sign(up.getComponent(axis)) || 1;
  const level = sign > 0 ? (least[axis] ?? 0) - GAP : (greatest[axis] ?? 0) + GAP;
  const normal = new Vector3().setComponent(axis, sign);

  // Light comes from above the eye's left, but more straight down than aslant: shadows stay with what throws them.
  const right = new Vector3().crossVectors(up, view).normalize();
  const above = new Vector3().crossVectors(view, right).normalize();
  const light = normal.clone().negate().addScaledVector(right, 0.28).addScaledVector(above, -0.22);

  const cell = roundLength(data.extent / CELLS);
  const [u, v] = axes.filter((other) => other !== axis) as [number, number];
  const lines: number[] = [];
  const range = (along: number): [number, number] => {
    // Lines of the grid are at whole cells of the world, not of the picture.
    const origin = data.centre[along as 0 | 1 | 2];
    const low = Math.floor((origin + (least[along] ?? 0) * data.extent) / cell) - BORDER;
    const high = Math.ceil((origin + (greatest[along] ?? 0) * data.extent) / cell) + BORDER;
    return [low * cell - origin, high * cell - origin];
  };
  for (const [along, across] of [[u, v], [v, u]] as const) {
    const [low, high] = range(along);
    const [from, to] = range(across);
    const count = Math.min(200, Math.round((high - low) / cell));
    for (let i = 0; i <= count; i += 1) {
      for (const end of [from, to]) {
        const point = [0, 0, 0];
        point[along] = (low + i * cell) / data.extent;
        point[across] = end / data.extent;
        point[axis] = level;
        lines.push(...point);
      }
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(lines, 3));
  const grid = new LineSegments(geometry, material);
  grid.frustumCulled = false;
  grid.renderOrder = -2;
  return { plane: new Vector4(normal.x, normal.y, normal.z, sign * level), light, cell, grid };
}

/** The nearest of 1, 2, 5, 10, … in its power of ten. */
export function roundLength(length: number): number {
  if (!(length > 0) || !Number.isFinite(length)) return 1;
  const power = 10 ** Math.floor(Math.log10(length));
  const steps = [1, 2, 5, 10];
  const nearest = steps.reduce((a, b) =>
    Math.abs(Math.log(b * power) - Math.log(length)) < Math.abs(Math.log(a * power) - Math.log(length)) ? b : a,
  );
  return Number((nearest * power).toPrecision(3));
}

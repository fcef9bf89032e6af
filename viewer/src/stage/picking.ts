import type { ShapeKind } from "../page_data";

/** A ray in the frame in which matrices place their unit solids. The direction need not have unit length. */
export interface PickRay {
  readonly origin: readonly [number, number, number];
  readonly direction: readonly [number, number, number];
}

/**
 * Where along a ray a solid is met, in units of its direction; null where it is missed.
 *
 * `matrix` (4 × 4, by columns) takes the unit solid to its place; `slack` makes it thicker by so much on every side, so
 * that thin rods can be hit with a finger.
 */
export function hit(ray: PickRay, kind: ShapeKind, matrix: readonly number[], slack: number): number | null {
  const origin = [0, 0, 0];
  const direction = [0, 0, 0];
  const half = [0, 0, 0];
  for (let k = 0; k < 3; k += 1) {
    const column = matrix.slice(4 * k, 4 * k + 3);
    const size = Math.hypot(...column);
    if (!(size > 0)) return null;
    half[k] = 0.5 * size + slack;
    for (let i = 0; i < 3; i += 1) {
      const unit = column[i]! / size;
      origin[k]! += unit * (ray.origin[i]! - matrix[12 + i]!);
      direction[k]! += unit * ray.direction[i]!;
    }
  }
  // An arrow starts at its origin; the others have theirs in the middle.
  if (kind === "arrow") origin[2]! -= half[2]! - slack;
  return kind === "sphere" ? hitEllipsoid(origin, direction, half) : hitBox(origin, direction, half, kind === "cylinder");
}

/** Enters the box between the last of the near faces and the first of the far ones; a cylinder cuts its corners off. */
function hitBox(origin: number[], direction: number[], half: number[], round: boolean): number | null {
  let [enter, leave] = [0, Infinity];
  const cut = (near: number, far: number): void => {
    enter = Math.max(enter, Math.min(near, far));
    leave = Math.min(leave, Math.max(near, far));
  };
  for (let k = round ? 2 : 0; k < 3; k += 1) {
    if (direction[k] === 0) {
      if (Math.abs(origin[k]!) > half[k]!) return null;
    } else {
      cut((-half[k]! - origin[k]!) / direction[k]!, (half[k]! - origin[k]!) / direction[k]!);
    }
  }
  if (round) {
    const roots = quadric(origin, direction, half, 2);
    if (roots === null) return null;
    cut(...roots);
  }
  return enter <= leave ? enter : null;
}

function hitEllipsoid(origin: number[], direction: number[], half: number[]): number | null {
  const roots = quadric(origin, direction, half, 3);
  return roots === null || roots[1] < 0 ? null : Math.max(0, roots[0]);
}

/** Where the ray crosses Σ (x_k / half_k)² = 1 over the first `dimensions` coordinates. */
function quadric(origin: number[], direction: number[], half: number[], dimensions: number): [number, number] | null {
  let [a, b, c] = [0, 0, -1];
  for (let k = 0; k < dimensions; k += 1) {
    const [o, d] = [origin[k]! / half[k]!, direction[k]! / half[k]!];
    a += d * d;
    b += o * d;
    c += o * o;
  }
  if (a === 0) return c <= 0 ? [-Infinity, Infinity] : null;
  const discriminant = b * b - a * c;
  if (discriminant < 0) return null;
  const root = Math.sqrt(discriminant);
  return [(-b - root) / a, (-b + root) / a];
}

import { Vector3 } from "three";

/** Where the eye is and what it looks at. */
export interface Framing {
  readonly eye: Vector3;
  readonly target: Vector3;
}

/**
 * The nearest place of the eye, looking along a direction, from which all points are in view.
 *
 * `towards` points from the mechanism to the eye; `slope` is the tangent of half the angle of view, upwards.
 */
export function frame(points: readonly Vector3[], towards: Vector3, up: Vector3, slope: number, aspect: number): Framing {
  const depth = towards.clone().normalize();
  const right = new Vector3().crossVectors(up, depth);
  if (right.lengthSq() < 1e-12) right.set(1, 0, 0);
  right.normalize();
  const above = new Vector3().crossVectors(depth, right);
  const reach = (direction: Vector3): [number, number] => {
    let [least, greatest] = [Infinity, -Infinity];
    for (const point of points) {
      const place = point.dot(direction);
      least = Math.min(least, place);
      greatest = Math.max(greatest, place);
    }
    return least <= greatest ? [least, greatest] : [0, 0];
  };
  const middle = (direction: Vector3): number => {
    const [least, greatest] = reach(direction);
    return 0.5 * (least + greatest);
  };
  const target = new Vector3()
    .addScaledVector(right, middle(right))
    .addScaledVector(above, middle(above))
    .addScaledVector(depth, middle(depth));
  const offset = new Vector3();
  const needed = (): number => {
    let distance = NEAREST;
    for (const point of points) {
      offset.subVectors(point, target);
      const aside = Math.max(Math.abs(offset.dot(above)), Math.abs(offset.dot(right)) / aspect) / slope;
      distance = Math.max(distance, offset.dot(depth) + aside);
    }
    return distance;
  };
  let distance = needed();
  // What is nearer looks larger, so the middle of the picture is not that of the points; a few steps find it.
  for (let step = 0; step < 4; step += 1) {
    for (const direction of [right, above]) {
      let [least, greatest] = [Infinity, -Infinity];
      for (const point of points) {
        offset.subVectors(point, target);
        const seen = offset.dot(direction) / Math.max(NEAREST / 2, distance - offset.dot(depth));
        least = Math.min(least, seen);
        greatest = Math.max(greatest, seen);
      }
      if (least <= greatest) target.addScaledVector(direction, 0.5 * (least + greatest) * distance);
    }
    distance = needed();
  }
  return { eye: target.clone().addScaledVector(depth, distance * MARGIN), target };
}

/** The eye goes no nearer, in units of the mechanism's size. */
const NEAREST = 0.2;
/** A little air around the mechanism. */
const MARGIN = 1.12;

/**
 * The axis about which a picture is turned: the axis of the world that stands upright in the first view, so that
 * turning keeps it upright; where none does, what the view calls up.
 */
export function pole(view: Vector3, up: Vector3): Vector3 {
  for (const [axis, sign] of [[2, 1], [1, 1], [0, 1], [2, -1], [1, -1], [0, -1]] as const) {
    const upright = new Vector3().setComponent(axis, sign);
    const seen = upright.clone().addScaledVector(view, -upright.dot(view));
    // An axis that points at the eye has no direction on the screen.
    if (seen.length() > 0.2 && seen.angleTo(up) < UPRIGHT) return upright;
  }
  return up.clone();
}

/** Leaning by less than this angle is not seen. */
const UPRIGHT = 0.03;

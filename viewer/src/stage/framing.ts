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
  let distance = 0.2;
  const offset = new Vector3();
  for (const point of points) {
    offset.subVectors(point, target);
    const needed = Math.max(Math.abs(offset.dot(above)), Math.abs(offset.dot(right)) / aspect) / slope;
    distance = Math.max(distance, offset.dot(depth) + needed);
  }
  return { eye: target.clone().addScaledVector(depth, distance * MARGIN), target };
}

/** A little air around the mechanism. */
const MARGIN = 1.12;

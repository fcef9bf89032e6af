import type { Motion } from "./page_data";

/**
 * The sample whose pose is nearest to a given one: squared distances of the links' origins in units of the mechanism's
 * size, plus squared chords between the rotations. The first of equals.
 */
export function nearestSample(motion: Pick<Motion, "poses">, pose: Float64Array, extent: number): number {
  const width = pose.length;
  const { poses } = motion;
  let [best, least] = [0, Infinity];
  for (let start = 0; start + width <= poses.length && width > 0; start += width) {
    let distance = 0;
    for (let link = 0; link < width && distance < least; link += 7) {
      let dot = 0;
      for (let c = 0; c < 3; c += 1) distance += ((poses[start + link + c]! - pose[link + c]!) / extent) ** 2;
      for (let c = 3; c < 7; c += 1) dot += poses[start + link + c]! * pose[link + c]!;
      // Both signs of a quaternion are the same rotation.
      distance += 2 * Math.max(0, 1 - Math.abs(dot));
    }
    if (distance < least) [best, least] = [start / width, distance];
  }
  return best;
}

/** Writes the rotation matrix of the quaternion `q[at..at+4]` (w, x, y, z; of unit length) by rows to `out`. */
export function rotationOf(q: ArrayLike<number>, at: number, out: Float64Array): void {
  const [w, x, y, z] = [q[at]!, q[at + 1]!, q[at + 2]!, q[at + 3]!];
  out[0] = 1 - 2 * (y * y + z * z);
  out[1] = 2 * (x * y - w * z);
  out[2] = 2 * (x * z + w * y);
  out[3] = 2 * (x * y + w * z);
  out[4] = 1 - 2 * (x * x + z * z);
  out[5] = 2 * (y * z - w * x);
  out[6] = 2 * (x * z - w * y);
  out[7] = 2 * (y * z + w * x);
  out[8] = 1 - 2 * (x * x + y * y);
}

/** The quaternion (w, x, y, z) of a rotation matrix given by rows, from whichever part is largest. */
export function quaternionOf(m: ArrayLike<number>): [number, number, number, number] {
  const [a, b, c] = [m[0]!, m[4]!, m[8]!];
  const squares = [1 + a + b + c, 1 + a - b - c, 1 - a + b - c, 1 - a - b + c];
  const largest = squares.indexOf(Math.max(...squares));
  const s = 2 * Math.sqrt(squares[largest]!);
  const [yz, zx, xy] = [m[7]! - m[5]!, m[2]! - m[6]!, m[3]! - m[1]!];
  const [sxy, szx, syz] = [m[1]! + m[3]!, m[2]! + m[6]!, m[5]! + m[7]!];
  const found: readonly [number, number, number, number][] = [
    [s / 4, yz / s, zx / s, xy / s],
    [yz / s, s / 4, sxy / s, szx / s],
    [zx / s, sxy / s, s / 4, syz / s],
    [xy / s, szx / s, syz / s, s / 4],
  ];
  return found[largest]!;
}

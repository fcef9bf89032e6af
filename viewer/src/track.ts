/**
 * A sampled curve of many coordinates, made smooth: between two samples the cubic that passes both and has in each the
 * slope of the parabola through it and its neighbours (Catmull and Rom's spline, with the samples where they are, not
 * evenly spaced). At a sample it gives the sample.
 */
export class Track {
  private worked: Float32Array | null = null;
  private last = 0;

  /**
   * `rows` holds `width` numbers for each of `times`, which ascend. Where the curve closes, `seam` says what the
   * row after the last is: the second row, changed as a full round changes it.
   */
  constructor(
    private readonly times: Float32Array,
    private readonly rows: Float32Array,
    readonly width: number,
    private readonly seam: Seam | null,
  ) {}

  /** Worked out when first needed: a page may hold many motions that nobody looks at. */
  private get slopes(): Float32Array {
    this.worked ??= slopes(this.times, this.rows, this.width, this.seam);
    return this.worked;
  }

  /** The sample at or before `time`; never the last. */
  interval(time: number): number {
    const last = Math.max(0, this.times.length - 2);
    const holds = (i: number): boolean => this.times[i]! <= time && (i === last || time < this.times[i + 1]!);
    // A motion that plays stays in an interval or goes to one of its neighbours.
    for (const near of [this.last, this.last + 1, this.last - 1]) {
      if (near >= 0 && near <= last && holds(near)) return (this.last = near);
    }
    let low = 0;
    let high = last;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle]! <= time) low = middle;
      else high = middle - 1;
    }
    return (this.last = low);
  }

  /** Writes the coordinates at `time` to `out`; times beyond the ends give the ends. */
  at(time: number, out: Float64Array): void {
    const { times, rows, width, slopes } = this;
    const i = this.interval(time);
    const start = i * width;
    const step = (times[i + 1] ?? times[i]!) - times[i]!;
    const u = step > 0 ? Math.min(1, Math.max(0, (time - times[i]!) / step)) : 0;
    if (u === 0 || u === 1) {
      const row = u === 0 ? start : start + width;
      for (let c = 0; c < width; c += 1) out[c] = rows[row + c]!;
      return;
    }
    const v = 1 - u;
    const [a, b] = [v * v * (1 + 2 * u), u * u * (1 + 2 * v)];
    const [p, q] = [step * u * v * v, -step * u * u * v];
    for (let c = 0; c < width; c += 1) {
      const k = start + c;
      out[c] = a * rows[k]! + b * rows[k + width]! + p * slopes[k]! + q * slopes[k + width]!;
    }
  }

  /** Slope of one coordinate at a sample. */
  slope(sample: number, coordinate: number): number {
    return this.slopes[sample * this.width + coordinate]!;
  }
}

/** How a coordinate changes in going round once: `value * factor + offset`, by coordinate. */
export interface Seam {
  readonly factor: Float64Array;
  readonly offset: Float64Array;
}

/** Joint variables may have gained full turns. */
export function seamOfValues(rows: Float32Array, width: number): Seam {
  const end = rows.length - width;
  const offset = new Float64Array(width);
  for (let c = 0; c < width; c += 1) offset[c] = rows[end + c]! - rows[c]!;
  return { factor: new Float64Array(width).fill(1), offset };
}

/** Quaternions (the last four of every seven) may have changed their sign, which is the same rotation. */
export function seamOfPoses(rows: Float32Array, width: number): Seam {
  const end = rows.length - width;
  const factor = new Float64Array(width).fill(1);
  for (let q = 3; q + 3 < width; q += 7) {
    let dot = 0;
    for (let c = q; c < q + 4; c += 1) dot += rows[c]! * rows[end + c]!;
    if (dot < 0) factor.fill(-1, q, q + 4);
  }
  return { factor, offset: new Float64Array(width) };
}

function slopes(times: Float32Array, rows: Float32Array, width: number, seam: Seam | null): Float32Array {
  const count = times.length;
  const found = new Float32Array(count * width);
  if (count < 2) return found;
  const step = (i: number): number => times[i + 1]! - times[i]!;
  for (let i = 0; i < count; i += 1) {
    const ends = i === 0 || i === count - 1;
    const before = i > 0 ? step(i - 1) : step(seam === null ? 0 : count - 2);
    const after = i < count - 1 ? step(i) : step(seam === null ? count - 2 : 0);
    // Samples that fall together have no slope between them.
    const secant = (from: number, to: number, h: number): number => (h > 0 ? (to - from) / h : 0);
    for (let c = 0; c < width; c += 1) {
      const here = rows[i * width + c]!;
      let [d0, d1] = [0, 0];
      if (i > 0) d0 = secant(rows[(i - 1) * width + c]!, here, before);
      if (i < count - 1) d1 = secant(here, rows[(i + 1) * width + c]!, after);
      if (ends && seam === null) {
        // The end of the parabola through the three samples there, or a straight line where there are but two.
        if (count === 2) d0 = d1 = i === 0 ? d1 : d0;
        else if (i === 0) {
          const h = step(1);
          d0 = 2 * d1 - mean(d1, secant(rows[width + c]!, rows[2 * width + c]!, h), after, h);
          found[c] = d0;
          continue;
        } else {
          const h = step(count - 3);
          const earlier = secant(rows[(i - 2) * width + c]!, rows[(i - 1) * width + c]!, h);
          found[i * width + c] = 2 * d0 - mean(earlier, d0, h, before);
          continue;
        }
      } else if (ends && seam !== null) {
        const [factor, offset] = [seam.factor[c]!, seam.offset[c]!];
        if (i === 0) d0 = secant(factor * (rows[(count - 2) * width + c]! - offset), here, before);
        else d1 = secant(here, factor * rows[width + c]! + offset, after);
      }
      found[i * width + c] = mean(d0, d1, before, after);
    }
  }
  return found;
}

/** Slope of a parabola at the middle one of three points, from the two secants and the lengths of their steps. */
function mean(d0: number, d1: number, before: number, after: number): number {
  return before + after > 0 ? (d0 * after + d1 * before) / (before + after) : 0;
}

import type { Motion } from "./page_data";
import type { Variable } from "./variables";

/**
 * How fast the picture goes along a motion: arclength per second at every sample.
 *
 * The chosen variable should turn evenly. At its dead centres it stands still while the rest moves on, so an even turn
 * would rush past them infinitely fast: there the pace is held to what a slower, fictitious variable would give. And it
 * never falls below a tenth of the mean pace, so that no stretch of the motion stands still.
 */
export class Pace {
  private readonly speeds: Float64Array;
  private readonly easing: number;

  constructor(
    private readonly motion: Motion,
    variable: Variable | undefined,
    variables: readonly Variable[],
    extent: number,
  ) {
    const times = motion.arclengths;
    const length = motion.last - motion.first;
    const rates = Array.from(times, (_, i) =>
      variable === undefined ? 1 : Math.abs(motion.valueTrack.slope(i, variable.column)),
    );
    const usual = Math.sqrt(average(times, rates.map((rate) => rate * rate)));
    // Seconds per arclength, up to a factor that the duration fixes.
    const slowness = rates.map((rate) => Math.hypot(rate, DEAD_CENTRE_SHARE * usual) || 1);
    const total = average(times, slowness) * length;
    const seconds = duration(motion, variables, extent);
    const mean = length / seconds;
    this.speeds = Float64Array.from(slowness, (s) => Math.max(mean / 10, total / (seconds * s)));
    this.easing = EASED_SHARE * length;
  }

  /** Arclength per second. */
  at(arclength: number): number {
    const { motion, speeds } = this;
    const i = motion.valueTrack.interval(arclength);
    const [from, to] = [motion.arclengths[i]!, motion.arclengths[i + 1] ?? NaN];
    const share = to > from ? Math.min(1, Math.max(0, (arclength - from) / (to - from))) : 0;
    const speed = speeds[i]! + share * ((speeds[i + 1] ?? speeds[i]!) - speeds[i]!);
    if (motion.closed || this.easing === 0) return speed;
    // Motions with ends come to rest there as a braked body does.
    const left = Math.min(arclength - motion.first, motion.last - arclength);
    return speed * Math.min(1, Math.max(0.12, Math.sqrt(left / this.easing)));
  }
}

/** Speed of the fictitious variable at dead centres, in parts of the usual speed of the chosen one. */
const DEAD_CENTRE_SHARE = 0.3;
/** Part of the motion over which it comes to rest at an end. */
const EASED_SHARE = 0.05;

/** Seconds for the whole motion at speed 1: a full turn takes six, a slide by the mechanism's size three. */
function duration(motion: Motion, variables: readonly Variable[], extent: number): number {
  const columns = variables.length;
  const travel = new Float64Array(columns);
  for (let i = columns; i < motion.values.length; i += 1) {
    travel[i % columns]! += Math.abs(motion.values[i]! - motion.values[i - columns]!);
  }
  const longest = variables.reduce((most, variable, column) => {
    const share = variable.unit === "rad" ? (6 * travel[column]!) / (2 * Math.PI) : (3 * travel[column]!) / extent;
    return Math.max(most, share);
  }, 0);
  return Math.min(16, Math.max(2.5, longest));
}

/** Mean over arclength by trapezoids; plain mean where the motion has no length. */
function average(times: Float32Array, values: readonly number[]): number {
  let sum = 0;
  for (let i = 1; i < times.length; i += 1) sum += 0.5 * (values[i]! + values[i - 1]!) * (times[i]! - times[i - 1]!);
  const length = times[times.length - 1]! - times[0]!;
  return length > 0 ? sum / length : (values[0] ?? 1);
}

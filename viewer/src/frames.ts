/** What is done at every frame while there is something to do; `true` asks for one more frame. */
export type FrameTask = (seconds: number) => boolean;

/** Longest time step: after the page was away for a while, the motion goes on where it was. */
const LONGEST_STEP = 0.1;

/** Draws only when something changes: frames are asked for, and stop when no task wants another. */
export class Frames {
  private readonly tasks: FrameTask[] = [];
  private pending = false;
  private last: number | null = null;
  /** Times of the latest frames drawn without a pause between them, in milliseconds. */
  private times: number[] = [];

  each(task: FrameTask): void {
    this.tasks.push(task);
  }

  request(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame((now) => this.run(now));
  }

  /** Frames per second over the last second of uninterrupted drawing; 0 where there were too few. */
  get perSecond(): number {
    const span = (this.times[this.times.length - 1] ?? 0) - (this.times[0] ?? 0);
    return span > 0 ? (1000 * (this.times.length - 1)) / span : 0;
  }

  private run(now: number): void {
    this.pending = false;
    const seconds = this.last === null ? 0 : Math.min(LONGEST_STEP, (now - this.last) / 1000);
    if (this.last === null) this.times = [];
    this.times.push(now);
    while (now - (this.times[0] ?? now) > 1000) this.times.shift();
    let more = false;
    for (const task of this.tasks) more = task(seconds) || more;
    this.last = more ? now : null;
    if (more) this.request();
  }
}

/**
 * Calls back now, but not again within some milliseconds: a last call at the end of that time makes up for those left
 * out. For figures and marks that nobody can read sixty times in a second.
 */
export function atMostEvery(milliseconds: number, act: () => void): () => void {
  let next = -Infinity;
  let waiting = false;
  const run = (): void => {
    waiting = false;
    next = performance.now() + milliseconds;
    act();
  };
  return () => {
    const left = next - performance.now();
    if (waiting) return;
    if (left <= 0) {
      run();
      return;
    }
    waiting = true;
    setTimeout(run, left);
  };
}

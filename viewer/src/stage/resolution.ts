import type { WebGLRenderer } from "three";

/** More pixels than these for one of the page's tell nothing more. */
const FINEST = 2;
/** Fewer look coarse. */
const COARSEST = 0.6;
/** Below this rate a motion begins to stutter. */
const WANTED_RATE = 34;
/** Frames to wait before judging the rate again. */
const PATIENCE = 24;
/** Milliseconds of rest before the picture is drawn finely. */
const REST = 200;

/**
 * Draws fewer pixels while things move and the machine cannot keep up, and all of them as soon as the picture rests.
 * Where the processor draws, all means more than the screen has: that smooths the edges, which is left out while things
 * move.
 */
export class Resolution {
  private width = 1;
  private height = 1;
  private share = 1;
  private fine: boolean;
  private waited = 0;
  private timer: number | undefined;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly software: boolean,
    private readonly changed: () => void,
  ) {
    this.fine = !software;
  }

  resize(width: number, height: number): void {
    this.width = width;
    this.height = height;
    this.apply();
  }

  /** Called with every frame; true where the canvas has changed and must be drawn anew. */
  follow(busy: boolean, rate: number): boolean {
    clearTimeout(this.timer);
    if (!busy) {
      this.waited = 0;
      if (!this.fine) {
        this.timer = window.setTimeout(() => {
          this.refine();
          this.changed();
        }, REST);
      }
      return false;
    }
    if (this.fine && (this.software || this.share < 1)) {
      this.fine = false;
      this.apply();
      return true;
    }
    this.waited += 1;
    const coarsest = COARSEST / this.usual;
    if (this.waited < PATIENCE || rate === 0 || rate > WANTED_RATE || this.share <= coarsest) return false;
    this.waited = 0;
    this.fine = false;
    this.share = Math.max(coarsest, 0.75 * this.share);
    this.apply();
    return true;
  }

  /** Takes every pixel, from the next drawing on. */
  refine(): void {
    if (this.fine) return;
    this.fine = true;
    this.apply();
  }

  /** Pixels of the canvas for one of the page's, in a motion that the machine can follow. */
  private get usual(): number {
    const device = Math.min(FINEST, window.devicePixelRatio || 1);
    return this.software ? Math.min(1, device) : device;
  }

  private apply(): void {
    const finest = this.software ? FINEST : this.usual;
    this.renderer.setPixelRatio(this.fine ? finest : this.usual * this.share);
    this.renderer.setSize(this.width, this.height, false);
  }
}

import type { WebGLRenderer } from "three";

/** More pixels than these for one of the page's tell nothing more. */
const FINEST = 2;
/** Fewer look coarse. */
const COARSEST = 0.6;
/** Below this rate a motion begins to stutter. */
const WANTED_RATE = 34;
/** Frames to wait before judging the rate again. */
const PATIENCE = 24;

/** Draws fewer pixels where the machine cannot keep up, and all of them as soon as the picture stands still. */
export class Resolution {
  private width = 1;
  private height = 1;
  private share = 1;
  private coarse = false;
  private waited = 0;

  constructor(private readonly renderer: WebGLRenderer) {}

  resize(width: number, height: number): void {
    this.width = width;
    this.height = height;
    this.apply();
  }

  /** Called with every frame; true where the canvas has changed and must be drawn anew. */
  follow(busy: boolean, rate: number): boolean {
    if (!busy) {
      this.waited = 0;
      if (!this.coarse) return false;
      this.coarse = false;
      this.apply();
      return true;
    }
    if (!this.coarse && this.share < 1) {
      this.coarse = true;
      this.apply();
      return true;
    }
    this.waited += 1;
    if (this.waited < PATIENCE || rate === 0 || rate > WANTED_RATE || this.share * full() <= COARSEST) return false;
    this.waited = 0;
    this.coarse = true;
    this.share = Math.max(COARSEST / full(), 0.75 * this.share);
    this.apply();
    return true;
  }

  private apply(): void {
    this.renderer.setPixelRatio(full() * (this.coarse ? this.share : 1));
    this.renderer.setSize(this.width, this.height, false);
  }
}

function full(): number {
  return Math.min(FINEST, window.devicePixelRatio || 1);
}

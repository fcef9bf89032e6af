/** A canvas' drawing context, and who draws. */
export interface Drawing {
  readonly context: WebGL2RenderingContext;
  /** Drawn by the processor, not by a graphics card: there every pixel counts. */
  readonly software: boolean;
}

/**
 * Opens a canvas for drawing; null where the browser has no three-dimensional drawing.
 *
 * Opaque, because laying a transparent picture over the page costs as much as drawing it, and kept after drawing so that
 * it can be copied for paper at any time. Edges are smoothed by the graphics card; the processor would need half as long again for it, so there
 * they are smoothed by drawing finer as soon as the picture rests.
 */
export function openDrawing(canvas: HTMLCanvasElement): Drawing | null {
  const software = drawnByProcessor();
  const context = canvas.getContext("webgl2", { alpha: false, antialias: !software, preserveDrawingBuffer: true });
  return context === null ? null : { context, software };
}

/** Smoothing is settled when a context is made, so another, tiny one has to be asked first. */
function drawnByProcessor(): boolean {
  const probe = document.createElement("canvas");
  [probe.width, probe.height] = [1, 1];
  const context = probe.getContext("webgl2", { antialias: false, depth: false, failIfMajorPerformanceCaveat: true });
  if (context === null) return true;
  const names = context.getExtension("WEBGL_debug_renderer_info");
  const name = String(context.getParameter(names?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER));
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

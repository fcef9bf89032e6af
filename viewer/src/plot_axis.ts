/** One axis of a plot: a range of data drawn over a range of pixels. */
export interface PlotAxis {
  readonly least: number;
  readonly greatest: number;
  readonly logarithmic: boolean;
  /** Pixel of the least and of the greatest value. */
  readonly from: number;
  readonly to: number;
}

/** Reads `MIN MAX linear|log FROM TO`; null where that is not what is written. */
export function readAxis(text: string | null): PlotAxis | null {
  const words = (text ?? "").trim().split(/\s+/);
  if (words.length !== 5 || (words[2] !== "linear" && words[2] !== "log")) return null;
  const [least, greatest, from, to] = [words[0], words[1], words[3], words[4]].map(Number);
  const axis = {
    least: least ?? NaN,
    greatest: greatest ?? NaN,
    logarithmic: words[2] === "log",
    from: from ?? NaN,
    to: to ?? NaN,
  };
  const finite = [axis.least, axis.greatest, axis.from, axis.to].every(Number.isFinite);
  return finite && !(axis.logarithmic && axis.least <= 0) ? axis : null;
}

/** The value drawn at a pixel. */
export function valueAt(axis: PlotAxis, pixel: number): number {
  const share = (pixel - axis.from) / (axis.to - axis.from);
  if (axis.logarithmic) return axis.least * (axis.greatest / axis.least) ** share;
  return axis.least + share * (axis.greatest - axis.least);
}

/** The pixel at which a value is drawn. */
export function pixelAt(axis: PlotAxis, value: number): number {
  const share = axis.logarithmic
    ? Math.log(value / axis.least) / Math.log(axis.greatest / axis.least)
    : (value - axis.least) / (axis.greatest - axis.least);
  return axis.from + share * (axis.to - axis.from);
}

import { svgElement } from "../dom";

/** Outlines on a grid of 24 pixels. */
const OUTLINES = {
  play: "M8 5.2v13.6a.8.8 0 0 0 1.2.7l11-6.8a.8.8 0 0 0 0-1.4l-11-6.8A.8.8 0 0 0 8 5.2z",
  pause: "M7 5h3.4v14H7zM13.6 5H17v14h-3.4z",
} as const;

export type IconName = keyof typeof OUTLINES;

/** An icon in the colour of the text around it. */
export function icon(name: IconName): SVGSVGElement {
  const picture = svgElement("svg", { viewBox: "0 0 24 24", width: 22, height: 22, "aria-hidden": "true" });
  picture.append(svgElement("path", { d: OUTLINES[name], fill: "currentColor" }));
  return picture;
}

import { svgElement } from "./dom";
import { atMostEvery } from "./frames";
import { fourDigits } from "./number_text";
import type { Player } from "./player";
import { pixelAt, readAxis, valueAt, type PlotAxis } from "./plot_axis";
import type { Tooltip } from "./tooltip";

interface Plot {
  readonly svg: SVGSVGElement;
  readonly x: PlotAxis;
  readonly y: PlotAxis;
  /** Follows the motion: its line marks where the mechanism is, and dragging in it moves the mechanism. */
  readonly cursor: SVGElement | null;
}

/** A place in a plot whose values can be told. */
export interface Vertex {
  readonly x: number;
  readonly y: number;
  readonly name: string;
  readonly unit: string;
}

/** How often the line moves while the mechanism plays. */
const CURSOR_MILLISECONDS = 50;

/** Farther away than this many pixels of the plot, nothing is meant. */
const REACH = 40;

/** Brings the page's plots to life: values under the pointer, and a line that follows the motion. */
export function followPlots(player: Player, tooltip: Tooltip, root: ParentNode): void {
  const plots: Plot[] = [];
  for (const svg of root.querySelectorAll<SVGSVGElement>("svg.plot")) {
    const x = readAxis(svg.getAttribute("data-x"));
    const y = readAxis(svg.getAttribute("data-y"));
    if (x === null || y === null) continue;
    const follows = svg.getAttribute("data-follows") === "arclength";
    const plot = { svg, x, y, cursor: follows ? svg.querySelector<SVGElement>("line.cursor") : null };
    plots.push(plot);
    showValues(plot, tooltip);
    if (plot.cursor !== null) dragMotion(plot, player);
  }
  const groups = [...root.querySelectorAll<HTMLElement>(".motion-plots[data-motion]")];
  const choose = (): void => {
    const shown = player.motion?.index;
    for (const group of groups) group.hidden = Number(group.getAttribute("data-motion")) !== shown;
  };
  const inView = followView(plots.map((plot) => plot.svg));
  const move = (): void => {
    for (const { svg, x, cursor } of plots) {
      if (cursor === null || !inView.has(svg)) continue;
      const place = pixelAt(x, player.arclength).toFixed(2);
      cursor.setAttribute("x1", place);
      cursor.setAttribute("x2", place);
    }
  };
  const later = atMostEvery(CURSOR_MILLISECONDS, move);
  player.onChange((change) => {
    if (change === "motion") choose();
    if (change === "pose" && player.playing) later();
    else move();
  });
  inView.onChange(move);
  choose();
  move();
}

/** Which elements can be seen: drawing the others anew would be for nobody. */
function followView(elements: readonly Element[]): { has(element: Element): boolean; onChange(act: () => void): void } {
  const seen = new Set<Element>();
  let changed = (): void => {};
  const observer = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) {
      if (isIntersecting) seen.add(target);
      else seen.delete(target);
    }
    changed();
  });
  for (const element of elements) observer.observe(element);
  return { has: (element) => seen.has(element), onChange: (act) => (changed = act) };
}

/** The point of the plot's own pixels under the pointer; null before it is laid out. */
function placeIn(svg: SVGSVGElement, event: PointerEvent): DOMPoint | null {
  const matrix = svg.getScreenCTM();
  return matrix === null ? null : new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
}

function showValues({ svg, x, y, cursor }: Plot, tooltip: Tooltip): void {
  const marker = svgElement("circle", { class: "marker", r: 4, visibility: "hidden", "pointer-events": "none" });
  svg.append(marker);
  let vertices: readonly Vertex[] | null = null;
  const hide = (): void => {
    marker.setAttribute("visibility", "hidden");
    tooltip.hide();
  };
  const show = (event: PointerEvent): void => {
    const place = placeIn(svg, event);
    vertices ??= verticesOf(svg);
    const near = place === null ? null : nearestVertex(vertices, place.x, place.y, REACH);
    if (near === null) {
      hide();
      return;
    }
    marker.setAttribute("cx", String(near.x));
    marker.setAttribute("cy", String(near.y));
    marker.setAttribute("visibility", "visible");
    const unit = near.unit === "" ? "" : ` ${near.unit}`;
    const value = `${fourDigits(valueAt(y, near.y))}${unit}`;
    const along = `${cursor === null ? "at" : "arclength"} ${fourDigits(valueAt(x, near.x))}`;
    tooltip.show(near.name === "" ? [value, along] : [near.name, value, along], event.clientX, event.clientY);
  };
  svg.addEventListener("pointermove", show);
  svg.addEventListener("pointerdown", show);
  svg.addEventListener("pointerleave", hide);
}

/** Corners of lines, centres of points, and the middles of bars' tops. */
function verticesOf(svg: SVGSVGElement): Vertex[] {
  const found: Vertex[] = [];
  const number = (element: Element, name: string): number => Number(element.getAttribute(name) ?? 0);
  for (const mark of svg.querySelectorAll("polyline.series, circle.point, rect.bar")) {
    const name = mark.getAttribute("data-name") ?? "";
    const unit = mark.getAttribute("data-unit") ?? "";
    if (mark instanceof SVGPolylineElement) {
      for (const { x, y } of mark.points) found.push({ x, y, name, unit });
    } else if (mark instanceof SVGCircleElement) {
      found.push({ x: number(mark, "cx"), y: number(mark, "cy"), name, unit });
    } else {
      found.push({ x: number(mark, "x") + number(mark, "width") / 2, y: number(mark, "y"), name, unit });
    }
  }
  return found;
}

/** The vertex nearest to a place, the first of equals; null where none is within reach. */
export function nearestVertex(vertices: readonly Vertex[], x: number, y: number, reach: number): Vertex | null {
  let [best, least]: [Vertex | null, number] = [null, reach * reach];
  for (const vertex of vertices) {
    const distance = (vertex.x - x) ** 2 + (vertex.y - y) ** 2;
    if (distance < least) [best, least] = [vertex, distance];
  }
  return best;
}

function dragMotion({ svg, x }: Plot, player: Player): void {
  svg.classList.add("draggable");
  const go = (event: PointerEvent): void => {
    const place = placeIn(svg, event);
    if (place === null) return;
    const { motion } = player;
    const wanted = valueAt(x, place.x);
    if (motion === null) return;
    player.pause();
    // A drag beyond an edge stops there; it does not go round.
    player.scrub(Math.min(motion.last, Math.max(motion.first, wanted)));
  };
  svg.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    if (event.pointerType === "mouse") svg.setPointerCapture(event.pointerId);
    go(event);
  });
  svg.addEventListener("pointermove", (event) => {
    if (event.pointerType === "mouse" && (event.buttons & 1) === 1) go(event);
  });
}

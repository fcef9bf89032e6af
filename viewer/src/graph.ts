/** A graph this much wider than its place is scaled down to it; a wider one keeps its size and scrolls. */
const LEGIBLE = 1.6;

/** Fits graphs into narrow pages as long as their words stay legible. */
export function fitGraphs(root: ParentNode): void {
  for (const graph of root.querySelectorAll<SVGSVGElement>("svg.graph")) {
    const place = graph.parentElement;
    const width = Number(graph.getAttribute("width"));
    if (place === null || !(width > 0)) continue;
    const fit = (): void => {
      graph.style.maxWidth = width <= LEGIBLE * place.clientWidth ? "100%" : "none";
    };
    fit();
    new ResizeObserver(fit).observe(place);
  }
}

import { element } from "./dom";
import { naturalOrder } from "./natural_order";
import { readNumber } from "./number_text";

type Direction = "ascending" | "descending" | "none";

const NEXT: Readonly<Record<Direction, Direction>> = {
  none: "ascending",
  ascending: "descending",
  descending: "none",
};

/** Puts a button into every heading by which a table can be sorted; the third press brings back the first order. */
export function makeSortable(root: ParentNode): void {
  for (const table of root.querySelectorAll<HTMLTableElement>("table.sortable")) {
    const body = table.tBodies[0];
    if (body === undefined) continue;
    const original = [...body.rows];
    const headings = [...table.querySelectorAll<HTMLTableCellElement>("th[data-sort]")];
    for (const heading of headings) {
      const button = element("button", { type: "button", class: "sort" });
      button.append(...heading.childNodes);
      heading.append(button);
      heading.setAttribute("aria-sort", "none");
      button.addEventListener("click", () => {
        const direction = NEXT[heading.getAttribute("aria-sort") as Direction];
        for (const other of headings) other.setAttribute("aria-sort", other === heading ? direction : "none");
        body.append(...sorted(original, heading, direction));
      });
    }
  }
}

function sorted(
  rows: readonly HTMLTableRowElement[],
  heading: HTMLTableCellElement,
  direction: Direction,
): HTMLTableRowElement[] {
  if (direction === "none") return [...rows];
  const sign = direction === "ascending" ? 1 : -1;
  const keyed = rows.map((row) => {
    const cell = row.cells[heading.cellIndex];
    const text = cell?.getAttribute("data-value") ?? cell?.textContent?.trim() ?? "";
    return { row, text, number: readNumber(text) };
  });
  // Sorting keeps the order of equals, in both directions.
  if (heading.getAttribute("data-sort") === "number") {
    keyed.sort((a, b) => numericOrder(a.number, b.number, sign));
  } else {
    keyed.sort((a, b) => sign * naturalOrder(a.text, b.text));
  }
  return keyed.map(({ row }) => row);
}

/** Cells without a number come last, whichever the direction. */
export function numericOrder(a: number, b: number, sign: 1 | -1): number {
  if (Number.isNaN(a) || Number.isNaN(b)) return Number(Number.isNaN(a)) - Number(Number.isNaN(b));
  return a === b ? 0 : sign * (a < b ? -1 : 1);
}

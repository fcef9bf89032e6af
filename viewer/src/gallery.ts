import { element, setText } from "./dom";

/** A card of the index, with what it can be found by. */
interface Card {
  readonly item: HTMLElement;
  readonly text: string;
  readonly families: readonly string[];
}

/** Whether a card has every word that is asked for, and every family. */
export function isFound(
  card: { readonly text: string; readonly families: readonly string[] },
  query: string,
  families: ReadonlySet<string>,
): boolean {
  const words = query.toLowerCase().split(/\s+/).filter((word) => word !== "");
  return words.every((word) => card.text.includes(word)) && [...families].every((one) => card.families.includes(one));
}

/** The families of all cards, those with most members first; one that has all or one only narrows nothing. */
export function familiesOf(cards: readonly { readonly families: readonly string[] }[]): [string, number][] {
  const counts = new Map<string, number>();
  for (const family of cards.flatMap((card) => card.families)) counts.set(family, (counts.get(family) ?? 0) + 1);
  const useful = [...counts].filter(([, count]) => count > 1 && count < cards.length);
  return useful.sort(([a, m], [b, n]) => n - m || (a < b ? -1 : 1));
}

/** Puts a field to search in and buttons of families above the cards of a gallery. */
export function makeSearchable(root: ParentNode): void {
  const gallery = root.querySelector("main.gallery");
  const header = gallery?.querySelector("header");
  if (gallery === null || header == null) return;
  const cards: Card[] = [...gallery.querySelectorAll<HTMLElement>("ul.cards > li")].map((item) => ({
    item,
    text: (item.textContent ?? "").toLowerCase(),
    families: (item.dataset["families"] ?? "").split("|").filter((family) => family !== ""),
  }));
  const chosen = new Set<string>();
  const search = element("input", { type: "search", placeholder: "Search", "aria-label": "Search mechanisms" });
  const found = element("output", { class: "quiet" });
  const narrow = (): void => {
    let left = 0;
    for (const card of cards) {
      card.item.hidden = !isFound(card, search.value, chosen);
      left += Number(!card.item.hidden);
    }
    for (const section of gallery.querySelectorAll<HTMLElement>("section")) {
      section.hidden = section.querySelector("ul.cards > li:not([hidden])") === null;
    }
    setText(found, `${left} of ${cards.length}`);
  };
  const chips = familiesOf(cards).map(([family, count]) => {
    const chip = element("button", { type: "button", class: "chip", "aria-pressed": "false" }, `${family} ${count}`);
    chip.addEventListener("click", () => {
      const on = !chosen.delete(family);
      if (on) chosen.add(family);
      chip.setAttribute("aria-pressed", String(on));
      narrow();
    });
    return chip;
  });
  search.addEventListener("input", narrow);
  header.append(element("div", { class: "search" }, search, found, element("div", { class: "families" }, ...chips)));
  narrow();
}

import type { PageData } from "./page_data";

export type ThingKind = "link" | "joint" | "cycle";

/** Something the page talks about, by its index in the page's data. */
export interface Thing {
  readonly kind: ThingKind;
  readonly index: number;
}

const ATTRIBUTES: Readonly<Record<ThingKind, string>> = {
  link: "data-link",
  joint: "data-joint",
  cycle: "data-cycle",
};
const KINDS: readonly ThingKind[] = ["link", "joint", "cycle"];
const ANY = KINDS.map((kind) => `[${ATTRIBUTES[kind]}]`).join(",");

/**
 * What is pointed at, in the picture or on the page, and everything that stands for it: elements get the class `lit`,
 * and the picture is told.
 */
export class Lights {
  private things: readonly Thing[] = [];
  private elements: Element[] = [];
  private readonly listeners: (() => void)[] = [];

  constructor(private readonly data: PageData) {}

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  get any(): boolean {
    return this.things.length > 0;
  }

  has(kind: ThingKind, index: number): boolean {
    return this.things.some((thing) => thing.kind === kind && thing.index === index);
  }

  /** Lights things and, with a cycle, its joints; an empty list puts everything out. */
  set(things: readonly Thing[]): void {
    const wanted = things.flatMap((thing) => [thing, ...this.partsOf(thing)]);
    const same =
      wanted.length === this.things.length && wanted.every((thing) => this.has(thing.kind, thing.index));
    if (same) return;
    for (const element of this.elements) element.classList.remove("lit");
    this.things = wanted;
    this.elements = wanted.flatMap(({ kind, index }) => [
      ...document.querySelectorAll(`[${ATTRIBUTES[kind]}="${index}"]`),
    ]);
    for (const element of this.elements) element.classList.add("lit");
    for (const listener of this.listeners) listener();
  }

  private partsOf(thing: Thing): Thing[] {
    if (thing.kind !== "cycle") return [];
    return (this.data.cycles[thing.index]?.joints ?? []).map((index) => ({ kind: "joint", index }));
  }
}

/** Follows pointer and focus over the page's elements, and makes them reachable by keyboard. */
export function followPage(lights: Lights, root: HTMLElement): void {
  const light = (event: Event): void => {
    const target = event.target instanceof Element ? event.target.closest(ANY) : null;
    lights.set(target === null ? [] : thingsOf(target));
  };
  root.addEventListener("pointerover", light);
  root.addEventListener("focusin", light);
  root.addEventListener("focusout", () => lights.set([]));
  root.addEventListener("pointerleave", () => lights.set([]));
  makeReachable(root);
}

function thingsOf(element: Element): Thing[] {
  return KINDS.flatMap((kind) => {
    const text = element.getAttribute(ATTRIBUTES[kind]);
    return text === null || !/^\d+$/.test(text) ? [] : [{ kind, index: Number(text) }];
  });
}

/**
 * One stop of the tab key for each table or picture; the arrow keys go on from there. With hundreds of joints, a stop for
 * each would bar the way to everything behind.
 */
function makeReachable(root: HTMLElement): void {
  for (const group of root.querySelectorAll("table, svg.graph, p.chips")) {
    const stops = (): NodeListOf<SVGElement | HTMLElement> => group.querySelectorAll<SVGElement | HTMLElement>(ANY);
    stops().forEach((stop, index) => stop.setAttribute("tabindex", index === 0 ? "0" : "-1"));
    group.addEventListener("keydown", (event) => {
      const step = event instanceof KeyboardEvent ? STEPS[event.key] : undefined;
      const all = [...stops()];
      const here = all.findIndex((stop) => stop === event.target);
      const next = step === undefined || here < 0 ? undefined : all[here + step];
      if (next === undefined) return;
      event.preventDefault();
      all[here]?.setAttribute("tabindex", "-1");
      next.setAttribute("tabindex", "0");
      next.focus();
    });
  }
}

const STEPS: Readonly<Record<string, number>> = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 };

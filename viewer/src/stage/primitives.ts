import { BoxGeometry, BufferGeometry, Float32BufferAttribute, SphereGeometry } from "three";
import type { ShapeKind } from "../page_data";

/** How many facets round things get. */
export interface Detail {
  readonly around: number;
  readonly ball: number;
}

/** Fewer facets where there are many shapes: without a graphics card every corner costs about a microsecond. */
export function detailFor(shapes: number): Detail {
  if (shapes <= 80) return { around: 24, ball: 24 };
  return shapes <= 160 ? { around: 14, ball: 16 } : { around: 8, ball: 10 };
}

/** Enough for a shadow. */
export const COARSE: Detail = { around: 6, ball: 8 };

/** The solid of one kind whose size is 1 along every axis of its own frame. */
export function primitive(kind: ShapeKind, { around, ball }: Detail): BufferGeometry {
  switch (kind) {
    case "box":
      return new BoxGeometry(1, 1, 1);
    case "cylinder":
      return revolved(around, [
        { from: [0.5, -0.5], to: [0.5, 0.5] },
        { from: [0, -0.5], to: [0.5, -0.5] },
        { from: [0.5, 0.5], to: [0, 0.5] },
      ]);
    case "sphere":
      return new SphereGeometry(0.5, ball, Math.ceil(ball / 2));
    case "arrow":
      return revolved(Math.max(5, around / 2), [
        { from: [0.5, 0], to: [0.5, 1 - HEAD_LENGTH] },
        { from: [0, 1 - HEAD_LENGTH], to: [HEAD_RADIUS, 1 - HEAD_LENGTH] },
        { from: [HEAD_RADIUS, 1 - HEAD_LENGTH], to: [0, 1] },
      ]);
  }
}

/** Part of an arrow's length that its head takes, and the head's radius in units of the shaft's diameter. */
const HEAD_LENGTH = 0.18;
const HEAD_RADIUS = 1.25;

/** A straight piece of an outline, as radius and height; the solid is on its left. */
interface Edge {
  readonly from: readonly [radius: number, height: number];
  readonly to: readonly [radius: number, height: number];
}

/** The surface that an outline sweeps out about z. Every piece has corners of its own, so that edges are sharp. */
function revolved(around: number, outline: readonly Edge[]): BufferGeometry {
  const places: number[] = [];
  const normals: number[] = [];
  const indices: number[] = [];
  for (const { from, to } of outline) {
    const [out, up] = [to[1] - from[1], from[0] - to[0]];
    const length = Math.hypot(out, up);
    const corner = (i: number, [radius, height]: readonly [number, number]): number => {
      const angle = (2 * Math.PI * (i % around)) / around;
      places.push(radius * Math.cos(angle), radius * Math.sin(angle), height);
      normals.push((Math.cos(angle) * out) / length, (Math.sin(angle) * out) / length, up / length);
      return places.length / 3 - 1;
    };
    if (out === 0) {
      // A flat end is a fan about one of its own corners.
      const ring = from[0] > 0 ? from : to;
      const corners = Array.from({ length: around }, (_, i) => corner(i, ring));
      for (let i = 1; i + 1 < around; i += 1) {
        const [a, b, c] = [corners[0]!, corners[i]!, corners[i + 1]!];
        indices.push(...(up > 0 ? [a, b, c] : [a, c, b]));
      }
      continue;
    }
    let last: [number, number] = [corner(0, from), corner(0, to)];
    for (let i = 1; i <= around; i += 1) {
      const next: [number, number] = [corner(i, from), corner(i, to)];
      indices.push(last[0], next[0], next[1]);
      if (to[0] > 0) indices.push(last[0], next[1], last[1]);
      last = next;
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(places, 3));
  geometry.setAttribute("normal", new Float32BufferAttribute(normals, 3));
  geometry.setIndex(indices);
  return geometry;
}

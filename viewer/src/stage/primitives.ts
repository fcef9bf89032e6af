import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  ConeGeometry,
  CylinderGeometry,
  Matrix4,
  SphereGeometry,
} from "three";
import type { ShapeKind } from "../page_data";

/** How many facets round things get: fewer where there are many of them. */
export interface Detail {
  readonly around: number;
  readonly ball: number;
}

export function detailFor(shapes: number): Detail {
  if (shapes <= 200) return { around: 24, ball: 24 };
  return shapes <= 800 ? { around: 14, ball: 14 } : { around: 8, ball: 8 };
}

/** The solid of one kind whose size is 1 along every axis of its own frame. */
export function primitive(kind: ShapeKind, detail: Detail): BufferGeometry {
  switch (kind) {
    case "box":
      return new BoxGeometry(1, 1, 1);
    case "cylinder":
      return alongZ(new CylinderGeometry(0.5, 0.5, 1, detail.around));
    case "sphere":
      return new SphereGeometry(0.5, detail.ball, Math.ceil(detail.ball / 2));
    case "arrow":
      return arrow(Math.max(6, detail.around / 2));
  }
}

/** Part of an arrow's length that its head takes, and the head's radius in units of the shaft's diameter. */
const HEAD_LENGTH = 0.18;
const HEAD_RADIUS = 1.25;

/** From the origin along +z, the shaft's diameter and the whole length being 1. */
function arrow(around: number): BufferGeometry {
  const shaft = alongZ(new CylinderGeometry(0.5, 0.5, 1 - HEAD_LENGTH, around));
  shaft.translate(0, 0, 0.5 * (1 - HEAD_LENGTH));
  const head = alongZ(new ConeGeometry(HEAD_RADIUS, HEAD_LENGTH, around));
  head.translate(0, 0, 1 - 0.5 * HEAD_LENGTH);
  return joined(shaft, head);
}

/** Round solids come along y; those of a mechanism lie along z. */
function alongZ(geometry: BufferGeometry): BufferGeometry {
  return geometry.applyMatrix4(new Matrix4().makeRotationX(Math.PI / 2));
}

function joined(a: BufferGeometry, b: BufferGeometry): BufferGeometry {
  const geometry = new BufferGeometry();
  for (const name of ["position", "normal"]) {
    const parts = [a, b].map((part) => part.getAttribute(name).array);
    const values = new Float32Array(parts.reduce((length, part) => length + part.length, 0));
    let at = 0;
    for (const part of parts) {
      values.set(part, at);
      at += part.length;
    }
    geometry.setAttribute(name, new BufferAttribute(values, 3));
  }
  const shift = a.getAttribute("position").count;
  geometry.setIndex([...indices(a), ...indices(b).map((index) => index + shift)]);
  return geometry;
}

function indices(geometry: BufferGeometry): number[] {
  return Array.from(geometry.getIndex()?.array ?? []);
}

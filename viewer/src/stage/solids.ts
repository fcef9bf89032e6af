import { InstancedBufferAttribute, InstancedMesh, type Scene, type ShaderMaterial } from "three";
import type { Rgb } from "../colours";
import type { PageData, ShapeData, ShapeKind } from "../page_data";
import { COARSE, detailFor, primitive } from "./primitives";
import { quaternionOf, rotationOf } from "./rotation";

const KINDS: readonly ShapeKind[] = ["box", "cylinder", "sphere", "arrow"];

/** All shapes of one kind: they are drawn together. */
interface Batch {
  readonly kind: ShapeKind;
  readonly mesh: InstancedMesh;
  readonly shadow: InstancedMesh | null;
}

/** A shape with what is worked out once: where its matrix lies, and `link_from_shape` in units of the extent. */
interface Placed {
  readonly data: ShapeData;
  readonly batch: Batch;
  readonly slot: number;
  /** By rows. */
  readonly rotation: Float64Array;
  readonly place: readonly [number, number, number];
  readonly size: readonly [number, number, number];
}

/** The mechanism's solids, one draw call for each kind. Drawn relative to the page's centre, in units of its extent. */
export class Solids {
  readonly shapes: readonly Placed[];
  private readonly batches: readonly Batch[];
  private readonly scratch = new Float64Array(9);

  constructor(
    private readonly data: PageData,
    scene: Scene,
    solid: ShaderMaterial,
    shadow: ShaderMaterial | null,
  ) {
    const detail = detailFor(data.shapes.length);
    const slots = new Map<ShapeKind, number>();
    const counts = new Map<ShapeKind, number>();
    for (const shape of data.shapes) counts.set(shape.kind, (counts.get(shape.kind) ?? 0) + 1);
    const batches = new Map<ShapeKind, Batch>();
    for (const kind of KINDS) {
      const count = counts.get(kind);
      if (count === undefined) continue;
      const geometry = primitive(kind, detail);
      const mesh = new InstancedMesh(geometry, solid, count);
      mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * count), 3);
      // Axes are marks, not bodies: they throw no shadow.
      const thrown = shadow !== null && kind !== "arrow" ? new InstancedMesh(primitive(kind, COARSE), shadow, count) : null;
      if (thrown !== null) {
        thrown.instanceMatrix = mesh.instanceMatrix;
        thrown.renderOrder = -1;
      }
      for (const drawn of [mesh, thrown]) {
        if (drawn === null) continue;
        // What is drawn moves without three knowing; it is all in view anyhow.
        drawn.frustumCulled = false;
        drawn.matrixAutoUpdate = false;
        scene.add(drawn);
      }
      batches.set(kind, { kind, mesh, shadow: thrown });
    }
    this.batches = [...batches.values()];
    this.shapes = data.shapes.flatMap((shape) => {
      const batch = batches.get(shape.kind);
      if (batch === undefined) return [];
      const slot = slots.get(shape.kind) ?? 0;
      slots.set(shape.kind, slot + 1);
      const rotation = new Float64Array(9);
      rotationOf(shape.pose, 3, rotation);
      const scaled = (values: readonly number[]): [number, number, number] => [
        (values[0] ?? 0) / data.extent,
        (values[1] ?? 0) / data.extent,
        (values[2] ?? 0) / data.extent,
      ];
      return [{ data: shape, batch, slot, rotation, place: scaled(shape.pose), size: scaled(shape.size) }];
    });
  }

  /** Puts every shape where its link is. `pose`: seven numbers for each link, in metres. */
  move(pose: Float64Array): void {
    const r = this.scratch;
    const { extent } = this.data;
    let link = -1;
    for (const shape of this.shapes) {
      const at = 7 * shape.data.link;
      if (link !== shape.data.link) {
        link = shape.data.link;
        rotationOf(pose, at + 3, r);
      }
      const { rotation: s, place, size } = shape;
      const out = shape.batch.mesh.instanceMatrix.array;
      const start = 16 * shape.slot;
      for (let row = 0; row < 3; row += 1) {
        const [a, b, c] = [r[3 * row]!, r[3 * row + 1]!, r[3 * row + 2]!];
        for (let column = 0; column < 3; column += 1) {
          out[start + 4 * column + row] = size[column]! * (a * s[column]! + b * s[3 + column]! + c * s[6 + column]!);
        }
        out[start + 12 + row] = a * place[0] + b * place[1] + c * place[2] + pose[at + row]! / extent;
      }
      out[start + 15] = 1;
    }
    for (const { mesh } of this.batches) mesh.instanceMatrix.needsUpdate = true;
  }

  /** Gives every shape its colour. */
  paint(colourOf: (shape: ShapeData) => Rgb): void {
    for (const { data, batch, slot } of this.shapes) {
      batch.mesh.instanceColor?.array.set(colourOf(data), 3 * slot);
    }
    for (const { mesh } of this.batches) if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true;
  }

  showAxes(shown: boolean): void {
    for (const { kind, mesh } of this.batches) if (kind === "arrow") mesh.visible = shown;
  }

  showShadows(shown: boolean): void {
    for (const { shadow } of this.batches) if (shadow !== null) shadow.visible = shown;
  }

  /** The 4 × 4 matrix with which a shape is drawn, by columns: from its unit solid to units of the extent. */
  matrix(index: number): number[] {
    const shape = this.shapes[index];
    if (shape === undefined) return [];
    const start = 16 * shape.slot;
    return Array.from(shape.batch.mesh.instanceMatrix.array.subarray(start, start + 16));
  }

  /** The pose of a link as it is drawn, worked back from the matrix of its best shape; null where it has none. */
  drawnPose(link: number): number[] | null {
    let [best, thickest] = [-1, 0];
    this.shapes.forEach((shape, index) => {
      const thin = Math.min(...shape.size);
      if (shape.data.link === link && thin > thickest) [best, thickest] = [index, thin];
    });
    const shape = this.shapes[best];
    if (shape === undefined) return null;
    const m = this.matrix(best);
    const { rotation: s, place, size } = shape;
    // world_from_shape without its size, times shape_from_link.
    const r = new Float64Array(9);
    for (let row = 0; row < 3; row += 1) {
      for (let column = 0; column < 3; column += 1) {
        for (let k = 0; k < 3; k += 1) r[3 * row + column]! += (m[4 * k + row]! / size[k]!) * s[3 * column + k]!;
      }
    }
    const origin = [0, 1, 2].map((row) => {
      const turned = r[3 * row]! * place[0] + r[3 * row + 1]! * place[1] + r[3 * row + 2]! * place[2];
      return (m[12 + row]! - turned) * this.data.extent;
    });
    return [...origin, ...quaternionOf(r)];
  }
}

import { Color, ColorManagement, PerspectiveCamera, Scene, Vector2, Vector3, WebGLRenderer, type ShaderMaterial } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { jointColour, linkColour, mix, onPage, type Rgb } from "../colours";
import { element } from "../dom";
import type { Frames } from "../frames";
import type { Lights, Thing } from "../lights";
import type { ShapeData } from "../page_data";
import type { Player } from "../player";
import { onThemeChange, readTheme, type Theme } from "../theme";
import { openDrawing, type Drawing } from "./drawing";
import { floorFor, type Floor } from "./floor";
import { frame, pole } from "./framing";
import { ribbonMaterial, lineMaterial, shadowMaterial, solidMaterial } from "./materials";
import { PATHS_BY_DEFAULT, PathLines, pathsOf } from "./paths";
import { hit } from "./picking";
import { Resolution } from "./resolution";
import { Solids } from "./solids";
import { sweptPoints } from "./sweep";

export type ViewName = "home" | "x" | "y" | "z";

/** Height of the view as an angle, in degrees: narrow, so that parallel things look parallel. */
const ANGLE = 26;
const SLOPE = Math.tan((ANGLE * Math.PI) / 360);
// Colours go to the screen as they are given.
ColorManagement.enabled = false;

/** Beyond so many joints, their axes hide more than they show unless they are asked for. */
const AXES_BY_DEFAULT = 40;
/** Beyond so many shapes, shadows cost more than they tell. */
const SHADOWED = 250;
/** How near a pointer must come to a thin rod, in pixels. */
const MOUSE_SLACK = 4;
const FINGER_SLACK = 14;

/** The mechanism in three dimensions, in a canvas that takes the place of the still sketch. */
export class Stage {
  readonly canvas: HTMLCanvasElement;
  axes: boolean;
  paths: boolean;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(ANGLE, 1, 0.01, 200);
  private readonly orbit: OrbitControls;
  private readonly solids: Solids;
  private readonly floor: Floor;
  private readonly pathLines: PathLines;
  private readonly materials: Readonly<Record<"shadow" | "grid", ShaderMaterial>>;
  private readonly points: readonly Vector3[];
  private readonly resolution: Resolution;
  /** Size of the picture in the page's pixels. */
  private readonly screen = new Vector2(1, 1);
  private theme: Theme;
  private readonly copy = element("canvas", { class: "copy" });
  private view: ViewName | null = "home";
  private glide: ((seconds: number) => boolean) | null = null;
  private moved = true;
  private dirty = true;

  private constructor(
    private readonly host: HTMLElement,
    private readonly player: Player,
    private readonly lights: Lights,
    private readonly frames: Frames,
    canvas: HTMLCanvasElement,
    { context, software }: Drawing,
  ) {
    const { data } = player;
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, context, preserveDrawingBuffer: true, alpha: false });
    // Asking for errors makes the first frame wait for every shader.
    this.renderer.debug.checkShaderErrors = false;
    this.resolution = new Resolution(this.renderer, software, () => this.invalidate());
    this.theme = readTheme(host, false);

    this.axes = data.joints.length <= AXES_BY_DEFAULT;
    this.points = sweptPoints(
      data,
      data.motions.slice(0, 12).map((_, index) => player.motions.get(index)),
      this.axes,
    );
    const gridMaterial = lineMaterial();
    this.floor = floorFor(data, this.points, gridMaterial);
    const shadow = shadowMaterial(this.floor.plane, this.floor.light);
    this.materials = { shadow, grid: gridMaterial };
    this.scene.matrixWorldAutoUpdate = false;
    this.solids = new Solids(data, this.scene, solidMaterial(), data.shapes.length <= SHADOWED ? shadow : null);
    this.pathLines = new PathLines(ribbonMaterial(this.screen));
    this.paths = data.joints.length <= PATHS_BY_DEFAULT || (data.points ?? []).length > 0;
    this.scene.add(this.floor.grid, this.pathLines.mesh);

    this.camera.up.copy(pole(new Vector3(...data.view), new Vector3(...data.up)));
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.enableDamping = true;
    this.orbit.dampingFactor = 0.14;
    this.orbit.enableZoom = false;
    this.orbit.minDistance = 0.05;
    this.orbit.maxDistance = 40;
    this.orbit.zoomToCursor = true;
    this.orbit.addEventListener("change", () => this.invalidate());
    this.orbit.addEventListener("start", () => {
      this.view = null;
      this.glide = null;
    });

    // The wheel scrolls the page until the picture is taken up by a click or by the keyboard.
    canvas.addEventListener("focus", () => (this.orbit.enableZoom = true));
    canvas.addEventListener("blur", () => (this.orbit.enableZoom = false));
    canvas.addEventListener("pointerdown", () => canvas.focus({ preventScroll: true }));

    this.showAxes(this.axes);
    this.showPaths(this.paths);
    this.recolour();
    player.onChange((change) => {
      if (change === "motion") {
        this.tracePaths();
        this.recolour();
      }
      this.moved = true;
      this.invalidate();
    });
    lights.onChange(() => this.recolour());
    onThemeChange((paper) => {
      this.theme = readTheme(host, paper);
      this.recolour();
      // Paper gets every pixel.
      this.resolution.refine();
      this.draw();
      if (paper) this.copyForPaper();
    });
    frames.each((seconds) => this.step(seconds));
    this.resize();
    new ResizeObserver(() => this.resize()).observe(host);
  }

  /** Null where the browser has no three-dimensional drawing. */
  static open(host: HTMLElement, player: Player, lights: Lights, frames: Frames): Stage | null {
    const canvas = element("canvas", { tabindex: "0", "aria-label": `${player.data.mechanism}, in motion` });
    const drawing = openDrawing(canvas);
    if (drawing === null) return null;
    const stage = new Stage(host, player, lights, frames, canvas, drawing);
    host.append(canvas);
    host.classList.add("live");
    stage.resize();
    stage.draw();
    return stage;
  }

  get gridCell(): number {
    return this.floor.cell;
  }

  get drawnSolids(): Solids {
    return this.solids;
  }

  invalidate(): void {
    this.dirty = true;
    this.frames.request();
  }

  showAxes(shown: boolean): void {
    this.axes = shown;
    this.solids.showAxes(shown);
    this.invalidate();
  }

  showPaths(shown: boolean): void {
    this.paths = shown;
    this.pathLines.mesh.visible = shown;
    this.tracePaths();
    this.recolour();
  }

  /** Turns to one of the named views, gently unless that is not wanted. */
  look(view: ViewName, gently: boolean): void {
    this.view = view;
    const { eye, target } = this.framing(view);
    const from = this.camera.position.clone().sub(this.orbit.target);
    const to = eye.clone().sub(target);
    const start = this.orbit.target.clone();
    if (!gently || from.dot(to) < -0.9 * from.length() * to.length()) {
      this.place(eye, target);
      return;
    }
    let time = 0;
    this.glide = (seconds) => {
      time = Math.min(1, time + seconds / 0.4);
      const share = time * time * (3 - 2 * time);
      const length = from.length() + share * (to.length() - from.length());
      const offset = from.clone().lerp(to, share).setLength(length);
      const middle = start.clone().lerp(target, share);
      this.place(middle.clone().add(offset), middle);
      return time < 1;
    };
    this.invalidate();
  }

  /** Turns the view by angles in radians. */
  turn(aside: number, over: number): void {
    const offset = this.camera.position.clone().sub(this.orbit.target);
    const { up } = this.camera;
    offset.applyAxisAngle(up, aside);
    const tilt = offset.angleTo(up);
    const wanted = Math.min(Math.PI - 0.01, Math.max(0.01, tilt + over));
    const right = new Vector3().crossVectors(up, offset).normalize();
    offset.applyAxisAngle(right, wanted - tilt);
    this.view = null;
    this.place(this.orbit.target.clone().add(offset), this.orbit.target.clone());
  }

  /** Goes nearer by a factor above 1, away by one below. */
  zoom(factor: number): void {
    const offset = this.camera.position.clone().sub(this.orbit.target).divideScalar(factor);
    offset.clampLength(this.orbit.minDistance, this.orbit.maxDistance);
    this.view = null;
    this.place(this.orbit.target.clone().add(offset), this.orbit.target.clone());
  }

  /** What is at a point of the window, if anything. */
  pick(x: number, y: number, finger: boolean): Thing | null {
    const box = this.canvas.getBoundingClientRect();
    const place = new Vector3(
      (2 * (x - box.left)) / box.width - 1,
      1 - (2 * (y - box.top)) / box.height,
      0.5,
    ).unproject(this.camera);
    const origin = this.camera.position;
    const direction = place.sub(origin).normalize();
    const ray = { origin: origin.toArray(), direction: direction.toArray() };
    const pixel = (2 * SLOPE * origin.distanceTo(this.orbit.target)) / box.height;
    for (const slack of [0, pixel * (finger ? FINGER_SLACK : MOUSE_SLACK)]) {
      let [best, nearest]: [ShapeData | null, number] = [null, Infinity];
      this.solids.shapes.forEach(({ data }, index) => {
        if (data.axis && !this.axes) return;
        const distance = hit(ray, data.kind, this.solids.matrix(index), slack);
        if (distance !== null && distance < nearest) [best, nearest] = [data, distance];
      });
      const found = best as ShapeData | null;
      if (found !== null) {
        return found.joint === null ? { kind: "link", index: found.link } : { kind: "joint", index: found.joint };
      }
    }
    return null;
  }

  /** Draws now. */
  draw(): void {
    if (this.moved) {
      this.solids.move(this.player.pose);
      this.moved = false;
    }
    const { plane } = this.floor;
    const { position } = this.camera;
    // Seen from behind, the sheet would lie in front of the mechanism.
    const before = plane.x * position.x + plane.y * position.y + plane.z * position.z > plane.w;
    this.solids.showShadows(before);
    this.floor.grid.visible = before;
    this.renderer.render(this.scene, this.camera);
    this.dirty = false;
  }

  /** Browsers print the last picture of such a canvas that was on the screen; of a plain one they print what it holds. */
  private copyForPaper(): void {
    const { canvas, copy } = this;
    [copy.width, copy.height] = [canvas.width, canvas.height];
    copy.getContext("2d")?.drawImage(canvas, 0, 0);
    if (!copy.isConnected) canvas.after(copy);
  }

  private step(seconds: number): boolean {
    const gliding = this.glide?.(seconds) ?? false;
    if (!gliding) this.glide = null;
    const turning = this.orbit.update();
    // A scrubber that is dragged is a motion as well.
    const busy = gliding || turning || this.player.playing || this.moved;
    if (this.resolution.follow(busy, this.frames.perSecond)) this.dirty = true;
    if (this.dirty) this.draw();
    return busy;
  }

  private place(eye: Vector3, target: Vector3): void {
    this.camera.position.copy(eye);
    this.orbit.target.copy(target);
    this.orbit.update();
    this.invalidate();
  }

  private framing(view: ViewName): ReturnType<typeof frame> {
    const up = this.camera.up;
    const towards = {
      home: (): Vector3 => new Vector3(...this.player.data.view),
      x: (): Vector3 => new Vector3(1, 0, 0),
      y: (): Vector3 => new Vector3(0, -1, 0),
      z: (): Vector3 => new Vector3(0, 0, 1),
    }[view]();
    const along = towards.dot(up);
    if (Math.abs(along) > 0.999) {
      // Looking down or up the vertical: a trace of tilt says which way is up on the screen.
      const upwards = Math.abs(up.y) < 0.5 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
      towards.addScaledVector(upwards, along > 0 ? -2e-3 : 2e-3).normalize();
    }
    return frame(this.points, towards, up, SLOPE, this.camera.aspect);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.screen.set(width, height);
    this.resolution.resize(width, height);
    if (this.view !== null) {
      const { eye, target } = this.framing(this.view);
      this.place(eye, target);
    }
    // Resizing empties the canvas; it must not stay empty until the next frame.
    if (this.canvas.isConnected) this.draw();
  }

  private tracePaths(): void {
    const { motion } = this.player;
    this.pathLines.set(this.paths && motion !== null ? pathsOf(this.player.data, motion) : []);
  }

  private recolour(): void {
    const { data } = this.player;
    const { dark, background, lit } = this.theme;
    const roles = this.player.roles();
    const { lights } = this;
    const shade = (colour: Rgb, isLit: boolean): Rgb => {
      if (!lights.any) return colour;
      return isLit ? mix(colour, lit, 0.85) : mix(colour, background, 0.62);
    };
    this.solids.paint(({ link, joint, axis }) => {
      if (joint === null) return shade(onPage(linkColour(data, roles, link), dark), lights.has("link", link));
      const plain = axis ? data.palette.axis : jointColour(data.palette, roles, joint);
      return shade(onPage(plain, dark), lights.has("joint", joint));
    });
    this.pathLines.paint(({ link, joint }) => {
      const colour = mix(onPage(linkColour(data, roles, link), dark), background, 0.1);
      return shade(colour, lights.has("link", link) || (joint !== null && lights.has("joint", joint)));
    });
    this.renderer.setClearColor(new Color(...background));
    this.materials.shadow.uniforms["tone"]?.value.setRGB(...this.theme.shadow);
    this.materials.grid.uniforms["tone"]?.value.setRGB(...this.theme.grid);
    this.invalidate();
  }
}

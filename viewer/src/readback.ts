import { jointColour, linkColour } from "./colours";
import type { Frames } from "./frames";
import type { Player } from "./player";
import type { Stage } from "./stage/stage";

/** What `window.kutzbach` offers to tests and to the curious: the state, and what is really drawn. */
export interface ReadBack {
  /** Resolves when the first picture is drawn, or when it is known that there will be none. */
  readonly ready: Promise<void>;
  /** Where the mechanism is; `motion`, `branch` and `drive` are null where there is none. */
  state(): {
    motion: number | null;
    branch: number | null;
    drive: number | null;
    arclength: number;
    samplePosition: number;
    playing: boolean;
    values: number[];
    webgl: boolean;
  };
  /**
   * `world_from_link` of every link (x, y, z in metres in the world, then the quaternion w, x, y, z), worked back from the
   * matrices that are drawn; links without a shape, and all without WebGL, as they would be drawn.
   */
  links(): number[][];
  /** The matrix a shape is drawn with (4 × 4, by columns): from its unit solid to units of the extent about the centre. */
  shapeMatrix(index: number): number[];
  scrub(arclength: number): void;
  play(): void;
  pause(): void;
  switchBranch(index: number): void;
  drive(column: number): void;
  /** Colours by the palette, `#rrggbb`, with the roles as they are now. */
  colours(): { links: string[]; joints: string[] };
  /** Over the last second of uninterrupted drawing. */
  framesPerSecond(): number;
  /** Milliseconds from the start of navigation to the end of the first picture; null before. */
  firstFrame(): number | null;
}

export const FIRST_FRAME = "kutzbach-first-frame";

export function readBack(player: Player, frames: Frames, ready: Promise<void>, stage: () => Stage | null): ReadBack {
  const { data } = player;
  return {
    ready,
    state: () => ({
      motion: player.motion?.index ?? null,
      branch: player.branch,
      drive: player.column,
      arclength: player.arclength,
      samplePosition: player.samplePosition,
      playing: player.playing,
      values: [...player.values],
      webgl: stage() !== null,
    }),
    links: () => {
      // What is asked for is what is on the screen: the last change is drawn first.
      stage()?.draw();
      return data.links.map((_, link) => {
        const wanted = [...player.pose.subarray(7 * link, 7 * link + 7)];
        const drawn = stage()?.drawnSolids.drawnPose(link) ?? wanted;
        // Of the two signs of a quaternion, the one in the data.
        const dot = [3, 4, 5, 6].reduce((sum, i) => sum + (drawn[i] ?? 0) * (wanted[i] ?? 0), 0);
        const pose = drawn.map((x, i) => (i < 3 ? x + (data.centre[i] ?? 0) : dot < 0 ? -x : x));
        return ownFrame(pose, data.links[link]?.origin);
      });
    },
    shapeMatrix: (index) => {
      stage()?.draw();
      return stage()?.drawnSolids.matrix(index) ?? [];
    },
    scrub: (arclength) => player.scrub(arclength),
    play: () => player.play(),
    pause: () => player.pause(),
    switchBranch: (index) => player.switchBranch(index),
    drive: (column) => player.drive(column),
    colours: () => {
      const roles = player.roles();
      return {
        links: data.links.map((_, link) => linkColour(data, roles, link)),
        joints: data.joints.map((_, joint) => jointColour(data.palette, roles, joint)),
      };
    },
    framesPerSecond: () => frames.perSecond,
    firstFrame: () => performance.getEntriesByName(FIRST_FRAME)[0]?.startTime ?? null,
  };
}

/** From the pose of the frame a link is drawn by to that of its own frame. */
function ownFrame(pose: number[], origin: readonly [number, number, number] | undefined): number[] {
  if (origin === undefined) return pose;
  const [x = 0, y = 0, z = 0, w = 1, a = 0, b = 0, c = 0] = pose;
  const [u, v, t] = origin;
  // v' = v + 2 q × (q × v + w v), q being the vector part.
  const first = [b * t - c * v + w * u, c * u - a * t + w * v, a * v - b * u + w * t] as const;
  const turned = [
    u + 2 * (b * first[2] - c * first[1]),
    v + 2 * (c * first[0] - a * first[2]),
    t + 2 * (a * first[1] - b * first[0]),
  ] as const;
  return [x - turned[0], y - turned[1], z - turned[2], w, a, b, c];
}

import { autoplay, wantsMotion } from "./autoplay";
import { Hint } from "./controls/hint";
import { followKeys, keyList } from "./controls/keys";
import { legend } from "./controls/legend";
import { eventList, heldNote } from "./controls/met";
import { branchChoice, driveChoice, loopChoice, speedChoice, toggles, viewButtons } from "./controls/options";
import { Transport } from "./controls/transport";
import { element } from "./dom";
import { Frames } from "./frames";
import { makeSearchable } from "./gallery";
import { fitGraphs } from "./graph";
import { Lights, followPage } from "./lights";
import { readPageData, type PageData } from "./page_data";
import { Player } from "./player";
import { followPlots } from "./plots";
import { FIRST_FRAME, readBack, type ReadBack } from "./readback";
import { followPointer } from "./stage/hover";
import { Stage } from "./stage/stage";
import { makeSortable } from "./tables";
import { Tooltip } from "./tooltip";
import { fourDigits } from "./number_text";

declare global {
  interface Window {
    kutzbach?: ReadBack;
  }
}

/** Everything but the picture first: it can be read while the first picture is being prepared. */
function start(data: PageData, host: HTMLElement, panel: HTMLElement): void {
  const player = new Player(data);
  const frames = new Frames();
  const lights = new Lights(data);
  const tooltip = new Tooltip();
  let stage: Stage | null = null;

  frames.each((seconds) => {
    player.advance(seconds);
    return player.playing;
  });
  player.onChange((change) => {
    if (change === "playing" && player.playing) frames.request();
  });
  const transport = new Transport(player);
  panel.append(transport.root, new Hint(player).root);
  followPlots(player, tooltip, document);
  for (const part of document.querySelectorAll<HTMLElement>("main section")) {
    if (!part.contains(host)) followPage(lights, part);
  }

  const ready = nextTask().then(() => {
    stage = Stage.open(host, player, lights, frames);
    panel.prepend(...aboutPicture(stage, player, host));
    panel.append(options(stage, player), heldNote(player), eventList(player));
    if (stage !== null || player.motion !== null) panel.append(keyList());
    followKeys([host, panel], player, stage);
    if (stage !== null) followPointer(stage, player, lights, tooltip);
    performance.mark(FIRST_FRAME);
    autoplay(player, host);
  });
  window.kutzbach = readBack(player, frames, ready, () => stage);
}

/** After the browser has had the chance to show the page. */
function nextTask(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, 0));
}

function aboutPicture(stage: Stage | null, player: Player, host: HTMLElement): HTMLElement[] {
  if (stage === null) {
    const note = "This browser shows no 3D pictures (WebGL is off or missing); the sketch shows the pose analysed.";
    return [element("p", { class: "note" }, note)];
  }
  // Beside the colours, not over the picture: what lies over a moving picture makes the browser put both together anew.
  const size = element("span", {}, `grid ${fourDigits(stage.gridCell)} m`);
  const how = element("span", { class: "how" }, "drag to turn, click and scroll to zoom");
  return [element("div", { class: "about" }, legend(player, host), element("p", { class: "caption" }, size, how))];
}

function options(stage: Stage | null, player: Player): HTMLElement {
  const moving = player.data.motions.length > 0;
  const parts = [
    branchChoice(player),
    moving ? driveChoice(player) : null,
    moving ? speedChoice(player) : null,
    moving ? loopChoice(player) : null,
    stage === null ? null : viewButtons(stage, wantsMotion),
    stage === null ? null : toggles(stage),
  ];
  return element("div", { class: "options" }, ...parts.filter((part) => part !== null));
}

makeSortable(document);
makeSearchable(document);
fitGraphs(document);
const data = readPageData();
const host = document.getElementById("stage");
const panel = document.getElementById("controls");
if (data !== null && host !== null && panel !== null) start(data, host, panel);

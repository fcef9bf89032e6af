import type { PageData, Palette, Role, Roles } from "./page_data";

/** A colour as red, green and blue from 0 to 1, as screens mix them. */
export type Rgb = readonly [number, number, number];

/** Reads `#rrggbb` or `#rgb`; middle grey where it is neither. */
export function rgb(text: string): Rgb {
  const digits = /^#([0-9a-f]{3}|[0-9a-f]{6})$/i.exec(text.trim())?.[1] ?? "808080";
  const each = digits.length / 3;
  const part = (i: number): number => {
    const pair = digits.slice(i * each, (i + 1) * each);
    return parseInt(each === 1 ? pair + pair : pair, 16) / 255;
  };
  return [part(0), part(1), part(2)];
}

/** `share` of the way from one colour to another. */
export function mix(from: Rgb, to: Rgb, share: number): Rgb {
  const at = (i: 0 | 1 | 2): number => from[i] + share * (to[i] - from[i]);
  return [at(0), at(1), at(2)];
}

export function hex(colour: Rgb): string {
  return `#${colour.map((part) => Math.round(255 * part).toString(16).padStart(2, "0")).join("")}`;
}

/** The palette's colour of a link. Where roles are not known, every link looks like one that moves. */
export function linkColour(data: PageData, roles: Roles | null, link: number): string {
  const role = link === data.ground ? "ground" : (roles?.links[link] ?? "moving");
  const { palette } = data;
  if (role === "ground" || role === "locked" || role === "idle") return palette[role];
  return palette.moving_links[link % palette.moving_links.length] ?? palette.ground;
}

/** The palette's colour of a joint's symbol. */
export function jointColour(palette: Palette, roles: Roles | null, joint: number): string {
  const role: Role = roles?.joints[joint] ?? "moving";
  return role === "moving" ? palette.moving_joint : palette[role];
}

/** Dark colours of the palette are lifted on dark pages, where they would drown. */
export function onPage(colour: string, dark: boolean): Rgb {
  const plain = rgb(colour);
  if (!dark) return plain;
  const light = 0.3 * plain[0] + 0.59 * plain[1] + 0.11 * plain[2];
  return mix(plain, [1, 1, 1], Math.max(0, 0.55 - light) * 0.8);
}

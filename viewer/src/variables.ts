import { decimals } from "./number_text";
import type { JointData, PageData } from "./page_data";

/** A joint variable: one column of the values of a motion. */
export interface Variable {
  readonly column: number;
  readonly joint: number;
  /** The joint's name, with the variable's where the joint has several. */
  readonly name: string;
  readonly unit: "rad" | "m";
}

/** All variables, by column. */
export function variablesOf(data: PageData): Variable[] {
  const found: Variable[] = [];
  data.joints.forEach((joint, index) => {
    joint.variables.forEach((variable, place) => {
      const column = joint.first + place;
      found[column] = { column, joint: index, name: fullName(joint, variable.name), unit: variable.unit };
    });
  });
  return found;
}

function fullName(joint: JointData, variable: string): string {
  if (joint.variables.length === 1) return joint.name;
  return variable.startsWith(joint.name) ? variable : `${joint.name}.${variable}`;
}

/** `1.571 rad (90.0°)` or `0.250 m`; lengths in as many decimals as the mechanism's size asks for. */
export function valueText(value: number, unit: "rad" | "m", extent: number): string {
  if (unit === "rad") return `${decimals(value, 3)} rad (${decimals((value * 180) / Math.PI, 1)}°)`;
  return `${decimals(value, lengthDecimals(extent))} m`;
}

/** Enough decimals to tell a thousandth of the mechanism's size. */
function lengthDecimals(extent: number): number {
  return Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(extent))));
}

// How long vectors are drawn: a round value of each kind that is shown, with its length.
import { quantity } from "../../words";
import { VECTOR } from "../../strokes";
import { forceScale, nice } from "./loads";
import type { Board } from "./sheet";

export interface Scale {
  kind: "velocity" | "acceleration" | "force" | "load" | "length";
  text: string;
  /** px. */
  long: number;
}

/** About this long a scale is at most, px. */
const LONG = 60;
const SHOWN = [["velocities", "velocity"], ["accelerations", "acceleration"], ["forces", "force"]] as const;

/** The scale of a kind of which a pixel is worth so much (SI). */
export function scale(kind: Scale["kind"], pixel: number): Scale {
  const value = nice(pixel * LONG);
  return { kind, long: value / pixel, text: quantity(value, kind === "load" ? "force" : kind, value, 3) };
}

/** The scales of what is shown on the sheet. */
export function scalesOf({ bench, view, camera, solved, stand }: Board): Scale[] {
  const found = SHOWN.flatMap(([shown, kind]) => {
    const longest = solved && bench.shows(shown) ? (view?.longest[kind] ?? 0) : 0;
    return longest > 0 ? [scale(kind, longest / VECTOR)] : [];
  });
  const forces = Object.values(stand.loads).some(({ kind }) => kind === "force"), aiming = bench.tool.value === "force";
  if (bench.shows("loads") && (aiming || (found.length > 0 && forces))) found.push(scale("load", forceScale(stand.loads)));
  return found.length ? [...found, scale("length", 1 / camera.scale)] : [];
}

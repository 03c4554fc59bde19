// Loads on the drawing paper: forces as arrows from their points (as circles where they turn with the machine), torques as
// arcs on their links, springs and dampers as lines between their points.
import type { Vec } from "./shapes";
import { arrow, element, line } from "./strokes";

/** A load as the text has it; `angle`: direction in space, rad, null where it turns with the machine or has none. */
export interface Load {
  kind: string;
  on: string;
  at: string;
  angle: number | null;
  ends: string[];
  size: string;
  /** In what its direction stays: space, link, ray (two points of its link) or velocity. */
  held?: string;
  /** Direction in the axes of its link, rad. */
  turn?: number | null;
  ray?: string[];
  /** Along the left normal of the ray. */
  normal?: boolean;
  /** Ends with their links: link and point. */
  between?: [string, string][];
  links?: string[];
  joint?: string;
  /** Size (SI), the largest of a ramp; null: no plain number. */
  magnitude?: number | null;
  stiffness?: number | null;
  preload?: number | null;
  /** Whether it acts all the time. */
  always?: boolean;
}

// Lengths in pixels: of a force's arrow and of what of it is left to its point, radius of a torque's arc.
const LONG = 52, FREE = 14, ROUND = 19;

/** The places of a load on the screen: its beginning and its end, the same where it has no direction. */
export function reach(load: Load, place: (point: string) => Vec | null, middle: (link: string) => Vec | null): [Vec, Vec] | null {
  const ends = load.ends.map(place);
  if (load.kind !== "force" && ends.length === 2 && ends[0] && ends[1]) return [ends[0], ends[1]];
  const from = place(load.at) ?? middle(load.on);
  return from && [from, load.angle === null ? from : away(from, load.angle, LONG)];
}

const away = ([x, y]: Vec, angle: number, far: number): Vec => [x + far * Math.cos(angle), y - far * Math.sin(angle)];

/** How far a place of the screen is from a load; the neighbourhood of its point belongs to the point. */
export function off(at: Vec, load: Load, [from, to]: [Vec, Vec]): number {
  if (from === to) return Math.abs(Math.hypot(at[0] - from[0], at[1] - from[1]) - ROUND);
  return distance(at, load.angle === null ? from : away(from, load.angle, FREE), to);
}

/** Draws a load with its size beside it; gives the strokes that names keep off. */
export function drawLoad(host: SVGElement, name: string, load: Load, [from, to]: [Vec, Vec], chosen: boolean): Vec[] {
  const group = element("g", { class: chosen ? "load chosen" : "load", "data-load": name }, host);
  const path = (style: string, d = "") => element("path", { class: style, d }, group);
  let label = to;
  if (from === to) {
    const [x, y] = from;
    if (load.kind === "force") element("circle", { class: "lw-load-line dashed", cx: x, cy: y, r: ROUND }, group);
    else path("lw-load-line", `M${x + ROUND} ${y}A${ROUND} ${ROUND} 0 1 0 ${x} ${y + ROUND}`);
    label = [x + ROUND, y - ROUND];
  } else if (load.angle === null) {
    path("lw-load-line dashed", line([from, to]));
    label = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
  } else arrow(path("lw-load-line"), path("lw-load-head"), from, to);
  element("text", { class: "size", x: label[0] + 6, y: label[1] - 4 }, group).textContent = load.size || load.kind;
  return [from, to];
}

/** How far a place is from a line between two others. */
export function distance(p: Vec, a: Vec, b: Vec): number {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]], square = dx * dx + dy * dy || 1;
  const share = Math.min(1, Math.max(0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square));
  return Math.hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy);
}

// Strokes that several tools lay over the sheet: an element in hand with its length and angle, a link lit up, a block.
import type { Vec } from "../../shapes";
import { dist } from "../sheet/geometry";
import { beyond, turned } from "./hand";
import type { Overlay, Sheet } from "./tool";
import { reads } from "./typed";

// Radius of the arc of an angle, length of the line that it begins at, distance of a dimension line; joints and blocks, px.
const ARC = 40, REFERENCE = 52, OFF = 26, PIN = 5, BLOCK: Vec = [16, 9], GUIDE = 400;
// An element shorter than this on the screen has no angle, one shorter than twice this no dimension line, a long one
// has room for its dimension beside the arc.
const SHORT = 14, LONG = 120;

export const line = (...places: Vec[]) => places.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

/** An element that would be made, between two places (m), with its length and angle. */
export function inHand(over: Overlay, sheet: Sheet, from: Vec, to: Vec, angle = true): void {
  const [a, b] = [from, to].map((each) => sheet.camera.screen(each)), { unit } = sheet.bench.settings.value;
  over.path(line(a, b), "ghost thick");
  if (dist(a, b) > 2 * SHORT) over.dimension(a, b, reads(dist(from, to), "length", unit), "hand strong", side(sheet, a, b));
  if (angle && dist(a, b) > SHORT) arc(over, a, Math.atan2(to[1] - from[1], to[0] - from[0]));
  joint(over, b);
}

/** The side of a dimension: away from the drawing, as lengths stand in it; of a short element where the arc of its angle is not. */
function side(sheet: Sheet, a: Vec, b: Vec): number {
  const clear = b[1] < a[1] ? OFF : -OFF, all = [...sheet.scene.points.values()].map(({ at }) => sheet.camera.screen(at));
  if (dist(a, b) < LONG || !all.length) return clear;
  const [x, y] = [0, 1].map((k) => all.reduce((sum, each) => sum + each[k], 0) / all.length);
  const across = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / dist(a, b);
  return Math.abs(across) < OFF ? clear : Math.sign(across) * OFF;
}

/** The angle of a direction from the horizontal, at a place of the screen. */
export function arc(over: Overlay, at: Vec, angle: number): void {
  const bent = turned(angle), end = beyond(at, ARC, -bent), [x, y] = beyond(at, ARC, 0);
  over.path(line(at, [at[0] + REFERENCE + ARC, at[1]]), "soft dashed");
  const sweep = `A${ARC} ${ARC} 0 0 ${bent > 0 ? 0 : 1} ${end[0].toFixed(1)} ${end[1].toFixed(1)}`;
  over.path(`M${at[0].toFixed(1)} ${at[1].toFixed(1)}L${x.toFixed(1)} ${y.toFixed(1)}${sweep}Z`, "hand fill");
  const [u, v] = beyond(at, ARC + 12, -bent / 2);
  over.text([u, v + 4], reads(bent, "angle"), "hand strong start");
}

/** A circle that may be dashed. */
export function circle(over: Overlay, [x, y]: Vec, r: number, style: string): void {
  over.path(`M${(x - r).toFixed(1)} ${y.toFixed(1)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`, style);
}

/** A joint that would be made, or that is in hand. */
export function joint(over: Overlay, at: Vec, style = "hand pin"): void {
  over.circle(at, PIN, style);
}

/** The outline of a link (m). */
export function outline(sheet: Sheet, link: string): string {
  const corners = sheet.scene.corners(link).map((each) => sheet.camera.screen(each));
  return corners.length ? line(...corners) + (corners.length > 2 ? "Z" : "") : "";
}

/** Lights a link up that a tool has taken. */
export function taken(over: Overlay, sheet: Sheet, link: string): void {
  const d = outline(sheet, link);
  over.path(d, "hand halo");
  over.path(d, "hand thick");
  for (const at of sheet.scene.corners(link)) joint(over, sheet.camera.screen(at));
}

/** A block with its guide, at a place (m). */
export function guide(over: Overlay, sheet: Sheet, place: Vec, angle: number): void {
  const at = sheet.camera.screen(place), along = (far: number) => beyond(at, far, -angle), [long, wide] = BLOCK;
  over.path(line(along(-GUIDE), along(GUIDE)), "soft dashed");
  const corner = (u: number, v: number): Vec => beyond(along(u), v, -angle - Math.PI / 2);
  over.path(`${line(corner(-long, -wide), corner(long, -wide), corner(long, wide), corner(-long, wide))}Z`, "ghost thick");
  joint(over, at);
}

export { ARC, OFF };

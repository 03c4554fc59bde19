// What the solved machine says on the sheet: transmission angles as arcs, limit positions, sizes of vectors.
import type { Session } from "../../session";
import type { Vec } from "../../shapes";
import type { Overlay, Sheet } from "../tools/tool";
import { quantity } from "../../words";
import type { Stand } from "./loads";
import { VECTOR } from "../../strokes";
import type { View } from "../../view";

/** Transmission angles that are good, and those with which a machine nearly locks, rad. */
export const GOOD = (40 * Math.PI) / 180, LOCKS = (20 * Math.PI) / 180;
const R = 46;
// About how wide a symbol with its gap and a letter are, px.
const SIGN = 13, LETTER = 6.9;

/** An angle between two directions at a place of the screen, by its sides (rad, counter-clockwise). */
export interface Wedge {
  at: Vec;
  from: number;
  to: number;
  /** The side that a link lies on the other way. */
  back: number | null;
}

/** The acute angle between two directions at a place: the second one goes back where the angle to it is obtuse. */
export function wedge(at: Vec, a: number, b: number): Wedge {
  const turn = Math.atan2(Math.sin(b - a), Math.cos(b - a));
  if (Math.abs(turn) <= Math.PI / 2 + 1e-9) return { at, from: a, to: a + turn, back: null };
  const other = turn - Math.sign(turn) * Math.PI;
  return { at, from: a, to: a + other, back: a + other };
}

/** A wedge as a path: its arc, and with its sides. */
export function wedgePath({ at: [x, y], from, to }: Wedge, r = R): string {
  const end = (angle: number) => `${(x + r * Math.cos(angle)).toFixed(1)} ${(y - r * Math.sin(angle)).toFixed(1)}`;
  return `M${x.toFixed(1)} ${y.toFixed(1)}L${end(from)}A${r} ${r} 0 0 ${to > from ? 0 : 1} ${end(to)}Z`;
}

/** Where a group's transmission angle is: its inner joint and the directions of its two ways there. */
export function transmissionAt(stand: Stand, links: string[], joints: string[]): Wedge | null {
  const { scene } = stand, points = (link: string) => scene.links[link] ?? [];
  const [a, b] = links;
  if (links.length !== 2) return null;
  const pin = points(a).find((point) => points(b).includes(point)), at = pin === undefined ? null : scene.at(pin);
  if (!at) return null;
  const outer = (link: string) => points(link).find((point) => point !== pin && joints.includes(point)) ?? points(link).find((point) => point !== pin);
  const way = (link: string) => {
    const guide = points(link).length === 1 ? stand.guideOf(link) : null, end = outer(link), to = end === undefined ? null : scene.at(end);
    return guide ? guide.angle + Math.PI / 2 : to && Math.atan2(to[1] - at[1], to[0] - at[0]);
  };
  const [u, v] = [way(a), way(b)];
  return u === null || v === null ? null : wedge(at, u, v);
}

export function drawTransmission({ bench, camera, stand }: Sheet, over: Overlay): void {
  const { session } = stand;
  if (!session || !bench.shows("transmission")) return;
  const { structure } = bench.desk.solved.value;
  for (const { name, links } of session.data.groups) {
    const value = stand.row(`m:${name}`);
    if (value === null || !Number.isFinite(value)) continue;
    const found = transmissionAt(stand, links, structure?.groups.find((each) => each.name === name)?.joints ?? []);
    if (!found) continue;
    const [style, word] = value >= GOOD ? ["good", ""] : value >= LOCKS ? ["warn", bench.say("mu.low")] : ["bad", bench.say("mu.locks")];
    const at = camera.screen(found.at), arc = { ...found, at };
    over.path(wedgePath(arc), `${style} fill mu-fill`);
    over.path(wedgePath(arc).replace(/^M[^L]+L([^A]+)A/, "M$1A").replace("Z", ""), `${style} thick`);
    if (style === "warn") hatch(over, arc);
    if (found.back !== null) over.path(`M${at[0]} ${at[1]}L${at[0] + (R + 14) * Math.cos(found.back)} ${at[1] - (R + 14) * Math.sin(found.back)}`, "soft dashed");
    const middle = (arc.from + arc.to) / 2, [x, y] = [at[0] + (R + 12) * Math.cos(middle), at[1] - (R + 12) * Math.sin(middle) + 4], left = Math.cos(middle) < -0.2;
    const text = `${quantity(value, "angle", 1, 3)}${word && ` ${word}`}`;
    symbolled(over, [x, y], "μ", text, style, left, " strong");
  }
}

/** A value behind its symbol, on the right of a place or on its left. */
function symbolled(over: Overlay, [x, y]: Vec, symbol: string, text: string, style: string, left: boolean, weight = ""): void {
  const from = left ? x - SIGN - LETTER * text.length : x;
  over.text([from, y], symbol, `${style} name start`);
  over.text([from + SIGN, y], text, `${style} start${weight}`);
}

/** Strokes across an angle that is too small. */
function hatch(over: Overlay, { at: [x, y], from, to }: Wedge): void {
  let d = "";
  for (let k = 1; k < 6; k++) {
    const angle = from + ((to - from) * k) / 6, [c, s] = [Math.cos(angle), Math.sin(angle)];
    d += `M${(x + (R - 12) * c).toFixed(1)} ${(y - (R - 12) * s).toFixed(1)}L${(x + R * c).toFixed(1)} ${(y - R * s).toFixed(1)}`;
  }
  over.path(d, "warn line");
}

// limits ---------------------------------------------------------------------------------------

const known = new WeakMap<Session, { version: number; found: Record<string, Vec>[] }>();

/** Places of all points (by key) where the machine's first output is at its two limits. */
export function limits(session: Session): Record<string, Vec>[] {
  const version = session.calm.peek(), before = known.get(session);
  if (before?.version === version) return before.found;
  const { model } = session, figure = session.data.numbers.find(({ kind }) => kind === "range"), found: Record<string, Vec>[] = [];
  if (figure) {
    const row = model.row(figure.signal);
    for (const sign of [1, -1] as const) {
      const place = model.extreme(figure.signal, row, sign).at, between = Number.isInteger(place) ? null : model.solver.whole(place), call = between ?? model.main;
      const k = between ? 0 : Math.round(place) % model.n;
      found.push(Object.fromEntries(session.data.points.map(({ key }) => [key, [call.row(`p:${key}.x`)[k], call.row(`p:${key}.y`)[k]] as Vec])));
    }
  }
  known.set(session, { version, found });
  return found;
}

/** Links at the limits of the output, pale; those that the driver turns are left out. */
export function drawLimits({ bench, camera, scene, stand }: Sheet, over: Overlay): void {
  const { session } = stand;
  if (!session || !bench.shows("limits")) return;
  const moving = new Set((scene.links[scene.driver ?? ""] ?? []).filter((name) => !scene.points.get(name)?.fixed));
  for (const places of limits(session))
    for (const [name, points] of Object.entries(scene.links)) {
      if (name === scene.driver || points.some((point) => moving.has(point))) continue;
      const corners = points.map((point) => places[scene.points.get(point)?.key ?? ""]).filter((each) => each).map((each) => camera.screen(each));
      const along = corners.length === 1 ? stand.guideOf(name)?.angle : undefined;
      if (along !== undefined) over.path(block(corners[0], along), "limit");
      if (corners.length > 1) over.path(corners.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("") + (corners.length > 2 ? "Z" : ""), "limit");
    }
}

/** The outline of a block that slides. */
function block([x, y]: Vec, angle: number): string {
  const [c, s] = [Math.cos(angle), -Math.sin(angle)], corner = (u: number, v: number) => `${(x + u * c - v * s).toFixed(1)} ${(y + u * s + v * c).toFixed(1)}`;
  return `M${corner(-15, -9)}L${corner(15, -9)}L${corner(15, 9)}L${corner(-15, 9)}Z`;
}

// vectors --------------------------------------------------------------------------------------

const FAMILIES = [["velocities", "velocity", "v", "v", "velocity"], ["accelerations", "acceleration", "a", "a", "acceleration"]] as const;

/** Sizes at the heads of vectors: of the largest one of each kind, and of selected points. */
export function drawVectorSizes({ bench, camera, scene, stand }: Sheet, over: Overlay, view: View): void {
  const { session } = stand;
  if (!session) return;
  const one = (style: string, symbol: string, kind: string, at: Vec, [x, y]: Vec) => {
    const long = VECTOR / view.longest[style], from = camera.screen(at), end: Vec = [from[0] + long * x, from[1] - long * y], left = x < 0;
    const text = quantity(Math.hypot(x, y), kind, Math.hypot(x, y), 3), spot: Vec = [end[0] + (left ? -6 : 6), end[1] + (y > 0 ? -4 : 12)];
    symbolled(over, spot, symbol, text, style, left);
  };
  for (const [shown, style, symbol, row, kind] of FAMILIES) {
    if (!bench.shows(shown) || !view.longest[style]) continue;
    const all = [...scene.points.values()].flatMap(({ name, key, at, fixed }) => {
      const vector = key && !fixed ? stand.pair(`${row}:${key}`) : null;
      return vector ? [{ name, at, vector, size: Math.hypot(...vector) }] : [];
    });
    const largest = all.reduce<(typeof all)[number] | null>((best, each) => (!best || each.size > best.size ? each : best), null);
    for (const each of all) if (each.size > 0 && (each === largest || bench.has({ kind: "point", name: each.name }))) one(style, symbol, kind, each.at, each.vector);
  }
  if (!bench.shows("forces") || !view.longest.force || !session.model.forces) return;
  let best: { at: Vec; vector: Vec; size: number } | null = null;
  for (const { id } of session.data.signals) {
    if (!id.startsWith("r:")) continue;
    const joint = id.slice(2).split("|")[0], point = scene.points.get(joint), vector = point && stand.pair(id), size = vector ? Math.hypot(...vector) : 0;
    if (point && vector && size > (best?.size ?? 0)) best = { at: point.at, vector, size };
  }
  if (best) one("force", "F", "force", best.at, best.vector);
}

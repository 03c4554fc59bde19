// Loads where they stand on the sheet: directions in space, lengths of arrows by size, what is under the pointer.
import type { Outputs } from "../../engine";
import type { Guide, Load, Picture } from "../picture";
import type { Session } from "../../session";
import type { Vec } from "../../shapes";
import type { Camera } from "./camera";
import { dist, nearestOn } from "./geometry";
import type { Scene } from "./scene";

/** A load as it is drawn, in pixels: an arrow from `from` to its head `to`, a line between two ends, or an arc about `from`. */
export interface DrawnLoad {
  name: string;
  form: "arrow" | "arc" | "spring" | "damper" | "gas" | "cylinder" | "twist" | "ring";
  from: Vec;
  to: Vec;
  /** Sense of an arc, +1 counter-clockwise. */
  sense: number;
  /** Whether it acts at the position that is shown. */
  acts: boolean;
  size: string;
}

// Lengths in pixels: between an arrow's head and its point (of a block), the longest and the shortest arrow, one whose
// size is no number, an arc's radius.
const GAP = 7, BLOCK_GAP = 22, LONG = 140, SHORT = 16, PLAIN = 52;
export const ROUND = 19;
/** Newtons for a pixel where no load says how large forces are. */
const USUAL = 2;
/** The least size of a vector that is drawn, of its usual one. */
const NOTHING = 1e-12;

/** The machine or drawing as it stands on the sheet, with directions of its links. */
export class Stand {
  readonly picture: Partial<Picture>;
  private readonly call: Outputs | null = null;
  private readonly k: number = 0;

  /** `place`: among the positions of the machine, between them as well. */
  constructor(readonly scene: Scene, picture: Picture | undefined, readonly session: Session | null, place: number) {
    this.picture = picture ?? {};
    if (!session) return;
    const { main, solver, n } = session.model, found = Number.isInteger(place) ? null : solver.whole(place);
    [this.call, this.k] = found ? [found, 0] : [main, Math.round(place) % n];
  }

  get loads(): Record<string, Load> {
    return this.picture.loads ?? {};
  }

  row(name: string): number | null {
    return this.call?.has(name) ? this.call.row(name)[this.k] : null;
  }

  pair(name: string): Vec | null {
    const x = this.row(`${name}.x`), y = this.row(`${name}.y`);
    return x === null || y === null || !Number.isFinite(x + y) ? null : [x, y];
  }

  /** Angle of a link's own axes, rad; null where nothing says it. */
  axis(link: string): number | null {
    if (link === "frame") return 0;
    const solved = this.pair(`e:${link}`);
    if (solved) return Math.atan2(solved[1], solved[0]);
    const [a, b] = this.scene.corners(link);
    return a && b ? Math.atan2(b[1] - a[1], b[0] - a[0]) : (this.guideOf(link)?.angle ?? null);
  }

  /** The guide along which a link slides, and its direction there, rad. */
  guideOf(link: string): { name: string; angle: number } | null {
    for (const [name, guide] of Object.entries(this.picture.guides ?? {})) {
      if (guide.block !== link) continue;
      const angle = this.along(name, guide);
      if (angle !== null) return { name, angle };
    }
    return null;
  }

  private along(name: string, { guide, direction, ray }: Guide): number | null {
    const solved = this.pair(`d:${name}`);
    if (solved) return Math.atan2(solved[1], solved[0]);
    const [a, b] = ray.map((point) => this.scene.at(point));
    if (a && b) return Math.atan2(b[1] - a[1], b[0] - a[0]);
    const axis = direction === null ? null : this.axis(guide);
    return axis === null ? null : axis + direction!;
  }

  /** Where the mass centre of a link is. */
  centre(link: string): Vec | null {
    const solved = this.pair(`p:${link}.@centre`), centre = this.picture.masses?.[link]?.centre ?? null;
    if (solved) return solved;
    if (typeof centre === "string") return this.scene.at(centre);
    const [a, b] = this.scene.corners(link), axis = this.axis(link);
    if (centre && a && axis !== null) return [a[0] + centre[0] * Math.cos(axis) - centre[1] * Math.sin(axis), a[1] + centre[0] * Math.sin(axis) + centre[1] * Math.cos(axis)];
    return a && b ? [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] : (a ?? null);
  }

  middle(link: string): Vec | null {
    const all = this.scene.corners(link);
    return all.length ? ([0, 1].map((k) => all.reduce((sum, each) => sum + each[k], 0) / all.length) as Vec) : null;
  }

  /** Direction in which a force points, rad; null where that is not known. */
  direction({ on, angle, held, turn, ray = [], normal }: Load): number | null {
    if (angle !== null) return angle;
    const axis = this.axis(on), [p, q] = ray.map((point) => this.scene.at(point));
    if (held === "link" && typeof turn === "number" && axis !== null) return axis + turn;
    return p && q ? Math.atan2(q[1] - p[1], q[0] - p[0]) + (normal ? Math.PI / 2 : 0) : null;
  }

  /** The force of a load at this position as a vector, N, and where it acts; null: it does not act, or nothing says it. */
  force(name: string, load: Load): { at: Vec; force: Vec | null; nominal: number | null } | null {
    const at = this.pair(`lp:${name}`) ?? this.scene.at(load.at);
    if (!at) return null;
    const solved = this.session?.model.forces ? this.pair(`lf:${name}`) : null, nominal = this.direction(load);
    if (solved) return { at, force: Math.hypot(...solved) > NOTHING ? solved : null, nominal };
    const size = load.magnitude ?? null;
    return { at, nominal, force: size === null || nominal === null ? null : [size * Math.cos(nominal), size * Math.sin(nominal)] };
  }

  /** Points where a load is held, with their places. */
  ends({ between = [], ends, links = [] }: Load): (Vec | null)[] {
    if (between.length === 2) return between.map(([, point]) => this.scene.at(point));
    const shared = links.length === 2 ? this.pin(links[0], links[1]) : null;
    return shared ? [this.scene.at(shared)] : ends.map((point) => this.scene.at(point));
  }

  /** A point that two links have in common. */
  pin(a: string, b: string): string | null {
    const of = (link: string) => (link === "frame" ? (this.picture.fixed ?? []) : (this.picture.links?.[link] ?? []));
    return of(a).find((point) => of(b).includes(point)) ?? null;
  }
}

/** The largest of 1, 2 and 5 times a power of ten that is not above a value. */
export function nice(value: number): number {
  const power = Math.floor(Math.log10(value) + 1e-9), of = (lead: number) => Number(`${lead}e${power}`);
  return of([5, 2, 1].find((lead) => of(lead) <= value * (1 + 1e-9)) ?? 1);
}

/** Newtons for a pixel, so that the largest force is no longer than the longest arrow. */
export function forceScale(loads: Record<string, Load>): number {
  const sizes = Object.values(loads).map(({ kind, magnitude }) => (kind === "force" ? Math.abs(magnitude ?? 0) : 0)), most = Math.max(0, ...sizes);
  if (!(most > 0)) return USUAL;
  const least = most / LONG, below = nice(least);
  return below >= least * (1 - 1e-9) ? below : nice(below * 2.5 * (1 + 1e-9));
}

/** All loads as they are drawn. */
export function drawnLoads(stand: Stand, camera: Camera): DrawnLoad[] {
  const scale = forceScale(stand.loads);
  return Object.entries(stand.loads).flatMap(([name, load]) => drawn(name, load, stand, camera, scale) ?? []);
}

function drawn(name: string, load: Load, stand: Stand, camera: Camera, scale: number): DrawnLoad | null {
  const base = { name, sense: 1, acts: true, size: load.size };
  switch (load.kind) {
    case "force": return pushing(name, load, stand, camera, scale);
    case "torque": {
      const middle = stand.middle(load.on), at = middle && camera.screen(middle);
      return at && { ...base, form: "arc", from: at, to: at, sense: Math.sign(load.magnitude ?? 1) || 1 };
    }
    case "pressure": {
      const guide = stand.picture.guides?.[load.joint ?? ""], place = guide && stand.scene.at(guide.at), at = place && camera.screen(place);
      return at ? { ...base, form: "ring", from: at, to: at } : null;
    }
  }
  const [a, b] = stand.ends(load).map((each) => each && camera.screen(each));
  if (a && b) return { ...base, form: formOf(load), from: a, to: b };
  return a ? { ...base, form: "twist", from: a, to: a } : null;
}

/** What a load between two points is drawn as: a spring that pushes from its free length on is a gas spring, one without
 *  stiffness a cylinder. */
function formOf({ kind, stiffness, preload }: Load): DrawnLoad["form"] {
  if (kind === "damper") return "damper";
  return stiffness === 0 ? "cylinder" : (preload ?? 0) < 0 ? "gas" : "spring";
}

/** How far an arrow's head is from the point of a link that it acts on, px. */
export const gapAt = (link: string, stand: Stand) => (stand.guideOf(link) ? BLOCK_GAP : GAP);

function pushing(name: string, load: Load, stand: Stand, camera: Camera, scale: number): DrawnLoad | null {
  const found = stand.force(name, load), base = { name, sense: 1, size: load.size };
  if (!found) return null;
  const at = camera.screen(found.at), { force, nominal } = found, gap = gapAt(load.on, stand);
  if (!force && nominal === null) return { ...base, form: "ring", from: at, to: at, acts: false };
  const size = force ? Math.hypot(...force) : 0, u: Vec = force ? [force[0] / size, -force[1] / size] : [Math.cos(nominal!), -Math.sin(nominal!)];
  const long = force ? Math.min(1.5 * LONG, Math.max(SHORT, size / scale)) : PLAIN;
  const tip: Vec = [at[0] - gap * u[0], at[1] - gap * u[1]];
  return { ...base, form: "arrow", from: [tip[0] - long * u[0], tip[1] - long * u[1]], to: tip, acts: force !== null };
}

/** How far a place of the screen is from a load, px. */
export function offLoad(at: Vec, { form, from, to }: DrawnLoad): number {
  if (form !== "arc" && form !== "twist" && form !== "ring") return dist(at, nearestOn(at, from, to).at);
  return Math.abs(Math.hypot(at[0] - from[0], at[1] - from[1]) - ROUND);
}

// An arrow's head: its length and half its width, px.
const HEAD = 10, HALF = 3.7;
const place = ([x, y]: Vec) => `${x.toFixed(1)} ${y.toFixed(1)}`;

/** Shaft and head of an arrow between two places of the screen. */
export function arrowPath(from: Vec, to: Vec): [shaft: string, head: string] {
  const far = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1, [u, v] = [(to[0] - from[0]) / far, (to[1] - from[1]) / far], size = Math.min(HEAD, far);
  const back: Vec = [to[0] - size * u, to[1] - size * v], half = (HALF * size) / HEAD;
  return [
    `M${place(from)}L${place([to[0] - 0.8 * size * u, to[1] - 0.8 * size * v])}`,
    `M${place(to)}L${place([back[0] - half * v, back[1] + half * u])}L${place([back[0] + half * v, back[1] - half * u])}Z`,
  ];
}

/** An arc about a place with a head at its end, from one angle to another (rad, counter-clockwise positive). */
export function arcPath([x, y]: Vec, r: number, from: number, to: number): [arc: string, head: string] {
  const at = (angle: number, radius = r): Vec => [x + radius * Math.cos(angle), y - radius * Math.sin(angle)], way = to - from, sign = Math.sign(way) || 1;
  const bend = Math.min(HEAD / r, Math.abs(way)), end = to - sign * bend, large = Math.abs(end - from) > Math.PI ? 1 : 0;
  return [
    `M${place(at(from))}A${r} ${r} 0 ${large} ${sign > 0 ? 0 : 1} ${place(at(end))}`,
    `M${place(at(to))}L${place(at(end, r - HALF))}L${place(at(end, r + HALF))}Z`,
  ];
}

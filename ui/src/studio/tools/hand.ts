// What tools that draw have in common: clicks, typed values, names that are free, what is under the pointer.
import type { Vec } from "../../shapes";
import type { Bench, Item } from "../bench";
import { dist } from "../sheet/geometry";
import type { Scene } from "../sheet/scene";
import type { Field, Sheet, Spot } from "./tool";
import { typed, type Typed } from "./typed";

// A press that goes farther than this is a drag, and a click within this of a joint is on it, px.
const STILL = 5, STILL_TOUCH = 12, ON = 10;
// Points that are nearer to each other are seen as one, m.
const TOGETHER = 1e-6;
// O is for pivots.
const LETTERS = "ABCDEFGHIJKLMNPQRSTUVWXYZ";

/** The place at a distance from another one, in a direction. */
export const beyond = ([x, y]: Vec, far: number, angle: number): Vec => [x + far * Math.cos(angle), y + far * Math.sin(angle)];
export const near = (spot: Spot, screen: Vec) => dist(spot.screen, screen) <= ON;

/** Makes clicks of presses. Where `begins`, a drag is two clicks: one where it begins, one where it ends. */
export class Clicks {
  private pressed: Spot | null = null;
  private dragged = false;
  private begun = false;

  constructor(private readonly click: (spot: Spot) => void, private readonly begins: () => boolean = () => false) {}

  down(spot: Spot): void {
    this.pressed = spot;
    this.dragged = this.begun = false;
  }

  move(spot: Spot): void {
    if (!this.pressed || this.dragged || !this.far(spot)) return;
    this.dragged = true;
    this.begun = this.begins();
    if (this.begun) this.click(this.pressed);
  }

  up(spot: Spot): void {
    const { pressed } = this;
    this.pressed = null;
    if (pressed) this.click(this.dragged ? spot : pressed);
  }

  /** What was pressed is no click; false where that is not enough: nothing was, or a drag has begun something. */
  drop(): boolean {
    const enough = this.pressed !== null && !this.begun;
    this.pressed = null;
    return enough;
  }

  private far({ screen, touch }: Spot): boolean {
    return dist(this.pressed!.screen, screen) > (touch ? STILL_TOUCH : STILL);
  }
}

/** A tool that works by clicks. */
export abstract class ClickTool {
  protected readonly clicks = new Clicks((spot) => this.click(spot), () => this.pulls());

  constructor(readonly sheet: Sheet) {}

  protected abstract click(spot: Spot): void;

  /** Whether a drag that begins now is two clicks. */
  protected pulls(): boolean {
    return false;
  }

  down(spot: Spot): void {
    this.clicks.down(spot);
  }

  move(spot: Spot): void {
    this.clicks.move(spot);
    this.sheet.redraw();
  }

  up(spot: Spot): void {
    this.clicks.up(spot);
  }
}

/** Values typed while an element is in hand. */
export class TypedValues {
  private readonly given = new Map<string, Typed>();
  private readonly raw = new Map<string, string>();

  constructor(private readonly bench: Bench, private readonly quantities: Record<string, Field["quantity"]>) {}

  /** A typed text, "" takes it back; a sentence where it cannot be read, or where `admits` does not take the value. */
  type(key: string, text: string, admits: (value: number) => boolean = () => true): string | null {
    const quantity = this.quantities[key];
    if (!text.trim()) {
      this.given.delete(key);
      this.raw.delete(key);
      return null;
    }
    const found = typed(text, quantity, this.bench.settings.value.unit);
    if (!found || !admits(found.value)) return this.bench.say(`refuse.${quantity}`, { text: text.trim() });
    this.given.set(key, found);
    this.raw.set(key, text);
    return null;
  }

  value(key: string): number | null {
    return this.given.get(key)?.value ?? null;
  }

  /** As the file has it. */
  written(key: string): string | null {
    return this.given.get(key)?.text ?? null;
  }

  field(key: string, value: number | string, more: Partial<Field> = {}): Field {
    const quantity = this.quantities[key];
    return { key, label: more.label ?? this.bench.say(`value.${key}`), quantity, value, text: this.raw.get(key) ?? null, ...more };
  }

  get any(): boolean {
    return this.given.size > 0;
  }

  /** Takes all back; whether there were any. */
  clear(): boolean {
    const { any } = this;
    this.given.clear();
    this.raw.clear();
    return any;
  }
}

/** The first free name for a point: O1, O2, … for pivots, else a letter, then P1, P2, …; `taken`: further names. */
export function freshPoint(scene: Scene, pivot: boolean, taken: Iterable<string> = []): string {
  const known = new Set([...scene.points.keys(), ...Object.values(scene.links).flat(), ...Object.keys(scene.links), ...taken]);
  if (!pivot) for (const letter of LETTERS) if (!known.has(letter)) return letter;
  for (let k = 1; ; k++) if (!known.has(`${pivot ? "O" : "P"}${k}`)) return `${pivot ? "O" : "P"}${k}`;
}

/** A point in hand: one of the drawing, or one that is made with the element; `on`: the link that it becomes a point of. */
export interface End {
  name: string;
  at: Vec;
  made: boolean;
  on: string | null;
}

/** What a click means for a tool that draws from point to point; `taken`: names in hand. */
export function endAt(spot: Spot, scene: Scene, taken: Iterable<string> = []): End {
  const { snap } = spot;
  if (snap?.kind === "point" && scene.at(snap.name)) {
    const name = uppermost(scene, snap.name);
    return { name, at: scene.at(name)!, made: false, on: null };
  }
  return { name: freshPoint(scene, false, taken), at: spot.place, made: true, on: snap?.kind === "link" && snap.name in scene.links ? snap.name : null };
}

/** What an end is now: a joint that is gone meanwhile is made again; `coming`: points on their way into the text. */
export function current(end: End, scene: Scene, coming: Iterable<string> = []): End {
  const there = scene.at(end.name);
  if (there) return { name: end.name, at: there, made: false, on: null };
  return [...coming].includes(end.name) ? end : { ...end, made: true };
}

/** The action that makes a point in hand part of the link that it was dropped on; none where it was not. */
export const dropped = ({ name, at, on }: End) => (on ? [{ do: "add_point", link: on, point: name, at }] : []);

/** The point under the pointer, whether it snaps or not. */
export function pointAt(spot: Spot, scene: Scene): string | null {
  const snapped = spot.snap?.kind === "point" && scene.points.has(spot.snap.name) ? spot.snap.name : null;
  const found = snapped ?? spot.under.find(({ kind, name }) => kind === "point" && scene.points.has(name))?.name;
  return found ? uppermost(scene, found) : null;
}

/** Of points at one place the one that is seen: that of a block, not the one of the frame by which its guide goes. */
function uppermost(scene: Scene, name: string): string {
  const at = scene.at(name)!, here = [...scene.points.values()].filter((each) => dist(each.at, at) < TOGETHER);
  return (here.find((each) => scene.guided.includes(each.name)) ?? here.find((each) => each.links.length) ?? here[0]).name;
}

/** The link under the pointer, one that `fits` before others; a point stands for its links, the one with fewest points first. */
export function linkAt(spot: Spot, scene: Scene, fits: (link: string) => boolean = () => true): string | null {
  const found = linksUnder(spot.under, scene);
  return found.find(fits) ?? found[0] ?? null;
}

function linksUnder(under: Item[], scene: Scene): string[] {
  const own = (point: string) => [...(scene.points.get(point)?.links ?? [])].sort((a, b) => scene.links[a].length - scene.links[b].length);
  const direct = under.filter(({ kind, name }) => kind === "link" && name in scene.links).map(({ name }) => name);
  const through = under.filter(({ kind }) => kind === "point").flatMap(({ name }) => own(name));
  // Close to a joint several links are under the pointer: that of fewest points is the one that is meant.
  return [...new Set([...direct, ...through])];
}

/** The pivot of a link: its point that the frame holds. */
export function pivotOf(scene: Scene, link: string): string | null {
  return (scene.links[link] ?? []).find((point) => scene.points.get(point)?.fixed) ?? null;
}

/** Where two circles meet, on the side of a place; null where they do not. */
export function meeting(a: Vec, ra: number, b: Vec, rb: number, towards: Vec): Vec | null {
  const far = dist(a, b), u = (far * far + ra * ra - rb * rb) / (2 * far), square = ra * ra - u * u;
  if (!far || square < -1e-12) return null;
  const [ex, ey]: Vec = [(b[0] - a[0]) / far, (b[1] - a[1]) / far], v = Math.sqrt(Math.max(0, square));
  const side = ex * (towards[1] - a[1]) - ey * (towards[0] - a[0]) < 0 ? -v : v;
  return [a[0] + u * ex - side * ey, a[1] + u * ey + side * ex];
}

/** An angle between −π and π. */
export function turned(angle: number): number {
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}

// Curves over the input on a canvas as large as its place; the cursor is moved over it, so that a frame paints nothing.
import type { Extreme } from "../../numbers";
import { type Colour, colours, painted } from "../../palette";
import { thinned } from "../../strokes";
import { digits } from "../../words";

export interface Shown {
  /** Places along the axis, one more than values where a cycle closes. */
  x: ArrayLike<number>;
  now: ArrayLike<number>;
  before: ArrayLike<number> | null;
  /** Kept variants. */
  kept: ArrayLike<number>[];
  /** Extremes between the positions. */
  peaks: Extreme[];
  colour: Colour;
  /** SI value of the unit that is written. */
  factor: number;
  /** What an angle gains in turns while a cycle closes; 0: it does not. */
  turn: number;
  /** A value that ought not to be passed downwards. */
  limit: number | null;
  ticks: { share: number; text: string }[];
}

const LEFT = 44, RIGHT = 10, TOP = 10, BOTTOM = 20, NEAR = 0.1, LETTERS = "11px system-ui, sans-serif";
/** Colours of kept variants, in their order. */
const KEPT = ["a", "b", "c", "d"] as const;
/** Share of the scale's height below which numbers at the axis would cover each other. */
const APART = 14;
/** Room of the numbers at the scale on the left of it, of the texts at the foot, px. */
const SIDE = 5, FOOT = 15;

export class Plot {
  readonly end: () => void;
  private readonly canvas: HTMLCanvasElement;
  private readonly pen: CanvasRenderingContext2D;
  private readonly line: HTMLElement;
  private readonly dot: HTMLElement;
  private shown: Shown | null = null;
  private shares = new Float64Array();
  private scale: [low: number, high: number] = [0, 1];
  private size: [wide: number, tall: number] = [0, 0];
  private at: [place: number, value: number] = [0, NaN];
  /** The shares across the canvas. */
  private us = new Float64Array();
  /** Curves that are compared with, and what their paths depend on. */
  private paths: { places: unknown[]; known: Map<ArrayLike<number>, Path2D> } = { places: [], known: new Map() };
  /** The texts that are painted. */
  private texts: { side: string; ticks: Shown["ticks"] | null } = { side: "", ticks: null };

  constructor(private readonly host: HTMLElement) {
    const { canvas, pen, end } = painted(host, () => this.resized());
    [this.canvas, this.pen] = [canvas, pen];
    canvas.setAttribute("role", "img");
    // As large as it will be at once: the observer comes a frame later.
    [canvas.width, canvas.height] = [host.clientWidth, host.clientHeight].map((each) => Math.round(each * (devicePixelRatio || 1)));
    this.line = host.appendChild(Object.assign(document.createElement("i"), { className: "plot-at" }));
    this.dot = host.appendChild(Object.assign(document.createElement("i"), { className: "plot-dot" }));
    this.end = () => {
      end();
      this.line.remove();
      this.dot.remove();
    };
  }

  label(text: string): void {
    if (this.canvas.ariaLabel !== text) this.canvas.ariaLabel = text;
  }

  set(shown: Shown): void {
    if (this.shown?.x !== shown.x) {
      const { x } = shown, first = x[0], range = x[x.length - 1] - first || 1;
      this.shares = Float64Array.from(x, (each) => (each - first) / range);
    }
    this.shown = shown;
    this.scale = reach(shown);
    this.host.style.setProperty("--curve", `var(--${shown.colour})`);
    this.paint();
    this.put();
  }

  /** Puts the cursor at a place among the positions, between two of them as well. */
  cursor(place: number, value: number): void {
    this.at = [place, value];
    this.put();
  }

  /** The share of the cycle under a point of the screen. */
  phase(clientX: number): number {
    const box = this.canvas.getBoundingClientRect(), share = (clientX - box.left - LEFT) / (box.width - LEFT - RIGHT), { shares } = this, last = shares.length - 1;
    let i = 0;
    while (i < last - 1 && shares[i + 1] < share) i++;
    const place = i + (share - shares[i]) / (shares[i + 1] - shares[i] || 1);
    return Math.min(1, Math.max(0, place / last));
  }

  /** A canvas forgets all with its size; colours have changed. */
  private resized(): void {
    this.texts = { side: "", ticks: null };
    this.paint();
    this.put();
  }

  private u(share: number): number {
    return LEFT + share * (this.size[0] - LEFT - RIGHT);
  }

  private v(y: number): number {
    const [low, high] = this.scale;
    return TOP + ((high - y) / (high - low)) * (this.size[1] - TOP - BOTTOM);
  }

  private put(): void {
    const [place, value] = this.at, { shares } = this;
    if (!this.size[0] || !shares.length) return;
    const i = Math.min(shares.length - 2, Math.floor(place)), u = this.u(shares[i] + (place - i) * (shares[i + 1] - shares[i])).toFixed(1);
    this.line.style.transform = `translate(${u}px, ${TOP}px)`;
    const seen = Number.isFinite(value);
    this.dot.hidden = !seen;
    if (seen) this.dot.style.transform = `translate(${u}px, ${this.v(value).toFixed(1)}px)`;
  }

  private paint(): void {
    const { canvas, pen, shown } = this, dense = devicePixelRatio || 1;
    this.size = [canvas.width / dense, canvas.height / dense];
    const [wide, tall] = this.size;
    if (!shown || wide < LEFT + RIGHT || tall < TOP + BOTTOM) return;
    this.line.style.height = `${tall - TOP - BOTTOM}px`;
    const colour = colours(), floor = tall - BOTTOM, end = wide - RIGHT;
    pen.setTransform(dense, 0, 0, dense, 0, 0);
    pen.clearRect(LEFT - SIDE, 0, wide, tall - FOOT);
    pen.lineJoin = "round";
    const stroke = (path: Path2D, style: string, width: number, dashes: number[] = []) => {
      [pen.strokeStyle, pen.lineWidth] = [style, width];
      pen.setLineDash(dashes);
      pen.stroke(path);
    };
    const [low, high] = this.scale, zero = low < 0 && high > 0;
    stroke(new Path2D(shown.ticks.map(({ share }) => `M${this.u(share)} ${TOP}V${floor}`).join("")), colour["grid-major"], 1);
    stroke(new Path2D(`M${LEFT} ${TOP}V${floor}H${end}${zero ? `M${LEFT} ${this.v(0)}H${end}` : ""}`), colour.axis, 1);
    const [now, before, ...kept] = this.written();
    if (before) stroke(before, colour.soft, 1.3, [4, 3]);
    kept.forEach((path, k) => stroke(path!, colour[KEPT[k % KEPT.length]], 1.1));
    stroke(now!, colour[shown.colour], 1.9);
    const { limit } = shown, bar = limit !== null && limit > low && limit < high;
    if (bar) stroke(new Path2D(`M${LEFT} ${this.v(limit)}H${end}`), colour.bad, 1.2, [3, 3]);
    this.write(this.numbers(colour.soft, bar ? colour.bad : null), colour.soft);
  }

  /** The paths of all curves: now, before, kept. What stays as it was is not found again. */
  private written(): (Path2D | null)[] {
    const { now, before, kept, peaks, x, turn } = this.shown!, places = [x, turn, ...this.scale, ...this.size];
    const same = this.paths.places.length === places.length && places.every((each, k) => each === this.paths.places[k]);
    const known = same ? this.paths.known : new Map<ArrayLike<number>, Path2D>(), next = new Map<ArrayLike<number>, Path2D>();
    if (!same) this.us = this.shares.map((share) => this.u(share));
    for (const values of [before, ...kept]) if (values) next.set(values, known.get(values) ?? this.path(values, []));
    this.paths = { places, known: next };
    return [this.path(now, peaks), before && next.get(before)!, ...kept.map((values) => next.get(values)!)];
  }

  /** Numbers at the scale: its ends, and zero and the limit where these leave room. */
  private numbers(soft: string, bad: string | null): { text: string; v: number; style: string }[] {
    const { shown, scale: [low, high] } = this, found: { text: string; v: number; style: string }[] = [];
    const one = (y: number, style: string) => {
      const v = this.v(y);
      if (found.some((each) => Math.abs(each.v - v) < APART)) return;
      found.push({ text: digits(Math.abs(y) < 1e-9 * (high - low) ? 0 : y / shown!.factor, 3), v, style });
    };
    one(high, soft);
    one(low, soft);
    if (bad) one(shown!.limit!, bad);
    if (low < 0 && high > 0) one(0, soft);
    return found;
  }

  /** Writes what has changed beside the scale and below the axis: texts, and setting their font, take longer than all strokes. */
  private write(numbers: { text: string; v: number; style: string }[], soft: string): void {
    const { pen, shown, size: [wide, tall], texts } = this, side = numbers.map(({ text, v }) => `${text} ${v.toFixed(1)}`).join();
    if (side !== texts.side) {
      pen.clearRect(0, 0, LEFT - SIDE, tall);
      [pen.font, pen.textBaseline, pen.textAlign] = [LETTERS, "middle", "right"];
      for (const { text, v, style } of numbers) {
        pen.fillStyle = style;
        pen.fillText(text, LEFT - 6, v);
      }
    }
    if (shown!.ticks !== texts.ticks) {
      pen.clearRect(LEFT - SIDE, tall - FOOT, wide, FOOT);
      [pen.font, pen.textBaseline, pen.textAlign, pen.fillStyle] = [LETTERS, "alphabetic", "left", soft];
      this.writeTicks(shown!.ticks, tall - 5);
    }
    this.texts = { side, ticks: shown!.ticks };
  }

  /** Texts below the axis: the ends, and what leaves room between them. */
  private writeTicks(ticks: Shown["ticks"], v: number): void {
    const { pen } = this, taken: [number, number][] = [], written = new Set<number>(), last = ticks.length - 1;
    for (const k of [0, last, last >> 1, ...ticks.keys()]) {
      if (written.has(k) || !ticks[k]) continue;
      written.add(k);
      const { share, text } = ticks[k], wide = pen.measureText(text).width, u = this.u(share);
      const left = k === 0 ? u : k === last ? u - wide : u - wide / 2;
      if (taken.some(([a, b]) => left < b + 8 && left + wide > a - 8)) continue;
      taken.push([left, left + wide]);
      pen.fillText(text, left, v);
    }
  }

  /** Runs without gaps, each with as few corners as it takes. */
  private path(values: ArrayLike<number>, peaks: Extreme[]): Path2D {
    const { shares, us, shown } = this, { length } = us, between = peaks.filter(({ at }) => at > 0 && at < length - 1 && !Number.isInteger(at)).sort((a, b) => a.at - b.at);
    const all = new Float64Array(length + between.length), vs = new Float64Array(all.length);
    for (let i = 0, k = 0, next = 0; i < length; i++) {
      [all[k], vs[k++]] = [us[i], this.v(valueAt(values, i, shown!.turn))];
      for (; next < between.length && between[next].at < i + 1; next++) {
        const { at, value } = between[next];
        [all[k], vs[k++]] = [this.u(shares[i] + (at - i) * (shares[i + 1] - shares[i])), this.v(value)];
      }
    }
    const path = new Path2D();
    for (let begin = 0; begin < all.length; ) {
      while (begin < all.length && Number.isNaN(vs[begin])) begin++;
      let end = begin;
      while (end < all.length && !Number.isNaN(vs[end])) end++;
      const way = all.subarray(begin, end), run = vs.subarray(begin, end);
      for (const i of thinned(way, run, NEAR)) path[i ? "lineTo" : "moveTo"](way[i], run[i]);
      begin = end;
    }
    return path;
  }
}

/** A curve's value at a place, the first one again at the end of a closed cycle. */
export function valueAt(values: ArrayLike<number>, i: number, turn: number): number {
  const { length } = values, first = values[0];
  return i < length ? values[i] : first + (turn && turn * Math.round((values[length - 1] - first) / turn));
}

/** The scale of a diagram. */
function reach({ x, now, before, kept, peaks, turn, limit }: Shown): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  const take = (y: number) => {
    if (y < low) low = y;
    if (y > high) high = y;
  };
  for (const values of [now, ...kept, ...(before ? [before] : [])]) for (let i = 0; i < x.length; i++) take(valueAt(values, i, turn));
  for (const { value } of peaks) take(value);
  if (!(high >= low)) return [0, 1];
  // A limit is shown where the curve comes near it.
  if (limit !== null && low < 1.2 * limit) {
    take(limit);
    low -= 0.04 * (high - low);
  }
  if (high - low < 1e-9 * Math.max(Math.abs(high), Math.abs(low), 1e-9)) return [low - 0.5 * Math.abs(low || 1), high + 0.5 * Math.abs(high || 1)];
  return [low, high];
}

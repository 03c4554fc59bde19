// Curves over the input, painted on a canvas; hodographs as SVG paths.
import type { Extreme } from "./numbers";
import { colours, painted } from "./palette";
import { element, thinned } from "./strokes";
import { digits } from "./words";

// The picture in its own units, about pixels.
const W = 360, H = 132, LEFT = 60, RIGHT = 8, TOP = 8, BOTTOM = 24;
// Share of an axis up to which its end is zero; how far a curve may leave its places, in these units; the least size of
// letters, in pixels and in these units, and the largest for which there is room.
const ZERO = 1e-9, FLAT = 0.08, LEAST = 10.5, SMALL = 10, LARGE = 15;
// Where the numbers at the axes stand, low, high, left and right, by which side, and what they may cover: x, y, width,
// height. The curves and the dot keep off it.
const FREE = 4.5, MIDDLE = (LEFT + W) / 2;
const TEXTS: { x: number; y: number; side: CanvasTextAlign; box: [number, number, number, number] }[] = [
  { x: LEFT - 5, y: H - BOTTOM + 3, side: "right", box: [0, H - BOTTOM - 9, LEFT - FREE, 16] },
  { x: LEFT - 5, y: TOP + 9, side: "right", box: [0, 0, LEFT - FREE, TOP + 13] },
  { x: LEFT, y: H - 4, side: "left", box: [LEFT, H - 17, MIDDLE - LEFT, 17] },
  { x: W - RIGHT, y: H - 4, side: "right", box: [MIDDLE, H - 17, W - MIDDLE, 17] },
];

/** Values at the places, and extremes between them. */
export interface Curve {
  style: "now" | "original" | number;
  values: ArrayLike<number>;
  peaks?: Extreme[];
}

interface Written {
  values: ArrayLike<number>;
  peaks?: Extreme[];
  low: number;
  high: number;
  path: Path2D;
}

/** One diagram: curves over x, a scale of its own, a line at the position that is shown. */
export class Chart {
  readonly end: () => void;
  private readonly canvas: HTMLCanvasElement;
  private readonly pen: CanvasRenderingContext2D;
  private low = 0;
  private high = 1;
  private x: ArrayLike<number> = [0, 1];
  private places = new Float64Array();
  private turn = 0;
  private curves: Curve[] = [];
  private ticks: string[] = [];
  private at: [number, number] = [NaN, NaN];
  /** The numbers at the axes that are painted: writing a text takes longer than all else here. */
  private shown: string[] = [];
  // Each curve with the scale it was drawn to: what stays is not found again.
  private written: Written[] = [];

  constructor(host: HTMLElement) {
    const { canvas, pen, end } = painted(host, () => this.afresh());
    [this.canvas, this.pen, this.end] = [canvas, pen, end];
    canvas.className = "chart";
    canvas.setAttribute("role", "img");
  }

  label(text: string): void {
    if (this.canvas.ariaLabel !== text) this.canvas.ariaLabel = text;
  }

  /**
   * The last curve is the current one; values are in units of `factor`. Painted by `cursor`. With one place more than
   * values curves go back to their first value, give or take `turn`s.
   */
  set(x: ArrayLike<number>, curves: Curve[], factor: number, ends: [string, string], turn: number): void {
    if (this.x !== x) {
      [this.x, this.turn] = [x, turn];
      const [a, b] = [x[0], x[x.length - 1]];
      this.places = Float64Array.from(x, (each) => LEFT + ((each - a) / (b - a || 1)) * (W - LEFT - RIGHT));
      this.written = [];
    }
    let [low, high] = [Infinity, -Infinity];
    const reach = (y: number) => {
      if (y < low) low = y;
      if (y > high) high = y;
    };
    for (const { values, peaks } of curves) {
      for (let i = 0; i < x.length; i++) reach(this.value(values, i));
      peaks?.forEach(({ value }) => reach(value));
    }
    if (!(high >= low)) [low, high] = [0, 1];
    if (high - low < 1e-9 * Math.max(Math.abs(high), Math.abs(low), 1e-9)) [low, high] = [low - 0.5 * Math.abs(low || 1), high + 0.5 * Math.abs(high || 1)];
    [this.low, this.high, this.curves] = [low, high, curves];
    this.written = curves.map(({ values, peaks }, k) => {
      const before = this.written[k], same = before?.values === values && before.peaks === peaks;
      return same && before.low === low && before.high === high ? before : { values, peaks, low, high, path: this.path(values, peaks) };
    });
    const tick = (y: number) => digits(Math.abs(y) < ZERO * (high - low) ? 0 : y / factor, 3);
    this.ticks = [tick(low), tick(high), ...ends];
  }

  cursor(i: number, value: number): void {
    this.at = [this.places[i], value];
    this.paint();
  }

  /** A canvas forgets all with its size. */
  private afresh(): void {
    const size = Math.min(LARGE, Math.max(SMALL, (LEAST * W * (devicePixelRatio || 1)) / this.canvas.width));
    [this.pen.font, this.pen.direction, this.shown] = [`${size}px system-ui, sans-serif`, "ltr", []];
    this.paint();
  }

  private paint(): void {
    const { pen, canvas } = this, colour = colours(), scale = canvas.width / W;
    // Strokes are as wide on small pictures as on large ones.
    const thick = (devicePixelRatio || 1) / scale;
    const stroke = (path: Path2D, style: string, width: number, dashes: number[] = []) => {
      [pen.strokeStyle, pen.lineWidth] = [style, width * thick];
      pen.setLineDash(dashes.map((each) => each * thick));
      pen.stroke(path);
    };
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.clearRect(LEFT - FREE, 0, W, H - 17);
    pen.lineJoin = "round";
    const zero = this.low < 0 && this.high > 0 ? `M${LEFT} ${this.v(0)}H${W - RIGHT}` : "";
    stroke(new Path2D(`M${LEFT} ${TOP}V${H - BOTTOM}H${W - RIGHT}${zero}`), colour.line, 1);
    this.curves.forEach(({ style }, k) => {
      const { path } = this.written[k];
      if (style === "now") stroke(path, colour.accent, 1.8);
      else if (style === "original") stroke(path, colour.soft, 1.2, [4, 3]);
      else stroke(path, [colour.a, colour.b, colour.c, colour.d][style % 4], 1.2);
    });
    this.mark(stroke, colour.soft, colour.accent);
    this.write(colour.soft);
  }

  /** The line at the position that is shown, and its dot. */
  private mark(stroke: (path: Path2D, style: string, width: number) => void, soft: string, accent: string): void {
    const [u, y] = this.at, { pen } = this;
    stroke(new Path2D(`M${u} ${TOP}V${H - BOTTOM}`), soft, 0.8);
    if (!Number.isFinite(y)) return;
    pen.fillStyle = accent;
    pen.beginPath();
    pen.arc(u, this.v(y), 3.5, 0, 2 * Math.PI);
    pen.fill();
  }

  private write(soft: string): void {
    const { pen, ticks, shown } = this;
    pen.fillStyle = soft;
    TEXTS.forEach(({ x, y, side, box }, k) => {
      if (shown[k] === ticks[k]) return;
      shown[k] = ticks[k];
      pen.clearRect(...box);
      pen.textAlign = side;
      pen.fillText(ticks[k] ?? "", x, y);
    });
  }

  /** The place among n positions under a point of the screen. */
  index(clientX: number): number {
    const box = this.canvas.getBoundingClientRect(), u = ((clientX - box.left) * W) / box.width;
    const share = (u - LEFT) / (W - LEFT - RIGHT);
    return Math.min(this.x.length - 1, Math.max(0, Math.round(share * (this.x.length - 1))));
  }

  /** A curve's value at a place, the first one again at the end of a closed cycle. */
  private value(values: ArrayLike<number>, i: number): number {
    const { turn } = this, first = values[0];
    return i < values.length ? values[i] : first + (turn && turn * Math.round((values[i - 1] - first) / turn));
  }

  private v(y: number): number {
    return TOP + ((this.high - y) / (this.high - this.low)) * (H - TOP - BOTTOM);
  }

  /** Runs without gaps, each with as few corners as it takes. */
  private path(values: ArrayLike<number>, peaks: Extreme[] = []): Path2D {
    const path = new Path2D(), last = this.x.length - 1;
    const between = peaks.filter(({ at }) => at > 0 && at < last && !Number.isInteger(at)).sort((a, b) => a.at - b.at);
    const all = [...this.places.keys()].map((i) => [i, this.places[i], this.v(this.value(values, i))]);
    for (const { at, value } of between) {
      const i = Math.floor(at), place = this.places[i] + (at - i) * (this.places[i + 1] - this.places[i]);
      all.splice(all.findIndex(([k]) => k > at), 0, [at, place, this.v(value)]);
    }
    const places = Float64Array.from(all, ([, place]) => place), heights = Float64Array.from(all, ([, , height]) => height), n = all.length;
    for (let begin = 0; begin < n; ) {
      while (begin < n && !(heights[begin] === heights[begin])) begin++;
      let end = begin;
      while (end < n && heights[end] === heights[end]) end++;
      const way = places.subarray(begin, end), run = heights.subarray(begin, end);
      for (const i of thinned(way, run, FLAT)) path[i ? "lineTo" : "moveTo"](way[i], run[i]);
      begin = end;
    }
    return path;
  }
}

/** The tip of a velocity vector over the cycle, to equal scales, with the vector of the position shown. */
export class Hodograph {
  readonly svg: SVGElement;
  private readonly path: SVGElement;
  private readonly vector: SVGElement;
  private scale = 1;

  constructor(host: HTMLElement) {
    this.svg = element("svg", { class: "chart hodograph", viewBox: "-90 -90 180 180", role: "img" }, host);
    element("path", { class: "grid", d: "M-86 0H86M0-86V86" }, this.svg);
    this.path = element("path", { class: "curve now" }, this.svg);
    this.vector = element("path", { class: "lw-velocity-line" }, this.svg);
  }

  set(label: string, x: ArrayLike<number>, y: ArrayLike<number>, closed: boolean): void {
    this.svg.setAttribute("aria-label", label);
    let largest = 0, d = "";
    for (let i = 0; i < x.length; i++) largest = Math.max(largest, Math.abs(x[i]), Math.abs(y[i]));
    this.scale = 80 / (largest || 1);
    for (let i = 0; i < x.length; i++) d += `${i ? "L" : "M"}${(x[i] * this.scale).toFixed(1)} ${(-y[i] * this.scale).toFixed(1)}`;
    this.path.setAttribute("d", d + (closed ? "Z" : ""));
  }

  cursor(x: number, y: number): void {
    this.vector.setAttribute("d", `M0 0L${(x * this.scale).toFixed(1)} ${(-y * this.scale).toFixed(1)}`);
  }
}

// Curves over the input, and hodographs, as SVG paths.
import { element, put, thinned, write } from "./strokes";
import { digits } from "./words";

// Units of the picture are tenths of a pixel, so that paths are written in whole numbers.
const W = 3600, H = 1320, LEFT = 500, RIGHT = 80, TOP = 80, BOTTOM = 200;
// How far a curve may leave its places, in these units.
const FLAT = 0.8;

export interface Curve {
  style: string;
  values: ArrayLike<number>;
}

/** One diagram: curves over x, a scale of its own, a line at the position that is shown. */
export class Chart {
  readonly svg: SVGElement;
  private readonly paths = new Map<number, SVGElement>();
  private readonly marks: { grid: SVGElement; low: SVGElement; high: SVGElement; left: SVGElement; right: SVGElement; cursor: SVGElement; dot: SVGElement };
  private low = 0;
  private high = 1;
  private x: ArrayLike<number> = [0, 1];
  // Abscissas, also as text, and each curve with the scale it was drawn to: what stays is not written again.
  private places = new Float64Array();
  private across: string[] = [];
  private readonly written = new Map<number, { values: ArrayLike<number>; low: number; high: number }>();

  constructor(host: HTMLElement) {
    this.svg = element("svg", { class: "chart", viewBox: `0 0 ${W} ${H}`, role: "img" }, host);
    const text = (x: number, y: number, anchor: string) => element("text", { x, y, "text-anchor": anchor, class: "tick" }, this.svg);
    this.marks = {
      grid: element("path", { class: "grid" }, this.svg),
      low: text(LEFT - 50, H - BOTTOM + 30, "end"),
      high: text(LEFT - 50, TOP + 90, "end"),
      left: text(LEFT, H - 50, "start"),
      right: text(W - RIGHT, H - 50, "end"),
      cursor: element("path", { class: "cursor" }, this.svg),
      dot: element("circle", { class: "dot", r: 35 }, this.svg),
    };
  }

  label(text: string): void {
    this.svg.setAttribute("aria-label", text);
  }

  /** The last curve is the current one; values are in units of `factor`. */
  set(x: ArrayLike<number>, curves: Curve[], factor: number, ends: [string, string]): void {
    if (this.x !== x) {
      this.x = x;
      this.places = Float64Array.from(x, (each) => this.u(each));
      this.across = Array.from(this.places, (each) => `${Math.round(each)} `);
      this.written.clear();
    }
    let [low, high] = [Infinity, -Infinity];
    for (const { values } of curves)
      for (let i = 0; i < values.length; i++) {
        if (values[i] < low) low = values[i];
        if (values[i] > high) high = values[i];
      }
    if (!(high >= low)) [low, high] = [0, 1];
    if (high - low < 1e-9 * Math.max(Math.abs(high), Math.abs(low), 1e-9)) [low, high] = [low - 0.5 * Math.abs(low || 1), high + 0.5 * Math.abs(high || 1)];
    [this.low, this.high] = [low, high];
    curves.forEach(({ style, values }, k) => {
      const path = this.paths.get(k) ?? this.added(k);
      put(path, "class", `curve ${style}`);
      const before = this.written.get(k);
      if (before?.values === values && before.low === low && before.high === high) return;
      this.written.set(k, { values, low, high });
      path.setAttribute("d", this.data(values));
    });
    for (const [k, path] of this.paths)
      if (k >= curves.length) {
        path.remove();
        this.paths.delete(k);
        this.written.delete(k);
      }
    const zero = low < 0 && high > 0 ? `M${LEFT} ${this.v(0)}H${W - RIGHT}` : "";
    put(this.marks.grid, "d", `M${LEFT} ${TOP}V${H - BOTTOM}H${W - RIGHT}${zero}`);
    write(this.marks.low, digits(low / factor, 3));
    write(this.marks.high, digits(high / factor, 3));
    write(this.marks.left, ends[0]);
    write(this.marks.right, ends[1]);
  }

  private added(k: number): SVGElement {
    const path = element("path");
    this.svg.insertBefore(path, this.marks.cursor);
    this.paths.set(k, path);
    return path;
  }

  cursor(i: number, value: number): void {
    const u = this.u(this.x[i]);
    this.marks.cursor.setAttribute("d", `M${u.toFixed(1)} ${TOP}V${H - BOTTOM}`);
    const seen = Number.isFinite(value);
    this.marks.dot.setAttribute("visibility", seen ? "visible" : "hidden");
    if (seen) {
      this.marks.dot.setAttribute("cx", u.toFixed(1));
      this.marks.dot.setAttribute("cy", this.v(value).toFixed(1));
    }
  }

  /** The place among n positions under a point of the screen. */
  index(clientX: number): number {
    const box = this.svg.getBoundingClientRect(), u = ((clientX - box.left) * W) / box.width;
    const share = (u - LEFT) / (W - LEFT - RIGHT);
    return Math.min(this.x.length - 1, Math.max(0, Math.round(share * (this.x.length - 1))));
  }

  private u(x: number): number {
    const a = this.x[0], b = this.x[this.x.length - 1];
    return LEFT + ((x - a) / (b - a || 1)) * (W - LEFT - RIGHT);
  }

  private v(y: number): number {
    return TOP + ((this.high - y) / (this.high - this.low)) * (H - TOP - BOTTOM);
  }

  /** Runs without gaps, each with as few corners as it takes. */
  private data(values: ArrayLike<number>): string {
    const n = values.length;
    let d = "";
    for (let begin = 0; begin < n; ) {
      while (begin < n && !(values[begin] === values[begin])) begin++;
      let end = begin;
      while (end < n && values[end] === values[end]) end++;
      d += this.run(values, begin, end);
      begin = end;
    }
    return d;
  }

  private run(values: ArrayLike<number>, begin: number, end: number): string {
    const heights = new Float64Array(end - begin), { high } = this, scale = (H - TOP - BOTTOM) / (high - this.low);
    for (let i = begin; i < end; i++) heights[i - begin] = TOP + (high - values[i]) * scale;
    let d = "";
    for (const i of thinned(this.places.subarray(begin, end), heights, FLAT)) d += `${i ? "L" : "M"}${this.across[begin + i]}${Math.round(heights[i])}`;
    return d;
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

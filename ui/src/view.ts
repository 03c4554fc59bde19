// The machine drawn in the standard symbols: elements made once, moved at every frame.
import type { Glyph } from "./data";
import type { Outputs } from "./engine";
import type { Model } from "./model";
import type { Values } from "./solver";
import { Names } from "./names";
import { colours, painted } from "./palette";
import { amount, Shapes, type Vec } from "./shapes";
import {
  arrow, away, DEEP, dashpot, element, far, FINEST, hull, line, PITCH, place, put, round, strand, TALL, thinned, tint, TOOTH, toothed, unit, VECTOR, zigzag,
} from "./strokes";

const LAYERS = ["ground", "paths", "bodies", "blocks", "pins", "tops", "marks", "vectors", "names", "handles"];
const BLOCK = 15, STUB = 8, HALF_HEIGHT = 9;
const PUSH = 52, GAP = 8;
// Paper narrower than this has smaller symbols, at least this share of their size; more points than these count as
// narrower paper.
const WIDE = 560, SMALLEST = 0.42, POINTS = 10;
const COLOURS = 4;
// Fewer ghosts than these are drawn as strongly as paths.
const FEW = 12;
// How far a path may leave its places, in pixels.
const NEAR = 0.08;

export interface Shown {
  paths: Set<string>;
  names: boolean;
  velocities: boolean;
  accelerations: boolean;
  forces: boolean;
  centres: boolean;
}

/** A path of a point, m. */
export interface Ghost {
  x: ArrayLike<number>;
  y: ArrayLike<number>;
}

/** Where a drawing is looked at from outside of it: pixels for a metre, the origin and the size of the paper, px. */
export interface Lens {
  scale: number;
  origin: Vec;
  size: Vec;
}

/** Moves an element to a place, with its x axis along a direction. */
const carry = (of: SVGElement, [u, v]: Vec, [x, y]: Vec) =>
  put(of, "transform", `matrix(${u.toFixed(5)} ${v.toFixed(5)} ${(-v).toFixed(5)} ${u.toFixed(5)} ${x.toFixed(2)} ${y.toFixed(2)})`);

export class View {
  readonly svg: SVGElement;
  private readonly layers: Record<string, SVGElement> = {};
  private readonly drawn: (() => void)[] = [];
  /** What is found again when the machine or the scale has changed, not at every position. */
  private readonly settled: (() => void)[] = [];
  private readonly shapes: Shapes;
  private readonly pen: CanvasRenderingContext2D;
  readonly end: () => void;
  private ghostly: Ghost[] = [];
  private seen: { values: Values | null; scale: number; paths: string; shift: string } = { values: null, scale: 0, paths: "", shift: "" };
  /** What holds the machine at the place that is drawn, and where in its rows. */
  private now: Outputs;
  private k = 0;
  private readonly handles = new Map<string, SVGElement>();
  private readonly names: Names;
  /** Ends of strokes beside the machine which names keep clear of, too. */
  taken: number[] = [];
  /** Ends of the strokes that are drawn, which names keep clear of. */
  private ink: number[] = [];
  private readonly vectors = new Map<string, { line: SVGElement; head: SVGElement }>();
  /** The longest vector of each kind that is shown, over the cycle, SI. */
  longest: Record<string, number> = {};
  private paths: SVGElement[] = [];
  private scale = 1;
  private shift: Vec = [0, 0];
  private width = 600;
  private height = 420;
  zoom = 1;
  index = 0;

  /** `lens`: the paper is looked at through it; without one the view fits itself and has handles to drag. */
  constructor(readonly model: Model, host: HTMLElement, public shown: Shown, private readonly lens: Lens | null = null) {
    this.shapes = new Shapes(model);
    this.now = model.main;
    const { canvas, pen, end } = painted(host, () => this.drawGhosts());
    canvas.setAttribute("aria-hidden", "true");
    [this.pen, this.end] = [pen, end];
    this.svg = element("svg", { class: "machine", role: "group" }, host);
    for (const name of LAYERS) this.layers[name] = element("g", { class: `lw-${name}` }, this.svg);
    model.data.glyphs.forEach((glyph, number) => this.drawn.push(this.glyph(glyph, number)));
    this.names = new Names(model.data.points.map(({ key }) => key), this.layers.names);
    for (const { key, fixed, moved } of model.data.points) {
      if (!moved.length || lens) continue;
      const handle = element("circle", { class: fixed ? "handle fixed" : "handle", r: 13, tabindex: 0, role: "button", "aria-label": key }, this.layers.handles);
      handle.dataset.key = key;
      this.handles.set(key, handle);
    }
    this.fit();
  }

  /** On narrow paper symbols are drawn smaller: `zoom` pixels are one unit of the picture. */
  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    if (this.lens) return this.look();
    const crowded = Math.min(1, Math.sqrt(POINTS / this.names.count));
    this.zoom = Math.min(1, Math.max(SMALLEST, (crowded * width) / WIDE));
    [this.width, this.height] = [width / this.zoom, height / this.zoom];
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    for (const handle of this.handles.values()) handle.setAttribute("r", String(13 / this.zoom));
    this.fit();
    this.draw(this.index);
    this.drawGhosts();
  }

  /** The lens has moved. */
  look(): void {
    if (!this.lens) return;
    const { scale, origin, size } = this.lens, [width, height] = size;
    if (width !== this.width || height !== this.height) this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    [this.scale, this.shift, this.width, this.height] = [scale, origin, width, height];
    this.draw(this.index);
    this.drawGhosts();
  }

  /** Puts all that the points reach into the picture. */
  fit(): void {
    if (this.lens) return;
    const margin = 46, [left, low, right, high] = this.box, size = Math.max(right - left, high - low) || 1;
    const wide = Math.max(right - left, 0.05 * size), tall = Math.max(high - low, 0.05 * size);
    this.scale = Math.min((this.width - 2 * margin) / wide, (this.height - 2 * margin) / tall);
    this.shift = [this.width / 2 - (this.scale * (left + right)) / 2, this.height / 2 + (this.scale * (low + high)) / 2];
  }

  /** What the machine reaches over all its positions, m: left, low, right, high. */
  get box(): [number, number, number, number] {
    let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
    const take = (xs: ArrayLike<number>, ys: ArrayLike<number>, r = 0) => {
      for (let i = 0; i < xs.length; i++) {
        [left, right] = [Math.min(left, xs[i] - r), Math.max(right, xs[i] + r)];
        [low, high] = [Math.min(low, ys[i] - r), Math.max(high, ys[i] + r)];
      }
    };
    for (const { key } of this.model.data.points) take(this.model.main.row(`p:${key}.x`), this.model.main.row(`p:${key}.y`), this.radius(key));
    for (const glyph of this.model.data.glyphs) if (glyph.kind === "rack") take(...this.shapes.reach(glyph));
    return [left, low, right, high];
  }

  /** How far wheels and cams reach about a point, m. */
  private radius(key: string): number {
    return this.model.data.glyphs.reduce((most, glyph) => {
      if (glyph.at !== key) return most;
      if (glyph.kind === "wheel") return Math.max(most, this.shapes.radius(glyph));
      return glyph.kind === "cam" ? this.shapes.cam(glyph).profile.reduce((reach, [x, y]) => Math.max(reach, Math.hypot(x, y)), most) : most;
    }, 0);
  }

  /** Whether a part of the machine has left the picture. */
  get outside(): boolean {
    return !this.lens && this.model.data.points.some(({ key }) => {
      for (let i = 0; i < this.model.n; i += 8) {
        const { main } = this.model, [x, y] = this.paper(main.row(`p:${key}.x`)[i], main.row(`p:${key}.y`)[i]);
        if (x < 4 || y < 4 || x > this.width - 4 || y > this.height - 4) return true;
      }
      return false;
    });
  }

  paper(x: number, y: number): Vec {
    return [this.shift[0] + this.scale * x, this.shift[1] - this.scale * y];
  }

  world(x: number, y: number): Vec {
    return [(x - this.shift[0]) / this.scale, (this.shift[1] - y) / this.scale];
  }

  private row(name: string): number {
    return this.now.row(name)[this.k];
  }

  private at(key: string): Vec {
    return this.paper(this.row(`p:${key}.x`), this.row(`p:${key}.y`));
  }

  private way(name: string | number): Vec {
    if (typeof name === "number") return [Math.cos(name), Math.sin(name)];
    return [this.row(`${name}.x`), -this.row(`${name}.y`)];
  }

  /** The machine at a place among its positions; between them it is solved, where that is known. */
  draw(i: number): void {
    this.index = i;
    const { values, main, solver, n } = this.model, paths = [...this.shown.paths].join(), shift = this.lens ? this.shift.join() : "";
    const found = Number.isInteger(i) ? null : solver.whole(i);
    [this.now, this.k] = found ? [found, 0] : [main, Math.round(i) % n];
    const settled = this.seen.values === values && this.seen.scale === this.scale;
    if (!settled) {
      this.shapes.forget();
      for (const each of this.settled) each();
    }
    if (!settled || paths !== this.seen.paths || shift !== this.seen.shift) this.drawPaths();
    this.seen = { values, scale: this.scale, paths, shift };
    this.ink = [...this.taken];
    for (const each of this.drawn) each();
    for (const [key, handle] of this.handles) place(handle, "cx", "cy", this.at(key));
    this.drawVectors();
    this.writeNames();
    this.layers.marks.classList.toggle("without-centres", !this.shown.centres);
  }

  private writeNames(): void {
    this.layers.names.classList.toggle("hidden", !this.shown.names);
    if (this.shown.names) this.names.write((key) => this.at(key), this.ink, this.zoom, this.width, this.height);
  }

  /** The path of a stroke, which names keep clear of. */
  private stroke(points: Vec[], closed = false): string {
    for (let k = closed ? 0 : 1; k < points.length; k++) this.ink.push(...points.at(k - 1)!, ...points[k]);
    return line(points, closed);
  }

  // glyphs -------------------------------------------------------------------------------

  private glyph(glyph: Glyph, number: number): () => void {
    const layer = this.layers[glyph.layer];
    const path = (style: string) => element("path", { class: style }, layer);
    const body = (style: string) => {
      const made = path(style);
      tint(made, glyph.colour);
      return made;
    };
    switch (glyph.kind) {
      case "stamp": return this.stamp(glyph, layer);
      case "bar": {
        const bar = body("lw-bar");
        return () => put(bar, "d", this.stroke(glyph.points!.map((key) => this.at(key))));
      }
      case "plate": {
        const plate = body("lw-plate");
        return () => put(plate, "d", this.stroke(hull(glyph.points!.map((key) => this.at(key))), true));
      }
      case "spring": {
        const spring = path("lw-spring elastic");
        return () => put(spring, "d", line(zigzag(this.at(glyph.points![0]), this.at(glyph.points![1]))));
      }
      case "damper": {
        const damper = path("lw-spring elastic");
        return () => put(damper, "d", dashpot(this.at(glyph.points![0]), this.at(glyph.points![1])));
      }
      case "passing": {
        const bar = body("lw-bar");
        return () => {
          const [a, b] = glyph.points!.map((key) => this.at(key)), at = this.at(glyph.at!), u = unit(a, b);
          put(bar, "d", this.stroke([away(at, u, -glyph.length!), away(at, u, glyph.length!)]));
        };
      }
      case "stub": {
        const bar = body("lw-bar");
        return () => {
          const at = this.at(glyph.at!);
          put(bar, "d", this.stroke([at, away(at, this.way(`d:${glyph.joint}`), glyph.shift!)]));
        };
      }
      case "rail": return this.rail(glyph, path("lw-ground"), path("lw-hatch"));
      case "rod": return this.rod(glyph, body("lw-bar"));
      case "cylinder": return this.cylinder(glyph, path("lw-bar"), path("lw-block"));
      case "wheel": return this.wheel(glyph, number, layer);
      case "rack": return this.rack(glyph, layer);
      case "cam": return this.cam(glyph, layer);
      case "strands": {
        const strands = path("lw-spring");
        return () => {
          const [a, b] = glyph.points!.map((key) => this.at(key)), [r, s] = glyph.radii!.map((each) => amount(each, this.model.values) * this.scale);
          put(strands, "d", [1, -1].map((side) => strand(a, b, side * r, side * (glyph.crossed ? -s : s))).join(""));
        };
      }
      case "load": return this.load(glyph, path("lw-load-line"), path("lw-load-head"));
    }
  }

  private stamp(glyph: Glyph, layer: SVGElement): () => void {
    const made = element("g", { class: `stamp ${glyph.role ?? ""}` }, layer);
    made.innerHTML = glyph.svg!;
    const { x: left, y: top, width, height } = (made as SVGGraphicsElement).getBBox();
    const corners: Vec[] = [[left, top], [left + width, top + height], [left, top + height], [left + width, top]];
    return () => {
      const along = this.way(glyph.along!), at = away(away(this.at(glyph.at!), [this.scale, 0], ...(glyph.off ?? [0, 0])), along, glyph.shift ?? 0);
      this.stroke(corners.map(([u, v]) => away(at, along, u, v)), true);
      carry(made, along, at);
    };
  }

  /** Where a block's point is at displacement zero, and its travel over all positions, on the paper. */
  private track(joint: string, at: string): () => { base: Vec; u: Vec; low: number; high: number } {
    let [low, high] = [0, 0];
    this.settled.push(() => {
      const s = this.model.main.row(`s:${joint}`);
      [low, high] = [Infinity, -Infinity];
      for (const x of s) [low, high] = [Math.min(low, x), Math.max(high, x)];
    });
    return () => {
      const s = this.row(`s:${joint}`), u = this.way(`d:${joint}`);
      return { base: away(this.at(at), u, -s * this.scale), u, low: low * this.scale, high: high * this.scale };
    };
  }

  private rail(glyph: Glyph, rail: SVGElement, hatch: SVGElement): () => void {
    const track = this.track(glyph.joint!, glyph.at!);
    return () => {
      const { base, u, low, high } = track(), side = glyph.side!;
      const first = low + glyph.shift! - BLOCK - STUB, last = high + glyph.shift! + BLOCK + STUB;
      const y = side * (HALF_HEIGHT + 1.3), count = Math.max(2, Math.round((last - first) / 6));
      put(rail, "d", this.stroke([away(base, u, first, y), away(base, u, last, y)]));
      let strokes = "";
      for (let k = 0; k < count; k++) {
        const x = first + ((k + 0.75) * (last - first)) / count;
        strokes += line([away(base, u, x, y), away(base, u, x - 5.25, y + 7 * side)]);
      }
      put(hatch, "d", strokes);
    };
  }

  private rod(glyph: Glyph, rod: SVGElement): () => void {
    const track = this.track(glyph.joint!, glyph.at!);
    return () => {
      const { base, u, low, high } = track();
      const along = glyph.reach!.map((key) => {
        const [x, y] = this.at(key);
        return (x - base[0]) * u[0] + (y - base[1]) * u[1];
      });
      const first = Math.min(low - BLOCK - STUB, ...along), last = Math.max(high + BLOCK + STUB, ...along);
      const tie = this.at(glyph.tie!);
      put(rod, "d", this.stroke([away(base, u, first), away(base, u, last)]) + (far(tie, base) > 1 ? this.stroke([tie, base]) : ""));
    };
  }

  private cylinder(glyph: Glyph, rod: SVGElement, barrel: SVGElement): () => void {
    return () => {
      const at = this.at(glyph.at!), from = this.at(glyph.through!), u = unit(from, at);
      const back = away(at, u, -glyph.piston! * this.scale), length = glyph.barrel! * this.scale;
      put(rod, "d", line([back, at]) + line([away(back, u, 0, -5), away(back, u, 0, 5)]) + line([from, away(from, u, 8)]));
      const box: Vec[] = [[8, -7.5], [length, -7.5], [length, 7.5], [8, 7.5]];
      put(barrel, "d", this.stroke(box.map(([x, y]) => away(from, u, x, y)), true));
    };
  }

  /** A part with a shape of its own in the axes of a link: found when the machine changes, moved at every frame. */
  private carried(glyph: Glyph, layer: SVGElement, styles: string[], shape: (paths: SVGElement[]) => void): () => void {
    const body = element("g", {}, layer), paths = styles.map((style) => element("path", { class: style }, body));
    this.settled.push(() => shape(paths));
    return () => {
      carry(body, this.way(glyph.along!), this.at(glyph.at!));
    };
  }

  /** A pitch circle with teeth, or a plain one, with a mark that shows how it turns. */
  private wheel(glyph: Glyph, number: number, layer: SVGElement): () => void {
    return this.carried(glyph, layer, ["lw-support", "lw-gear", "lw-pitch"], ([rim, teeth, pitch]) => {
      const r = this.shapes.radius(glyph) * this.scale, u: Vec = [1, 0], sign = glyph.inside ? -1 : 1;
      put(pitch, "d", round([0, 0], r));
      put(rim, "d", glyph.inside ? round([0, 0], r + 14) : "");
      const mark = line([away([0, 0], u, glyph.inside ? r : 0.55 * r), away([0, 0], u, glyph.inside ? r + 12 : 0.9 * r)]);
      put(teeth, "d", (glyph.toothed ? toothed(r, glyph.teeth ?? null, -this.shapes.tooth(number), sign) : round([0, 0], r)) + mark);
    });
  }

  private rack(glyph: Glyph, layer: SVGElement): () => void {
    return this.carried(glyph, layer, ["lw-gear", "lw-pitch"], ([teeth, pitch]) => {
      const turn = -amount(glyph.turn!, this.model.values), u: Vec = [Math.cos(turn), Math.sin(turn)];
      const found = this.shapes.rack(glyph), side = glyph.inside ? 1 : -1, fine = (found.pitch ?? 0) * this.scale;
      const step = fine > FINEST ? fine : PITCH, begin = found.low * this.scale - 14, end = found.high * this.scale + 14;
      const first = begin + (((found.tooth * this.scale - begin) % step) + step) % step, height = Math.min(1, step / PITCH);
      const outline: Vec[] = [[begin, 3 * DEEP], [begin, DEEP * height]];
      for (let x = first - step; x < end + step; x += step)
        for (const [share, up] of TOOTH) if (x + share * step > begin && x + share * step < end) outline.push([x + share * step, (up ? -TALL : DEEP) * height]);
      outline.push([end, DEEP * height], [end, 3 * DEEP]);
      put(teeth, "d", line(outline.map(([x, y]) => away([0, 0], u, x, -side * y)), true));
      put(pitch, "d", line([away([0, 0], u, begin), away([0, 0], u, end)]));
    });
  }

  /** The cam on its link; what touches it on the follower. */
  private cam(glyph: Glyph, layer: SVGElement): () => void {
    const tip = element("path", { class: { roller: "lw-ground", knife: "lw-gear", flat: "lw-bar" }[glyph.touch!] }, this.layers.tops);
    let face: Vec = [0, 0];
    const body = this.carried(glyph, layer, ["lw-support", "lw-plate", "lw-pitch"], ([wall, cam, curve]) => {
      const found = this.shapes.cam(glyph), outline = (points: Vec[]) => line(points.map(([x, y]) => [x * this.scale, -y * this.scale]), found.closed);
      put(wall, "d", outline(found.outer));
      put(cam, "d", outline(found.profile));
      cam.classList.toggle("open", !found.closed);
      put(curve, "d", outline(found.pitch));
      face = [found.face[0] * this.scale, found.face[1] * this.scale];
    });
    return () => {
      body();
      const at = this.at(glyph.trace!), [x, y] = this.shapes.line(glyph, this.k, this.now), u: Vec = [x, -y];
      const open = 14 * (glyph.joint ? glyph.side! : -glyph.side!);
      if (glyph.touch === "roller") put(tip, "d", round(at, amount(glyph.radius!, this.model.values) * this.scale));
      else if (glyph.touch === "flat") put(tip, "d", line([away(at, u, face[0]), away(at, u, face[1])]));
      else put(tip, "d", line([at, away(at, u, 4.5, open), away(at, u, -4.5, open)], true));
    };
  }

  private load(glyph: Glyph, shaft: SVGElement, head: SVGElement): () => void {
    return () => {
      const [fx, fy] = ["x", "y"].map((axis) => this.row(`lf:${glyph.load}.${axis}`));
      const [px, py] = ["x", "y"].map((axis) => this.row(`lp:${glyph.load}.${axis}`));
      const size = Math.hypot(fx, fy), seen = size > 1e-12 && this.model.forces;
      for (const each of [shaft, head]) put(each, "visibility", seen ? "visible" : "hidden");
      if (!seen) return;
      const u: Vec = [fx / size, -fy / size], tip = away(this.paper(px, py), u, -GAP);
      arrow(shaft, head, away(tip, u, -PUSH), tip);
      this.stroke([away(tip, u, -PUSH), tip]);
    };
  }

  // paths and vectors --------------------------------------------------------------------

  drawPaths(): void {
    const wanted = [...this.shown.paths];
    while (this.paths.length > wanted.length) this.paths.pop()!.remove();
    wanted.forEach((key, k) => {
      this.paths[k] ??= element("path", {}, this.layers.paths);
      put(this.paths[k], "class", `lw-trace trace-${k % COLOURS}`);
      const [xs, ys] = ["x", "y"].map((axis) => this.model.main.row(`p:${key}.${axis}`));
      const corners = thinned(xs, ys, NEAR / this.scale).map((i) => this.paper(xs[i], ys[i]));
      put(this.paths[k], "d", line(corners, this.model.data.positions.closed));
    });
  }

  /** Paths of points for other designs, under the machine: on a canvas, so that they cost nothing while it moves. */
  ghosts(rows: Ghost[]): void {
    this.ghostly = rows;
    this.drawGhosts();
  }

  private drawGhosts(): void {
    const { pen, ghostly } = this, { canvas } = pen, dense = canvas.width / this.width;
    canvas.hidden = !ghostly.length;
    if (!ghostly.length) return;
    pen.setTransform(dense, 0, 0, dense, 0, 0);
    pen.clearRect(0, 0, this.width, this.height);
    [pen.strokeStyle, pen.globalAlpha, pen.lineWidth] = [colours().soft, 0.4, ghostly.length < FEW ? 1.8 : 0.7];
    pen.beginPath();
    for (const { x, y } of ghostly)
      for (let i = 0; i < x.length; i += 2) {
        const [u, v] = this.paper(x[i], y[i]);
        if (i) pen.lineTo(u, v);
        else pen.moveTo(u, v);
      }
    pen.stroke();
  }

  private drawVectors(): void {
    const { data, main } = this.model, { velocities, accelerations, forces } = this.shown;
    if (!(velocities || accelerations || forces || this.vectors.size)) return;
    const seen = new Set<string>();
    this.longest = {};
    const family = (style: string, shown: boolean, list: { id: string; rows: string; at: string }[]) => {
      if (!shown || !list.length) return;
      let largest = 0;
      for (const { rows } of list) {
        const x = main.row(`${rows}.x`), y = main.row(`${rows}.y`);
        for (let k = 0; k < this.model.n; k++) largest = Math.max(largest, Math.hypot(x[k], y[k]));
      }
      if (!(largest > 0)) return;
      this.longest[style] = largest;
      for (const { id, rows, at } of list) {
        const from = this.at(at), long = VECTOR / largest;
        const end: Vec = [from[0] + long * this.row(`${rows}.x`), from[1] - long * this.row(`${rows}.y`)];
        const name = `${style}:${id}`;
        const vector = this.vectors.get(name) ?? {
          line: element("path", { class: `lw-${style}-line` }, this.layers.vectors),
          head: element("path", { class: `lw-${style}-head` }, this.layers.vectors),
        };
        this.vectors.set(name, vector);
        seen.add(name);
        arrow(vector.line, vector.head, from, end);
        this.stroke([from, end]);
      }
    };
    const moving = data.points.filter(({ fixed }) => !fixed).map(({ key }) => key);
    family("velocity", velocities, moving.map((key) => ({ id: key, rows: `v:${key}`, at: key })));
    family("acceleration", accelerations, moving.map((key) => ({ id: key, rows: `a:${key}`, at: key })));
    const reactions = data.signals.filter(({ id }) => id.startsWith("r:"));
    const places = new Map(data.glyphs.filter((g) => g.joint).map((g) => [g.joint!, g.at!]));
    const keys = new Set(data.points.map(({ key }) => key));
    family("force", forces && this.model.forces, reactions.flatMap(({ id }) => {
      const joint = id.slice(2).split("|")[0], at = keys.has(joint) ? joint : places.get(joint);
      return at ? [{ id, rows: id, at }] : [];
    }));
    for (const [name, vector] of this.vectors)
      for (const each of [vector.line, vector.head]) put(each, "visibility", seen.has(name) ? "visible" : "hidden");
  }
}

// The machine drawn in the standard symbols: elements made once, moved at every frame.
import type { Glyph } from "./data";
import type { Model } from "./model";

const NS = "http://www.w3.org/2000/svg";
const LAYERS = ["ground", "paths", "ghosts", "bodies", "blocks", "pins", "tops", "marks", "vectors", "names", "handles"];
const BLOCK = 15, STUB = 8, HALF_HEIGHT = 9;
const PUSH = 52, GAP = 8;
const COLOURS = 4;
const TURN = 2 * Math.PI;

type Vec = [number, number];
export interface Shown {
  paths: Set<string>;
  names: boolean;
  velocities: boolean;
  accelerations: boolean;
  forces: boolean;
  centres: boolean;
}

export function element(tag: string, attributes: Record<string, string | number> = {}, parent?: Element): SVGElement {
  const made = document.createElementNS(NS, tag);
  for (const name in attributes) made.setAttribute(name, String(attributes[name]));
  parent?.append(made);
  return made as SVGElement;
}

const tenth = (x: number) => Math.round(10 * x) / 10;
const line = (points: Vec[], closed = false) =>
  points.map(([x, y], k) => `${k ? "L" : "M"}${tenth(x)} ${tenth(y)}`).join("") + (closed ? "Z" : "");
const away = ([x, y]: Vec, [u, v]: Vec, far: number, side = 0): Vec => [x + far * u - side * v, y + far * v + side * u];

export class View {
  readonly svg: SVGElement;
  private readonly layers: Record<string, SVGElement> = {};
  private readonly drawn: ((i: number) => void)[] = [];
  private readonly handles = new Map<string, SVGElement>();
  private readonly labels = new Map<string, SVGElement>();
  private readonly vectors = new Map<string, { line: SVGElement; head: SVGElement }>();
  private paths: SVGElement[] = [];
  private scale = 1;
  private shift: Vec = [0, 0];
  private width = 600;
  private height = 420;
  index = 0;

  constructor(readonly model: Model, host: HTMLElement, public shown: Shown) {
    this.svg = element("svg", { class: "machine", role: "group" }, host);
    for (const name of LAYERS) this.layers[name] = element("g", { class: `lw-${name}` }, this.svg);
    for (const glyph of model.data.glyphs) this.drawn.push(this.glyph(glyph));
    for (const { key, fixed, moved } of model.data.points) {
      const label = element("text", { class: "lw-name" }, this.layers.names);
      label.textContent = key;
      this.labels.set(key, label);
      if (!moved.length) continue;
      const handle = element("circle", { class: fixed ? "handle fixed" : "handle", r: 13, tabindex: 0, role: "button" }, this.layers.handles);
      handle.dataset.key = key;
      this.handles.set(key, handle);
    }
    this.fit();
  }

  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    [this.width, this.height] = [width, height];
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.fit();
    this.draw(this.index);
  }

  /** Puts all that the points reach into the picture. */
  fit(): void {
    let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const { key } of this.model.data.points) {
      const r = this.radius(key);
      for (const x of this.model.main.row(`p:${key}.x`)) [left, right] = [Math.min(left, x - r), Math.max(right, x + r)];
      for (const y of this.model.main.row(`p:${key}.y`)) [low, high] = [Math.min(low, y - r), Math.max(high, y + r)];
    }
    const margin = 46, size = Math.max(right - left, high - low) || 1;
    const wide = Math.max(right - left, 0.05 * size), tall = Math.max(high - low, 0.05 * size);
    this.scale = Math.min((this.width - 2 * margin) / wide, (this.height - 2 * margin) / tall);
    this.shift = [this.width / 2 - (this.scale * (left + right)) / 2, this.height / 2 + (this.scale * (low + high)) / 2];
  }

  /** Radius of the largest wheel about a point, m. */
  private radius(key: string): number {
    const { main } = this.model, world = (name: string): Vec => [main.row(`p:${name}.x`)[0], main.row(`p:${name}.y`)[0]];
    return this.model.data.glyphs.reduce((most, glyph) => {
      if (glyph.kind !== "wheel" || glyph.at !== key) return most;
      const [a, b] = glyph.points!.map(world);
      return Math.max(most, glyph.radius ?? glyph.share! * far(a, b));
    }, 0);
  }

  /** Whether a part of the machine has left the picture. */
  get outside(): boolean {
    return this.model.data.points.some(({ key }) => {
      for (let i = 0; i < this.model.n; i += 8) {
        const [x, y] = this.at(key, i);
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

  private at(key: string, i: number): Vec {
    const { main } = this.model;
    return this.paper(main.row(`p:${key}.x`)[i], main.row(`p:${key}.y`)[i]);
  }

  private way(name: string | number, i: number): Vec {
    if (typeof name === "number") return [Math.cos(name), Math.sin(name)];
    const { main } = this.model;
    return [main.row(`${name}.x`)[i], -main.row(`${name}.y`)[i]];
  }

  draw(i: number): void {
    this.index = i;
    for (const each of this.drawn) each(i);
    for (const [key, handle] of this.handles) place(handle, "cx", "cy", this.at(key, i));
    this.writeNames(i);
    this.drawPaths();
    this.drawVectors(i);
    this.layers.marks.classList.toggle("without-centres", !this.shown.centres);
  }

  private writeNames(i: number): void {
    this.layers.names.classList.toggle("hidden", !this.shown.names);
    if (!this.shown.names) return;
    const used: Vec[] = [];
    for (const [key, label] of this.labels) {
      let [x, y] = this.at(key, i);
      [x, y] = [x + 9, y - 9];
      while (used.some(([u, v]) => Math.abs(u - x) < 18 && Math.abs(v - y) < 12)) y -= 13;
      used.push([x, y]);
      label.setAttribute("transform", `translate(${tenth(x)} ${tenth(y)})`);
    }
  }

  // glyphs -------------------------------------------------------------------------------

  private glyph(glyph: Glyph): (i: number) => void {
    const layer = this.layers[glyph.layer];
    const path = (style: string) => element("path", { class: style }, layer);
    switch (glyph.kind) {
      case "stamp": return this.stamp(glyph, layer);
      case "bar": {
        const bar = path("lw-bar");
        return (i) => bar.setAttribute("d", line(glyph.points!.map((key) => this.at(key, i))));
      }
      case "plate": {
        const plate = path("lw-plate");
        return (i) => plate.setAttribute("d", line(hull(glyph.points!.map((key) => this.at(key, i))), true));
      }
      case "spring": {
        const spring = path("lw-spring");
        return (i) => spring.setAttribute("d", line(zigzag(this.at(glyph.points![0], i), this.at(glyph.points![1], i))));
      }
      case "damper": {
        const damper = path("lw-spring");
        return (i) => damper.setAttribute("d", dashpot(this.at(glyph.points![0], i), this.at(glyph.points![1], i)));
      }
      case "passing": {
        const bar = path("lw-bar");
        return (i) => {
          const [a, b] = glyph.points!.map((key) => this.at(key, i)), at = this.at(glyph.at!, i), u = unit(a, b);
          bar.setAttribute("d", line([away(at, u, -glyph.length!), away(at, u, glyph.length!)]));
        };
      }
      case "stub": {
        const bar = path("lw-bar");
        return (i) => {
          const at = this.at(glyph.at!, i);
          bar.setAttribute("d", line([at, away(at, this.way(`d:${glyph.joint}`, i), glyph.shift!)]));
        };
      }
      case "rail": return this.rail(glyph, path("lw-ground"), path("lw-hatch"));
      case "rod": return this.rod(glyph, path("lw-bar"));
      case "cylinder": return this.cylinder(glyph, path("lw-bar"), path("lw-block"));
      case "wheel": return this.wheel(glyph, path("lw-support"), path("lw-gear"), path("lw-pitch"));
      case "strands": {
        const strands = path("lw-spring");
        return (i) => {
          const [a, b] = glyph.points!.map((key) => this.at(key, i)), [r, s] = glyph.radii!.map((each) => each * this.scale);
          strands.setAttribute("d", [1, -1].map((side) => strand(a, b, side * r, side * (glyph.crossed ? -s : s))).join(""));
        };
      }
      case "load": return this.load(glyph, path("lw-load-line"), path("lw-load-head"));
    }
  }

  private stamp(glyph: Glyph, layer: SVGElement): (i: number) => void {
    const made = element("g", { class: `stamp ${glyph.role ?? ""}` }, layer);
    const parsed = new DOMParser().parseFromString(`<svg xmlns="${NS}">${glyph.svg}</svg>`, "image/svg+xml");
    made.append(...[...parsed.documentElement.childNodes].map((node) => document.importNode(node, true)));
    return (i) => {
      const along = this.way(glyph.along!, i), [x, y] = away(this.at(glyph.at!, i), along, glyph.shift ?? 0);
      const turn = (Math.atan2(along[1], along[0]) * 180) / Math.PI;
      made.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${turn.toFixed(3)})`);
    };
  }

  /** Where a block's point is at displacement zero, and its travel over all positions, on the paper. */
  private track(joint: string, at: string, i: number): { base: Vec; u: Vec; low: number; high: number } {
    const s = this.model.main.row(`s:${joint}`), u = this.way(`d:${joint}`, i);
    let [low, high] = [Infinity, -Infinity];
    for (const x of s) [low, high] = [Math.min(low, x), Math.max(high, x)];
    return { base: away(this.at(at, i), u, -s[i] * this.scale), u, low: low * this.scale, high: high * this.scale };
  }

  private rail(glyph: Glyph, rail: SVGElement, hatch: SVGElement): (i: number) => void {
    return (i) => {
      const { base, u, low, high } = this.track(glyph.joint!, glyph.at!, i), side = glyph.side!;
      const first = low + glyph.shift! - BLOCK - STUB, last = high + glyph.shift! + BLOCK + STUB;
      const y = side * (HALF_HEIGHT + 1.3), count = Math.max(2, Math.round((last - first) / 6));
      rail.setAttribute("d", line([away(base, u, first, y), away(base, u, last, y)]));
      let strokes = "";
      for (let k = 0; k < count; k++) {
        const x = first + ((k + 0.75) * (last - first)) / count;
        strokes += line([away(base, u, x, y), away(base, u, x - 5.25, y + 7 * side)]);
      }
      hatch.setAttribute("d", strokes);
    };
  }

  private rod(glyph: Glyph, rod: SVGElement): (i: number) => void {
    return (i) => {
      const { base, u, low, high } = this.track(glyph.joint!, glyph.at!, i);
      const along = glyph.reach!.map((key) => {
        const [x, y] = this.at(key, i);
        return (x - base[0]) * u[0] + (y - base[1]) * u[1];
      });
      const first = Math.min(low - BLOCK - STUB, ...along), last = Math.max(high + BLOCK + STUB, ...along);
      const tie = this.at(glyph.tie!, i);
      rod.setAttribute("d", line([away(base, u, first), away(base, u, last)]) + (far(tie, base) > 1 ? line([tie, base]) : ""));
    };
  }

  private cylinder(glyph: Glyph, rod: SVGElement, barrel: SVGElement): (i: number) => void {
    return (i) => {
      const u = this.way(`d:${glyph.joint}`, i), at = this.at(glyph.at!, i), from = this.at(glyph.through!, i);
      const back = away(at, u, -glyph.piston! * this.scale), length = glyph.barrel! * this.scale;
      rod.setAttribute("d", line([back, at]) + line([away(back, u, 0, -5), away(back, u, 0, 5)]) + line([from, away(from, u, 8)]));
      const box: Vec[] = [[8, -7.5], [length, -7.5], [length, 7.5], [8, 7.5]];
      barrel.setAttribute("d", line(box.map(([x, y]) => away(from, u, x, y)), true));
    };
  }

  /** A pitch circle with teeth, or a plain one with a mark that shows how it turns. */
  private wheel(glyph: Glyph, rim: SVGElement, teeth: SVGElement, pitch: SVGElement): (i: number) => void {
    return (i) => {
      const [a, b] = glyph.points!.map((key) => this.at(key, i)), at = this.at(glyph.at!, i);
      const r = glyph.radius ? glyph.radius * this.scale : glyph.share! * far(a, b);
      const u = this.way(glyph.along!, i), turned = Math.atan2(u[1], u[0]);
      pitch.setAttribute("d", round(at, r));
      rim.setAttribute("d", glyph.inside ? round(at, r + 14) : "");
      const mark = line([away(at, u, glyph.inside ? r : 0.55 * r), away(at, u, glyph.inside ? r + 12 : 0.9 * r)]);
      teeth.setAttribute("d", (glyph.toothed ? toothed(at, r, turned, glyph.inside ? -1 : 1) : round(at, r)) + mark);
    };
  }

  private load(glyph: Glyph, shaft: SVGElement, head: SVGElement): (i: number) => void {
    const { main } = this.model;
    return (i) => {
      const [fx, fy] = ["x", "y"].map((axis) => main.row(`lf:${glyph.load}.${axis}`)[i]);
      const [px, py] = ["x", "y"].map((axis) => main.row(`lp:${glyph.load}.${axis}`)[i]);
      const size = Math.hypot(fx, fy), seen = size > 1e-12 && this.model.forces;
      for (const each of [shaft, head]) each.setAttribute("visibility", seen ? "visible" : "hidden");
      if (!seen) return;
      const u: Vec = [fx / size, -fy / size], tip = away(this.paper(px, py), u, -GAP);
      arrow(shaft, head, away(tip, u, -PUSH), tip);
    };
  }

  // paths and vectors --------------------------------------------------------------------

  drawPaths(): void {
    const wanted = [...this.shown.paths];
    while (this.paths.length > wanted.length) this.paths.pop()!.remove();
    wanted.forEach((key, k) => {
      this.paths[k] ??= element("path", {}, this.layers.paths);
      this.paths[k].setAttribute("class", `lw-trace trace-${k % COLOURS}`);
      const points: Vec[] = [];
      for (let i = 0; i < this.model.n; i++) points.push(this.at(key, i));
      this.paths[k].setAttribute("d", line(points, this.model.data.positions.closed));
    });
  }

  /** Paths of a point for other designs, under the machine. */
  ghosts(rows: { x: ArrayLike<number>; y: ArrayLike<number> }[]): void {
    let d = "";
    for (const { x, y } of rows)
      for (let i = 0; i < x.length; i += 2) {
        const [u, v] = this.paper(x[i], y[i]);
        d += `${i ? "L" : "M"}${u.toFixed(1)} ${v.toFixed(1)}`;
      }
    const ghost = (this.layers.ghosts.firstElementChild as SVGElement) ?? element("path", { class: "lw-ghost" }, this.layers.ghosts);
    ghost.setAttribute("d", d);
  }

  private drawVectors(i: number): void {
    const { data, main } = this.model;
    const seen = new Set<string>();
    const family = (style: string, shown: boolean, list: { id: string; rows: string; at: string }[]) => {
      if (!shown || !list.length) return;
      let largest = 0;
      for (const { rows } of list) {
        const x = main.row(`${rows}.x`), y = main.row(`${rows}.y`);
        for (let k = 0; k < this.model.n; k++) largest = Math.max(largest, Math.hypot(x[k], y[k]));
      }
      if (!(largest > 0)) return;
      for (const { id, rows, at } of list) {
        const from = this.at(at, i), long = 90 / largest;
        const end: Vec = [from[0] + long * main.row(`${rows}.x`)[i], from[1] - long * main.row(`${rows}.y`)[i]];
        const name = `${style}:${id}`;
        const vector = this.vectors.get(name) ?? {
          line: element("path", { class: `lw-${style}-line` }, this.layers.vectors),
          head: element("path", { class: `lw-${style}-head` }, this.layers.vectors),
        };
        this.vectors.set(name, vector);
        seen.add(name);
        arrow(vector.line, vector.head, from, end);
      }
    };
    const moving = data.points.filter(({ fixed }) => !fixed).map(({ key }) => key);
    family("velocity", this.shown.velocities, moving.map((key) => ({ id: key, rows: `v:${key}`, at: key })));
    family("acceleration", this.shown.accelerations, moving.map((key) => ({ id: key, rows: `a:${key}`, at: key })));
    const reactions = data.signals.filter(({ id }) => id.startsWith("r:"));
    const places = new Map(data.glyphs.filter((g) => g.joint).map((g) => [g.joint!, g.at!]));
    const keys = new Set(data.points.map(({ key }) => key));
    family("force", this.shown.forces && this.model.forces, reactions.flatMap(({ id }) => {
      const joint = id.slice(2).split("|")[0], at = keys.has(joint) ? joint : places.get(joint);
      return at ? [{ id, rows: id, at }] : [];
    }));
    for (const [name, vector] of this.vectors)
      for (const each of [vector.line, vector.head]) each.setAttribute("visibility", seen.has(name) ? "visible" : "hidden");
  }
}

function place(of: SVGElement, a: string, b: string, [x, y]: Vec): void {
  of.setAttribute(a, x.toFixed(2));
  of.setAttribute(b, y.toFixed(2));
}

const far = (a: Vec, b: Vec) => Math.hypot(b[0] - a[0], b[1] - a[1]);

function unit(a: Vec, b: Vec): Vec {
  const d = far(a, b) || 1;
  return [(b[0] - a[0]) / d, (b[1] - a[1]) / d];
}

function arrow(shaft: SVGElement, head: SVGElement, from: Vec, to: Vec): void {
  const length = far(from, to), u = unit(from, to), size = Math.min(9, length);
  shaft.setAttribute("d", line([from, away(to, u, -0.7 * size)]));
  head.setAttribute("d", line([to, away(to, u, -size, -0.38 * size), away(to, u, -size, 0.38 * size)], true));
}

function hull(cloud: Vec[]): Vec[] {
  const rows = [...cloud].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (ordered: Vec[]) => {
    const chain: Vec[] = [];
    for (const p of ordered) {
      while (chain.length > 1) {
        const [a, b] = chain.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(rows), ...half([...rows].reverse())];
}

const TOOTH: Vec[] = [[-0.5, -3.6], [-0.32, -3.6], [-0.16, 3.2], [0.16, 3.2], [0.32, -3.6]];

/** Teeth that show that it is a gear; their number is not the gear's. */
function toothed(at: Vec, r: number, turned: number, sign: number): string {
  const count = Math.max(12, Math.round((TURN * r) / 11)), outline: Vec[] = [];
  for (let k = 0; k < count; k++)
    for (const [share, height] of TOOTH) {
      const angle = turned + (TURN * (k + share)) / count, radius = r + sign * height;
      outline.push([at[0] + radius * Math.cos(angle), at[1] + radius * Math.sin(angle)]);
    }
  return line(outline, true);
}

const round = ([x, y]: Vec, r: number) =>
  `M${tenth(x - r)} ${tenth(y)}a${tenth(r)} ${tenth(r)} 0 1 0 ${tenth(2 * r)} 0a${tenth(r)} ${tenth(r)} 0 1 0 ${tenth(-2 * r)} 0Z`;

/** The common tangent of two circles on one side (signed radii: on different sides it crosses). */
function strand(a: Vec, b: Vec, r: number, s: number): string {
  const d = far(a, b), u = unit(a, b), sine = (r - s) / d, cosine = Math.sqrt(Math.max(0, 1 - sine * sine));
  return line([away(a, u, r * sine, r * cosine), away(b, u, s * sine, s * cosine)]);
}

function zigzag(a: Vec, b: Vec): Vec[] {
  const length = far(a, b), u = unit(a, b), lead = Math.min(0.18 * length, 16), points: Vec[] = [a];
  for (let k = 0; k <= 12; k++) {
    const side = k === 0 || k === 12 ? 0 : k % 2 ? -7 : 7;
    points.push(away(a, u, lead + ((length - 2 * lead) * k) / 12, side));
  }
  return [...points, b];
}

function dashpot(from: Vec, to: Vec): string {
  const length = far(from, to), u = unit(from, to), body = Math.min(26, 0.5 * length), h = 8;
  const a = (length - body) / 2, b = (length + body) / 2, c = length / 2 + 0.15 * body;
  const strokes: Vec[][] = [
    [[0, 0], [a, 0]], [[b, -h], [a, -h], [a, h], [b, h]], [[c, -0.7 * h], [c, 0.7 * h]], [[c, 0], [length, 0]],
  ];
  return strokes.map((stroke) => line(stroke.map(([x, y]) => away(from, u, x, y)))).join("");
}

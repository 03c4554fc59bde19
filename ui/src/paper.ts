// Drawing paper: what of a text can be drawn before it is a machine, and the tools that draw on it.
import { distance, drawLoad, type Load, off, reach } from "./drawn_loads";
import { Names } from "./names";
import { Photo } from "./photo";
import type { Action, Picture, Tool } from "./picture";
import type { Vec } from "./shapes";
import { element } from "./strokes";

const SNAP = 12;
const STEPS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1];
const LETTERS = "ABCDEFGHIJKLMNPQRSTUVW";

// A hand-drawn curve ends at its beginning where it comes this near, in pixels; its points are this far apart.
const CLOSING = 22, APART = 4;

export class Paper {
  readonly svg: SVGElement;
  tool: Tool = "fixed";
  value = "";
  private picture: Picture = { points: {}, fixed: [], links: {}, driver: null, guided: [], loads: {} };
  private chosen: string[] = [];
  private dragged: string | null = null;
  private scale = 1000;
  private shift: Vec = [0, 0];
  private size: Vec = [600, 420];
  /** Called with the points of a curve that was drawn, m, and whether it is closed. */
  drawn: ((points: Vec[], closed: boolean) => void) | null = null;
  /** Called with a sentence for the user: its key and values. */
  tell: ((key: string, values: Record<string, string>) => void) | null = null;
  /** A load that is shown as chosen. */
  load: string | null = null;
  /** A curve to be reached, and curves of candidates, the shown one first, m. */
  target: Vec[] = [];
  candidates: Vec[][] = [];
  private readonly photo: Photo;
  private drawing = false;
  private picked: string | null = null;
  /** New points of a link that is not finished: they are on the paper only. */
  private begun: Record<string, Vec> = {};
  private pointer: Vec | null = null;
  private readonly back: SVGElement;
  private readonly measures: SVGElement;
  private readonly front: SVGElement;

  /** `act` carries out actions one after the other; `symbols`: those of pivots and blocks, as SVG. */
  constructor(host: HTMLElement, readonly act: (actions: Action[]) => void, private readonly symbols: Record<string, string>) {
    this.svg = element("svg", { class: "machine drafting", role: "application", tabindex: 0 }, host);
    this.photo = new Photo(element("image", { preserveAspectRatio: "none", class: "photo" }, this.svg));
    this.back = element("path", { class: "grid fine" }, this.svg);
    this.front = element("g", {}, this.svg);
    this.measures = element("text", { class: "measures", x: 8 }, this.svg);
    this.svg.addEventListener("pointerdown", (event) => this.down(event));
    this.svg.addEventListener("pointermove", (event) => this.moved(event));
    this.svg.addEventListener("pointerup", (event) => this.up(event));
    this.svg.addEventListener("keydown", (event) => {
      if (event.key === "Enter") this.finish();
      if (event.key === "Escape") this.leave();
      if ((event.key === "Delete" || event.key === "Backspace") && this.load) this.remove("load", this.load);
    });
  }

  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    this.size = [width, height];
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.fit();
    this.draw();
  }

  set(picture: Picture): void {
    const first = !Object.keys(this.picture.points).length;
    this.picture = picture;
    for (const name in this.begun) picture.points[name] ??= this.begun[name];
    if (this.load && !(this.load in picture.loads)) this.load = null;
    if (this.picked && !(this.picked in picture.links)) this.picked = null;
    this.chosen = this.chosen.filter((name) => name in picture.points);
    if (first || this.outside()) this.fit();
    this.draw();
  }

  /** Ends what was begun with a tool. */
  leave(): void {
    this.picked = this.load = null;
    this.photo.clicks = [];
    for (const name in this.begun) delete this.picture.points[name];
    this.begun = {};
    this.choose([]);
  }

  /** Puts a picture behind the drawing, as wide as the paper. */
  show(href: string | null, shape = 1): void {
    const [w, h] = this.size, width = Math.min(w, h / shape) / this.scale;
    this.photo.show(href === null ? null : { href, corner: this.free([8, 8]), width: 0.95 * width, shape });
    this.draw();
  }

  choose(names: string[]): void {
    this.chosen = names;
    this.draw();
  }

  private outside(): boolean {
    return Object.values(this.picture.points).some((at) => {
      const [x, y] = this.screen(at);
      return x < 0 || y < 0 || x > this.size[0] || y > this.size[1];
    });
  }

  private fit(): void {
    const all = Object.values(this.picture.points), [w, h] = this.size;
    const xs = all.map(([x]) => x), ys = all.map(([, y]) => y);
    const box = all.length > 1 ? [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)] : [-0.1, 0.3, -0.1, 0.2];
    const wide = Math.max(box[1] - box[0], 0.02), tall = Math.max(box[3] - box[2], 0.02);
    this.scale = Math.min(w / (1.7 * wide), h / (1.7 * tall));
    this.shift = [w / 2 - (this.scale * (box[0] + box[1])) / 2, h / 2 + (this.scale * (box[2] + box[3])) / 2];
  }

  /** Width of the grid, m. */
  get grid(): number {
    return STEPS.find((step) => step * this.scale >= 14) ?? 1;
  }

  screen([x, y]: Vec): Vec {
    return [this.shift[0] + this.scale * x, this.shift[1] - this.scale * y];
  }

  private world([x, y]: Vec): Vec {
    const snap = (value: number) => Math.round(value / this.grid) * this.grid;
    return [snap((x - this.shift[0]) / this.scale), snap((this.shift[1] - y) / this.scale)];
  }

  /** A place of the paper as it is, off the grid. */
  private free([x, y]: Vec): Vec {
    return [(x - this.shift[0]) / this.scale, (this.shift[1] - y) / this.scale];
  }

  private local(event: PointerEvent): Vec {
    const box = this.svg.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private near(at: Vec): string | null {
    let best = SNAP, found: string | null = null;
    const [u, v] = this.world(at);
    for (const name in this.picture.points) {
      const [a, b] = this.picture.points[name];
      if (Math.hypot(a - u, b - v) < 1e-9) return name;
      const [x, y] = this.screen(this.picture.points[name]), d = Math.hypot(x - at[0], y - at[1]);
      if (d < best) [best, found] = [d, name];
    }
    return found;
  }

  /** The link nearest to a place of the screen; of those with a point, however far it is. */
  private link(at: Vec, point: string | null = null): string | null {
    let best = point ? Infinity : SNAP, found: string | null = null;
    for (const name of point ? this.linksOf(point) : Object.keys(this.picture.links)) {
      const corners = this.picture.links[name].filter((each) => each in this.picture.points).map((each) => this.screen(this.picture.points[each]));
      for (let k = 0; k < corners.length; k++) {
        const d = distance(at, corners[k], corners[(k + 1) % corners.length]);
        if (d < best) [best, found] = [d, name];
      }
    }
    return found;
  }

  private linksOf(point: string): string[] {
    return Object.keys(this.picture.links).filter((name) => this.picture.links[name].includes(point));
  }

  private readonly placed = (point: string): Vec | null => (point in this.picture.points ? this.screen(this.picture.points[point]) : null);

  /** The middle of a link's points on the screen. */
  private readonly middle = (link: string): Vec | null => {
    const all = (this.picture.links[link] ?? []).map(this.placed).filter((each) => each !== null);
    return all.length ? [0, 1].map((k) => all.reduce((sum, each) => sum + each[k], 0) / all.length) as Vec : null;
  };

  /** The load nearest to a place of the screen. */
  private loadAt(at: Vec): string | null {
    let best = SNAP, found: string | null = null;
    for (const [name, load] of Object.entries(this.picture.loads)) {
      const ends = reach(load, this.placed, this.middle), d = ends ? off(at, load, ends) : Infinity;
      if (d < best) [best, found] = [d, name];
    }
    return found;
  }

  private fresh(letters: boolean): string {
    const known = new Set(Object.keys(this.picture.points));
    if (letters) for (const each of LETTERS) if (!known.has(each)) return each;
    for (let k = 1; ; k++) if (!known.has(`${letters ? "P" : "O"}${k}`)) return `${letters ? "P" : "O"}${k}`;
  }

  private down(event: PointerEvent): void {
    const at = this.local(event), near = this.near(at);
    this.svg.focus();
    this.svg.setPointerCapture(event.pointerId);
    switch (this.tool) {
      case "select": {
        const placed = near !== null && this.picture.placed?.includes(near);
        this.dragged = placed ? null : near;
        if (placed) this.tell?.("placed", { name: near });
        return this.chooseLoad(near ? null : this.loadAt(at));
      }
      case "fixed": {
        if (!near) this.add(this.fresh(false), this.world(at), true);
        return;
      }
      case "link": return this.linkPoint(at, near);
      case "driver": return this.drive(this.link(at));
      case "mass": {
        const link = this.link(at);
        if (link) this.act([{ do: "mass", link, mass: this.value, places: this.places() }]);
        return;
      }
      case "load": return this.push(at, near);
      case "guide": return this.slide(at, near);
      case "slot": return this.slot(at, near);
      case "gear": return this.pair(this.link(at), (links) => ({ do: "gear", links, teeth: this.value }));
      case "rack": return this.pair(this.link(at), ([pinion, rack]) => ({ do: "rack", pinion, rack, places: this.places() }));
      case "cam": return this.cam(at, near);
      case "curve": {
        this.drawing = true;
        this.target = [this.free(at)];
        this.candidates = [];
        return;
      }
      case "photo": {
        if (!this.photo.measure(this.free(at), this.value)) this.tell?.("no_length_given", { text: this.value });
        return this.draw();
      }
      case "remove": {
        const load = near ? null : this.loadAt(at), link = this.link(at);
        if (near) this.remove("joint", this.loose(near) ?? near);
        else if (load) this.remove("load", load);
        else if (link) this.remove("link", link);
      }
    }
  }

  /** Whether a fixed point is under a block that it guides. */
  private covered(name: string): boolean {
    const { fixed, guided } = this.picture;
    return fixed.includes(name) && guided.some((block) => block in this.picture.points && this.together(block, name));
  }

  private together(a: string, b: string): boolean {
    const [[ax, ay], [bx, by]] = [a, b].map((name) => this.screen(this.picture.points[name]));
    return Math.hypot(ax - bx, ay - by) < 1;
  }

  /** A point of no link where another one is. */
  private loose(point: string): string | undefined {
    return Object.keys(this.picture.points).find((name) => this.together(name, point) && !this.covered(name) && !this.linksOf(name).length);
  }

  private remove(what: string, name: string): void {
    this.act([{ do: "remove", what, name }]);
  }

  private chooseLoad(name: string | null): void {
    this.load = name;
    const load = name && this.picture.loads[name];
    if (load) this.tell?.("load_chosen", { name, size: load.size, on: load.on || load.ends.join(" – "), at: load.at });
    this.draw();
  }

  private add(name: string, at: Vec, fixed: boolean): void {
    this.picture.points[name] = at;
    if (fixed) this.picture.fixed.push(name);
    this.act([{ do: "point", name, at, fixed }]);
    this.draw();
  }

  private linkPoint(at: Vec, near: string | null): void {
    if (near && near === this.chosen[this.chosen.length - 1]) return this.finish();
    const name = near ?? this.fresh(true);
    if (!near) this.picture.points[name] = this.begun[name] = this.world(at);
    this.choose([...this.chosen, name]);
  }

  /** Where points stand that no drawing gives; all of them where none are named. */
  private places(points = Object.keys(this.picture.points)): Record<string, Vec> {
    return Object.fromEntries(points.filter((point) => this.picture.placed?.includes(point)).map((point) => [point, this.picture.points[point]]));
  }

  private finish(): void {
    if (this.tool === "link" && this.chosen.length > 1) {
      const base = this.chosen.some((point) => this.picture.fixed.includes(point)) ? "arm" : "bar";
      let k = 1;
      while (`${base}${k}` in this.picture.links) k++;
      this.picture.links[`${base}${k}`] = [...this.chosen];
      this.act([{ do: "link", name: `${base}${k}`, points: this.chosen, places: { ...this.places(this.chosen), ...this.begun } }]);
      this.begun = {};
    }
    this.leave();
  }

  private drive(link: string | null): void {
    const about = link && this.picture.links[link].find((point) => this.picture.fixed.includes(point));
    if (about) this.act([{ do: "driver", link, about }]);
    else if (link) this.tell?.("no_drive", { link });
  }

  /** The point of a link, the link being the one nearest to the pointer or at each click the next; then a direction. */
  private push(at: Vec, near: string | null): void {
    const [point] = this.chosen;
    if (point === undefined) {
      const link = near ? this.link(at, near) : this.link(at);
      this.picked = link;
      if (link) this.choose([near ?? this.nearest(at, this.picture.links[link])]);
      else if (near) this.tell?.("no_link_there", { point: near });
    } else if (near === point) {
      const links = this.linksOf(point);
      this.picked = links[(links.indexOf(this.picked!) + 1) % links.length];
      this.draw();
    } else {
      this.act([{ do: "load", link: this.picked, at: point, force: this.value, angle: this.heading(point, at) }]);
      this.leave();
    }
  }

  private nearest(at: Vec, points: string[]): string {
    const far = (point: string) => Math.hypot(...[0, 1].map((k) => (this.placed(point)?.[k] ?? Infinity) - at[k]));
    return points.reduce((best, each) => (far(each) < far(best) ? each : best));
  }

  /** The direction from a point to a place of the screen, in steps of 15 degrees. */
  private heading(point: string, at: Vec): number {
    const [x, y] = this.screen(this.picture.points[point]);
    return fifteenth((Math.atan2(y - at[1], at[0] - x) * 180) / Math.PI);
  }

  private slide(at: Vec, near: string | null): void {
    if (!this.chosen.length) {
      if (near) this.choose([near]);
      return;
    }
    const [point] = this.chosen, step = this.heading(point, at);
    let k = 1;
    while (`slider${k}` in this.picture.links) k++;
    this.picture.links[`slider${k}`] = [point];
    this.act([
      { do: "link", name: `slider${k}`, points: [point] },
      { do: "guide", link: `slider${k}`, at: point, angle: step, places: this.places() },
    ]);
    this.choose([]);
  }

  private slot(at: Vec, near: string | null): void {
    if (!this.picked) this.picked = this.link(at);
    else if (near && !this.picture.links[this.picked].includes(near)) {
      this.act([{ do: "slot", along: this.picked, at: near, places: this.places() }]);
      this.picked = null;
    }
    this.draw();
  }

  /** Two links clicked one after the other. */
  private pair(link: string | null, action: (links: [string, string]) => Action): void {
    if (!link) return;
    if (!this.picked) this.picked = link;
    else if (link !== this.picked) {
      this.act([action([this.picked, link])]);
      this.picked = null;
    }
    this.draw();
  }

  /** The link that is the cam, then the roller's point. */
  private cam(at: Vec, near: string | null): void {
    if (!this.picked) this.picked = this.link(at);
    else if (near && !this.picture.links[this.picked].includes(near)) {
      this.act([{ do: "cam", cam: this.picked, at: near, lift: this.value, places: this.places() }]);
      this.picked = null;
    }
    this.draw();
  }

  /** How wide a square of the grid is, and where the pointer is on it. */
  private note(at?: Vec): void {
    const mm = (value: number) => Number((1e3 * value).toPrecision(6)), place = at ? ` · ${this.world(at).map(mm).join(", ")} mm` : "";
    this.measures.textContent = `□ ${mm(this.grid)} mm${place}`;
    this.measures.setAttribute("y", String(this.size[1] - 8));
  }

  private moved(event: PointerEvent): void {
    const at = (this.pointer = this.local(event));
    this.note(at);
    if (this.tool === "load") this.draw();
    if (this.drawing) {
      const [x, y] = this.screen(this.target[this.target.length - 1]);
      if (Math.hypot(at[0] - x, at[1] - y) >= APART) {
        this.target.push(this.free(at));
        this.draw();
      }
      return;
    }
    if (!this.dragged) return;
    this.picture.points[this.dragged] = this.world(at);
    this.draw();
  }

  private up(_event: PointerEvent): void {
    if (this.drawing) {
      this.drawing = false;
      const [first, last] = [this.target[0], this.target[this.target.length - 1]].map((place) => this.screen(place));
      if (this.target.length > 5) this.drawn?.(this.target, Math.hypot(first[0] - last[0], first[1] - last[1]) < CLOSING);
      return;
    }
    if (!this.dragged) return;
    const name = this.dragged;
    this.dragged = null;
    this.act([{ do: "point", name, at: this.picture.points[name], fixed: this.picture.fixed.includes(name) }]);
  }

  /** The link that a click with *Load* would take. */
  private hovered(): string | null {
    if (this.tool !== "load" || !this.pointer) return null;
    return this.link(this.pointer, this.near(this.pointer));
  }

  /** The loads, with the one that is being set at the pointer. */
  private aimed(): Record<string, Load> {
    const { loads } = this.picture, [at] = this.chosen;
    if (this.tool !== "load" || at === undefined || !this.pointer || this.near(this.pointer) === at) return loads;
    const angle = (this.heading(at, this.pointer) * Math.PI) / 180;
    return { ...loads, "": { kind: "force", on: this.picked ?? "", at, angle, ends: [], size: this.value } };
  }

  private symbol(name: string, x: number, y: number): void {
    element("g", { transform: `translate(${x} ${y})` }, this.front).innerHTML = this.symbols[name];
  }

  draw(): void {
    const [w, h] = this.size, step = this.grid * this.scale;
    let d = "";
    for (let x = this.shift[0] % step; x < w; x += step) d += `M${x.toFixed(1)} 0V${h}`;
    for (let y = this.shift[1] % step; y < h; y += step) d += `M0 ${y.toFixed(1)}H${w}`;
    this.back.setAttribute("d", d);
    if (!this.dragged && !this.drawing) this.note();
    this.photo.draw((place) => this.screen(place), this.scale);
    this.front.replaceChildren();
    const curve = (line: Vec[], style: string) => {
      const text = line.map((place, k) => `${k ? "L" : "M"}${this.screen(place).map((each) => each.toFixed(1)).join(" ")}`).join("");
      element("path", { class: style, d: text }, this.front);
    };
    [...this.candidates].reverse().forEach((line, k) => curve(line, `curve ${k === this.candidates.length - 1 ? "now" : "original"}`));
    if (this.target.length > 1) curve(this.target, "curve target");
    for (const place of this.photo.clicks) {
      const [cx, cy] = this.screen(place);
      element("circle", { class: "lw-pin chosen", cx, cy, r: 4 }, this.front);
    }
    const { points, links, fixed, driver, guided } = this.picture, ink: number[] = [], named: string[] = [];
    const inked = (corners: Vec[]) => corners.forEach((corner, k) => k && ink.push(...corners[k - 1], ...corner));
    for (const name in links) {
      const corners = links[name].filter((point) => point in points).map((point) => this.screen(points[point]));
      inked(corners.length > 2 ? [...corners, corners[0]] : corners);
      const text = corners.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");
      element("path", { class: `${corners.length > 2 ? "lw-plate" : "lw-bar"}${name === driver ? " driven" : ""}${name === (this.picked ?? this.hovered()) ? " chosen" : ""}`, d: corners.length > 2 ? `${text}Z` : text }, this.front);
    }
    for (const [name, load] of Object.entries(this.aimed())) {
      const ends = reach(load, this.placed, this.middle);
      if (ends) inked(drawLoad(this.front, name, load, ends, name === (this.load ?? "")));
    }
    for (const name in points) {
      const [x, y] = this.screen(points[name]);
      if (this.covered(name)) continue;
      if (fixed.includes(name)) {
        this.symbol("fixed_pivot", x, y);
        inked([[x - 16, y + 18], [x + 16, y + 18], [x, y + 6], [x - 16, y + 25], [x + 16, y + 25]]);
      }
      if (guided.includes(name)) {
        this.symbol("slider", x, y);
        inked([[x - 15, y - 9], [x + 15, y + 9], [x - 15, y + 9], [x + 15, y - 9], [x - 15, y - 9], [x - 15, y + 9]]);
      }
      element("circle", { class: `lw-pin${this.chosen.includes(name) ? " chosen" : ""}`, cx: x, cy: y, r: 5, "data-point": name }, this.front);
      inked([[x - 5, y - 5], [x + 5, y + 5], [x - 5, y + 5], [x + 5, y - 5]]);
      named.push(name);
    }
    new Names(named, element("g", {}, this.front)).write((name) => this.screen(points[name]), ink, 1, w, h);
    if (this.chosen.length > 1) {
      const way = this.chosen.filter((name) => name in points).map((name) => this.screen(points[name]));
      element("path", { class: "curve now", d: way.map(([x, y], k) => `${k ? "L" : "M"}${x} ${y}`).join("") }, this.front);
    }
  }
}

/** The nearest multiple of 15 degrees. */
function fifteenth(angle: number): number {
  return Math.round(angle / 15) * 15;
}

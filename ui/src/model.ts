// One machine of the page: its dimensions as they are now, its programs' results, and what a change may do.
import { bytes, floats, type Figure, type Group, type ModelData, type Signal } from "./data";
import { Call, Cycle, Kernels, type Code } from "./engine";
import { settle } from "./friction";
import { least, leastChange, root } from "./search";

export type Values = Record<string, number>;

/** Why a change stops: a group at a position, or a dimension. */
export interface Wall {
  kind: "apart" | "singular" | "change" | "lost" | "length" | "locked" | "still";
  name: string;
  group: Group | null;
  input: number;
  facts: Values;
}

/** What stays of a design for comparison: its dimensions, rows of curves and design numbers. */
export interface Design {
  values: Values;
  rows: Record<string, Float64Array>;
  numbers: Values;
}

const TURN = 2 * Math.PI;
const BISECTIONS = 32;
// Share of the way that is kept clear of a limit.
const BEFORE = 1e-7;
// Least squares of sines of transmission angles: worth a closer look; a change point.
const NEAR = 0.02;
const TOUCH = 1e-10;
// Largest change of a chain coordinate in one step towards other dimensions, and the most halvings of the way.
const LARGEST = 0.1;
const HALVINGS = 12;

export class Model {
  readonly main: Call;
  readonly n: number;
  original: Design;
  readonly signals: Record<string, Signal>;
  readonly inputs: Float64Array;
  /** What curves run over: the input where it goes one way, else the time. */
  readonly axis: { x: Float64Array; kind: "angle" | "length" | "time" };
  values: Values;
  locked = new Set<string>();
  wall: Wall | null = null;
  doubtful = false;
  /** Friction for which no finite effort is found. */
  locking = false;
  private readonly one: Call;
  private readonly cycle: Cycle | null;
  private readonly arrays: Record<string, Float64Array> = {};
  private found: Values = {};
  private states: Values = {};
  private drawn: Values = {};
  private determinants: Values = {};

  constructor(readonly data: ModelData, code: Code) {
    const { positions } = data;
    this.n = positions.count;
    const kernels = new Kernels(data.programs, code, data.tables, size(data));
    this.main = kernels.call(data.main, this.n);
    this.one = kernels.call(data.main, 1);
    this.cycle = data.stages.length ? new Cycle(kernels, data.stages, this.n) : null;
    for (const name in positions.arrays) this.arrays[name] = floats(positions.arrays[name]);
    const { time, inputs, steady } = positions, given = inputs[0]?.values;
    this.inputs = steady ? Float64Array.from({ length: this.n }, (_, i) => steady.start + i * steady.step) : given ? floats(given) : new Float64Array(1);
    const way = Math.sign(this.inputs[1] - this.inputs[0]);
    const forward = this.inputs.every((q, i) => i === 0 || Math.sign(q - this.inputs[i - 1]) === way);
    this.axis = forward || time === null
      ? { x: this.inputs, kind: inputs[0]?.turns === false ? "length" : "angle" }
      : { x: floats(time), kind: "time" };
    this.signals = Object.fromEntries(data.signals.map((signal) => [signal.id, signal]));
    for (const name in data.fields) this.main.give({ [name]: floats(data.fields[name]) });
    for (const name of this.main.program.states) {
      const start = data.starts[name];
      if (typeof start === "number") this.states[name] = start;
    }
    this.drawn = this.states;
    this.values = { ...data.values };
    this.evaluate(this.values);
    this.keepStates();
    this.original = this.design();
  }

  get iterated(): boolean {
    return this.main.program.states.length > 0;
  }

  get changed(): boolean {
    return this.data.dimensions.some(({ address }) => this.values[address] !== this.data.values[address]);
  }

  /** Whether it is another design than the first one. */
  get differs(): boolean {
    return this.data.dimensions.some(({ address }) => this.values[address] !== this.original.values[address]);
  }

  /** Whether forces can be shown: what is held is that of the original. */
  get forces(): boolean {
    return !this.doubtful && !this.locking && !(this.data.held.length && this.changed);
  }

  get margin(): number | null {
    return this.iterated ? this.main.row("margin").reduce((a, b) => Math.min(a, b), 1) : null;
  }

  // evaluation ---------------------------------------------------------------------------

  private steady(values: Values): void {
    const law = this.data.positions.steady;
    if (!law) return;
    const speed = values[`${law.driver}.speed`] ?? law.speed, ratio = law.speed / speed;
    const put = (name: string, of: (q: number, i: number) => number) => {
      const row = (this.arrays[name] ??= new Float64Array(this.n));
      for (let i = 0; i < this.n; i++) row[i] = of(law.start + i * law.step, i);
    };
    const dt = (law.step / law.speed) * ratio;
    if (!this.arrays.input) {
      put("input", (q) => q);
      put(`cos:${law.driver}`, Math.cos);
      put(`sin:${law.driver}`, Math.sin);
      put(`slide:${law.driver}`, (q) => q);
      put(`turn:${law.driver}`, (q) => q);
    }
    put("time", (_, i) => law.begin * ratio + i * dt);
    put("step", () => dt);
  }

  /** Fills the rows for these values; returns the wall in the way, or null where every position is reached. */
  evaluate(values: Values): Wall | null {
    this.steady(values);
    if (Object.keys(this.data.positions.modes).length) this.setModes(values);
    this.doubtful = false;
    if (this.cycle) {
      this.found = this.cycle.run(values, this.arrays);
      this.doubtful = Object.entries(this.found).some(([name, x]) => name.startsWith("doubt:") && !(x === 0));
    }
    this.main.set({ ...values, ...this.found });
    this.main.give(this.arrays);
    if (this.iterated && !this.approach(values)) return this.lost(0);
    this.main.run();
    const { friction } = this.data;
    this.locking = friction.length > 0 && !settle(this.main, friction);
    if (this.main.has(this.data.sizes)) this.doubtful ||= !this.main.row(this.data.sizes).every(Number.isFinite);
    return this.reached(values);
  }

  /** Signs of assembly modes pass change points only in the original, where they are known. */
  private setModes(values: Values): void {
    const same = this.data.dimensions.every((d) => !d.geometry || values[d.address] === d.value);
    for (const name in this.data.positions.modes) {
      const sign = this.data.positions.modes[name];
      this.arrays[name] = same ? floats(this.data.positions.arrays[name]) : new Float64Array(this.n).fill(sign);
    }
  }

  private reached(values: Values): Wall | null {
    const ok = this.main.row("ok");
    for (let i = 0; i < this.n; i++) if (ok[i] === 0) return this.failure(i);
    if (values === this.data.values || this.n < 3) return null;
    return this.changePoint();
  }

  private failure(i: number): Wall {
    const code = this.main.row("outcome")[i];
    if (code === 0) return this.lost(i);
    const group = this.data.groups[Math.abs(code) - 1];
    const facts: Values = {};
    for (const fact of group.facts) facts[fact] = this.main.row(`fact:${group.name}|${fact}`)[i];
    return { kind: code < 0 ? "singular" : "apart", name: group.name, group, input: this.inputs[i], facts };
  }

  private lost(i: number): Wall {
    const group = this.data.groups.find((each) => !each.dyad && each.links.length > 1) ?? this.data.groups[0];
    return { kind: "lost", name: group.name, group, input: this.inputs[i], facts: {} };
  }

  /** What lies between two positions: the square under a dyad's root falls to zero (change point) or below it. */
  private changePoint(): Wall | null {
    if (Object.keys(this.data.positions.modes).length) return null;
    for (const group of this.data.groups) {
      if (!group.dyad) continue;
      const name = `quality:${group.name}`, row = this.main.row(name), { closed } = this.data.positions;
      for (let i = 0; i < this.n; i++) {
        const before = row[i > 0 ? i - 1 : closed ? this.n - 1 : 0], after = row[i < this.n - 1 ? i + 1 : closed ? 0 : i];
        const here = row[i], change = Math.max(before, after) - here;
        if (here > before || here > after || here > Math.max(NEAR, change)) continue;
        const found = this.between(name, i, before, here, after);
        if (found.value >= TOUCH) continue;
        const facts = Object.fromEntries(group.facts.map((fact) => [fact, this.one.row(`fact:${group.name}|${fact}`)[0]]));
        return { kind: found.value < -TOUCH && found.exact ? "apart" : "change", name: group.name, group, input: found.at, facts };
      }
    }
    return null;
  }

  /** The least value near position i: found with the program, or by a parabola where the input's law is data. */
  private between(name: string, i: number, before: number, here: number, after: number) {
    if (!this.data.positions.steady || this.iterated) {
      const bend = before - 2 * here + after, slope = 0.5 * (after - before);
      return { at: this.inputs[i], value: bend > 0 ? here - (0.5 * slope * slope) / bend : here, exact: false };
    }
    const found = this.refined((call) => call.row(name)[0], i, here);
    this.valueAt(found.at, () => 0);
    return { ...found, exact: true };
  }

  // groups without closed form -------------------------------------------------------------

  /** Chain coordinates at the first position for other dimensions, in steps small enough to keep the assembly. */
  private approach(values: Values): boolean {
    const same = this.data.dimensions.every(({ address }) => values[address] === this.data.values[address]);
    // The original's assembly is known, whatever came between.
    const from = same ? values : (this.reachedAt ?? values);
    let states = same ? this.drawn : this.states, done = 0, share = 1;
    while (done < 1) {
      const ahead = Math.min(done + share, 1);
      const next = this.corrected(mixed(from, values, ahead), states);
      if (next) {
        [states, done, share] = [next, ahead, 2 * share];
      } else {
        share /= 2;
        if (share < 2 ** -HALVINGS) return false;
      }
    }
    this.main.program.states.forEach((name, k) => (this.main.starts[k] = this.start(name, states)));
    this.pending = states;
    return true;
  }

  private pending: Values = {};
  private reachedAt: Values | null = null;

  private start(name: string, states: Values): number {
    const given = this.data.starts[name];
    return typeof given === "string" ? states[given] : (states[name] ?? given);
  }

  private corrected(values: Values, states: Values): Values | null {
    const call = this.one;
    call.set({ ...values, ...this.found });
    call.give(Object.fromEntries(Object.entries(this.arrays).map(([name, row]) => [name, row.subarray(0, 1)])));
    let now = states, moved = Infinity;
    for (let k = 0; k < 4 && moved > 1e-13; k++) {
      call.program.states.forEach((name, j) => (call.starts[j] = this.start(name, now)));
      call.run();
      const next = { ...now };
      moved = 0;
      for (const name in now)
        if (call.has(`next:${name}`)) {
          next[name] = call.row(`next:${name}`)[0];
          moved = Math.max(moved, Math.abs(next[name] - now[name]));
        }
      now = next;
    }
    const change = Object.keys(now).reduce((most, name) => Math.max(most, Math.abs(now[name] - states[name])), 0);
    const signs = call.program.outputs.filter((name) => name.startsWith("determinant:"));
    const kept = signs.every((name) => !(name in this.determinants) || call.row(name)[0] * this.determinants[name] > 0);
    return moved < 1e-9 && change < LARGEST && kept ? now : null;
  }

  private keepStates(): void {
    if (!this.iterated) return;
    this.states = this.pending;
    this.reachedAt = { ...this.values };
    for (const name of this.main.program.outputs)
      if (name.startsWith("determinant:")) this.determinants[name] = this.main.row(name)[0];
  }

  // changes ------------------------------------------------------------------------------

  /** Takes other values, or goes as far towards them as the machine can; `wall` says what stopped it. */
  change(target: Values): void {
    this.wall = this.notPositive(target) ?? this.evaluate(target);
    if (this.wall) {
      let good = this.values, low = 0, high = 1;
      for (let k = 0; k < BISECTIONS; k++) {
        const middle = 0.5 * (low + high), tried = mixed(this.values, target, middle);
        if (this.allows(tried)) [good, low] = [tried, middle];
        else high = middle;
      }
      // A little before the limit, so that the digits of a file do not pass it.
      const before = mixed(this.values, good, 1 - BEFORE);
      if (!this.allows(before)) this.evaluate(good);
      else good = before;
      this.values = good;
    } else this.values = target;
    this.keepStates();
  }

  /** Whether the machine can have these dimensions; its rows are those of them. */
  allows(values: Values): boolean {
    return !this.notPositive(values) && !this.evaluate(values);
  }

  private notPositive(values: Values): Wall | null {
    for (const { address, positive } of this.data.dimensions)
      if (positive && !(values[address] > 0))
        return { kind: "length", name: address, group: null, input: 0, facts: {} };
    return null;
  }

  /** Moves a point at position i towards (x, y) from a base design by the least change of its unlocked dimensions. */
  drag(base: Values, key: string, i: number, x: number, y: number): void {
    const known = new Map(this.data.dimensions.map((each) => [each.address, each]));
    const all = this.data.points.find((each) => each.key === key)!.moved.filter((address) => known.has(address));
    const free = all.filter((address) => !this.locked.has(address));
    if (!free.length) {
      this.wall = { kind: all.length ? "locked" : "still", name: key, group: null, input: 0, facts: {} };
      return;
    }
    const angle = (address: string) => known.get(address)!.unit === "deg" || known.get(address)!.unit === "rad";
    const sizes = free.map((address) => (angle(address) ? 1 / this.size : 1));
    const target = { ...base };
    let [px, py] = this.place(target, key, i);
    let moves = false;
    for (let k = 0; k < 12; k++) {
      const [jx, jy] = this.slopes(target, key, i, free, sizes);
      moves ||= jx.some((each, j) => Math.hypot(each, jy[j]) * sizes[j] > 1e-6);
      const step = leastChange(jx, jy, sizes, x - px, y - py);
      if (!step.every(Number.isFinite)) break;
      const before = { ...target };
      free.forEach((address, j) => (target[address] += step[j]));
      [px, py] = this.place(target, key, i);
      if (!Number.isFinite(px + py)) {
        Object.assign(target, mixed(before, target, 0.5));
        [px, py] = this.place(target, key, i);
        if (!Number.isFinite(px + py)) break;
      }
      if (Math.max(...step.map(Math.abs)) < 1e-12 * this.size) break;
    }
    this.change(target);
    if (!this.wall && !moves) this.wall = { kind: "still", name: key, group: null, input: 0, facts: {} };
  }

  /** About how large the machine is, m. */
  get size(): number {
    const rows = this.data.points.map(({ key }) => [this.main.row(`p:${key}.x`)[0], this.main.row(`p:${key}.y`)[0]]);
    const spread = [0, 1].map((axis) => Math.max(...rows.map((r) => r[axis])) - Math.min(...rows.map((r) => r[axis])));
    return Math.hypot(spread[0], spread[1]) || 1;
  }

  private slopes(values: Values, key: string, i: number, free: string[], sizes: number[]): [number[], number[]] {
    const jx: number[] = [], jy: number[] = [], length = this.size;
    free.forEach((address, j) => {
      const h = 1e-6 * length * sizes[j], tried = { ...values };
      tried[address] = values[address] + h;
      const [ax, ay] = this.place(tried, key, i);
      tried[address] = values[address] - h;
      const [bx, by] = this.place(tried, key, i);
      // A dimension that the machine does not let go either way, as a centre of wheels that fit, moves nothing.
      const free = Number.isFinite(ax + bx + ay + by);
      jx.push(free ? (ax - bx) / (2 * h) : 0);
      jy.push(free ? (ay - by) / (2 * h) : 0);
    });
    return [jx, jy];
  }

  private place(values: Values, key: string, i: number): [number, number] {
    this.at(values, i);
    if (this.one.row("outcome")[0] !== 0) return [NaN, NaN];
    return [this.one.row(`p:${key}.x`)[0], this.one.row(`p:${key}.y`)[0]];
  }

  /** Evaluates one position; groups without closed form start from the rows that are there. */
  private at(values: Values, i: number): void {
    const call = this.one;
    call.set({ ...values, ...this.found });
    for (const name in call.positions) {
      const row = this.arrays[name];
      if (row) call.positions[name].fill(row[Math.min(i, row.length - 1)]);
    }
    for (const name in call.fields) call.fields[name].fill(this.main.fields[name][i]);
    if (this.iterated) {
      const states: Values = {};
      for (const name in this.states) {
        const row = `next:${name}`;
        states[name] = this.main.has(row) ? this.main.row(row)[i] : this.states[name];
      }
      call.program.states.forEach((name, k) => (call.starts[k] = this.start(name, states)));
      call.run();
      for (const name in states) if (call.has(`next:${name}`)) states[name] = call.row(`next:${name}`)[0];
      call.program.states.forEach((name, k) => (call.starts[k] = this.start(name, states)));
    }
    call.run();
  }

  // results ------------------------------------------------------------------------------

  /** A signal's values over the positions. */
  row(id: string): Float64Array {
    const signal = this.signals[id], rows = signal.rows.map((name) => this.main.row(name));
    const out = new Float64Array(this.n);
    if (isForce(id) && !this.forces) return out.fill(NaN);
    for (let i = 0; i < this.n; i++) out[i] = formed(signal, rows[0][i], rows[1]?.[i] ?? 0);
    if (signal.form === "angle") unwrap(out);
    return out;
  }

  design(): Design {
    const rows = Object.fromEntries(this.data.signals.map(({ id }) => [id, this.row(id)]));
    return { values: { ...this.values }, rows, numbers: this.numbers() };
  }

  numbers(): Values {
    return Object.fromEntries(this.data.numbers.map((figure) => [figure.id, this.number(figure)]));
  }

  private number(figure: Figure): number {
    const row = this.row(figure.signal);
    if (row.some(Number.isNaN)) return NaN;
    switch (figure.kind) {
      case "rms": return Math.sqrt(row.reduce((sum, x) => sum + x * x, 0) / this.n);
      case "least": return this.extreme(figure.signal, row, (x) => x);
      case "largest": return -this.extreme(figure.signal, row, (x) => -Math.abs(x));
      case "range": {
        const top = -this.extreme(figure.signal, row, (x) => -x);
        return top - this.extreme(figure.signal, row, (x) => x);
      }
      case "ratio": return this.ratio(figure.signal, row);
    }
  }

  /** Least value of `of` the signal, between the positions as well. */
  private extreme(id: string, row: Float64Array, of: (x: number) => number): number {
    const signal = this.signals[id];
    let at = 0;
    for (let i = 1; i < this.n; i++) if (of(row[i]) < of(row[at])) at = i;
    if (isForce(id) && this.main.program.fields.length) return of(row[at]);
    const value = (call: Call) => {
      const [a, b] = signal.rows.map((name) => call.row(name)[0]);
      const x = formed(signal, a, b);
      return of(signal.form === "angle" ? x + TURN * Math.round((row[at] - x) / TURN) : x);
    };
    return this.refined(value, at, of(row[at])).value;
  }

  /** The least value near position i, at most one step away; at the position where the input's law is data. */
  private refined(value: (call: Call) => number, i: number, here: number): { at: number; value: number } {
    const law = this.data.positions.steady, q = this.inputs[i];
    if (!law || this.iterated || this.n < 3) return { at: q, value: here };
    this.one.parameters.set(this.main.parameters);
    const open = !this.data.positions.closed, last = this.n - 1, h = Math.abs(law.step);
    const low = q - (open && (law.step > 0 ? i === 0 : i === last) ? 0 : h);
    const high = q + (open && (law.step > 0 ? i === last : i === 0) ? 0 : h);
    const found = least((x) => this.valueAt(x, value), low, 0.5 * (low + high), high);
    return found.value < here ? found : { at: q, value: here };
  }

  private valueAt(q: number, value: (call: Call) => number): number {
    const law = this.data.positions.steady!, call = this.one;
    const speed = this.main.program.parameters.includes(`${law.driver}.speed`) ? this.speed : law.speed;
    const put = (name: string, x: number) => call.positions[name]?.fill(x);
    put("input", q);
    put(`cos:${law.driver}`, Math.cos(q));
    put(`sin:${law.driver}`, Math.sin(q));
    put(`slide:${law.driver}`, q);
    put(`turn:${law.driver}`, q);
    put("time", law.begin * (law.speed / speed) + (q - law.start) / speed);
    for (const name in this.data.positions.modes) put(name, this.arrays[name][this.index(q)]);
    call.run();
    return value(call);
  }

  private get speed(): number {
    const { driver } = this.data.positions.steady!;
    return this.main.parameters[this.main.program.parameters.indexOf(`${driver}.speed`)];
  }

  private index(q: number): number {
    const law = this.data.positions.steady!;
    return ((Math.round((q - law.start) / law.step) % this.n) + this.n) % this.n;
  }

  /** Input from one limit position to the other over the rest of the turn, at least 1. */
  private ratio(id: string, row: Float64Array): number {
    let top = 0, bottom = 0;
    for (let i = 1; i < this.n; i++) {
      if (row[i] > row[top]) top = i;
      if (row[i] < row[bottom]) bottom = i;
    }
    const rate = id.startsWith("angle:") ? `w:${id.slice(6)}` : `sv:${id.slice(2)}`;
    const limits = [top, bottom].map((i) => {
      const h = Math.abs(this.data.positions.steady!.step), q = this.inputs[i];
      if (this.iterated) return q;
      this.one.parameters.set(this.main.parameters);
      const of = (x: number) => this.valueAt(x, (call) => call.row(rate)[0]);
      const [a, b] = [of(q - h), of(q + h)];
      return a * b < 0 ? root(of, q - h, q + h, a, b) : q;
    });
    const way = (((limits[1] - limits[0]) % TURN) + TURN) % TURN;
    return Math.max(way, TURN - way) / Math.min(way, TURN - way);
  }
}

export function isForce(id: string): boolean {
  return id.startsWith("effort:") || id.startsWith("r:") || id === "shake";
}

function formed(signal: Signal, a: number, b: number): number {
  switch (signal.form) {
    case "row": return a;
    case "size": return Math.hypot(a, b);
    case "angle": return Math.atan2(b, a);
  }
}

function unwrap(row: Float64Array): void {
  for (let i = 1; i < row.length; i++) row[i] += TURN * Math.round((row[i - 1] - row[i]) / TURN);
}

function mixed(from: Values, to: Values, share: number): Values {
  if (share >= 1) return { ...to };
  return Object.fromEntries(Object.keys(to).map((name) => [name, (from[name] ?? to[name]) + share * (to[name] - (from[name] ?? to[name]))]));
}

/** Memory that a model's calls take, MB. */
function size(data: ModelData): number {
  const rows = data.programs.reduce((sum, p) => sum + p.outputs.length + p.positions.length + p.fields.length + 8, 0);
  return Math.ceil((3 * 8 * rows * (data.positions.count + 16)) / 1048576) + 2;
}

export async function code(data: ModelData, number: number): Promise<Code> {
  const { module } = data;
  if (typeof module === "string") return { module: await WebAssembly.compile(bytes(module)) };
  if (module instanceof Uint8Array) return { module: await WebAssembly.compile(module) };
  return { functions: (globalThis as unknown as { kernels: never[][] }).kernels[number] };
}

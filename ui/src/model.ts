// A machine of the page: its dimensions as they are now, its curves and metrics, and what a change may do.
import { floats, type ModelData, type Signal } from "./data";
import type { Call, Code } from "./engine";
import { unwrap } from "./loads";
import { type Extreme, extreme, formed, isForce, number, roundingOf } from "./numbers";
import { leastChange } from "./search";
import { mixed, Solver, type Values, type Wall } from "./solver";

/** What stays of a design for comparison: its dimensions, rows of curves and metrics. */
export interface Design {
  values: Values;
  rows: Record<string, Float64Array>;
  numbers: Values;
}

const BISECTIONS = 32;
// Share of the way that is kept clear of a limit.
const BEFORE = 1e-7;

export class Model {
  readonly solver: Solver;
  /** What has been found of the machine with these values. */
  private found: { values: Values; rounding: number; size: number; extremes: Record<string, Extreme>; jumps: Record<number, [number, number][]> } | null = null;
  original: Design;
  readonly signals: Record<string, Signal>;
  /** What curves run over: the input where it goes one way in a prescribed motion, else the time; with the end of a closed cycle. */
  readonly axis: { x: Float64Array; kind: "angle" | "length" | "time" };
  values: Values;
  locked = new Set<string>();
  wall: Wall | null = null;

  constructor(readonly data: ModelData, code: Code) {
    this.solver = new Solver(data, code);
    const { inputs } = this.solver, { time } = data.positions, way = Math.sign(inputs[1] - inputs[0]);
    const forward = inputs.every((q, i) => i === 0 || Math.sign(q - inputs[i - 1]) === way);
    this.axis = (forward && !data.positions.run) || time === null
      ? { x: inputs, kind: data.positions.inputs[0]?.turns ?? true ? "angle" : "length" }
      : { x: floats(time), kind: "time" };
    const { x } = this.axis;
    if (data.positions.closed) this.axis.x = Float64Array.of(...x, 2 * x[this.n - 1] - x[this.n - 2]);
    this.signals = Object.fromEntries(data.signals.map((signal) => [signal.id, signal]));
    this.values = { ...data.values };
    this.evaluate(this.values);
    this.solver.keep(this.values);
    this.original = this.design();
  }

  /** The call that holds the rows of the machine. */
  get main(): Call {
    return this.solver.main;
  }

  get n(): number {
    return this.solver.n;
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
    return !this.solver.doubtful && !this.solver.locking && !(this.data.held.length && this.changed);
  }

  /** Fills the rows for these values; returns the wall in the way, or null where every position is reached. */
  evaluate(values: Values): Wall | null {
    return this.solver.evaluate(values);
  }

  // changes ------------------------------------------------------------------------------

  /** Takes other values, or goes as far towards them as the machine can; `wall` says what stopped it. */
  change(target: Values): void {
    this.wall = this.notPositive(target);
    if (this.wall) target = this.values;
    const met = this.evaluate(target);
    this.wall ??= met;
    if (met) {
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
    this.solver.keep(this.values);
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
    const { size } = this, sizes = free.map((address) => (angle(address) ? 1 / size : 1)), steps = sizes.map((each) => 1e-6 * size * each);
    const target = { ...base };
    let [px, py] = this.solver.place(target, key, i);
    let moves = false;
    for (let k = 0; k < 12; k++) {
      const [jx, jy] = this.slopes(target, key, i, [px, py], free, steps);
      moves ||= jx.some((each, j) => Math.hypot(each, jy[j]) * sizes[j] > 1e-6);
      const step = leastChange(jx, jy, sizes, x - px, y - py);
      if (!step.every(Number.isFinite)) break;
      const before = { ...target };
      free.forEach((address, j) => (target[address] += step[j]));
      [px, py] = this.solver.place(target, key, i);
      if (!Number.isFinite(px + py)) {
        Object.assign(target, mixed(before, target, 0.5));
        [px, py] = this.solver.place(target, key, i);
        if (!Number.isFinite(px + py)) break;
      }
      if (Math.max(...step.map(Math.abs)) < 1e-12 * size) break;
    }
    this.change(target);
    if (!this.wall && !moves) this.wall = { kind: "still", name: key, group: null, input: 0, facts: {} };
  }

  private slopes(values: Values, key: string, i: number, [px, py]: [number, number], free: string[], steps: number[]): [number[], number[]] {
    const jx: number[] = [], jy: number[] = [];
    free.forEach((address, j) => {
      const h = steps[j], tried = { ...values };
      tried[address] = values[address] + h;
      const [ax, ay] = this.solver.place(tried, key, i);
      tried[address] = values[address] - h;
      const [bx, by] = this.solver.place(tried, key, i);
      // At a limit one side counts; what the machine lets go neither way, as a centre of wheels that fit, moves nothing.
      const above = Number.isFinite(ax + ay), below = Number.isFinite(bx + by), width = h * (Number(above) + Number(below));
      jx.push(width ? ((above ? ax : px) - (below ? bx : px)) / width : 0);
      jy.push(width ? ((above ? ay : py) - (below ? by : py)) / width : 0);
    });
    return [jx, jy];
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

  /** The least (`sign` 1) or largest (-1) value of a signal with this row over the cycle. */
  extreme(id: string, row: Float64Array, sign: 1 | -1): Extreme {
    return (this.known.extremes[`${sign} ${id}`] ??= extreme(this, id, row, sign));
  }

  /** Size up to which a force, N, is but rounding. */
  get rounding(): number {
    return this.known.rounding;
  }

  /** Places on both sides of jumps that have been found, by the position before them. */
  get jumps(): Record<number, [number, number][]> {
    return this.known.jumps;
  }

  /** About how large the machine is, m. */
  get size(): number {
    return this.known.size;
  }

  private get known(): NonNullable<Model["found"]> {
    if (this.found?.values === this.values) return this.found;
    return (this.found = { values: this.values, rounding: roundingOf(this), size: this.spread(), extremes: {}, jumps: {} });
  }

  private spread(): number {
    const rows = this.data.points.map(({ key }) => [this.main.row(`p:${key}.x`)[0], this.main.row(`p:${key}.y`)[0]]);
    const spread = [0, 1].map((axis) => Math.max(...rows.map((r) => r[axis])) - Math.min(...rows.map((r) => r[axis])));
    return Math.hypot(spread[0], spread[1]) || 1;
  }

  design(): Design {
    const rows = Object.fromEntries(this.data.signals.map(({ id }) => [id, this.row(id)]));
    return { values: { ...this.values }, rows, numbers: this.numbers() };
  }

  numbers(): Values {
    return Object.fromEntries(this.data.numbers.map((figure) => [figure.id, number(this, figure)]));
  }
}

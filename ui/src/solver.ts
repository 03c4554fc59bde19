// One machine solved at all its positions by its programs, and what is in the way where it cannot be.
import { bytes, floats, type Group, type ModelData } from "./data";
import { type Call, type Code, Kernel, moduleCode, type Outputs, taken } from "./engine";
import { Drive } from "./drive";
import { corners, type Cycle } from "./events";
import { settle } from "./friction";
import { type Between, follow } from "./loads";
import { least } from "./search";

export type Values = Record<string, number>;

/** Why a change stops: a group at a position, or a dimension. */
export interface Wall {
  kind: "apart" | "singular" | "change" | "lost" | "length" | "locked" | "still";
  name: string;
  group: Group | null;
  input: number;
  facts: Values;
}

// Least squares of sines of transmission angles: worth a closer look; a change point.
const NEAR = 0.02;
const TOUCH = 1e-10;
// Largest change of a chain coordinate in one step towards other dimensions, and the most halvings of the way.
const LARGEST = 0.1;
const HALVINGS = 12;

export class Solver {
  readonly main: Call;
  readonly n: number;
  readonly inputs: Float64Array;
  /** Time from one position to the next where no driver is steady, s. */
  private readonly pace: number;
  /** Limits or magnitudes of loads that are not certain to be right. */
  doubtful = false;
  /** Friction for which no finite effort is found. */
  locking = false;
  /** The machine over its cycle. */
  cycle!: Cycle;
  private readonly one: Call;
  /** What loads take between the positions; null where they take nothing, or not as the rows have it. */
  private between: Between | null = null;
  private drive: Drive | null = null;
  private readonly arrays: Record<string, Float64Array> = {};
  private readonly coordinates: Float64Array[] = [];
  /** Chain coordinates that go from one position to the next. */
  private readonly carried: string[];
  private found: Values = {};
  private states: Values = {};
  private drawn: Values = {};

  constructor(readonly data: ModelData, compiled: Code) {
    const { positions } = data;
    this.n = positions.count;
    const kernel = new Kernel(data.program, compiled, data.tables, size(data));
    this.main = kernel.call(this.n);
    this.one = kernel.call(1);
    for (const name in positions.arrays) this.arrays[name] = floats(positions.arrays[name]);
    const { inputs, steady, time } = positions, given = inputs[0]?.values, times = time === null ? [0, 0] : floats(time);
    this.pace = times[1] - times[0];
    this.inputs = steady ? Float64Array.from({ length: this.n }, (_, i) => steady.start + i * steady.step) : given ? floats(given) : new Float64Array(1);
    for (const name in data.fields) this.main.give({ [name]: floats(data.fields[name]) });
    this.carried = Object.keys(data.starts);
    this.drawn = this.states = data.starts;
  }

  get iterated(): boolean {
    return this.carried.length > 0;
  }

  /** The coordinate of a driver at a position. */
  driver(number: number, i: number): number {
    const { steady, inputs } = this.data.positions, given = inputs[number].values;
    return steady || given === null ? this.inputs[i] : (this.coordinates[number] ??= floats(given))[i];
  }

  get margin(): number | null {
    return this.iterated ? this.main.row("margin").reduce((a, b) => Math.min(a, b), 1) : null;
  }

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
    put("step", (_, i) => (i ? dt : 0));
  }

  /** Fills the rows for these values; returns the wall in the way, or null where every position is reached. */
  evaluate(values: Values): Wall | null {
    this.steady(values);
    if (Object.keys(this.data.positions.modes).length) this.setModes(values);
    this.doubtful = false;
    this.found = this.paces(values);
    this.main.set({ ...values, ...this.found });
    this.main.give(this.arrays);
    if (this.iterated && !this.approach(values)) return this.lost(0);
    this.main.run();
    [this.between, this.locking, this.cycle] = [null, false, this.over(values)];
    const wall = this.reached(values), { friction, phases, angles } = this.data;
    if (wall && !this.unchanged(values)) return wall;
    if (phases.length + angles.length) {
      this.between = follow(this.cycle, phases, angles, values);
      this.doubtful ||= !this.between;
      this.main.run();
    }
    this.locking = friction.length > 0 && !settle(this.main, friction);
    if (this.main.has(this.data.sizes)) this.doubtful ||= !this.main.row(this.data.sizes).every(Number.isFinite);
    return wall;
  }

  /** Whether the machine is the original, which passes its cycle even where the page could not follow it so far. */
  private unchanged(values: Values): boolean {
    return this.data.dimensions.every(({ address, value }) => values[address] === value);
  }

  /** Rates beside which others are rest, with the speed of a steady driver. */
  private paces(values: Values): Values {
    const law = this.data.positions.steady, share = law ? Math.abs((values[`${law.driver}.speed`] ?? law.speed) / law.speed) : 1;
    const names = Object.keys(this.data.values).filter((name) => name.startsWith("pace:"));
    return Object.fromEntries(names.map((name) => [name, share * this.data.values[name]]));
  }

  private over(values: Values): Cycle {
    const { steady, closed, drift, inputs, breaks } = this.data.positions, { main, data } = this;
    let found: number[] | null = null;
    const cycle: Cycle = {
      main, closed, drift, turns: inputs[0]?.turns ?? true, pace: steady ? steady.step / this.speed : this.pace,
      input: (place) => (steady ? steady.start + place * steady.step : Number.isInteger(place) ? this.inputs[place] : (this.inputsAt(place)?.input ?? NaN)),
      at: (place) => (this.run(place) ? this.one : null),
      get corners() {
        return (found ??= corners(cycle, breaks ?? [], data.bends, values));
      },
    };
    return cycle;
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
    const outcome = this.main.row("outcome")[i];
    if (outcome === 0) return this.lost(i);
    const group = this.data.groups[Math.abs(outcome) - 1];
    const facts: Values = {};
    for (const fact of group.facts) facts[fact] = this.main.row(`fact:${group.name}|${fact}`)[i];
    return { kind: outcome < 0 ? "singular" : "apart", name: group.name, group, input: this.inputs[i], facts };
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
        const found = this.lowest(name, i, before, here, after);
        if (found.value >= TOUCH) continue;
        const facts = Object.fromEntries(group.facts.map((fact) => [fact, this.one.row(`fact:${group.name}|${fact}`)[0]]));
        return { kind: found.value < -TOUCH && found.exact ? "apart" : "change", name: group.name, group, input: found.at, facts };
      }
    }
    return null;
  }

  /** The least value near position i: found with the program, or by a parabola where the input's law is data. */
  private lowest(name: string, i: number, before: number, here: number, after: number) {
    if (!this.data.positions.steady || this.iterated) {
      const bend = before - 2 * here + after, slope = 0.5 * (after - before);
      return { at: this.inputs[i], value: bend > 0 ? here - (0.5 * slope * slope) / bend : here, exact: false };
    }
    const found = this.refined((place) => this.valueAt(place, (call) => call.row(name)[0]), i, here), { start, step } = this.data.positions.steady;
    this.valueAt(found.at, () => 0);
    return { at: start + found.at * step, value: found.value, exact: true };
  }

  // groups without closed form -------------------------------------------------------------

  /** Chain coordinates at the first position for other dimensions, in steps small enough to keep the assembly. */
  private approach(values: Values): boolean {
    const same = this.unchanged(values);
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
    this.walk(states);
    this.pending = states;
    return true;
  }

  /** Fills what every position takes from the one before, from chain coordinates at the first position on. */
  private walk(states: Values): void {
    const { one, main, carried } = this, found: [Float64Array, Float64Array][] = [], given: [Float64Array, Float64Array][] = [];
    for (const name of carried)
      [states[name], 0, 0].forEach((value, k) => {
        const along = main.fields[`${name}|${k}`];
        along[0] = value;
        found.push([along, one.row(`then:${name}|${k}`)]);
      });
    for (const name in one.positions) given.push([one.positions[name], main.positions[name]]);
    for (const name in one.fields) given.push([one.fields[name], main.fields[name]]);
    one.parameters.set(main.parameters);
    for (const [here, along] of given) here.fill(along[0]);
    for (let i = 0; i < this.n; i++) {
      for (const [here, along] of given) here[0] = along[i];
      one.run();
      for (const [along, here] of found) along[i + 1] = here[0];
    }
  }

  private pending: Values = {};
  private reachedAt: Values | null = null;

  private corrected(values: Values, states: Values): Values | null {
    const call = this.one;
    call.set({ ...values, ...this.found });
    call.give(Object.fromEntries(Object.entries(this.arrays).map(([name, row]) => [name, row.subarray(0, 1)])));
    let now = states, moved = Infinity;
    for (let k = 0; k < 4 && moved > 1e-13; k++) {
      this.begin(call, now);
      const next = this.after(call);
      moved = Object.keys(next).reduce((most, name) => Math.max(most, Math.abs(next[name] - now[name])), 0);
      now = next;
    }
    const change = Object.keys(now).reduce((most, name) => Math.max(most, Math.abs(now[name] - states[name])), 0);
    const kept = call.program.outputs.every((name) => !name.startsWith("kept:") || call.row(name)[0] > 0);
    return moved < 1e-9 && change < LARGEST && kept ? now : null;
  }

  /** The machine with these values, which the rows are of, is where the next change begins. */
  keep(values: Values): void {
    if (!this.iterated) return;
    this.states = this.pending;
    this.reachedAt = { ...values };
  }

  // single positions -----------------------------------------------------------------------

  /** Where a point is at a place among the positions; not a number where the machine does not close. */
  place(values: Values, key: string, i: number): [number, number] {
    this.at(values, i);
    if (this.one.row("outcome")[0] !== 0) return [NaN, NaN];
    return [this.one.row(`p:${key}.x`)[0], this.one.row(`p:${key}.y`)[0]];
  }

  /** Evaluates one place; groups without closed form start from the rows that are there. */
  private at(values: Values, i: number): void {
    const call = this.one, near = this.near(i), given = Number.isInteger(i) ? null : this.inputsAt(this.within(i));
    call.set({ ...values, ...this.found });
    for (const name in call.positions) {
      const row = this.arrays[name];
      if (row) call.positions[name].fill(given?.[name] ?? row[Math.min(near, row.length - 1)]);
    }
    for (const name in call.fields) call.fields[name].fill(this.main.fields[name][near]);
    if (this.iterated) this.settle(call, this.after(this.main, near));
    else call.run();
  }

  /** Chain coordinates at a position that has been solved. */
  private after(call: Call, i = 0): Values {
    return Object.fromEntries(this.carried.map((name) => [name, call.row(`then:${name}|0`)[i]]));
  }

  /** Runs one position twice, so that Newton's steps from chain coordinates near it come to their end. */
  private settle(call: Call, states: Values): void {
    this.begin(call, states);
    this.begin(call, this.after(call));
  }

  /** Runs one position as the first one, from chain coordinates near it. */
  private begin(call: Call, states: Values): void {
    for (const name of this.carried) [states[name], 0, 0].forEach((value, k) => call.fields[`${name}|${k}`].fill(value));
    call.run();
  }

  /** The least value near position i, at most one step away. */
  refined(at: (place: number) => number, i: number, here: number): { at: number; value: number } {
    const { closed } = this.data.positions, low = i - Number(closed || i > 0), high = i + Number(closed || i < this.n - 1);
    const found = least((place) => (Number.isFinite((place = at(place))) ? place : Infinity), low, 0.5 * (low + high), high);
    return found.value < here ? found : { at: i, value: here };
  }

  /** A value of the present machine at any place among the positions, of which the first is 0. */
  valueAt(place: number, value: (call: Call) => number): number {
    return this.run(place) ? value(this.one) : NaN;
  }

  /** Runs the present machine at a place; false where the drivers are not known there. */
  private run(place: number): boolean {
    const call = this.one, at = this.within(place), near = this.near(at), given = this.inputsAt(at);
    if (!given) return false;
    call.parameters.set(this.main.parameters);
    for (const name in given) call.positions[name]?.fill(given[name]);
    for (const name in this.data.positions.modes) call.positions[name]?.fill(this.arrays[name][near]);
    for (const name in call.fields) call.fields[name].fill(this.main.fields[name][near]);
    if (this.iterated) this.settle(call, this.after(this.main, near));
    else call.run();
    return true;
  }

  /** The same of a force. */
  forceAt(place: number, value: (call: Call) => number): number {
    const { friction } = this.data, call = this.one, at = this.within(place);
    if (!this.run(place)) return NaN;
    const found = this.between?.(call, at, this.near(at));
    for (const name in found) call.fields[name]?.fill(found[name]);
    if (found) call.run();
    return friction.length && !this.locking && !settle(call, friction) ? NaN : value(call);
  }

  /** The machine with its loads at a place between the positions; null where it is not known there. */
  whole(place: number): Outputs | null {
    let found: Call | null = null;
    this.forceAt(place, (call) => ((found = call), 0));
    const whole = found && (found as Call).row("ok")[0] !== 0 ? found : this.closed(place);
    return whole && taken(whole);
  }

  /** The same without loads, where friction finds no effort. */
  private closed(place: number): Call | null {
    return this.run(place) && this.one.row("ok")[0] !== 0 ? this.one : null;
  }

  /** The drivers' inputs at a place; null where they are not known. */
  private inputsAt(place: number): Values | null {
    const { steady, breaks } = this.data.positions;
    if (!steady) return breaks && (this.drive ??= new Drive(this.data.positions)).at(place);
    const { driver, begin, step, start } = steady, q = start + place * step, speed = this.speed;
    return {
      input: q, time: (begin * steady.speed + place * step) / speed, [`cos:${driver}`]: Math.cos(q), [`sin:${driver}`]: Math.sin(q),
      [`slide:${driver}`]: q, [`turn:${driver}`]: q,
    };
  }

  /** The speed of a steady driver. */
  private get speed(): number {
    const { driver, speed } = this.data.positions.steady!, place = this.main.program.parameters.indexOf(`${driver}.speed`);
    return place < 0 ? speed : this.main.parameters[place];
  }

  /** The position nearest to a place within the cycle. */
  private near(place: number): number {
    return Math.min(this.n - 1, Math.max(0, Math.round(place)));
  }

  /** The place within the cycle that a closed one has for any. */
  private within(place: number): number {
    return this.data.positions.closed ? place - this.n * Math.floor(place / this.n) : place;
  }
}

export function mixed(from: Values, to: Values, share: number): Values {
  if (share >= 1) return { ...to };
  return Object.fromEntries(Object.keys(to).map((name) => [name, (from[name] ?? to[name]) + share * (to[name] - (from[name] ?? to[name]))]));
}

/** Memory that a model's calls take, MB. */
function size(data: ModelData): number {
  const { outputs, positions, fields } = data.program, rows = outputs.length + positions.length + fields.length + 8;
  return Math.ceil((3 * 8 * rows * (data.positions.count + 16)) / 1048576) + 2;
}

export async function code({ module }: ModelData): Promise<Code> {
  return moduleCode(await WebAssembly.compile(typeof module === "string" ? bytes(module) : (module as Uint8Array<ArrayBuffer>)));
}

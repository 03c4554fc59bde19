// What loads take per position once the motion is known: when they act, and angles of links that turn through.
import type { AngleField, Interval, Phase, PhaseOfOutput } from "./data";
import type { Call } from "./engine";
import { type Cycle, events, modulo, type Reading } from "./events";
import { TURN } from "./numbers";

/** Where an output reverses, and its value there. Ways are places in the order of time. */
interface Limit {
  way: number;
  value: number;
  max: boolean;
}

// Share of a cycle, a turn or a stroke within which positions belong to a phase, limits are equal and parts fit, as in the
// core; between positions phases end at their ends.
const NEAR = 1e-9;
const slack = (place: number) => (Number.isInteger(place) ? NEAR : 0);

/** What loads take at a place between positions, by the names of fields, of a call that has run there. */
export type Between = (one: Call, place: number, near: number) => Record<string, number>;

/** The share of a phase that is passed at a place; null where the load does not act. */
type Passed = (...where: Parameters<Reading>) => number | null;

/** Writes the phases and angles of loads into the call of a cycle; null where a phase does not exist, else how they go on
 *  between the positions. */
export function follow(cycle: Cycle, phases: Phase[], angles: AngleField[], values: Record<string, number>): Between | null {
  const call = cycle.main, rows = angles.map(({ field, a, b, near }) => {
    const row = between(call, a, b, near && (values[near[0]] ?? near[1]));
    put(call, field, row);
    return row;
  });
  const found: [load: string, passed: Passed][] = [];
  for (const phase of phases) {
    const passed = phase.kind === "input" ? interval(phase, values, cycle) : byOutput(phase, cycle);
    if (!passed) return null;
    found.push([phase.load, passed]);
    const acts = new Float64Array(call.n), shares = new Float64Array(call.n);
    for (let i = 0; i < call.n; i++) {
      const share = passed(call, i, i, i);
      acts[i] = Number(share !== null);
      shares[i] = share ?? 0;
    }
    put(call, `acts:${phase.load}`, acts);
    put(call, `share:${phase.load}`, shares);
  }
  return (one, place, near) => {
    const taken: Record<string, number> = {};
    angles.forEach(({ field, a, b }, k) => (taken[field] = nearest(turned(one, a, b, 0), rows[k][near])));
    for (const [load, passed] of found) {
      const share = passed(one, 0, place, near);
      taken[`acts:${load}`] = Number(share !== null);
      taken[`share:${load}`] = share ?? 0;
    }
    return taken;
  };
}

/** Beyond the last position a program repeats it. */
function put(call: Call, field: string, row: Float64Array): void {
  const given = call.fields[field];
  given?.set(row);
  given?.fill(row[call.n - 1], call.n);
}

// angles ---------------------------------------------------------------------------------------

function turned(call: Call, a: string, b: string, i: number): number {
  const direction = (link: string) => (call.has(`e:${link}.x`) ? Math.atan2(call.row(`e:${link}.y`)[i], call.row(`e:${link}.x`)[i]) : 0);
  return direction(b) - direction(a);
}

function between(call: Call, a: string, b: string, near: number | null): Float64Array {
  const row = Float64Array.from({ length: call.n }, (_, i) => turned(call, a, b, i));
  if (near !== null) row[0] = nearest(row[0], near);
  return unwrap(row);
}

/** An angle, give or take turns, nearest to another one. */
export const nearest = (angle: number, to: number) => angle + TURN * Math.round((to - angle) / TURN);

export function unwrap(row: Float64Array): Float64Array {
  for (let i = 1; i < row.length; i++) row[i] = nearest(row[i], row[i - 1]);
  return row;
}

// phases ---------------------------------------------------------------------------------------

/** While the input is between two coordinates; of angles modulo one turn, from the larger to the smaller one through its
 *  end where the input grows; null for more than a turn. */
function interval({ between: ends }: Interval, values: Record<string, number>, { input, pace, turns }: Cycle): Passed | null {
  const [start, end] = ends.map((name) => values[name]), gap = end - start, heading = (input(1) - input(0)) * pace;
  if (!turns)
    return (_call, _i, place) => {
      const q = input(place), near = slack(place);
      return q >= Math.min(start, end) - near && q <= Math.max(start, end) + near ? clipped((q - start) / gap) : null;
    };
  if (Math.abs(gap) > TURN + NEAR) return null;
  const length = gap < 0 && heading > 0 ? modulo(gap, TURN) || TURN : gap, size = Math.abs(length), low = Math.min(start, start + length);
  return (_call, _i, place) => {
    const gone = within(place, input(place) - low, size, TURN), share = gone === null ? 0 : clipped(gone / size);
    return gone === null ? null : length > 0 ? share : 1 - share;
  };
}

/** What is gone of a length in a lap at a place, both ends included; null beyond. */
function within(place: number, gone: number, length: number, lap: number): number | null {
  const way = modulo(gone, lap), near = slack(place) * lap, passed = way > lap - near ? way - lap : way;
  return passed <= length + near ? passed : null;
}

const clipped = (share: number) => Math.min(1, Math.max(0, share));

/** While an output moves one way, from limit to limit for a ramp, or goes between its outermost limits, or in a part of
 *  that; null where it never does. */
function byOutput(phase: PhaseOfOutput, cycle: Cycle): Passed | null {
  const sign = phase.ends[1] === "max" ? 1 : -1, moves = (one: Call, i: number) => sign * one.row(phase.moving)[i] > 0;
  const moving = phase.kind === "moving", { closed } = cycle, { n } = cycle.main;
  if (moving && !phase.ramp) return (one, i) => (moves(one, i) ? 0 : null);
  const output = outputOf(phase, cycle.main), limits = reversals(phase, cycle, output), sense = Math.sign(cycle.pace), lap = closed ? n : 2 * n;
  if (!limits.length || limits.some(({ value }) => Number.isNaN(value))) return null;
  const ways = strokes(moving ? limits : outermost(limits), phase.ends, closed ? lap : null)
    .map(({ begin, end }) => ({ begin, end, share: phase.part ? partOf(begin, end, phase, output) : shareOf(begin, end, cycle) }));
  if ((!moving && !ways.length) || ways.some(({ share }) => !share)) return null;
  return (one, i, place, near) => {
    if (moving && !moves(one, i)) return null;
    for (const { begin, end, share } of ways) {
      const gone = within(place, sense * place - begin.way, end.way - begin.way, lap);
      const there = gone === null ? null : share!(gone, one, i, place, near);
      if (there !== null) return clipped(there);
    }
    return null;
  };
}

/** An output; an angle as it goes on from a position near it. */
function outputOf({ rows }: PhaseOfOutput, main: Call): Reading {
  const read: Reading = (call, i) => (rows.length > 1 ? Math.atan2(call.row(rows[1])[i], call.row(rows[0])[i]) : call.row(rows[0])[i]);
  if (rows.length < 2) return read;
  const [x, y] = rows.map((name) => main.row(name)), angles = unwrap(x.map((cosine, i) => Math.atan2(y[i], cosine)));
  return (call, i, place, near) => nearest(read(call, i, place, near), angles[near]);
}

/** Where an output reverses, in the order of time. */
function reversals({ rate, second, moving }: PhaseOfOutput, cycle: Cycle, output: Reading): Limit[] {
  const row = (name: string): Reading => (call, i) => call.row(name)[i];
  const limits = events(cycle, { value: row(rate), rate: row(second), rests: row(moving) }).map(({ place, grows }) => {
    const one = cycle.at(place), value = one ? output(one, 0, place, Math.floor(place)) : NaN;
    return { way: Math.sign(cycle.pace) * place, value, max: grows !== cycle.pace > 0 };
  });
  return limits.sort((a, b) => a.way - b.way);
}

/** Of all reversals those with the largest and the smallest value. */
function outermost(limits: Limit[]): Limit[] {
  const values = limits.map(({ value }) => value), alike = NEAR * (Math.max(...values) - Math.min(...values));
  const top = Math.max(...limits.filter(({ max }) => max).map(({ value }) => value)) - alike;
  const bottom = Math.min(...limits.filter(({ max }) => !max).map(({ value }) => value)) + alike;
  return limits.filter(({ max, value }) => (max ? value >= top : value <= bottom));
}

/** From each limit of one kind to the other kind's next one, through the end of a lap that closes. */
function strokes(limits: Limit[], ends: ("max" | "min")[], lap: number | null): { begin: Limit; end: Limit }[] {
  return limits.flatMap((end, k) => {
    const before = limits.at(k - 1)!;
    if (before.max !== (ends[0] === "max") || end.max !== (ends[1] === "max") || (!k && lap === null)) return [];
    return [{ begin: k ? before : { ...before, way: before.way - lap! }, end }];
  });
}

/** The share of a stroke, by what is gone of it and by the output there; null outside of it. */
type Share = (gone: number, ...where: Parameters<Reading>) => number | null;

/** The share of the input's way; null where the input goes nowhere. */
function shareOf(begin: Limit, end: Limit, { pace, drift, input, main: { n } }: Cycle): Share | null {
  const at = (way: number, place = Math.sign(pace) * way) => input(modulo(place, n)) + Math.floor(place / n) * drift;
  const first = at(begin.way), rise = at(end.way) - first;
  return Math.abs(rise) < NEAR * (1 + Math.abs(first + rise)) ? null : (gone) => (at(begin.way + gone) - first) / rise;
}

/** The share of a part of a stroke, by the way of the output itself; null where the stroke is too short for it. */
function partOf(begin: Limit, end: Limit, { part, rows }: PhaseOfOutput, output: Reading): Share | null {
  const size = Math.abs(end.value - begin.value), fits = NEAR * size;
  const ways = part!.amounts.map(([value, share]) => value * (share ? size : 1)), last = ways[ways.length - 1];
  const [from, to] = part!.word === "first" ? [0, ways[0]] : part!.word === "last" ? [size - ways[0], size] : [ways[0], size - last];
  if (!(from >= -fits && from < to && to <= size + fits)) return null;
  return (_gone, ...where) => {
    const near = slack(where[2]) * size;
    let way = (output(...where) - begin.value) * Math.sign(end.value - begin.value);
    if (rows.length > 1 && size < TURN) way -= TURN * Math.floor((way + (TURN - size) / 2) / TURN);
    return way >= from - near && way <= to + near ? (way - from) / (to - from) : null;
  };
}

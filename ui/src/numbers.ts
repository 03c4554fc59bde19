// Metrics of a machine over its cycle, between the positions as well.
import type { Figure, Signal } from "./data";
import { through } from "./drive";
import type { Call } from "./engine";
import type { Model } from "./model";
import { nearest } from "./loads";
import { events } from "./events";
import { least } from "./search";
import type { Solver } from "./solver";

export const TURN = 2 * Math.PI;

/** The value of a metric. */
export function number(model: Model, figure: Figure): number {
  const row = model.row(figure.signal), { signal } = figure;
  if (row.some(Number.isNaN)) return NaN;
  if (largest(row) <= rounding(model, signal)) return 0;
  const lowest = () => model.extreme(signal, row, 1).value, highest = () => model.extreme(signal, row, -1).value;
  switch (figure.kind) {
    case "rms": return rms(model, signal, row);
    case "least": return lowest();
    case "largest": return model.signals[signal].form === "size" ? highest() : Math.max(highest(), -lowest());
    case "range": return highest() - lowest();
    case "ratio": return ratio(model, signal, row);
  }
}

/** An extreme of a signal: its value, and the place among the positions, of which the first is 0. */
export interface Extreme {
  at: number;
  value: number;
}

// Brackets that are searched for an extreme at most; a change between positions, as a share of the signal's size, that
// may be a jump; how often the stretch with a jump in it is halved.
const MOST = 16, JUMP = 0.02, HALVINGS = 40;

/** The least (`sign` 1) or largest (-1) value of a signal, between the positions as well; of equal ones the first. */
export function extreme(model: Model, id: string, row: Float64Array, sign: 1 | -1): Extreme {
  const { n, solver } = model, f = row.map((x) => sign * x);
  let at = 0;
  for (let i = 1; i < n; i++) if (f[i] < f[at]) at = i;
  const size = largest(row);
  let found: Extreme = { at, value: f[at] };
  const turns = model.signals[id].form === "angle" && model.data.positions.closed && Math.abs(row[n - 1] - row[0]) > Math.PI;
  if (!(size > rounding(model, id)) || n < 3 || turns || searched(model, id) !== null) return { at, value: row[at] };
  const better = (place: number, value: number) => {
    const here = place < 0 ? place + n : place, near = SAME * size;
    if (value < found.value - near || (value <= found.value + near && here < found.at)) found = { at: here, value: Math.min(value, found.value) };
  };
  for (const i of brackets(f, model.data.positions.closed, f[at])) {
    const value = (place: number) => sign * between(model, id, place, row[i]);
    const lowest = smoothly(solver, f, i, size) ?? solver.refined(value, i, f[i]);
    better(lowest.at, lowest.value);
  }
  for (const i of jumps(f, model.data.positions.closed, size)) {
    const value = (place: number) => sign * between(model, id, place, row[i]);
    for (const place of sides(model, value, i, f[i], f[(i + 1) % n])) better(place, value(place));
  }
  return { at: found.at, value: sign * found.value };
}

// Positions on each side of one through which polynomials go, of a higher and of a lower degree; the share of a signal's
// size up to which both may differ at its extreme, so that the higher one meets the signal.
const [WIDE, NARROW] = [4, 3], MET = 1e-12;

/** The least value near a position by a polynomial through the positions beside it; null where it may not meet the signal. */
function smoothly(solver: Solver, f: Float64Array, i: number, size: number): Extreme | null {
  const n = f.length, { closed } = solver.data.positions;
  if (n < 2 * WIDE + 1 || (!closed && (i < WIDE || i + WIDE >= n))) return null;
  const samples = Array.from({ length: 2 * WIDE + 1 }, (_, k) => f[(i - WIDE + k + n) % n]), inner = samples.slice(WIDE - NARROW, WIDE + NARROW + 1);
  const at = (values: number[], x: number) => through(x + (values.length - 1) / 2, values.length).reduce((sum, w, k) => sum + w * values[k], 0);
  const found = least((x) => at(samples, x), -1, 0, 1);
  if (!(Math.abs(found.value - at(inner, found.at)) <= MET * size)) return null;
  return found.value < f[i] ? { at: i + found.at, value: found.value } : { at: i, value: f[i] };
}

// Share of a signal's size within which values are equal; of the largest joint force, up to which others are rounding.
const SAME = 1e-12, ROUNDING = 1e-12;

const largest = (row: Float64Array) => row.reduce((most, x) => Math.max(most, Math.abs(x)), 0);

/** Size up to which a force, N, is but rounding beside the largest joint force. */
export function roundingOf({ main }: Model): number {
  return ROUNDING * main.program.outputs.reduce((most, name) => (name.startsWith("r:") ? Math.max(most, largest(main.row(name))) : most), 0);
}

/** The same of a force or a torque; 0 of what is none. */
function rounding(model: Model, id: string): number {
  return isForce(id) ? model.rounding * (model.signals[id].kind === "torque" ? model.size : 1) : 0;
}

/** A signal at any place among the positions; angles give or take turns near another one. */
function between({ solver, signals }: Model, id: string, place: number, near: number): number {
  const { rows, form } = signals[id], signal = signals[id];
  const value = (call: Call) => formed(signal, call.row(rows[0])[0], rows.length > 1 ? call.row(rows[1])[0] : 0);
  const x = isForce(id) ? solver.forceAt(place, value) : solver.valueAt(place, value);
  return form === "angle" ? nearest(x, near) : x;
}

/** Samples near which a value below the lowest one may lie, were it to go on as steeply as beside them, lowest first. */
function brackets(f: Float64Array, closed: boolean, lowest: number): number[] {
  const n = f.length, beside = (i: number) => (closed ? f[(i + n) % n] : (f[i] ?? Infinity)), found: number[] = [];
  f.forEach((here, i) => {
    const [a, b] = [beside(i - 1), beside(i + 1)].map((x) => x - here);
    if (a >= 0 && b >= 0 && here - Math.max(Number.isFinite(a) ? a : 0, Number.isFinite(b) ? b : 0) <= lowest) found.push(i);
  });
  return found.sort((i, j) => f[i] - f[j]).slice(0, MOST);
}

/** Positions between which and the next ones a signal may jump: neither side goes on towards the other, largest first. */
function jumps(f: Float64Array, closed: boolean, size: number): number[] {
  const n = f.length, at = (i: number) => f[(i + n) % n], found: [number, number][] = [];
  for (let i = closed ? 0 : 1; i < (closed ? n : n - 2); i++) {
    const [a, b, c, d] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
    const off = Math.min(Math.abs(2 * b - a - c), Math.abs(2 * c - d - b));
    if (off > JUMP * size) found.push([off, i]);
  }
  return found.sort(([x], [y]) => y - x).slice(0, MOST).map(([, i]) => i);
}

/** The last place before a jump between two positions, and the first one behind it: that of another signal, if most of the
 *  change is there, else always the half that changes more. */
function sides(model: Model, value: (place: number) => number, i: number, before: number, after: number): [number, number] {
  const places = (model.jumps[i] ??= []), known = places.find(([a, b]) => Math.abs(value(b) - value(a)) > 0.5 * Math.abs(after - before));
  if (known) return known;
  let [a, b, fa, fb] = [i, i + 1, before, after];
  for (let k = 0; k < HALVINGS; k++) {
    const m = 0.5 * (a + b), fm = value(m);
    if (Math.abs(fm - fa) > Math.abs(fb - fm)) [b, fb] = [m, fm];
    else [a, fa] = [m, fm];
  }
  places.push([a, b]);
  return [a, b];
}

// Samples that a polynomial goes through; their last difference, as a share of the largest square, up to which it meets the
// square; how near integrals of other stretches come, how often these are halved, and how many samples they take at most.
const SAMPLES = 6, ROUGH = 1e-5, NEAR = 1e-8, FINEST = 26, FURTHER = 4000;
const GAUSS = [-1, 0, 1].map((side) => ({ at: 0.5 + 0.5 * side * Math.sqrt(0.6), weight: side ? 5 / 18 : 8 / 18 }));
/** By the number of a step among the samples: weights of its integral. */
const STEPS = Array.from({ length: SAMPLES - 1 }, (_, step) =>
  GAUSS.map(({ at, weight }) => through(step + at, SAMPLES).map((x) => weight * x)).reduce((a, b) => a.map((x, k) => x + b[k])));
const DIFFERENCE = [1, -5, 10, -10, 5, -1];

/** Root of the mean square over the cycle: all samples alike of a smooth closed one, else the integral between them. */
function rms(model: Model, id: string, row: Float64Array): number {
  const { closed } = model.data.positions, last = row.length - 1, f = row.map((x) => x * x);
  const n = closed ? row.length : last, size = largest(f), mean = f.reduce((sum, x) => sum + x, 0) / row.length;
  if (last < SAMPLES) return Math.sqrt(mean);
  const at = (i: number) => f[(i + f.length) % f.length], dot = (weights: number[], from: number) => weights.reduce((sum, w, k) => sum + w * at(from + k), 0);
  let left = FURTHER, even = closed, total = 0;
  const value = (place: number) => (left-- > 0 ? between(model, id, place, 0) : NaN), square = (place: number) => value(place) ** 2;
  const free = searched(model, id) === null, jumping = new Set(free ? jumps(row, closed, largest(row)) : []);
  for (let i = 0; i < n; i++) {
    const from = closed ? i - 2 : Math.min(Math.max(i - 2, 0), last - SAMPLES + 1);
    if (Math.abs(dot(DIFFERENCE, from)) <= ROUGH * size) total += dot(STEPS[i - from], from);
    else {
      even = false;
      const parts = free && jumping.has(i) ? [i, ...sides(model, value, i, row[i], row[(i + 1) % n]), i + 1] : [i, i + 1];
      let sum = free ? 0 : NaN;
      for (let k = 0; k < parts.length; k += 2) sum += integral(square, parts[k], parts[k + 1], NEAR * size);
      total += Number.isFinite(sum) ? sum : 0.5 * (at(i) + at(i + 1));
    }
  }
  return Math.sqrt(even ? mean : total / n);
}

/** The integral by Simpson's rule, halved where halves say something else. */
function integral(f: (x: number) => number, a: number, b: number, near: number, depth = FINEST, fa = f(a), fm = f(0.5 * (a + b)), fb = f(b)): number {
  const m = 0.5 * (a + b), left = f(0.5 * (a + m)), right = f(0.5 * (m + b)), h = (b - a) / 6;
  const whole = h * (fa + 4 * fm + fb), halves = 0.5 * h * (fa + 4 * left + 2 * fm + 4 * right + fb);
  if (!(Math.abs(halves - whole) > near * (b - a)) || !depth) return Number.isFinite(halves) ? halves + (halves - whole) / 15 : 0.5 * (b - a) * (fa + fb);
  return integral(f, a, m, near, depth - 1, fa, left, fm) + integral(f, m, b, near, depth - 1, fm, right, fb);
}

/** What of a signal's course between the positions is not known: all where drivers are known at the positions alone, forces
 *  where loads are those of the original; null: it is known. */
function searched(model: Model, id: string): "forces" | "all" | null {
  const what = sampled(model);
  return what === "forces" && !isForce(id) ? null : what;
}

/** Of what the least and largest values are those of the positions. */
export function sampled({ data }: Model): "forces" | "all" | null {
  if (!data.positions.steady && !data.positions.breaks) return "all";
  return data.held.length ? "forces" : null;
}

/** Input from one limit position to the other over the rest of the turn, at least 1; NaN for other ways than a single one
 * to and fro. */
function ratio({ n, solver }: Model, id: string, row: Float64Array): number {
  const [, kind, owner] = /^(angle|s):(.*)$/.exec(id)!, [rate, second] = (kind === "s" ? ["sv", "sa"] : ["w", "g"]).map((each) => `${each}:${owner}`);
  const limits = events(solver.cycle, { value: (call, i) => call.row(rate)[i], rate: (call, i) => call.row(second)[i] });
  if (!returns(row) || limits.length !== 2) return NaN;
  const way = limits[1].place - limits[0].place;
  return Math.max(way, n - way) / Math.min(way, n - way);
}

/** Whether a closed row has two reversals and rests nowhere. */
function returns(row: Float64Array): boolean {
  const size = Math.max(...row) - Math.min(...row), n = row.length;
  const steps = Array.from(row, (x, i) => (Math.abs(row[(i + 1) % n] - x) <= 1e-9 * size ? 0 : Math.sign(row[(i + 1) % n] - x)));
  if (steps.some((step, i) => !step && !steps[(i + 1) % n])) return false;
  const ways = steps.filter((step) => step);
  return ways.filter((way, i) => way !== ways[(i + 1) % ways.length]).length === 2;
}

export function isForce(id: string): boolean {
  return id.startsWith("effort:") || id.startsWith("r:") || id === "shake";
}

export function formed(signal: Signal, a: number, b: number): number {
  switch (signal.form) {
    case "row": return a;
    case "size": return Math.sqrt(a * a + b * b);
    case "angle": return Math.atan2(b, a);
  }
}

// Design numbers of a machine over its cycle, between the positions as well.
import type { Figure, Signal } from "./data";
import type { Call } from "./engine";
import type { Model } from "./model";
import { root } from "./search";

export const TURN = 2 * Math.PI;

/** The value of a design number. */
export function number(model: Model, figure: Figure): number {
  const row = model.row(figure.signal);
  if (row.some(Number.isNaN)) return NaN;
  switch (figure.kind) {
    case "rms": return rms(row, model.data.positions.closed);
    case "least": return extreme(model, figure.signal, row, (x) => x);
    case "largest": return -extreme(model, figure.signal, row, (x) => -Math.abs(x));
    case "range": {
      const top = -extreme(model, figure.signal, row, (x) => -x);
      return top - extreme(model, figure.signal, row, (x) => x);
    }
    case "ratio": return ratio(model, figure.signal, row);
  }
}

/** Over a closed cycle all samples count alike, else the first and the last one half. */
function rms(row: Float64Array, closed: boolean): number {
  const last = row.length - 1, sum = row.reduce((total, x) => total + x * x, 0);
  return Math.sqrt(closed || last < 1 ? sum / row.length : (sum - 0.5 * (row[0] ** 2 + row[last] ** 2)) / last);
}

/** Least value of `of` the signal, between the positions as well. */
function extreme(model: Model, id: string, row: Float64Array, of: (x: number) => number): number {
  const signal = model.signals[id];
  let at = 0;
  for (let i = 1; i < model.n; i++) if (of(row[i]) < of(row[at])) at = i;
  if (sampled(model) === "forces" && isForce(id)) return of(row[at]);
  const value = (call: Call) => {
    const [a, b] = signal.rows.map((name) => call.row(name)[0]);
    const x = formed(signal, a, b);
    return of(signal.form === "angle" ? x + TURN * Math.round((row[at] - x) / TURN) : x);
  };
  return model.solver.refined(value, at, of(row[at])).value;
}

/** Of what the least and largest values are those of the positions: forces where friction or parts of the cycle are found
 * at the positions alone, everything without a steady drive. */
export function sampled({ main, data }: Model): "forces" | "all" | null {
  if (!data.positions.steady) return "all";
  return main.program.fields.length ? "forces" : null;
}

/** Input from one limit position to the other over the rest of the turn, at least 1; NaN for other ways than a single one
 * to and fro. */
function ratio(model: Model, id: string, row: Float64Array): number {
  if (!returns(row)) return NaN;
  let top = 0, bottom = 0;
  for (let i = 1; i < model.n; i++) {
    if (row[i] > row[top]) top = i;
    if (row[i] < row[bottom]) bottom = i;
  }
  const rate = id.startsWith("angle:") ? `w:${id.slice(6)}` : `sv:${id.slice(2)}`;
  const limits = [top, bottom].map((i) => {
    const h = Math.abs(model.data.positions.steady!.step), q = model.solver.inputs[i];
    const of = (x: number) => model.solver.valueAt(x, (call) => call.row(rate)[0]);
    const [a, b] = [of(q - h), of(q + h)];
    return a * b < 0 ? root(of, q - h, q + h, a, b) : q;
  });
  const way = (((limits[1] - limits[0]) % TURN) + TURN) % TURN;
  return Math.max(way, TURN - way) / Math.min(way, TURN - way);
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

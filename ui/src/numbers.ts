// Design numbers of a machine over its cycle, between the positions as well.
import type { Figure, Signal } from "./data";
import type { Call } from "./engine";
import type { Model } from "./model";
import { root } from "./search";

const TURN = 2 * Math.PI;

/** The value of a design number. */
export function number(model: Model, figure: Figure): number {
  const row = model.row(figure.signal);
  if (row.some(Number.isNaN)) return NaN;
  switch (figure.kind) {
    case "rms": return Math.sqrt(row.reduce((sum, x) => sum + x * x, 0) / model.n);
    case "least": return extreme(model, figure.signal, row, (x) => x);
    case "largest": return -extreme(model, figure.signal, row, (x) => -Math.abs(x));
    case "range": {
      const top = -extreme(model, figure.signal, row, (x) => -x);
      return top - extreme(model, figure.signal, row, (x) => x);
    }
    case "ratio": return ratio(model, figure.signal, row);
  }
}

/** Least value of `of` the signal, between the positions as well. */
function extreme(model: Model, id: string, row: Float64Array, of: (x: number) => number): number {
  const signal = model.signals[id];
  let at = 0;
  for (let i = 1; i < model.n; i++) if (of(row[i]) < of(row[at])) at = i;
  if (isForce(id) && model.main.program.fields.length) return of(row[at]);
  const value = (call: Call) => {
    const [a, b] = signal.rows.map((name) => call.row(name)[0]);
    const x = formed(signal, a, b);
    return of(signal.form === "angle" ? x + TURN * Math.round((row[at] - x) / TURN) : x);
  };
  return model.solver.refined(value, at, of(row[at])).value;
}

/** Input from one limit position to the other over the rest of the turn, at least 1. */
function ratio(model: Model, id: string, row: Float64Array): number {
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

// What the time line runs over: the input of a prescribed motion, the time of a run under forces.
import { floats } from "../../data";
import type { Session } from "../../session";
import { quantity } from "../../words";
import { course, ticksOf, typed } from "./timeline";

const DEGREE = Math.PI / 180;

export interface Axis {
  /** Along the track, SI. */
  values: Float64Array;
  /** Whether it is an angle, of which whole turns are the same. */
  turns: boolean;
  labels: { share: number; text: string }[];
  /** A value as it is read. */
  shown: (x: number) => string;
  /** A typed value, null where it is none. */
  typed: (text: string) => number | null;
  /** Keys of what is said of the field, and of a value that is none or not there. */
  says: { label: string; wrong: string; never: string };
}

const neat = (x: number) => (Math.abs(x) < 5e-10 ? 0 : x);
const angle = (x: number) => `${neat(x / DEGREE).toFixed(1).replace("-", "−")}°`;

/** A coordinate of the input as it is read. */
export const shown = (x: number, turns: boolean, size: number) => (turns ? angle(x) : quantity(neat(x), "length", size));
export const tick = (x: number, turns: boolean, size: number) => (turns ? `${String(Math.round(10 * neat(x / DEGREE)) / 10).replace("-", "−")}°` : quantity(neat(x), "length", size, 3));

export function axisOf(session: Session): Axis {
  const { positions } = session.data;
  return positions.run && positions.time ? timeAxis(floats(positions.time)) : inputAxis(session, positions.inputs[0]?.turns ?? true);
}

function inputAxis(session: Session, turns: boolean): Axis {
  const values = course(session), size = Math.max(...values.map(Math.abs)) || 1;
  return {
    values, turns, labels: ticksOf(values, turns).map(({ share, value }) => ({ share, text: tick(value, turns, size) })), shown: (x) => shown(x, turns, size),
    typed: (text) => typed(text, turns), says: { label: "dock.input", wrong: "dock.no_input", never: "dock.not_reached" },
  };
}

function timeAxis(values: Float64Array): Axis {
  const end = values[values.length - 1], places = Math.max(0, 3 - Math.floor(Math.log10(end) + 1));
  const labels = ticksOf(values, false).map(({ share, value }) => ({ share, text: quantity(value, "time", 1, 4) }));
  return {
    values, turns: false, labels, shown: (x) => `${x.toFixed(places)} s`, typed: seconds, says: { label: "dock.moment", wrong: "dock.no_moment", never: "dock.after_run" },
  };
}

/** A typed time, s. */
function seconds(text: string): number | null {
  const [, number, unit] = /^\s*([\d.,]+)\s*(ms|s|min)?\s*$/.exec(text) ?? [], value = Number(number?.replace(",", ".")) * { ms: 1e-3, s: 1, min: 60 }[unit ?? "s"]!;
  return Number.isFinite(value) ? value : null;
}

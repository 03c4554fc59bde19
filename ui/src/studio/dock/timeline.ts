// The track of the time line: where its ticks stand, when loads act, where the machine cannot be. Places on it are shares
// of its length, from 0 to 1.
import type { ModelData } from "../../data";
import type { Session } from "../../session";

export interface Tick {
  share: number;
  value: number;
}

export interface Stretch {
  from: number;
  to: number;
}

const DEGREE = Math.PI / 180;
// Steps of ticks in degrees; the most pieces that ticks make; what a tick keeps off the ends of the track.
const STEPS = [5, 10, 15, 30, 45, 60, 90, 180, 360, 720, 1440], PIECES = 5, CLEAR = 0.11;

/** Steps of 1, 2 and 5 that make at most `PIECES` pieces of a range. */
function decimal(range: number): number {
  const power = 10 ** Math.floor(Math.log10(range / PIECES));
  return power * ([1, 2, 5, 10].find((each) => each * power * PIECES >= range * (1 - 1e-9)) ?? 10);
}

/** Ticks of a track from a to b, in turns of neat angles or lengths: both ends, and what lies clear of them. */
export function ticks(a: number, b: number, turns: boolean): Tick[] {
  const range = Math.abs(b - a), ends = [{ share: 0, value: a }, { share: 1, value: b }];
  if (!(range > 0) || !Number.isFinite(range)) return [ends[0]];
  const unit = turns ? DEGREE : 1, step = unit * (turns ? (STEPS.find((each) => each * PIECES >= (range / unit) * (1 - 1e-9)) ?? decimal(range / unit)) : decimal(range));
  const first = Math.ceil(Math.min(a, b) / step - 1e-9), last = Math.floor(Math.max(a, b) / step + 1e-9), inner: Tick[] = [];
  for (let k = first; k <= last; k++) {
    const share = (k * step - a) / (b - a);
    if (share > CLEAR && share < 1 - CLEAR) inner.push({ share, value: k * step });
  }
  return [ends[0], ...inner.sort((p, q) => p.share - q.share), ends[1]];
}

/** Whether values go one way only. */
export function oneWay(values: ArrayLike<number>): boolean {
  const way = Math.sign(values[values.length - 1] - values[0]);
  for (let i = 1; i < values.length; i++) if (Math.sign(values[i] - values[i - 1]) !== way) return false;
  return way !== 0;
}

/** Coordinates of the input along the track, with the end of a cycle that closes. */
export function course(session: Session): Float64Array {
  const { inputs } = session.model.solver, { closed, drift } = session.data.positions;
  return closed && inputs.length > 1 ? Float64Array.of(...inputs, inputs[0] + (oneWay(inputs) ? drift : 0)) : inputs;
}

/** Ticks of a course: in neat values where it goes one way, else at quarters with what the input is there. */
export function ticksOf(values: ArrayLike<number>, turns: boolean): Tick[] {
  if (oneWay(values)) return ticks(values[0], values[values.length - 1], turns);
  const last = values.length - 1;
  return [0, 0.25, 0.5, 0.75, 1].map((share) => ({ share, value: values[Math.round(share * last)] }));
}

/** Where a row of zeros and ones is one; of a cycle that closes the last position reaches to the end of the track. */
export function stretches(row: ArrayLike<number>, count: number, closed: boolean): Stretch[] {
  const found: Stretch[] = [], last = closed ? count : count - 1;
  let begin = -1;
  for (let i = 0; i <= count; i++) {
    const on = i < count && row[i] > 0.5;
    if (on && begin < 0) begin = i;
    if (on || begin < 0) continue;
    found.push({ from: begin / last, to: Math.min(1, (closed ? i : i - 1) / last) });
    begin = -1;
  }
  return found;
}

/** The loads that act in a part of the cycle only, with when they do. */
export function phases(session: Session): { load: string; stretches: Stretch[] }[] {
  const { main } = session.model, { count, closed } = session.data.positions;
  return session.data.phases.flatMap(({ load }) => {
    const row = main.fields[`acts:${load}`];
    return row ? [{ load, stretches: stretches(row, count, closed) }] : [];
  });
}

/** Where an output reverses at the ends of its way. */
export interface Limit {
  share: number;
  name: string;
  max: boolean;
}

/** The limits of the last output of the machine that goes to and fro. */
export function limits(session: Session): Limit[] {
  const { model, data } = session, { count, closed } = data.positions, figure = data.numbers.findLast(({ kind }) => kind === "range");
  if (!figure || count < 3) return [];
  const row = model.row(figure.signal), name = figure.signal.replace(/^\w+:/, "");
  if (row.some(Number.isNaN)) return [];
  return ([-1, 1] as const).map((sign) => ({ share: model.extreme(figure.signal, row, sign).at / (closed ? count : count - 1), name, max: sign < 0 }));
}

/** The parts of a track from `low` to `high` between which intervals lie. */
export function outside(intervals: readonly [number, number][], low: number, high: number): Stretch[] {
  const share = (x: number) => (x - low) / (high - low), found: Stretch[] = [];
  let reached = 0;
  for (const [a, b] of [...intervals].sort(([p], [q]) => p - q)) {
    const [from, to] = [share(a), share(b)].map((x) => Math.min(1, Math.max(0, x)));
    if (from > reached) found.push({ from: reached, to: from });
    reached = Math.max(reached, to);
  }
  if (reached < 1) found.push({ from: reached, to: 1 });
  return found;
}

/** The phase at which the input has a value, nearest to the present phase; null where it never has. */
export function phaseOf(values: ArrayLike<number>, value: number, turns: boolean, now: number): number | null {
  const last = values.length - 1, found: number[] = [];
  const wanted = turns ? [-2, -1, 0, 1, 2].map((k) => value + k * 2 * Math.PI) : [value];
  for (const each of wanted)
    for (let i = 0; i < last; i++) {
      const [a, b] = [values[i], values[i + 1]], slack = 1e-9 * (Math.abs(b - a) + 1e-9);
      if (each < Math.min(a, b) - slack || each > Math.max(a, b) + slack) continue;
      found.push((i + (b === a ? 0 : Math.min(1, Math.max(0, (each - a) / (b - a))))) / last);
    }
  return found.sort((p, q) => Math.abs(p - now) - Math.abs(q - now))[0] ?? null;
}

const UNITS: Record<string, number> = { "": NaN, "°": DEGREE, deg: DEGREE, rad: 1, mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254 };

/** A typed coordinate in SI; null where it cannot be read. */
export function typed(text: string, turns: boolean): number | null {
  const [, number, unit] = /^\s*([-−+]?[\d.,]+)\s*(\p{L}*|°)\s*$/u.exec(text) ?? [], factor = unit ? UNITS[unit] : turns ? DEGREE : 1e-3;
  const value = Number(number?.replace("−", "-").replace(",", ".")) * factor, own = turns ? ["", "°", "deg", "rad"] : ["", "mm", "cm", "m", "in"];
  return own.includes(unit) && Number.isFinite(value) ? value : null;
}

/** Turns of the driver per minute where it turns steadily, else the seconds of a cycle. */
export function pace({ positions }: ModelData): { rpm: number | null; seconds: number | null } {
  const { steady, period } = positions;
  const seconds = period ?? (steady ? Math.abs((positions.count * steady.step) / steady.speed) : null);
  return { rpm: steady?.turns ? (Math.abs(steady.speed) * 30) / Math.PI : null, seconds };
}

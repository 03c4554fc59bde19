// What loads take per position once the motion is known: when they act, and angles of links that turn through.
import type { AngleField, Phase } from "./data";
import type { Call } from "./engine";
import { TURN } from "./numbers";
import { root } from "./search";

/** Where an output reverses: input, time, its value there. */
interface Limit {
  input: number;
  time: number;
  value: number;
  max: boolean;
}

/** From a limit to the next one; times and inputs go on through the cycle's end. */
interface Stretch {
  begin: Limit;
  end: Limit;
}

/** A cycle: times and inputs per position, the place of an input between positions, how far both go in it. */
export interface Course {
  time: (i: number) => number;
  inputs: Float64Array;
  closed: boolean;
  period: number;
  drift: number;
  at(input: number, value: (call: Call) => number): number;
}

// As in the core: shares within which places belong to a phase, rates that are zero but for rounding.
const NEAR = 1e-9, STILL = 1e-12;

/** Writes the phases and angles of loads into a call that has run; false where a phase does not exist. */
export function follow(call: Call, phases: Phase[], angles: AngleField[], values: Record<string, number>, course: Course): boolean {
  for (const { field, a, b, near } of angles) put(call, field, between(call, a, b, near && (values[near[0]] ?? near[1])));
  return phases.every((phase) => {
    const { acts, share } = new Acting(call, phase, course).found();
    put(call, `acts:${phase.load}`, acts);
    put(call, `share:${phase.load}`, share);
    return acts.every((x) => x === x);
  });
}

/** Beyond the last position a program repeats it. */
function put(call: Call, field: string, row: Float64Array): void {
  call.fields[field]?.forEach((_, i, of) => (of[i] = row[Math.min(i, call.n - 1)]));
}

function between(call: Call, a: string, b: string, near: number | null): Float64Array {
  const direction = (link: string, i: number) => (call.has(`e:${link}.x`) ? Math.atan2(call.row(`e:${link}.y`)[i], call.row(`e:${link}.x`)[i]) : 0);
  const row = Float64Array.from({ length: call.n }, (_, i) => direction(b, i) - direction(a, i));
  if (near !== null) row[0] += TURN * Math.round((near - row[0]) / TURN);
  return unwrap(row);
}

export function unwrap(row: Float64Array): Float64Array {
  for (let i = 1; i < row.length; i++) row[i] += TURN * Math.round((row[i - 1] - row[i]) / TURN);
  return row;
}

class Acting {
  private readonly rate: Float64Array;
  private readonly value: Float64Array;

  constructor(private readonly call: Call, private readonly phase: Phase, private readonly course: Course) {
    const still = STILL * call.row(phase.rate).reduce((most, x) => Math.max(most, Math.abs(x)), 0);
    this.rate = call.row(phase.rate).map((x) => (Math.abs(x) <= still ? 0 : x));
    this.value = Float64Array.from({ length: call.n }, (_, i) => this.read(call, i));
    if (this.angular) unwrap(this.value);
  }

  private get angular(): boolean {
    return this.phase.rows.length > 1;
  }

  private read(call: Call, i: number): number {
    const [a, b] = this.phase.rows.map((name) => call.row(name)[i]);
    return this.angular ? Math.atan2(b, a) : a;
  }

  found(): { acts: Float64Array; share: Float64Array } {
    const { call, rate } = this, { moving, ramp, ends } = this.phase, empty = () => new Float64Array(call.n);
    const rising = ends[1] === "max";
    const sign = (x: number) => (rising ? x > 0 : x < 0);
    if (moving && !ramp) return { acts: rate.map((x) => Number(sign(x))), share: empty() };
    // Backwards through the positions their times fall, and limits do not come one after the other.
    if (!(this.course.period > 0)) return { acts: empty().fill(NaN), share: empty() };
    const limits = this.limits(), stretches = this.stretches(moving ? limits : outermost(limits));
    const [acts, share] = [empty(), empty()];
    if (!stretches.length) return { acts: acts.fill(NaN), share };
    for (const stretch of stretches) {
      const part = this.part(stretch);
      if (!part) return { acts: acts.fill(NaN), share };
      for (let i = 0; i < call.n; i++) {
        const gained = this.gained(stretch, i);
        if (gained === null || (moving && !sign(rate[i]))) continue;
        const passed = part(i) ?? gained / (stretch.end.input - stretch.begin.input);
        if (passed === OUTSIDE) continue;
        [acts[i], share[i]] = [1, Math.min(1, Math.max(0, passed))];
      }
    }
    return { acts, share };
  }

  /** What the input has gained at a position since a stretch began; null outside it. */
  private gained({ begin, end }: Stretch, i: number): number | null {
    const { period, drift, time, inputs } = this.course, slack = NEAR * period, since = time(i) - begin.time;
    const laps = Math.floor((since + slack) / period), inside = since - laps * period;
    return inside <= end.time - begin.time + slack ? inputs[i] - begin.input - laps * drift : null;
  }

  /** The share of a part of a stroke that the output has passed; undefined where there is no part, null for a part
   *  that the stroke is too short for. */
  private part({ begin, end }: Stretch): ((i: number) => number | undefined) | null {
    const { part } = this.phase, size = Math.abs(end.value - begin.value), slack = NEAR * size;
    if (!part) return () => undefined;
    const ways = part.amounts.map(([value, share]) => value * (share ? size : 1)), last = ways[ways.length - 1];
    const [from, to] = part.word === "first" ? [0, ways[0]] : part.word === "last" ? [size - ways[0], size] : [ways[0], size - last];
    if (!(from >= -slack && from < to && to <= size + slack)) return null;
    return (i) => {
      let gone = (this.value[i] - begin.value) * Math.sign(end.value - begin.value);
      if (this.angular && size < TURN) gone -= TURN * Math.floor((gone + (TURN - size) / 2) / TURN);
      return gone >= from - slack && gone <= to + slack ? (gone - from) / (to - from) : OUTSIDE;
    };
  }

  /** Where the rate passes zero, by increasing time. */
  private limits(): Limit[] {
    const { rate, course, call } = this, { n } = call, { inputs, drift, period } = course, found: Limit[] = [];
    const first = rate.findIndex((x) => x !== 0);
    const input = (i: number) => inputs[i % n] + Math.floor(i / n) * drift;
    for (let k = first + 1, last = first; first >= 0 && k <= first + n; k++) {
      const [a, b] = [rate[last % n], rate[k % n]];
      if (b === 0) continue;
      if (a * b < 0) {
        const of = (x: number) => course.at(x, (one) => one.row(this.phase.rate)[0]);
        const x = root(of, input(last), input(k), a, b), laps = x - inputs[0] >= Math.abs(drift) || inputs[0] - x >= Math.abs(drift) ? 1 : 0;
        let value = course.at(x, (one) => this.read(one, 0));
        if (this.angular) value += TURN * Math.round((this.value[last % n] - value) / TURN);
        const time = course.time(0) + ((x - inputs[0]) / drift) * period;
        found.push({ input: x - laps * drift, time: time - laps * period, value, max: a > 0 });
      }
      last = k;
    }
    return found.sort((a, b) => a.time - b.time);
  }

  /** From each limit of one kind to the other kind's next one. */
  private stretches(limits: Limit[]): Stretch[] {
    const { ends } = this.phase, { period, drift } = this.course, found: Stretch[] = [];
    limits.forEach((end, k) => {
      const before = limits.at(k - 1)!;
      if (before.max !== (ends[0] === "max") || end.max !== (ends[1] === "max")) return;
      found.push({ begin: k ? before : { ...before, time: before.time - period, input: before.input - drift }, end });
    });
    return found;
  }
}

const OUTSIDE = -Infinity;

/** Of all reversals those with the largest and the smallest value. */
function outermost(limits: Limit[]): Limit[] {
  const values = limits.map(({ value }) => value), slack = NEAR * (Math.max(...values) - Math.min(...values));
  const top = Math.max(...limits.filter(({ max }) => max).map(({ value }) => value)) - slack;
  const bottom = Math.min(...limits.filter(({ max }) => !max).map(({ value }) => value)) + slack;
  return limits.filter(({ max, value }) => (max ? value >= top : value <= bottom));
}

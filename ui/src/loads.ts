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

/** What loads take at a place between positions, by the names of fields. */
export type Between = (one: Call, input: number, near: number) => Record<string, number>;

/** Writes the phases and angles of loads into a call that has run; null where a phase does not exist, else how they go on
 *  between the positions. */
export function follow(call: Call, phases: Phase[], angles: AngleField[], values: Record<string, number>, course: Course): Between | null {
  const rows = angles.map(({ field, a, b, near }) => {
    const row = between(call, a, b, near && (values[near[0]] ?? near[1]));
    put(call, field, row);
    return row;
  });
  const acting = phases.map((phase) => new Acting(call, phase, course));
  if (!acting.map((each) => each.give()).every((exists) => exists)) return null;
  return (one, input, near) => {
    const found: Record<string, number> = {};
    angles.forEach(({ field, a, b }, k) => (found[field] = nearest(turned(one, a, b, 0), rows[k][near])));
    for (const each of acting) Object.assign(found, each.between(one, input, near));
    return found;
  };
}

/** Beyond the last position a program repeats it. */
function put(call: Call, field: string, row: Float64Array): void {
  call.fields[field]?.forEach((_, i, of) => (of[i] = row[Math.min(i, call.n - 1)]));
}

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

/** A stretch with the share of a part of its way that a value of the output has passed. */
type Way = { stretch: Stretch; part: (value: number) => number | undefined };

class Acting {
  private readonly rate: Float64Array;
  private readonly value: Float64Array;
  private readonly still: number;
  private readonly ways: Way[] | null;

  constructor(private readonly call: Call, private readonly phase: Phase, private readonly course: Course) {
    this.still = STILL * call.row(phase.rate).reduce((most, x) => Math.max(most, Math.abs(x)), 0);
    this.rate = call.row(phase.rate).map((x) => this.moving(x));
    this.value = Float64Array.from({ length: call.n }, (_, i) => this.read(call, i));
    if (this.angular) unwrap(this.value);
    this.ways = this.found();
  }

  private moving(rate: number): number {
    return Math.abs(rate) <= this.still ? 0 : rate;
  }

  private get angular(): boolean {
    return this.phase.rows.length > 1;
  }

  private read(call: Call, i: number): number {
    const [a, b] = this.phase.rows.map((name) => call.row(name)[i]);
    return this.angular ? Math.atan2(b, a) : a;
  }

  /** Writes it into the call; false where the phase does not exist. */
  give(): boolean {
    const { call, course, phase } = this, n = call.n, acts = new Float64Array(n), share = new Float64Array(n);
    if (this.ways) for (let i = 0; i < n; i++) [acts[i], share[i]] = this.passed(course.time(i), course.inputs[i], this.rate[i], this.value[i]);
    else acts.fill(NaN);
    put(call, `acts:${phase.load}`, acts);
    put(call, `share:${phase.load}`, share);
    return this.ways !== null;
  }

  /** The same at a place near a position, of a call that has run there. */
  between(one: Call, input: number, near: number): Record<string, number> {
    const { phase, course } = this, time = course.time(0) + ((input - course.inputs[0]) / course.drift) * course.period;
    const value = this.angular ? nearest(this.read(one, 0), this.value[near]) : this.read(one, 0);
    const [acts, share] = this.passed(time, input, this.moving(one.row(phase.rate)[0]), value);
    return { [`acts:${phase.load}`]: acts, [`share:${phase.load}`]: share };
  }

  /** Whether the load acts at a place, and the share of its phase that is passed. */
  private passed(time: number, input: number, rate: number, value: number): [number, number] {
    const { moving, ramp, ends } = this.phase, along = ends[1] === "max" ? rate > 0 : rate < 0;
    if (moving && !(ramp && along)) return [Number(along && !ramp), 0];
    for (const { stretch, part } of this.ways!) {
      const gained = this.gained(stretch, time, input);
      const passed = gained === null ? OUTSIDE : (part(value) ?? gained / (stretch.end.input - stretch.begin.input));
      if (passed !== OUTSIDE) return [1, Math.min(1, Math.max(0, passed))];
    }
    return [0, 0];
  }

  /** Where it acts, as far as that is not said by the rate alone; null where there is none. */
  private found(): Way[] | null {
    const { moving, ramp } = this.phase, ways: Way[] = [];
    if (moving && !ramp) return ways;
    // Backwards through the positions their times fall, and limits do not come one after the other.
    if (!(this.course.period > 0)) return null;
    const limits = this.limits();
    for (const stretch of this.stretches(moving ? limits : outermost(limits))) {
      const part = this.part(stretch);
      if (!part) return null;
      ways.push({ stretch, part });
    }
    return ways.length ? ways : null;
  }

  /** What the input has gained at a place since a stretch began; null outside it. */
  private gained({ begin, end }: Stretch, time: number, input: number): number | null {
    const { period, drift } = this.course, slack = NEAR * period, since = time - begin.time;
    const laps = Math.floor((since + slack) / period), inside = since - laps * period;
    return inside <= end.time - begin.time + slack ? input - begin.input - laps * drift : null;
  }

  /** The share of a part of a stroke that the output has passed; undefined where there is no part, null for a part
   *  that the stroke is too short for. */
  private part({ begin, end }: Stretch): ((value: number) => number | undefined) | null {
    const { part } = this.phase, size = Math.abs(end.value - begin.value), slack = NEAR * size;
    if (!part) return () => undefined;
    const ways = part.amounts.map(([value, share]) => value * (share ? size : 1)), last = ways[ways.length - 1];
    const [from, to] = part.word === "first" ? [0, ways[0]] : part.word === "last" ? [size - ways[0], size] : [ways[0], size - last];
    if (!(from >= -slack && from < to && to <= size + slack)) return null;
    return (value) => {
      let gone = (value - begin.value) * Math.sign(end.value - begin.value);
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
        if (this.angular) value = nearest(value, this.value[last % n]);
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

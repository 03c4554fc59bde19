// Events over the cycle: places where a signal passes zero, on the pieces between positions. A place is a number among the
// positions, of which the first is 0.
import type { Bends } from "./data";
import type { Call } from "./engine";
import { zero } from "./search";

/** A machine solved over its cycle. */
export interface Cycle {
  /** A call that has run at the positions. */
  main: Call;
  closed: boolean;
  /** Time from one position to the next, s; below zero where the positions go backwards. */
  pace: number;
  /** The first driver: whether it turns, its coordinate at a place within the cycle, what that gains in a closed one. */
  turns: boolean;
  input: (place: number) => number;
  drift: number;
  /** A call that has run at a place; null where the drivers are not known there. */
  at: (place: number) => Call | null;
  /** Places where drivers and cams go over to another formula. */
  corners: number[];
}

/** A number by a call that has run at a place, there for position i of its own; the position near the place. */
export type Reading = (call: Call, i: number, place: number, near: number) => number;

/** What events are of: a value, its rate in time, and where it rests at zero. */
export interface Signal {
  value: Reading;
  rate: Reading;
  rests?: Reading;
}

/** Where a signal passes zero; whether it grows there with the place. */
export interface Event {
  place: number;
  grows: boolean;
}

// Looks at the cubic of a piece; a least value, as a share of the smaller end, from which on it may be a dip below zero.
const LOOKS = 32, DIP = 0.5;
// Halvings of a piece; how near a corner is to a position on it.
const HALVINGS = 60, HERE = 1e-9;
const NONE: Event[] = [];

/** All events of a signal, by growing place; of a rest at zero between unlike signs the middle. */
export function events(cycle: Cycle, signal: Signal): Event[] {
  const pieces = new Pieces(cycle, signal), found: Event[] = [], { closed } = cycle, { n } = cycle.main;
  let first = 0;
  while (first < n && pieces.resting[first]) first++;
  for (let i = first, j = first + 1; j < n || (closed && j <= first + n && first < n); j++) {
    if (pieces.resting[j % n]) continue;
    const a = pieces.values[i % n], b = pieces.values[j % n];
    if (a < 0 !== b < 0) found.push({ place: pieces.crossing(i, j), grows: b > 0 });
    else if (j === i + 1) found.push(...pieces.dip(i % n));
    i = j;
  }
  if (closed) for (const each of found) each.place = modulo(each.place, n);
  return found.sort((a, b) => a.place - b.place);
}

export const modulo = (x: number, by: number) => x - by * Math.floor(x / by);

/** Where laws of drivers go over to another formula, at the `breaks`, and cams: where the angle to their carriers is one of
 *  their bends. */
export function corners(cycle: Cycle, breaks: number[], bends: Bends[], values: Record<string, number>): number[] {
  const ofCams = bends.flatMap(({ link, carrier, phase, angles }) => {
    const beyond = values[phase[0]] ?? phase[1], turning: Reading = (call, i) => heading(call, link, i) - heading(call, carrier, i) - beyond;
    return angles.flatMap((angle) => turns(cycle, (...where) => turning(...where) - angle, (call, i) => spin(call, link, i) - spin(call, carrier, i)));
  });
  return [...breaks, ...ofCams];
}

const heading = (call: Call, link: string, i: number) => (call.has(`e:${link}.x`) ? Math.atan2(call.row(`e:${link}.y`)[i], call.row(`e:${link}.x`)[i]) : 0);
const spin = (call: Call, link: string, i: number) => (call.has(`w:${link}`) ? call.row(`w:${link}`)[i] : 0);

/** Places where an angle is a whole number of turns. */
function turns(cycle: Cycle, angle: Reading, rate: Reading): number[] {
  const found = events(cycle, { value: (...where) => Math.sin(angle(...where)), rate: (...where) => Math.cos(angle(...where)) * rate(...where) });
  return found.map(({ place }) => place).filter((place) => {
    const one = cycle.at(place);
    return one !== null && Math.cos(angle(one, 0, place, 0)) > 0;
  });
}

/** A signal at the positions, and its course between them by cubics, of which it is asked itself at last. */
class Pieces {
  readonly values: Float64Array;
  readonly resting: Uint8Array;
  private readonly slopes: Float64Array;

  constructor(private readonly cycle: Cycle, private readonly signal: Signal) {
    const { main, pace } = cycle, { n } = main;
    [this.values, this.slopes, this.resting] = [new Float64Array(n), new Float64Array(n), new Uint8Array(n)];
    for (let i = 0; i < n; i++) {
      this.values[i] = signal.value(main, i, i, i);
      this.slopes[i] = pace * signal.rate(main, i, i, i);
      if (signal.rests) this.resting[i] = Number(signal.rests(main, i, i, i) === 0);
    }
  }

  /** Value and slope (per position) at a place; not numbers where the drivers are not known. */
  private at = (place: number): [value: number, slope: number] => {
    const { cycle, signal } = this, one = cycle.at(place), { n } = cycle.main, near = Math.min(n - 1, Math.round(modulo(place, n)));
    return one ? [signal.value(one, 0, place, near), cycle.pace * signal.rate(one, 0, place, near)] : [NaN, NaN];
  };

  private rests(place: number): boolean {
    const one = this.cycle.at(place);
    return one !== null && this.signal.rests?.(one, 0, place, 0) === 0;
  }

  /** Where it passes zero between two positions, among which there may be a rest. */
  crossing(i: number, j: number): number {
    const n = this.values.length;
    // A position on the event itself has a slope, a rest has none.
    let rest = j - i > 2;
    for (let k = i + 1; k < j; k++) rest ||= this.slopes[k % n] === 0;
    return rest ? 0.5 * (this.edge(i + 1, i) + this.edge(j - 1, j)) : zero(this.at, i, j, this.values[i], this.values[j % n]);
  }

  /** Where a rest ends between a position in it and one where the signal moves: at a corner, if there is one. */
  private edge(resting: number, moving: number): number {
    const { n } = this.cycle.main, low = Math.min(resting, moving) - HERE;
    for (let k = 0; k < HALVINGS; k++) {
      const middle = 0.5 * (resting + moving);
      if (this.rests(middle)) resting = middle;
      else moving = middle;
    }
    const near = this.cycle.corners.map((x) => low + modulo(x - low, n)).filter((x) => x <= low + 1 + 2 * HERE);
    return near.sort((a, b) => Math.abs(a - resting) - Math.abs(b - resting))[0] ?? resting;
  }

  /** The two events between neighbours of one sign, if the cubic through both comes near zero and the signal passes it. */
  dip(i: number): Event[] {
    const { values, slopes } = this, j = (i + 1) % values.length, sign = values[i] < 0 ? -1 : 1;
    if (!(sign * slopes[i] < 0 && sign * slopes[j] > 0)) return NONE;
    const [a, b, da, db] = [values[i], values[j], slopes[i], slopes[j]].map((x) => sign * x);
    let lowest = a, where = 0;
    for (let k = 1; k < LOOKS; k++) {
      const u = k / LOOKS, v = 1 - u, y = v * v * ((1 + 2 * u) * a + u * da) + u * u * ((1 + 2 * v) * b - v * db);
      if (y < lowest) [lowest, where] = [y, u];
    }
    if (!(lowest < DIP * Math.min(a, b))) return NONE;
    const turn = this.turn(i, i + where, sign), bottom = this.at(turn)[0];
    if (!(sign * bottom < 0) || this.rests(turn)) return NONE;
    return [
      { place: zero(this.at, i, turn, values[i], bottom), grows: sign < 0 },
      { place: zero(this.at, turn, i + 1, bottom, values[j]), grows: sign > 0 },
    ];
  }

  /** Where the slope is zero between a position and the next one. */
  private turn(i: number, x: number, sign: number): number {
    for (let k = 0, low = i, high = i + 1; k < HALVINGS; k++, x = 0.5 * (low + high))
      if (sign * this.at(x)[1] < 0) low = x;
      else high = x;
    return x;
  }
}

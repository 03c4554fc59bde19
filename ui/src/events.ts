// Events over the cycle: places where a signal passes zero, on the pieces between positions. A place is a number among the
// positions, of which the first is 0.

/** A signal over the cycle: values and slopes (per position) at the positions and at any place, and what is zero but for
 *  rounding. */
export interface Course {
  values: ArrayLike<number>;
  slopes: ArrayLike<number>;
  closed: boolean;
  at: (place: number) => [value: number, slope: number];
  rests: (place: number) => boolean;
}

/** Where a signal passes zero; whether it grows there with the place. */
export interface Event {
  place: number;
  grows: boolean;
}

// Looks at the cubic of a piece; a least value, as a share of the smaller end, from which on it may be a dip below zero.
const LOOKS = 32, DIP = 0.5;
// Steps of a search, the width of a bracket that ends it, as a share of the place, and the last step of Newton's method.
const STEPS = 80, MET = 4e-16, LAST = 1e-8;
const NONE: Event[] = [];

/** All events of a signal, by growing place; of a rest at zero between unlike signs the middle. */
export function events(course: Course): Event[] {
  const { values, closed } = course, n = values.length, found: Event[] = [];
  let first = 0;
  while (first < n && course.rests(first)) first++;
  for (let i = first, j = first + 1; j < n || (closed && j <= first + n && first < n); j++) {
    if (course.rests(j % n)) continue;
    const a = values[i % n], b = values[j % n];
    if (a < 0 !== b < 0) found.push({ place: crossing(course, i, j), grows: b > 0 });
    else if (j === i + 1) found.push(...dip(course, i % n));
    i = j;
  }
  if (closed) for (const each of found) each.place = modulo(each.place, n);
  return found.sort((a, b) => a.place - b.place);
}

export const modulo = (x: number, by: number) => x - by * Math.floor(x / by);

/** Where a signal passes zero between two positions, among which there may be a rest. */
function crossing(course: Course, i: number, j: number): number {
  const n = course.values.length, still = Array.from({ length: j - i - 1 }, (_, k) => i + 1 + k);
  // A position on the event itself has a slope, a rest has none.
  const rest = still.length > 1 || still.some((k) => course.slopes[k % n] === 0);
  if (!rest) return zero(course.at, i, j, course.values[i], course.values[j % n]);
  return 0.5 * (edge(course, j - 1, j) + edge(course, i + 1, i));
}

/** Where a rest ends between a place in it and one where the signal moves. */
function edge(course: Course, resting: number, moving: number): number {
  for (let k = 0; k < STEPS && Math.abs(moving - resting) > MET * Math.abs(moving); k++) {
    const middle = 0.5 * (resting + moving);
    if (course.rests(middle)) resting = middle;
    else moving = middle;
  }
  return resting;
}

/** The two events between neighbours of one sign, if the cubic through both comes near zero and the signal passes it. */
function dip(course: Course, i: number): Event[] {
  const { values, slopes, at } = course, j = (i + 1) % values.length, sign = values[i] < 0 ? -1 : 1;
  if (!(sign * slopes[i] < 0 && sign * slopes[j] > 0)) return NONE;
  const [a, b, da, db] = [values[i], values[j], slopes[i], slopes[j]].map((x) => sign * x);
  let lowest = a, where = 0;
  for (let k = 1; k < LOOKS; k++) {
    const u = k / LOOKS, v = 1 - u, y = v * v * ((1 + 2 * u) * a + u * da) + u * u * ((1 + 2 * v) * b - v * db);
    if (y < lowest) [lowest, where] = [y, u];
  }
  if (!(lowest < DIP * Math.min(a, b))) return NONE;
  const turn = least((place) => sign * at(place)[1], i, i + 1, i + where), bottom = at(turn)[0];
  if (!(sign * bottom < 0) || course.rests(turn)) return NONE;
  return [
    { place: zero(at, i, turn, values[i], bottom), grows: sign < 0 },
    { place: zero(at, turn, i + 1, bottom, values[j]), grows: sign > 0 },
  ];
}

/** Where a slope that grows through zero between two places is zero. */
function least(slope: (place: number) => number, low: number, high: number, x: number): number {
  for (let k = 0; k < STEPS && high - low > MET * high; k++, x = 0.5 * (low + high))
    if (slope(x) < 0) low = x;
    else high = x;
  return x;
}

/** Where a signal of unlike signs at two places is zero: Newton's steps with its slope, halvings where these leave them. */
export function zero(at: (place: number) => [number, number], low: number, high: number, a: number, b: number): number {
  let x = low + (high - low) * (a / (a - b));
  for (let k = 0; k < STEPS; k++) {
    const [value, slope] = at(x), step = value / slope;
    if (value === 0 || Math.abs(step) <= LAST) return value === 0 ? x : x - step;
    if (value < 0 === a < 0) low = x;
    else high = x;
    if (high - low <= MET * Math.abs(high)) break;
    const next = x - step;
    x = next >= low && next <= high ? next : 0.5 * (low + high);
  }
  return x;
}

// The drivers between the positions of a cycle; a place is a number among positions, of which the first is 0.
import { floats, type ModelData } from "./data";

// Positions that a polynomial goes through, and how many of them it takes at least; how near a position may be to where
// a law goes over, in positions.
const MOST = 8, FEWEST = 5, NEAR = 1e-6;

/** Drivers whose laws are not steady: polynomials through positions within a piece of all laws. */
export class Drive {
  private readonly rows: [string, Float64Array][];
  private readonly turns: [string, Float64Array][];
  private readonly edges: number[];
  private readonly pace: number;
  private readonly begin: number;

  constructor({ inputs, arrays, time, count, closed, breaks }: ModelData["positions"]) {
    const follows = ([name]: [string, string]) => name.startsWith("rate:") || name.startsWith("second:");
    this.rows = Object.entries(arrays).filter(follows).map(([name, row]) => [name, floats(row)]);
    this.turns = inputs.map(({ name, values }) => [name, floats(values!)]);
    const times = floats(time!);
    [this.begin, this.pace] = [times[0], times[1] - times[0]];
    this.edges = [0, ...breaks!, closed ? count : count - 1];
  }

  /** Inputs of programs at a place, by name; null where the piece of the laws has too few positions. */
  at(place: number): Record<string, number> | null {
    const piece = Math.max(0, this.edges.slice(0, -1).findLastIndex((edge) => edge <= place)), last = this.turns[0][1].length - 1;
    const ends = [this.edges[piece], this.edges[piece + 1]];
    const first = Math.ceil(ends[0] + (ends[0] > 0 ? NEAR : 0)), end = Math.min(last, Math.floor(ends[1] - (ends[1] < last ? NEAR : 0)));
    const count = Math.min(MOST, end - first + 1);
    if (count < FEWEST) return null;
    const start = Math.min(Math.max(first, Math.round(place - 0.5 * (count - 1))), end - count + 1);
    const weights = through(place - start, count);
    const value = (row: Float64Array) => weights.reduce((sum, w, k) => sum + w * row[start + k], 0);
    const found: Record<string, number> = { time: this.begin + place * this.pace };
    for (const [name, row] of this.rows) found[name] = value(row);
    for (const [name, row] of this.turns) {
      const q = value(row);
      Object.assign(found, { [`cos:${name}`]: Math.cos(q), [`sin:${name}`]: Math.sin(q), [`turn:${name}`]: q, [`slide:${name}`]: q });
      found.input ??= q;
    }
    return found;
  }
}

/** Lagrange's weights at x of samples at 0, 1, 2, … */
export function through(x: number, count: number): number[] {
  return Array.from({ length: count }, (_, k) => {
    let weight = 1;
    for (let j = 0; j < count; j++) if (j !== k) weight *= (x - j) / (k - j);
    return weight;
  });
}

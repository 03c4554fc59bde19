// Closed loops as sums of turned arms, as in the core's kinematics/closed_loops.py: values, derivatives, roots.
import type { LoopData } from "./data";
import type { Values } from "./solver";

export type Matrix = number[][];

/** Real and imaginary parts. */
interface Complexes {
  re: Matrix;
  im: Matrix;
}

/** Loops at some coordinates: arms turned (C, K), directions of slides turned (S, K), lengths of the arms (K). */
export interface Turned {
  arms: Complexes;
  slides: Complexes;
  sizes: number[];
}

export const zeros = (rows: number, columns: number): Matrix => Array.from({ length: rows }, () => new Array<number>(columns).fill(0));
const complexes = (rows: number, columns: number): Complexes => ({ re: zeros(rows, columns), im: zeros(rows, columns) });
export const dot = (a: number[], b: number[]) => a.reduce((sum, x, k) => sum + x * b[k], 0);
export const times = (matrix: Matrix, v: number[]) => matrix.map((row) => dot(row, v));
export const product = (a: Matrix, b: Matrix): Matrix => a.map((row) => b[0].map((_, j) => row.reduce((sum, x, k) => sum + x * b[k][j], 0)));
export const mapped = (matrix: Matrix, of: (x: number, i: number, j: number) => number): Matrix => matrix.map((row, i) => row.map((x, j) => of(x, i, j)));

/** The inverse by Gauss and Jordan with the largest pivots, and the determinant's sign; null where it is singular. */
export function inverted(matrix: Matrix): { inverse: Matrix; sign: number } | null {
  const n = matrix.length, rows = matrix.map((row, i) => [...row, ...row.map((_, j) => Number(i === j))]);
  let sign = 1;
  for (let c = 0; c < n; c++) {
    let best = c;
    for (let r = c + 1; r < n; r++) if (Math.abs(rows[r][c]) > Math.abs(rows[best][c])) best = r;
    if (!(Math.abs(rows[best][c]) > 0)) return null;
    if (best !== c) [rows[c], rows[best], sign] = [rows[best], rows[c], -sign];
    const pivot = rows[c][c];
    if (pivot < 0) sign = -sign;
    rows[c] = rows[c].map((x) => x / pivot);
    for (let r = 0; r < n; r++) {
      const factor = rows[r][c];
      if (r !== c && factor !== 0) rows[r] = rows[r].map((x, k) => x - factor * rows[c][k]);
    }
  }
  return { inverse: rows.map((row) => row.slice(n)), sign };
}

/** K loops in coordinates y = (n unknowns, d drivers); lengths in m, angles in rad. */
export class Loops {
  readonly n: number;
  readonly K: number;
  readonly C: number;
  /** Rotations, then slides, as sums of y. */
  readonly coordinates: Matrix;
  readonly scale: number[];

  constructor(
    readonly turning: Matrix, readonly sliding: Matrix, readonly owner: number[],
    private readonly a: Complexes, private readonly b: Complexes, scale: number[],
  ) {
    [this.n, this.C, this.K, this.scale] = [scale.length, turning.length, a.re[0].length, scale];
    this.coordinates = [...turning, ...sliding];
  }

  /** The loops of a machine whose points are where `place` says, in the axes of their links but for a shift of each;
   *  `changes`: of its dimensions from the original's. */
  static of(data: LoopData, place: (link: string, key: string) => [number, number], values: Values, changes: Values): Loops {
    const { turning, sliding, owner, unknowns, slides, size } = data, K = unknowns.length / 2, [a, b] = [complexes(turning.length, K), complexes(slides.length, K)];
    /** Adds a factor to a part, turned as factor n is, times (x, y). */
    const add = (part: Complexes, row: number, k: number, n: number, re: number, im: number, [x, y]: [number, number]) => {
      const turn = Object.entries(data.turns).reduce((sum, [address, shares]) => sum + shares[n] * changes[address], 0), [c, s] = [Math.cos(turn), Math.sin(turn)];
      part.re[row][k] += (re * c - im * s) * x - (re * s + im * c) * y;
      part.im[row][k] += (re * c - im * s) * y + (re * s + im * c) * x;
    };
    data.arms.forEach(([c, k, link, key, re, im], n) => add(a, c, k, n, re, im, link ? place(link, key) : [key ? values[key] : 1, 0]));
    slides.forEach((row, j) => row.forEach(([re, im], k) => add(b, j, k, data.arms.length + j * K + k, re, im, [1, 0])));
    return new Loops(turning, sliding, owner, a, b, unknowns.map(([kind]) => (kind === "turn" ? 1 : size)));
  }

  /** The same loops open by a gap (2K) times one more driver coordinate. */
  opened(gap: number[]): Loops {
    const { K, a, b } = this, wider = (matrix: Matrix) => matrix.map((row) => [...row, 0]);
    const more = (matrix: Matrix, part: number[]) => [...matrix, part.map((x) => -x)];
    const last = [...this.coordinates[0].map(() => 0), 1];
    return new Loops(
      wider(this.turning), [...wider(this.sliding), last], [...this.owner, 0], a,
      { re: more(b.re, gap.slice(0, K)), im: more(b.im, gap.slice(K)) }, this.scale,
    );
  }

  turned(y: number[]): Turned {
    const { C, K, owner } = this, theta = times(this.turning, y), s = times(this.sliding, y);
    const cos = theta.map(Math.cos), sin = theta.map(Math.sin);
    const re = mapped(this.a.re, (x) => x), im = mapped(this.a.im, (x) => x);
    owner.forEach((c, j) => {
      for (let k = 0; k < K; k++) {
        re[c][k] += this.b.re[j][k] * s[j];
        im[c][k] += this.b.im[j][k] * s[j];
      }
    });
    const sizes = new Array<number>(K).fill(0);
    for (let c = 0; c < C; c++) for (let k = 0; k < K; k++) sizes[k] += Math.hypot(re[c][k], im[c][k]);
    const turn = (a: Complexes, of: (row: number) => number): Complexes => ({
      re: mapped(a.re, (x, i, k) => x * cos[of(i)] - a.im[i][k] * sin[of(i)]),
      im: mapped(a.re, (x, i, k) => x * sin[of(i)] + a.im[i][k] * cos[of(i)]),
    });
    return { arms: turn({ re, im }, (c) => c), slides: turn(this.b, (j) => owner[j]), sizes };
  }

  /** F (2K): real parts, then imaginary parts. */
  gap({ arms }: Turned): number[] {
    const sum = (matrix: Matrix) => matrix[0].map((_, k) => matrix.reduce((total, row) => total + row[k], 0));
    return [...sum(arms.re), ...sum(arms.im)];
  }

  /** ∂F/∂y, (n + d, 2K). */
  slopes({ arms, slides }: Turned): Matrix {
    const rows = [...arms.re.map((re, c) => [...arms.im[c].map((x) => -x), ...re]), ...slides.re.map((re, j) => [...re, ...slides.im[j]])];
    return product(this.coordinates[0].map((_, i) => this.coordinates.map((row) => row[i])), rows);
  }

  /** ∂F/∂z, (n, n). */
  jacobian(slopes: Matrix): Matrix {
    return slopes[0].map((_, r) => slopes.slice(0, this.n).map((row) => row[r]));
  }

  /** y′ and y″ where the drivers go straight with the given rates (d), and the sign of the determinant. */
  rates(y: number[], drive: number[]): { rate: number[]; second: number[]; sign: number } | null {
    const { n, K, owner } = this, at = this.turned(y), slopes = this.slopes(at), found = inverted(this.jacobian(slopes));
    if (!found) return null;
    const solved = (right: number[]) => times(found.inverse, right).map((x) => -x);
    const rate = [...solved(slopes[0].map((_, r) => drive.reduce((sum, x, k) => sum + x * slopes[n + k][r], 0))), ...drive];
    const theta = times(this.turning, rate), slid = times(this.sliding, rate), bend = new Array<number>(2 * K).fill(0);
    for (let k = 0; k < K; k++) {
      theta.forEach((w, c) => {
        bend[k] -= w * w * at.arms.re[c][k];
        bend[K + k] -= w * w * at.arms.im[c][k];
      });
      owner.forEach((c, j) => {
        bend[k] -= 2 * theta[c] * slid[j] * at.slides.im[j][k];
        bend[K + k] += 2 * theta[c] * slid[j] * at.slides.re[j][k];
      });
    }
    return { rate, second: [...solved(bend), ...drive.map(() => 0)], sign: found.sign };
  }

  /** The largest change of an unknown: rad, or share of the machine's size. */
  largest(step: number[]): number {
    return this.scale.reduce((most, size, k) => Math.max(most, Math.abs(step[k]) / size), 0);
  }

  /** The root near y with the same drivers, to rounding; null where Newton's method fails. */
  newton(start: number[], iterations = 8): number[] | null {
    const y = [...start];
    for (let k = 0, last = Infinity; k < iterations; k++) {
      const at = this.turned(y), found = inverted(this.jacobian(this.slopes(at)));
      if (!found) return null;
      const step = times(found.inverse, this.gap(at)), size = this.largest(step);
      step.forEach((x, i) => (y[i] -= x));
      if (!(size < 1e3)) return null;
      if (size < 1e-8 && (size < 1e-13 || size * size < 1e-16 || size > 0.3 * last)) return y;
      last = size;
    }
    return null;
  }
}

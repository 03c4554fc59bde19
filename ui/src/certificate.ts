// Proof that a step of the drivers leads from one assembly to the same one: the bounds of kinematics/certificate.py
// for drivers that go straight, and the walk of kinematics/branch.py.
import { dot, inverted, type Loops, mapped, type Matrix, product, times } from "./loops";

/** One end of a step: place x, coordinates y with two derivatives, sign of the determinant. */
export interface End {
  x: number;
  y: number[];
  rate: number[];
  second: number[];
  sign: number;
}

interface Certificate {
  /** The tube around the cubic in which there is exactly one root at every place; null: not certified. */
  tube: number[] | null;
  /** Steers the next step. */
  contraction: number;
}

const LARGEST_CONTRACTION = 0.95, ROUNDING = 4e-16;
const REFUSED: Certificate = { tube: null, contraction: Infinity };

/** The cubic through both ends with their rates. */
export function cubic(a: End, b: End, x: number): number[] {
  const h = b.x - a.x, t = (x - a.x) / h, rise = t * t * (3 - 2 * t), begin = t * (1 - t) * (1 - t) * h, end = t * t * (t - 1) * h;
  return a.y.map((y, i) => y + rise * (b.y[i] - y) + begin * a.rate[i] + end * b.rate[i]);
}

const largest = (v: number[]) => v.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
const sized = (matrix: Matrix) => mapped(matrix, Math.abs);

export function certify(loops: Loops, a: End, b: End): Certificate {
  const { n, K, C, turning, sliding, owner } = loops, h = b.x - a.x;
  const mean = a.y.map((y, i) => (b.y[i] - y) / h), inner = mean.map((x, i) => 3 * x - a.rate[i] - b.rate[i]);
  const firsts = [a.rate, inner, b.rate].map((each) => times(loops.coordinates, each));
  const first = firsts[0].map((_, c) => largest(firsts.map((each) => each[c])));
  const second = firsts[0].map((_, c) => (2 / h) * Math.max(Math.abs(firsts[1][c] - firsts[0][c]), Math.abs(firsts[2][c] - firsts[1][c])));
  const third = firsts[0].map((_, c) => (2 / h ** 2) * Math.abs(firsts[0][c] - 2 * firsts[1][c] + firsts[2][c]));
  const [w, g, c3] = [first, second, third].map((each) => each.slice(0, C)), [s1, s2, s3] = [first, second, third].map((each) => each.slice(C));

  const at = loops.turned(a.y.map((y, i) => 0.5 * (y + b.y[i]) + (h / 8) * (a.rate[i] - b.rate[i])));
  const J = loops.jacobian(loops.slopes(at)), found = inverted(J);
  if (!found) return REFUSED;
  const A = found.inverse;
  // Rows of A times the turned arms, as complex numbers.
  const through = ({ re, im }: { re: Matrix; im: Matrix }, imaginary: boolean) =>
    A.map((row) => re.map((x, c) => x.reduce((sum, u, k) => sum + (imaginary ? row[k] * im[c][k] - row[K + k] * u : row[k] * u + row[K + k] * im[c][k]), 0)));
  const [turned, turnedAcross] = [through(at.arms, false), through(at.arms, true)];
  const [slidAlong, slidAcross] = [through(at.slides, false), through(at.slides, true)];
  const slid = mapped(slidAlong, (x, r, j) => Math.hypot(x, slidAcross[r][j]));
  /** Values of slides summed over the rotations that they lie on. */
  const owned = (rows: Matrix): Matrix => rows.map((row) => {
    const sum = new Array<number>(C).fill(0);
    owner.forEach((c, j) => (sum[c] += row[j]));
    return sum;
  });
  const weighed = (by: number[]) => mapped(slid, (x, _, j) => x * by[j]);
  const added = (...all: Matrix[]): Matrix => mapped(all[0], (x, i, j) => all.slice(1).reduce((sum, each) => sum + each[i][j], x));
  const columns = (turns: Matrix, slides: Matrix, T = turning, S = sliding): Matrix =>
    turns.map((row, r) => Array.from({ length: n }, (_, i) => row.reduce((sum, x, c) => sum + x * T[c][i], 0) + slides[r].reduce((sum, x, j) => sum + x * S[j][i], 0)));
  const [T, S] = [sized(turning), sized(sliding)];
  const reach = added(mapped(turned, (x, r, c) => Math.hypot(x, turnedAcross[r][c])), owned(weighed(s1.map((x) => (x * h) / 2))));

  const rate = times(loops.coordinates, mean.map((x, i) => 1.5 * x - 0.25 * (a.rate[i] + b.rate[i])));
  const N = columns(
    added(mapped(turned, (x, _, c) => -rate[c] * x), owned(mapped(slidAcross, (x, _, j) => -x * rate[C + j]))),
    mapped(slidAcross, (x, _, j) => -rate[owner[j]] * x),
  );
  const unit = (i: number, j: number) => Number(i === j);
  const spread = mapped(N, (x, i, j) => unit(i, j) + (h / 2) * Math.abs(x));
  const square = mapped(product(N, N), (x) => (h * h * Math.abs(x)) / 4);
  const e2 = w.map((x, c) => x * x + g[c]), AJ = product(A, J);
  const curved = columns(
    added(mapped(reach, (x, _, c) => x * e2[c]), owned(weighed(s2)), mapped(owned(weighed(s1)), (x, _, c) => 2 * x * w[c])),
    weighed(owner.map((c) => e2[c])), T, S,
  );
  const bend = mapped(curved, (x, i, j) => ((h * h) / 8) * x + Math.abs(unit(i, j) - AJ[i][j]) + 1e-15);
  const deviation = (tube: number[]): Matrix => {
    const turn = times(T, tube), slide = times(S, tube);
    const tilt = columns(added(mapped(reach, (x, _, c) => x * turn[c]), owned(weighed(slide))), weighed(owner.map((c) => turn[c])), T, S);
    return added(square, product(spread, added(bend, tilt)));
  };

  const none = turning[0].map(() => 0), flat = deviation(none), contraction = growth(flat);
  if (!(contraction < LARGEST_CONTRACTION)) return { tube: null, contraction };
  const e3 = w.map((x, c) => x ** 3 + 3 * x * g[c] + c3[c]);
  const e4 = w.map((x, c) => x ** 4 + 6 * x * x * g[c] + 3 * g[c] ** 2 + 4 * x * c3[c]);
  const onSlides = owner.map((c, j) => 4 * s1[j] * e3[c] + 6 * s2[j] * e2[c] + 4 * s3[j] * w[c]);
  const rest = remainder(loops, A, [a, b], h);
  const off = times(spread, rest.map((x, r) => (h ** 4 / 384) * (dot(reach[r], e4) + dot(slid[r], onSlides)) + x + 1e-15));
  const solve = inverted(mapped(flat, (x, i, j) => unit(i, j) - x));
  if (!solve) return { tube: null, contraction };
  const tube = times(solve.inverse, off).map((x) => 2 * x), drawn = times(deviation([...tube, ...none.slice(n)]), tube);
  return { tube: tube.every((x, i) => x > 0 && off[i] + drawn[i] <= x) ? tube : null, contraction };
}

/** What rounding and Newton's method leave of F and F′ at the ends, through |A|. */
function remainder(loops: Loops, A: Matrix, ends: End[], h: number): number[] {
  const left = A.map(() => 0), size = new Array<number>(loops.K).fill(0);
  for (const { y, rate } of ends) {
    const at = loops.turned(y), slopes = loops.slopes(at), slope = slopes[0].map((_, r) => rate.reduce((sum, x, i) => sum + x * slopes[i][r], 0));
    const [value, along] = [times(A, loops.gap(at)), times(A, slope)];
    left.forEach((_, r) => (left[r] += Math.abs(value[r]) + (4 / 27) * h * Math.abs(along[r])));
    at.sizes.forEach((x, k) => (size[k] = Math.max(size[k], x)));
  }
  const rounding = times(sized(A), [...size, ...size]);
  return left.map((x, r) => x + ROUNDING * rounding[r]);
}

/** About the largest eigenvalue of a matrix without negative entries. */
function growth(matrix: Matrix): number {
  let v = matrix.map(() => 1), grown = 0;
  for (let k = 0; k < 8; k++) {
    const next = times(matrix, v);
    grown = largest(next);
    if (!(grown > 0)) return grown;
    v = next.map((x) => x / grown);
  }
  return grown;
}

// the walk -------------------------------------------------------------------------------

// Longest and shortest step of a driver (rad or share of the size), the contraction that a step aims at, most tries.
const LONGEST = 0.5, FLOOR = 1e-7, WANTED = 0.5, PATIENCE = 3000;

/** Drivers on a straight way from x = 0 to x = 1; `unit`: of each, rad or the machine's size. */
export interface Straight {
  from: number[];
  to: number[];
  unit: number[];
}

/**
 * Follows the assembly of unknowns z by certified steps along a straight way; `passed` is told of each step with its
 * tube and may end the walk by false. Null where a step cannot be certified.
 */
export function walk(loops: Loops, z: number[], { from, to, unit }: Straight, passed: (a: End, b: End, tube: number[]) => boolean = () => true): End | null {
  const drive = to.map((x, k) => x - from[k]), pace = Math.max(1e-12, ...drive.map((x, k) => Math.abs(x) / unit[k]));
  const end = (x: number, guess: number[], sign: number | null): End | null => {
    const y = loops.newton([...guess.slice(0, loops.n), ...from.map((q, k) => q + x * drive[k])]), found = y && loops.rates(y, drive);
    return found && (sign === null || found.sign === sign) && found.second.every(Number.isFinite) ? { x, y, ...found } : null;
  };
  let here = end(0, z, null), step = LONGEST / pace;
  for (let tries = 0; here && here.x < 1; tries++) {
    if (tries > PATIENCE || step < FLOOR / pace) return null;
    const left = 1 - here.x, full = left <= Math.min(step, LONGEST / pace) * (1 + 1e-9), h: number = full ? left : Math.min(step, LONGEST / pace);
    const { x, y, rate, second, sign }: End = here;
    const ahead = end(full ? 1 : x + h, y.map((each, i) => each + h * rate[i] + 0.5 * h * h * second[i]), sign);
    const { tube, contraction } = ahead ? certify(loops, here, ahead) : REFUSED;
    const share = Number.isFinite(contraction) ? 0.8 * Math.sqrt(WANTED / Math.max(contraction, 1e-9)) : 0.5;
    if (ahead && tube) {
      if (!passed(here, ahead, tube)) return null;
      here = ahead;
      step = full && share > 1 ? Math.max(step, h) * share : h * Math.min(2, Math.max(0.3, share));
    } else step = h * Math.min(0.5, Math.max(0.1, share));
  }
  return here;
}

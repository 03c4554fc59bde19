// Searches along one number, and the least change that brings a point to a place.

// Steps of a search for a zero at most, the width of its bracket, as a share of the place, and the last step that end it.
const STEPS = 80, WIDTH = 4e-16, LAST = 1e-8;

/** Where a function of unlike signs, a and b, at two places is zero: Newton's steps with its slope, halvings where these
 *  leave the bracket. */
export function zero(at: (x: number) => [value: number, slope: number], low: number, high: number, a: number, b: number): number {
  let x = low + (high - low) * (a / (a - b));
  for (let k = 0; k < STEPS; k++) {
    const [value, slope] = at(x), step = value / slope;
    if (value === 0) return x;
    if (Math.abs(step) <= LAST) return x - step;
    if (value < 0 === a < 0) low = x;
    else high = x;
    if (Math.abs(high - low) <= WIDTH * Math.abs(high)) break;
    const next = x - step;
    x = (next - low) * (next - high) <= 0 ? next : 0.5 * (low + high);
  }
  return x;
}

const GOLDEN = 0.3819660112501051;

/** The least value of a function between a and b (Brent, ch. 5); x is its middle. */
export function least(f: (x: number) => number, a: number, x: number, b: number): { at: number; value: number } {
  let w = x, v = x, fx = f(x), fw = fx, fv = fx, d = 0, e = 0;
  for (let k = 0; k < 40; k++) {
    const m = 0.5 * (a + b), tolerance = 1e-9 * Math.abs(x) + 1e-10;
    if (Math.abs(x - m) <= 2 * tolerance - 0.5 * (b - a)) break;
    let golden = true;
    if (Math.abs(e) > tolerance) {
      const r = (x - w) * (fx - fv);
      let q = (x - v) * (fx - fw), p = (x - v) * q - (x - w) * r;
      q = 2 * (q - r);
      if (q > 0) p = -p;
      q = Math.abs(q);
      if (Math.abs(p) < Math.abs(0.5 * q * e) && p > q * (a - x) && p < q * (b - x)) {
        [e, d] = [d, p / q];
        golden = false;
      }
    }
    if (golden) {
      e = x < m ? b - x : a - x;
      d = GOLDEN * e;
    }
    const u = x + (Math.abs(d) >= tolerance ? d : Math.sign(d) * tolerance), fu = f(u);
    if (fu <= fx) {
      if (u < x) b = x;
      else a = x;
      [v, fv, w, fw, x, fx] = [w, fw, x, fx, u, fu];
    } else {
      if (u < x) a = u;
      else b = u;
      if (fu <= fw || w === x) [v, fv, w, fw] = [w, fw, u, fu];
      else if (fu <= fv || v === x || v === w) [v, fv] = [u, fu];
    }
  }
  return { at: x, value: fx };
}

/** The change of the dimensions, least in its squares over their sizes, that moves a point by (rx, ry); J: 2 rows. */
export function leastChange(jx: number[], jy: number[], sizes: number[], rx: number, ry: number): number[] {
  let a = 0, b = 0, c = 0;
  sizes.forEach((size, k) => {
    const w = size * size;
    a += w * jx[k] * jx[k];
    b += w * jx[k] * jy[k];
    c += w * jy[k] * jy[k];
  });
  const damping = 1e-9 * (a + c) + 1e-300;
  a += damping;
  c += damping;
  const d = a * c - b * b, u = (c * rx - b * ry) / d, v = (a * ry - b * rx) / d;
  return sizes.map((size, k) => size * size * (jx[k] * u + jy[k] * v));
}

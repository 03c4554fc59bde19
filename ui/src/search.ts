// Searches along one number, and the least change that brings a point to a place.

/** Where a function that changes its sign between a and b is zero (Brent, Algorithms for Minimization, ch. 4). */
export function root(f: (x: number) => number, a: number, b: number, fa = f(a), fb = f(b)): number {
  let c = a, fc = fa, d = b - a, e = d;
  for (let k = 0; k < 60; k++) {
    if (Math.abs(fc) < Math.abs(fb)) [a, b, c, fa, fb, fc] = [b, c, b, fb, fc, fb];
    const tolerance = 2e-16 * Math.abs(b) + 1e-15, m = 0.5 * (c - b);
    if (Math.abs(m) <= tolerance || fb === 0) break;
    if (Math.abs(e) < tolerance || Math.abs(fa) <= Math.abs(fb)) d = e = m;
    else {
      let p: number, q: number;
      const s = fb / fa;
      if (a === c) [p, q] = [2 * m * s, 1 - s];
      else {
        const r = fb / fc, t = fa / fc;
        p = s * (2 * m * t * (t - r) - (b - a) * (r - 1));
        q = (t - 1) * (r - 1) * (s - 1);
      }
      if (p > 0) q = -q;
      else p = -p;
      if (2 * p < Math.min(3 * m * q - Math.abs(tolerance * q), Math.abs(e * q))) [e, d] = [d, p / q];
      else d = e = m;
    }
    [a, fa] = [b, fb];
    b += Math.abs(d) > tolerance ? d : Math.sign(m) * tolerance;
    fb = f(b);
    if (fb > 0 === fc > 0) [c, fc, d, e] = [a, fa, b - a, b - a];
  }
  return b;
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

// Places and directions on a plane.
import type { Vec } from "../../shapes";

export const minus = ([a, b]: Vec, [c, d]: Vec): Vec => [a - c, b - d];
export const plus = ([a, b]: Vec, [c, d]: Vec): Vec => [a + c, b + d];
export const times = (k: number, [x, y]: Vec): Vec => [k * x, k * y];
export const size = ([x, y]: Vec) => Math.hypot(x, y);
export const polar = (r: number, angle: number): Vec => [r * Math.cos(angle), r * Math.sin(angle)];
export const heading = (from: Vec, to: Vec) => Math.atan2(to[1] - from[1], to[0] - from[0]);
export const dist = (a: Vec, b: Vec) => Math.hypot(b[0] - a[0], b[1] - a[1]);

/** The place of a stretch that is nearest to another one, and its share of the way. */
export function nearestOn(p: Vec, a: Vec, b: Vec): { at: Vec; share: number } {
  const d = minus(b, a), square = d[0] * d[0] + d[1] * d[1] || 1;
  const share = Math.min(1, Math.max(0, ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / square));
  return { at: plus(a, times(share, d)), share };
}

/** Whether a place is inside of a polygon. */
export function inside([x, y]: Vec, corners: Vec[]): boolean {
  let odd = false;
  for (let i = 0, j = corners.length - 1; i < corners.length; j = i++) {
    const [a, b] = corners[i], [c, d] = corners[j];
    if (b > y !== d > y && x < ((c - a) * (y - b)) / (d - b) + a) odd = !odd;
  }
  return odd;
}

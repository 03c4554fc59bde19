import assert from "node:assert/strict";
import test from "node:test";
import { least, leastChange, zero } from "../src/search";
import { allNear, near } from "./near";

test("zeros are those of known functions, whichever end is given first", () => {
  const cases: [(x: number) => [number, number], number, number, number][] = [
    [(x) => [Math.cos(x) - x, -Math.sin(x) - 1], 0, 1, 0.7390851332151607], [(x) => [x ** 3 - 2, 3 * x * x], 0, 4, Math.cbrt(2)],
    [(x) => [Math.exp(x) - 2, Math.exp(x)], -5, 5, Math.LN2], [(x) => [Math.sin(x), Math.cos(x)], 3, 4, Math.PI],
    [(x) => [Math.tanh(50 * (x - 0.1)), 50 / Math.cosh(50 * (x - 0.1)) ** 2], -1, 3, 0.1],
  ];
  for (const [f, a, b, wanted] of cases) {
    near(zero(f, a, b, f(a)[0], f(b)[0]), wanted, 1e-14);
    near(zero(f, b, a, f(b)[0], f(a)[0]), wanted, 1e-14);
  }
});

test("a zero at an end is that end", () => {
  assert.equal(zero((x) => [x, 1], 0, 1, 0, 1), 0);
  assert.equal(zero((x) => [x - 1, 1], 0, 1, -1, 0), 1);
});

test("the least values of smooth and of broken functions", () => {
  near(least(Math.cos, 2, 3, 4).at, Math.PI, 1e-7);
  near(least(Math.cos, 2, 3, 4).value, -1, 1e-14);
  near(least((x) => (x - Math.SQRT2) ** 2 + 3, 0, 1, 2).at, Math.SQRT2, 1e-7);
  near(least((x) => Math.abs(x - 0.3), -1, 0, 1).at, 0.3, 1e-7);
  near(least((x) => x, 1, 2, 3).value, 1, 1e-6);
});

test("the least change brings the point there and has nothing that does not move it", () => {
  allNear(leastChange([3, 4], [0, 0], [1, 1], 5, 0), [0.6, 0.8], 1e-8);
  // Of (1, 2, 2) and (0, 1, -1), which are at right angles: r₁ a/|a|² + r₂ b/|b|².
  allNear(leastChange([1, 2, 2], [0, 1, -1], [1, 1, 1], 9, 4), [1, 2 + 2, 2 - 2], 1e-8);
  // Of (1, 0) and (1, 1), which are not: (x, y − x).
  allNear(leastChange([1, 0], [1, 1], [1, 1], 3, 7), [3, 4], 1e-7);
  // A dimension twice as large takes four times the share.
  allNear(leastChange([1, 1], [0, 0], [1, 2], 5, 0), [1, 4], 1e-8);
});

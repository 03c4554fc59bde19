import assert from "node:assert/strict";
import test from "node:test";
import type { Vec } from "../src/shapes";
import { arrow, dashpot, far, hull, line, put, round, strand, tenth, thinned, toothed, unit, zigzag } from "../src/strokes";
import { allNear, near } from "./near";
import { Element, numbersOf } from "./paper";

const circle = (count: number, r: number): Vec[] => Array.from({ length: count }, (_, k) => [r * Math.cos((k * 2 * Math.PI) / count), r * Math.sin((k * 2 * Math.PI) / count)]);

/** How far a place is from a stretch. */
function off([x, y]: Vec, [a, b]: Vec, [c, d]: Vec): number {
  const [u, v] = [c - a, d - b], t = Math.min(1, Math.max(0, ((x - a) * u + (y - b) * v) / (u * u + v * v || 1)));
  return Math.hypot(a + t * u - x, b + t * v - y);
}

test("a thinned curve is nowhere farther from its places than the tolerance, and has few corners", () => {
  for (const [places, tolerance] of [[circle(720, 100), 0.1], [circle(720, 100), 1], [Array.from({ length: 400 }, (_, k): Vec => [k, 40 * Math.sin(k / 30)]), 0.2]] as [Vec[], number][]) {
    const kept = thinned(places.map(([x]) => x), places.map(([, y]) => y), tolerance);
    assert.deepEqual([kept[0], kept[kept.length - 1]], [0, places.length - 1]);
    for (let k = 1; k < kept.length; k++)
      for (let i = kept[k - 1]; i <= kept[k]; i++) assert.ok(off(places[i], places[kept[k - 1]], places[kept[k]]) <= tolerance * (1 + 1e-9));
    assert.ok(kept.length < places.length / 8, `${kept.length}`);
  }
});

test("a straight line keeps its ends, one that goes back its turning point", () => {
  const x = [0, 1, 2, 3, 4];
  assert.deepEqual(thinned(x, x, 0.1), [0, 4]);
  assert.deepEqual(thinned([0, 1, 2, 1, 0], [0, 0, 0, 0, 0], 0.1), [0, 2, 4]);
  assert.deepEqual(thinned([], [], 0.1), []);
  assert.deepEqual(thinned([5], [5], 0.1), [0]);
});

test("the hull of a cloud is the square around it", () => {
  const corners: Vec[] = [[0, 0], [4, 0], [4, 4], [0, 4]];
  assert.deepEqual(hull([[2, 2], [1, 3], ...corners, [3, 1], [2, 0]]).toSorted((a, b) => a[0] - b[0] || a[1] - b[1]), corners.toSorted((a, b) => a[0] - b[0] || a[1] - b[1]));
});

test("a wheel has as many teeth as it is said to have, in even steps", () => {
  const places = numbersOf(toothed(60, 20, 0.3, 1)), radii = places.map(([x, y]) => Math.hypot(x, y));
  assert.equal(places.length, 100);
  const tops = places.filter((_, k) => radii[k] > 61).map(([x, y]) => Math.atan2(y, x));
  assert.equal(tops.length, 40);
  // The middle of the first top is the tooth that was turned to 0.3 rad.
  near(0.5 * (tops[0] + tops[1]), 0.3, 2e-3);
  near(tops[2] - tops[0], Math.PI / 10, 4e-3);
  const inside = numbersOf(toothed(60, 20, 0.3, -1)).map(([x, y]) => Math.hypot(x, y));
  near(Math.min(...inside), 60 - 3.2, 0.1);
});

test("strands touch both circles, crossed where the radii have other signs", () => {
  for (const [r, s] of [[30, 10], [20, -15]]) {
    const [a, b] = numbersOf(strand([0, 0], [100, 0], r, s)), u = unit(a, b);
    near(Math.abs(a[0] * u[1] - a[1] * u[0]), r, 0.2);
    near(Math.abs((b[0] - 100) * u[1] - b[1] * u[0]), Math.abs(s), 0.2);
    near(far(a, b), Math.sqrt(100 ** 2 - (r - s) ** 2), 2e-3);
  }
});

test("springs and dampers reach from one end to the other", () => {
  const coil = zigzag([0, 0], [60, 80]);
  assert.deepEqual([coil[0], coil[coil.length - 1]], [[0, 0], [60, 80]]);
  assert.ok(coil.every((place) => off(place, [0, 0], [60, 80]) <= 7 + 1e-9));
  const strokes = numbersOf(dashpot([10, 10], [10, 110]));
  assert.deepEqual([strokes[0], strokes[strokes.length - 1]], [[10, 10], [10, 110]]);
});

test("paths of lines and circles, and arrows that point to their ends", () => {
  assert.equal(line([[0, 0], [1.26, -2.04]], true), "M0 0L1.3 -2Z");
  assert.equal(line([], true), "");
  assert.equal(tenth(-0.04), -0);
  assert.equal(round([10, 20], 5), "M5 20a5 5 0 1 0 10 0a5 5 0 1 0 -10 0Z");
  const [shaft, head] = [new Element("path"), new Element("path")];
  arrow(shaft.svg, head.svg, [0, 0], [30, 40]);
  const tip = numbersOf(head.attributes.d);
  assert.deepEqual(tip[0], [30, 40]);
  near(far(tip[1], tip[2]), 2 * 0.38 * 9, 0.05);
  allNear(numbersOf(shaft.attributes.d)[0], [0, 0]);
});

test("an attribute is written where it changes", () => {
  const each = new Element("path");
  put(each.svg, "x", "1");
  put(each.svg, "x", "1");
  put(each.svg, "x", "2");
  assert.deepEqual([each.attributes.x, each.written], ["2", 2]);
});

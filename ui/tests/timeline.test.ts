// Ticks, stretches and typed values of the time line.
import assert from "node:assert/strict";
import { test } from "node:test";
import { outside, phaseOf, stretches, ticks, typed } from "../src/studio/dock/timeline";

const TURN = 2 * Math.PI, degrees = (a: number, b: number) => ticks((a * Math.PI) / 180, (b * Math.PI) / 180, true).map(({ value }) => Math.round((value * 180) / Math.PI));

test("ticks of angles are neat and keep off the ends", () => {
  assert.deepEqual(degrees(0, -360), [0, -90, -180, -270, -360]);
  assert.deepEqual(degrees(20, 110), [20, 30, 60, 90, 110]);
});

test("ticks of lengths go in ones, twos and fives", () => {
  assert.deepEqual(ticks(0, 0.1, false).map(({ value }) => Math.round(value * 1e3)), [0, 20, 40, 60, 80, 100]);
});

test("a phase through the end of a closed cycle is two stretches", () => {
  assert.deepEqual(stretches([1, 0, 0, 1], 4, true), [{ from: 0, to: 0.25 }, { from: 0.75, to: 1 }]);
});

test("what lies outside of intervals", () => {
  assert.deepEqual(outside([[-90, 90]], -180, 180), [{ from: 0, to: 0.25 }, { from: 0.75, to: 1 }]);
  assert.deepEqual(outside([], 0, 1), [{ from: 0, to: 1 }]);
});

test("a typed angle is found a turn away, and nearest to the present position", () => {
  const values = Array.from({ length: 361 }, (_, i) => (i * TURN) / 360);
  assert.ok(Math.abs(phaseOf(values, typed("-90", true)!, true, 0)! - 0.75) < 1e-12);
  const rocking = [0, 1, 2, 1, 0];
  assert.equal(phaseOf(rocking, 1, false, 0.9), 0.75);
  assert.equal(phaseOf(rocking, 3, false, 0), null);
});

test("typed coordinates have the unit of the input unless they say another", () => {
  assert.ok(Math.abs(typed("90", true)! - Math.PI / 2) < 1e-12);
  assert.equal(typed("40 mm", false), 0.04);
  assert.equal(typed("0,12 m", false), 0.12);
  assert.equal(typed("3 mm", true), null);
  assert.equal(typed("fast", true), null);
});

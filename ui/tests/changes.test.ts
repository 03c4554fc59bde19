// How drawings differ: what a sheet goes on showing while a text is solved depends on it.
import assert from "node:assert/strict";
import test from "node:test";
import type { Picture } from "../src/studio/picture";
import { compare, without } from "../src/studio/sheet/changes";

const OLD: Picture = { points: { O: [0, 0], A: [1, 0], B: [2, 0] }, fixed: ["O"], links: { crank: ["O", "A"], bar: ["A", "B"] }, driver: null, guided: [], loads: {} };

test("an addition, another place and what is gone are told apart", () => {
  assert.equal(compare(OLD, structuredClone(OLD)), "same");
  assert.equal(compare(OLD, { ...OLD, points: { ...OLD.points, C: [3, 0] }, links: { ...OLD.links, rod: ["B", "C"] } }), "more");
  assert.equal(compare(OLD, { ...OLD, points: { ...OLD.points, B: [2, 1] } }), "moved");
  assert.equal(compare(OLD, { ...OLD, links: { crank: ["O", "A"] } }), "other");
  assert.equal(compare(OLD, { ...OLD, points: { ...OLD.points, B: [2, 1], C: [3, 0] } }), "other");
});

test("without a link go the points that only it has", () => {
  const left = without(OLD, ["bar"], []);
  assert.deepEqual([Object.keys(left.links), Object.keys(left.points)], [["crank"], ["O", "A"]]);
  assert.deepEqual(Object.keys(without(OLD, [], ["O"]).points), ["A", "B"]);
});

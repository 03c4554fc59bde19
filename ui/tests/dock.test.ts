// What is typed in the dock: demands of a task, wishes of an optimisation; the order of a sweep.
import assert from "node:assert/strict";
import test from "node:test";
import { pasted, type Task, written } from "../src/studio/dock/demands";
import { outwards } from "../src/studio/dock/sweep";
import { parted, ranged, wished, writtenWish } from "../src/studio/dock/wish";

const demand = (key: string, form: string, usual: boolean | string | null = null) => ({ key, form, needed: false, usual, words: [] as [string, string][] });
const TASK: Task = {
  name: "any",
  demands: [
    demand("stroke", "length"), demand("ratio", "number"), demand("swing", "angle"), demand("inputs", "angles"), demand("poses", "poses"), demand("pivot", "point"),
    demand("turning", "flag", true), demand("linkage", "word", "four_bar"),
  ],
};

test("bare numbers get the unit of their form, others stay", () => {
  assert.deepEqual(written(TASK, { stroke: "120", ratio: "1.2", swing: "60°" }), { stroke: "120 mm", ratio: "1.2", swing: "60 deg" });
  assert.deepEqual(written(TASK, { stroke: "4 in", swing: "1 rad" }), { stroke: "4 in", swing: "1 rad" });
  assert.deepEqual(written(TASK, { stroke: "0,5", swing: "−20" }), { stroke: "0.5 mm", swing: "-20 deg" });
});

test("lists are taken apart at commas, blanks and semicolons", () => {
  assert.deepEqual(written(TASK, { inputs: "0, 30, 60" }), { inputs: ["0 deg", "30 deg", "60 deg"] });
  assert.deepEqual(written(TASK, { inputs: "0 30;60" }), { inputs: ["0 deg", "30 deg", "60 deg"] });
  assert.deepEqual(written(TASK, { inputs: "0,30,60" }), { inputs: ["0 deg", "30 deg", "60 deg"] });
});

test("what is empty, and what is so by itself, stays out", () => {
  assert.deepEqual(written(TASK, { stroke: " ", turning: true, linkage: "four_bar", poses: [[1, null, 3]] }), {});
  assert.deepEqual(written(TASK, { turning: false, linkage: "watt" }), { turning: false, linkage: "watt" });
});

test("rows are numbers; a pose without an angle is a place", () => {
  assert.deepEqual(written(TASK, { poses: [[0, 10, 30], [5, 12, null]], pivot: [[1, 2]] }), { poses: [[0, 10, 30], [5, 12]], pivot: [1, 2] });
});

test("a table of a spreadsheet becomes rows", () => {
  assert.deepEqual(pasted("0\t10\n5\t12\n", 2), [[0, 10], [5, 12]]);
  assert.deepEqual(pasted("x, y\n0, 10, 30\n5, 12, 40", 3), [[0, 10, 30], [5, 12, 40]]);
});

test("a sweep goes from the present value outwards", () => {
  assert.deepEqual(outwards([0, 1, 2, 3, 4], 2.1), [2, 3, 1, 4, 0]);
});

test("a section of the file comes back from its form as it was", () => {
  const asked = { vary: { "crank.length": "80..120 mm" }, minimize: "peak_torque", keep: { transmission_angle: "at least 40 deg" }, seed: 3 };
  assert.deepEqual(writtenWish(wished(asked), asked), asked);
  assert.deepEqual(ranged("-0.5..1.25e1 m"), { low: "-0.5", high: "1.25e1", unit: "m" });
  assert.equal(ranged("[80 mm, 90 mm]"), null);
  assert.deepEqual(parted(">= 40 deg"), ["at least", "40 deg"]);
  assert.deepEqual(parted("40..50 deg"), ["", "40..50 deg"]);
});

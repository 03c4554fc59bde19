import assert from "node:assert/strict";
import test from "node:test";
import { settle } from "../src/friction";
import { Kernel } from "../src/engine";
import { nearest, unwrap } from "../src/loads";
import { Model } from "../src/model";
import { mixed, Solver } from "../src/solver";
import { CRANK, OFFSET, ROD, asCode, formulas, slider, sliderCrank } from "./machine";
import { allNear, near } from "./near";

function machine(count: number) {
  const { data, code } = sliderCrank(count);
  return new Model(data, code);
}

test("a rod too short for the crank stops where it just reaches the guide, between positions too", () => {
  for (const count of [7, 36, 50]) {
    const model = machine(count);
    model.change({ ...model.values, "rod.length": 0.04 });
    const length = model.values["rod.length"];
    assert.equal(model.wall?.kind, "apart");
    assert.ok(length >= CRANK + OFFSET, `${length}`);
    near(length, CRANK + OFFSET, 1e-6);
    assert.ok(model.main.row("ok").every((each) => each === 1));
  }
});

test("what lies between two positions is seen: the rod misses the guide at none of them", () => {
  const { data, code } = sliderCrank(7), solver = new Solver(data, code);
  const reach = Math.max(...Array.from({ length: 7 }, (_, i) => Math.abs(CRANK * Math.sin((i * 2 * Math.PI) / 7) - OFFSET)));
  const rod = 0.5 * (reach + CRANK + OFFSET), wall = solver.evaluate({ ...data.values, "rod.length": rod });
  assert.ok(solver.main.row("ok").every((each) => each === 1));
  assert.equal(wall?.kind, "apart");
  near(wall.input, 1.5 * Math.PI, 1e-6);
  near(wall.facts.height, -CRANK - OFFSET, 1e-9);
  near(wall.facts["length²"], rod ** 2, 1e-12);
});

test("lengths stay above nought", () => {
  const model = machine(12), before = { ...model.values };
  model.change({ ...before, "crank.length": -0.01 });
  assert.deepEqual([model.wall?.kind, model.wall?.name], ["length", "crank.length"]);
  assert.deepEqual(model.values, before);
});

test("a drag changes the one free dimension as its triangle says", () => {
  const model = machine(12), i = 2, angle = Math.PI / 3, x = slider(angle) + 0.03;
  for (const address of ["crank.length", "guide.offset"]) model.locked.add(address);
  model.drag(model.values, "B", i, x, OFFSET);
  near(model.values["rod.length"], Math.hypot(x - CRANK * Math.cos(angle), CRANK * Math.sin(angle) - OFFSET), 1e-10);
  assert.equal(model.values["crank.length"], CRANK);
  near(model.row("s:guide")[i], x, 1e-10);
});

test("a drag with all dimensions free takes the point there by a change that is least", () => {
  const model = machine(12), before = { ...model.values }, x = slider(0) + 1e-3;
  model.locked.add("guide.offset");
  model.drag(before, "B", 0, x, OFFSET);
  near(model.row("s:guide")[0], x, 1e-10);
  // By dx/dr = 1 and dx/dl = l / √(l² − e²): shares as of the slopes.
  const [r, l] = ["crank.length", "rod.length"].map((name) => model.values[name] - before[name]);
  near(l / r, ROD / Math.sqrt(ROD ** 2 - OFFSET ** 2), 1e-2);
});

test("loads of the original are found even where the page cannot follow it, those of no other machine are", () => {
  const { data } = sliderCrank(36);
  data.program = { ...data.program, fields: ["acts:push", "share:push"] };
  data.phases = [{ load: "push", kind: "stroke", ramp: false, rows: ["s:guide"], rate: "sv:guide", second: "sa:guide", moving: "sv:guide", ends: ["max", "min"], part: null }];
  const lost = asCode(data.program, (parameters, positions, fields, out, n) => {
    formulas(parameters, positions, fields, out, n);
    if (n > 4) out[5] = 0;
  });
  const solver = new Solver(data, lost), acting = () => solver.main.fields["acts:push"].reduce((sum, x) => sum + x);
  assert.equal(solver.evaluate({ ...data.values, "rod.length": 0.21 })?.kind, "lost");
  assert.equal(acting(), 0);
  assert.equal(solver.evaluate({ ...data.values })?.kind, "lost");
  assert.ok(Math.abs(acting() - 18) <= 1);
});

test("what is locked or moves nothing is said", () => {
  const model = machine(12);
  model.locked.add("crank.length");
  model.drag(model.values, "A", 0, 1, 1);
  assert.equal(model.wall?.kind, "locked");
  model.locked.clear();
  model.data.points[0].moved = [];
  model.drag(model.values, "A", 0, 1, 1);
  assert.equal(model.wall?.kind, "still");
});

test("a design between two others, and the other one to its last digit", () => {
  assert.deepEqual(mixed({ a: 1, b: 10 }, { a: 2, b: 20 }, 0.25), { a: 1.25, b: 12.5 });
  assert.deepEqual(mixed({ a: 0.1 }, { a: 0.3 }, 1), { a: 0.3 });
  assert.deepEqual(mixed({}, { c: 3 }, 0.5), { c: 3 });
});

test("angles near others, and rows without jumps", () => {
  near(nearest(0.1, 4 * Math.PI), 0.1 + 4 * Math.PI);
  near(nearest(3, -3), 3 - 2 * Math.PI);
  allNear(unwrap(Float64Array.of(3, -3, -2.5)), [3, 2 * Math.PI - 3, 2 * Math.PI - 2.5]);
});

/** A program that an arm's friction f acts on: the reaction is 10 N and its share. */
function rubbing(share: number, pace: number) {
  const program = { outputs: ["r:J|b.x", "r:J|b.y", "rate"], parameters: ["k", "rate"], positions: [], fields: ["f"], tables: [] };
  const kernel = new Kernel(program, asCode(program, ([k, rate], _positions, [f], out, n) => {
    for (let i = 0; i < n; i++) [out[i], out[n + i], out[2 * n + i]] = [10 + k * f[i], 0, rate];
  }));
  const call = kernel.call(3), term = { field: "f", rate: "rate", joint: "J", a: "a", b: "b", arm: 0.2, slides: false, on: ["b"] };
  call.set({ k: share, rate: pace });
  call.run();
  return { settled: settle(call, [term]), friction: call.fields.f[0], reaction: call.row("r:J|b.x")[0] };
}

test("friction agrees with the reaction that it causes, against the motion; it locks where it grows with itself", () => {
  for (const [k, rate] of [[2, 1], [-3, 1], [2, -1], [1, 0]]) {
    const found = rubbing(k, rate), f = (-Math.sign(rate) * 0.2 * 10) / (1 + Math.sign(rate) * 0.2 * k);
    assert.equal(found.settled, true);
    near(found.friction, f, 1e-10);
    near(found.reaction, 10 + k * f, 1e-10);
  }
  const locked = rubbing(-6, 1);
  assert.deepEqual([locked.settled, locked.friction, locked.reaction], [false, 0, 10]);
});

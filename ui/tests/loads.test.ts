import assert from "node:assert/strict";
import test from "node:test";
import type { Phase } from "../src/data";
import { Kernel } from "../src/engine";
import { follow } from "../src/loads";
import { asCode } from "./machine";
import { near } from "./near";

const TURN = 2 * Math.PI, SPEED = 4;

type Formula = (q: number) => [value: number, rate: number, second: number];

/** An output by its formulas over the input at so many positions of a turn, and a load that follows it by a phase. */
function loaded(formula: Formula, phase: Partial<Phase>, { n = 24, speed = SPEED, values = {}, wobble = 0, corners = [] as number[] } = {}) {
  const program = { outputs: ["x", "v", "a", "moving"], parameters: [], positions: ["q"], fields: ["acts:push", "share:push"], tables: [] };
  const kernel = new Kernel(program, asCode(program, (_parameters, [q], _fields, out, length) => {
    for (let i = 0; i < length; i++) {
      const [x, v, a] = formula(q[i]);
      [out[i], out[length + i], out[2 * length + i]] = [x, speed * v, speed * speed * a];
      out[3 * length + i] = Math.abs(speed * v) > 1e-13 ? speed * v : 0;
    }
  }));
  const call = kernel.call(n), one = kernel.call(1), step = (Math.sign(speed) * TURN) / n;
  const input = (place: number) => place * step + wobble * Math.sin(place * step);
  call.give({ q: Array.from({ length: n }, (_, i) => input(i)) });
  call.run();
  const at = (place: number) => {
    one.give({ q: [input(place)] });
    one.run();
    return one;
  };
  const whole = { load: "push", rows: ["x"], rate: "v", second: "a", moving: "moving", kind: "stroke", ramp: true, ends: ["max", "min"], part: null, ...phase };
  const cycle = { main: call, closed: true, pace: step / speed, turns: true, drift: n * step, input, at, corners };
  const between = follow(cycle, [whole as Phase], [], values);
  const acts = [...call.fields["acts:push"]], share = [...call.fields["share:push"]];
  return { acts, share, between: between && ((place: number) => between(at(place), place, Math.round(place) % n)), inputs: acts.map((_, i) => input(i)) };
}

const cosine: Formula = (q) => [Math.cos(q - 0.1), -Math.sin(q - 0.1), -Math.cos(q - 0.1)];
const angle = (q: number, from: number) => (((q - from) % TURN) + TURN) % TURN;

test("a load acts from one limit of a cosine to the other, and its ramp goes on with the input, forwards and backwards", () => {
  for (const speed of [SPEED, -SPEED]) {
    const { acts, share, between, inputs } = loaded(cosine, {}, { speed }), from = speed > 0 ? 0.1 : 0.1 + Math.PI;
    inputs.forEach((q, i) => {
      const since = speed > 0 ? angle(q, from) : Math.PI - angle(q, from);
      assert.equal(acts[i], Number(since >= 0 && since <= Math.PI));
      if (acts[i]) near(share[i], since / Math.PI, 1e-12);
    });
    const q = Math.sign(speed) * 1.234, since = speed > 0 ? q - 0.1 : 0.1 - q;
    near(between!(1.234 / (TURN / 24))["share:push"], since / Math.PI, 1e-12);
    // At once beyond its end it does not act.
    const end = (speed > 0 ? 0.1 + Math.PI : Math.PI - 0.1) / (TURN / 24);
    for (const off of [-1e-9, 1e-9]) assert.equal(between!(end + off)["acts:push"], Number(off < 0));
  }
});

test("a ramp over an input that goes unevenly goes by the input, not by the time", () => {
  const { acts, share, inputs } = loaded(cosine, {}, { wobble: 0.3 });
  inputs.forEach((q, i) => {
    const since = angle(q, 0.1);
    if (acts[i]) near(share[i], since / Math.PI, 1e-9);
    assert.equal(acts[i], Number(since <= Math.PI));
  });
});

test("of several reversals a stroke takes the outermost ones, a load that goes with the motion all of them", () => {
  // sin q + 0.8 sin 2q: four reversals; slopes have closed forms by cos 2q = 2c² − 1.
  const double: Formula = (q) => [Math.sin(q) + 0.8 * Math.sin(2 * q), Math.cos(q) + 1.6 * Math.cos(2 * q), -Math.sin(q) - 3.2 * Math.sin(2 * q)];
  const root = (sign: number) => Math.acos((-1 + sign * Math.sqrt(1 + 8 * 1.6 * 1.6)) / (4 * 1.6));
  const [first, second] = [root(1), root(-1)];
  // Largest at the first one, smallest at a turn less it; small ones at the second and a turn less it.
  const stroke = loaded(double, { ramp: false }, { n: 96 }), moving = loaded(double, { kind: "moving", ends: ["max", "min"] }, { n: 96 });
  stroke.inputs.forEach((q, i) => {
    assert.equal(stroke.acts[i], Number(q >= first && q <= TURN - first));
    const falls = (q > first && q < second) || (q > TURN - second && q < TURN - first);
    assert.equal(moving.acts[i], Number(falls));
    if (falls) near(moving.share[i], q < Math.PI ? (q - first) / (second - first) : (q - TURN + second) / (second - first), 1e-12);
  });
});

test("limits between two positions of one sign are seen", () => {
  // A dip of the rate of about a tenth of a position's width.
  const e = 1e-4, dipping: Formula = (q) => {
    const c = Math.cos(q - 1), v = 1 - c - e;
    return [q * (1 - e) - Math.sin(q - 1), v, Math.sin(q - 1)];
  };
  const way = Math.acos(1 - e), { acts, between } = loaded(dipping, { kind: "moving", ends: ["max", "min"], ramp: true }, { n: 60 });
  assert.ok(acts.every((each) => each === 0));
  for (const [off, want] of [[-0.5, 0.25], [0, 0.5], [0.9, 0.95]]) {
    const found = between!((1 + off * way) / (TURN / 60));
    assert.equal(found["acts:push"], 1);
    near(found["share:push"], want, 1e-8);
  }
  assert.equal(between!((1 + 1.1 * way) / (TURN / 60))["acts:push"], 0);
});

test("a part of a stroke acts by the way of the output; there is none in a stroke too short for it", () => {
  const part = { word: "free" as const, amounts: [[0.1, true], [0.4, false]] as [number, boolean][] };
  const { acts, share, inputs } = loaded(cosine, { part });
  inputs.forEach((q, i) => {
    const gone = 1 - Math.cos(q - 0.1), since = angle(q, 0.1);
    assert.equal(acts[i], Number(since <= Math.PI && gone >= 0.2 && gone <= 1.6));
    if (acts[i]) near(share[i], (gone - 0.2) / 1.4, 1e-12);
  });
  assert.equal(loaded(cosine, { part: { word: "last", amounts: [[2.1, false]] } }).between, null);
});

test("of a rest between opposite motions the middle is the limit", () => {
  // Grows up to 1, rests to 2.5, falls up to 5 and rests to the end of the turn.
  const hump = (u: number) => u ** 3 * (1 - u) ** 3, bend = (u: number) => 3 * u * u * (1 - u) ** 2 * (1 - 2 * u);
  const lifted: Formula = (q) => {
    const p = angle(q, 0);
    if (p < 1) return [0, hump(p), bend(p)];
    return p > 2.5 && p < 5 ? [0, -hump((p - 2.5) / 2.5) / 2.5, -bend((p - 2.5) / 2.5) / 6.25] : [0, 0, 0];
  };
  const [top, bottom] = [1.75, 0.5 * (5 + TURN)];
  for (const [known, close] of [[[], 1e-4], [[0, 1, 2.5, 5], 1e-12]] as const) {
    const { acts, share, inputs } = loaded(lifted, { kind: "moving", ends: ["max", "min"] }, { n: 72, corners: known.map((q) => q / (TURN / 72)) });
    inputs.forEach((q, i) => {
      if (q > 2.6 && q < 4.9) near(share[i], (q - top) / (bottom - top), close);
      assert.equal(acts[i], Number(q > 2.5 + 1e-4 && q < 5 - 1e-4));
    });
  }
});

test("an interval of the input goes through the end of the turn, and back where the input falls", () => {
  const values = { from: 5.5, to: 1 }, phase = { kind: "input", between: ["from", "to"] } as Partial<Phase>;
  const { acts, share, inputs } = loaded(cosine, phase, { n: 48, values });
  inputs.forEach((q, i) => {
    const gone = angle(q, 5.5);
    assert.equal(acts[i], Number(gone <= TURN - 4.5));
    if (acts[i]) near(share[i], gone / (TURN - 4.5), 1e-12);
  });
  const back = loaded(cosine, phase, { n: 48, values, speed: -SPEED });
  back.inputs.forEach((q, i) => {
    const p = angle(q, 0);
    assert.equal(back.acts[i], Number(p >= 1 && p <= 5.5));
    if (back.acts[i]) near(back.share[i], (5.5 - p) / 4.5, 1e-12);
  });
  assert.equal(loaded(cosine, phase, { values: { from: 0, to: 7 } }).between, null);
});

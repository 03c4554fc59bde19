import assert from "node:assert/strict";
import test from "node:test";
import { Branch } from "../src/branch";
import { certify, cubic, walk } from "../src/certificate";
import type { LoopData } from "../src/data";
import { inverted, Loops, product, times } from "../src/loops";
import type { Solver } from "../src/solver";
import { allNear, near } from "./near";

const TURNING = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];

/** A four-bar: two unknown angles and a driver's; a e^{iq} + b e^{iβ} − c e^{iγ} − d = 0. */
function fourbar(a: number, b: number, c: number, d: number): Loops {
  // y = (β, γ, q); turned arms: base, which does not turn, coupler, rocker, crank.
  return new Loops(TURNING, [], [], { re: [[-d], [b], [-c], [a]], im: [[0], [0], [0], [0]] }, { re: [], im: [] }, [1, 1]);
}

/** The angles of coupler and rocker of a four-bar by its diagonal, the pin on the left of it. */
function closed(a: number, b: number, c: number, d: number, q: number): [number, number] {
  const [x, y] = [d - a * Math.cos(q), -a * Math.sin(q)], far = Math.hypot(x, y), line = Math.atan2(y, x);
  const beta = line + Math.acos((far * far + b * b - c * c) / (2 * far * b));
  return [beta, Math.atan2(a * Math.sin(q) + b * Math.sin(beta), a * Math.cos(q) + b * Math.cos(beta) - d)];
}

const LENGTHS = [1, 3.5, 3, 4] as const;

test("the inverse of Hilbert's matrix, and the sign of determinants", () => {
  const found = inverted([[1, 1 / 2, 1 / 3], [1 / 2, 1 / 3, 1 / 4], [1 / 3, 1 / 4, 1 / 5]])!;
  [[9, -36, 30], [-36, 192, -180], [30, -180, 180]].forEach((row, i) => allNear(found.inverse[i], row, 1e-11));
  assert.equal(found.sign, 1);
  assert.equal(inverted([[0, 1], [1, 0]])!.sign, -1);
  assert.equal(inverted([[0, -2], [3, 1]])!.sign, 1);
  assert.equal(inverted([[1, 2], [2, 4]]), null);
  assert.deepEqual(times([[1, 2], [3, 4]], [5, 6]), [17, 39]);
  assert.deepEqual(product([[1, 2], [3, 4]], [[0, 1], [1, 0]]), [[2, 1], [4, 3]]);
});

test("a four-bar's angles are those of its triangles, from any start near them", () => {
  const loops = fourbar(...LENGTHS);
  for (const q of [0, 0.7, 2, 3.5, 5.9]) {
    const wanted = closed(...LENGTHS, q);
    allNear(loops.newton([wanted[0] + 0.1, wanted[1] - 0.1, q])!, [...wanted, q], 1e-13);
    allNear(loops.gap(loops.turned([...wanted, q])), [0, 0], 1e-14);
  }
  assert.equal(fourbar(1, 1, 1, 5).newton([0.1, 0.2, 0.3]), null);
});

test("slopes are those of differences, and rates those of the closed form", () => {
  const loops = fourbar(...LENGTHS), q = 1.1, h = 1e-4, y = [...closed(...LENGTHS, q), q];
  const slopes = loops.slopes(loops.turned(y));
  y.forEach((_, i) => {
    const [before, after] = [-h, h].map((step) => loops.gap(loops.turned(y.map((each, k) => (k === i ? each + step : each)))));
    allNear(slopes[i], after.map((x, r) => (x - before[r]) / (2 * h)), 1e-7);
  });
  const found = loops.rates(y, [1])!, [past, now, next] = [-h, 0, h].map((step) => closed(...LENGTHS, q + step));
  [0, 1].forEach((k) => {
    near(found.rate[k], (next[k] - past[k]) / (2 * h), 1e-7);
    near(found.second[k], (next[k] - 2 * now[k] + past[k]) / h ** 2, 1e-6);
  });
});

test("a parallelogram's rocker turns with its crank, and its coupler does not turn", () => {
  const loops = fourbar(1, 4, 1, 4), found = loops.rates([0, 0.8, 0.8], [2])!;
  allNear(found.rate, [0, 2, 2], 1e-13);
  allNear(found.second, [0, 0, 0], 1e-12);
});

test("a swinging slide's rates are those of its closed form", () => {
  // r e^{iq} − s e^{iθ} + d = 0 with y = (θ, s, q): s² = r² + d² + 2 r d cos q, tan θ = r sin q / (d + r cos q).
  const [r, d, q, h] = [0.4, 1, 0.9, 1e-4];
  const loops = new Loops(
    [[0, 0, 0], [1, 0, 0], [0, 0, 1]], [[0, 1, 0]], [1], { re: [[d], [0], [r]], im: [[0], [0], [0]] }, { re: [[-1]], im: [[0]] }, [1, 1],
  );
  const place = (at: number) => [Math.atan2(r * Math.sin(at), d + r * Math.cos(at)), Math.sqrt(r * r + d * d + 2 * r * d * Math.cos(at))];
  const [past, now, next] = [-h, 0, h].map((step) => place(q + step));
  allNear(loops.newton([now[0] + 0.05, now[1] - 0.05, q])!, [...now, q], 1e-13);
  const found = loops.rates([...now, q], [1])!;
  [0, 1].forEach((k) => {
    near(found.rate[k], (next[k] - past[k]) / (2 * h), 1e-7);
    near(found.second[k], (next[k] - 2 * now[k] + past[k]) / h ** 2, 1e-6);
  });
});

test("loops opened by a gap close as the gap is taken back", () => {
  const loops = fourbar(...LENGTHS), q = 0.4, right = closed(...LENGTHS, q), wrong = [right[0] + 0.02, right[1], q];
  const open = loops.opened(loops.gap(loops.turned(wrong)));
  allNear(open.gap(open.turned([...wrong, 1])), [0, 0], 1e-14);
  allNear(open.newton([...wrong, 0])!.slice(0, 2), right, 1e-13);
});

test("the walk goes round with a crank-rocker and ends at its triangle", () => {
  const loops = fourbar(...LENGTHS), seen: number[] = [];
  const last = walk(loops, closed(...LENGTHS, 0), { from: [0], to: [2 * Math.PI], unit: [1] }, (a, b, tube) => {
    for (const share of [0.25, 0.5]) {
      const x = a.x + share * (b.x - a.x), found = cubic(a, b, x), wanted = closed(...LENGTHS, 2 * Math.PI * x);
      wanted.forEach((angle, k) => assert.ok(Math.abs(angle - found[k]) < tube[k] + 1e-12));
    }
    return seen.push(b.x) > 0;
  })!;
  allNear(last.y.slice(0, 2), closed(...LENGTHS, 0), 1e-12);
  assert.ok(seen.length > 5 && seen[seen.length - 1] === 1);
});

test("no step is certified through a change point or where nothing closes", () => {
  const flat = fourbar(1, 4, 1, 4);
  assert.equal(walk(flat, [0, 0.5], { from: [0.5], to: [4], unit: [1] }), null);
  const rocker = fourbar(3, 2, 2, 3);
  assert.equal(walk(rocker, closed(3, 2, 2, 3, 0.5), { from: [0.5], to: [Math.PI], unit: [1] }), null);
  const ends = [0.5, 4].map((q) => ({ x: q, y: [0, q, q], rate: [0, 1, 1], second: [0, 0, 0], sign: 1 }));
  assert.equal(certify(flat, ends[0], ends[1]).tube, null);
});

test("the cubic has the places and rates of its ends", () => {
  const [a, b] = [[1, 2], [3, -1]].map(([y, rate], k) => ({ x: k ? 4 : 2, y: [y], rate: [rate], second: [0], sign: 1 })), h = 1e-6;
  near(cubic(a, b, 2)[0], 1);
  near(cubic(a, b, 4)[0], 3);
  near((cubic(a, b, 2 + h)[0] - 1) / h, 2, 1e-5);
  near((3 - cubic(a, b, 4 - h)[0]) / h, -1, 1e-5);
});

/** A page's solver of the four-bar at so many positions, its rows by the closed form. */
function solved(count: number, lengths: readonly [number, number, number, number]) {
  const q = (i: number) => (i * 2 * Math.PI) / count, rows: Record<string, Float64Array> = {};
  const angles = Array.from({ length: count }, (_, i) => [q(i), ...closed(...lengths, q(i))]);
  ["crank", "coupler", "rocker"].forEach((link, k) => {
    rows[`e:${link}.x`] = Float64Array.from(angles, (each) => Math.cos(each[k]));
    rows[`e:${link}.y`] = Float64Array.from(angles, (each) => Math.sin(each[k]));
  });
  const values = { "crank.length": 1, "coupler.length": 3.5, "rocker.length": 3, base: 4 };
  const loops: LoopData = {
    unknowns: [["turn", "coupler"], ["turn", "rocker"]], drivers: ["driver"], turning: TURNING, sliding: [], owner: [],
    arms: [[0, 0, "", "base", -1, 0], [1, 0, "", "coupler.length", 1, 0], [2, 0, "", "rocker.length", -1, 0], [3, 0, "", "crank.length", 1, 0]],
    slides: [], size: 4, begin: closed(...LENGTHS, 0), fixed: ["base"], turns: {},
  };
  const solver = {
    n: count, data: { loops, values, positions: { inputs: [{ name: "driver", turns: true, values: null }] } },
    driver: (_: number, i: number) => q(i), main: { row: (name: string) => rows[name] },
  };
  return { branch: new Branch(solver as unknown as Solver), values, rows };
}

test("rows of the branch are certified at all positions, also after a change; those that leave it are not", () => {
  const { branch, values, rows } = solved(36, LENGTHS);
  assert.equal(branch.uncertain(values), 0);
  const longer = solved(36, [1.2, 3.5, 3, 4]);
  assert.equal(longer.branch.uncertain({ ...values, "crank.length": 1.2 }), 0);
  assert.equal(longer.branch.uncertain(values), 36);
  rows["e:rocker.y"][20] *= -1;
  assert.equal(branch.uncertain(values), 16);
  assert.equal(branch.uncertain({ ...values, base: 4.1 }), null);
});

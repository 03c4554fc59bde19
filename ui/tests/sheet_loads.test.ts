import assert from "node:assert/strict";
import test from "node:test";
import type { Load, Picture } from "../src/studio/picture";
import type { Vec } from "../src/shapes";
import { wedge } from "../src/studio/sheet/analysis";
import { scaled } from "../src/studio/sheet/backdrop";
import { Camera } from "../src/studio/sheet/camera";
import { drawnLoads, forceScale, nice, offLoad, Stand } from "../src/studio/sheet/loads";
import { beside } from "../src/studio/sheet/hand";
import { scale } from "../src/studio/sheet/scales";
import { Scene } from "../src/studio/sheet/scene";
import { aimed, direction } from "../src/studio/tools/aim";
import { closing, through } from "../src/studio/tools/target";
import { written } from "../src/studio/tools/written";
import { near } from "./near";

const DEGREE = Math.PI / 180, MM = 1e-3;
const force = (more: Partial<Load>): Load => ({ kind: "force", on: "ram", at: "B", angle: null, ends: [], size: "250 N", magnitude: 250, always: true, ...more });

/** A crank, a coupler and a ram on a guide that rises by 20 degrees, with loads and masses, as it is drawn. */
function standing(loads: Record<string, Load> = {}, more: Partial<Picture> = {}): Stand {
  const picture: Picture = {
    points: { O: [0, 0], A: [30 * MM, 40 * MM], B: [150 * MM, 60 * MM], S: [90 * MM, 150 * MM] }, fixed: ["O", "S"],
    links: { crank: ["O", "A"], coupler: ["A", "B"], ram: ["B"] }, driver: "crank", guided: ["B"], loads,
    guides: { guide: { guide: "frame", through: "G", block: "ram", at: "B", direction: 20 * DEGREE, ray: [] } }, ...more,
  };
  return new Stand(new Scene(picture, null, 0), picture, null, 0);
}

const camera = () => Object.assign(new Camera(), { scale: 2000, origin: [400, 400] as Vec, size: [900, 700] as Vec });

/** The angle between two directions, give or take turns. */
const between = (a: number, b: number) => Math.abs(Math.atan2(Math.sin(a - b), Math.cos(a - b)));

test("round values are 1, 2 or 5 times a power of ten, the next below", () => {
  for (let k = 0; k < 400; k++) {
    const value = 10 ** (12 * Math.random() - 6), found = nice(value), lead = Number(found.toExponential().split("e")[0]);
    assert.ok([1, 2, 5].includes(lead) && found <= value * (1 + 1e-9) && value < 2.5001 * found, `${value}: ${found}`);
  }
});

test("the largest force is drawn no longer than it may, and not much shorter", () => {
  for (const magnitude of [0.3, 7, 250, -85e3, 4.2e6]) {
    const long = Math.abs(magnitude) / forceScale({ a: force({ magnitude }), b: force({ magnitude: magnitude / 9 }) });
    assert.ok(long <= 140.001 && long >= 55, `${magnitude}: ${long}`);
  }
});

test("a force in a link turns with the link's axes", () => {
  const stand = standing(), turned = stand.direction(force({ held: "link", turn: 180 * DEGREE }))!;
  near(between(turned, 200 * DEGREE), 0);
  const square = stand.direction(force({ on: "coupler", held: "ray", ray: ["A", "B"], normal: true }))!;
  near(between(square, Math.atan2(20, 120) + Math.PI / 2), 0);
  assert.equal(stand.direction(force({ held: "velocity" })), null);
});

test("an arrow points at its point along its force, as long as it is large", () => {
  const stand = standing({ push: force({ held: "link", turn: 180 * DEGREE }) }), [{ from, to, acts }] = drawnLoads(stand, camera());
  const [x, y] = camera().screen([150 * MM, 60 * MM]), u: Vec = [Math.cos(20 * DEGREE), -Math.sin(20 * DEGREE)];
  assert.ok(acts);
  near(Math.hypot(to[0] - from[0], to[1] - from[1]), 250 / forceScale(stand.loads));
  near((from[0] - x) * u[1] - (from[1] - y) * u[0], 0);
  assert.ok((to[0] - x) * u[0] + (to[1] - y) * u[1] > 0, "its head is on the side that it comes from");
  const [push] = drawnLoads(stand, camera());
  assert.equal(push.name, "push");
  assert.ok(offLoad([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2 + 5], push) < 8);
  assert.ok(!(offLoad([x, y], push) < 8), "the point itself is not the load");
});

test("a spring that pushes is a gas spring, one without stiffness a cylinder", () => {
  const spring = (more: Partial<Load>) => force({ kind: "spring", between: [["frame", "S"], ["coupler", "B"]], stiffness: 2000, preload: 0, ...more });
  const stand = standing({ a: spring({}), b: spring({ preload: -200 }), c: spring({ preload: -200, stiffness: 0 }), d: spring({ kind: "damper" }) });
  assert.deepEqual(drawnLoads(stand, camera()).map(({ form }) => form), ["spring", "gas", "cylinder", "damper"]);
});

test("a mass centre is midway, at a point or in the axes of its link", () => {
  const mass = (centre: string | Vec | null) => standing({}, { masses: { crank: { mass: 1, size: "1 kg", centre } } }).centre("crank")!;
  for (const [found, [x, y]] of [[mass(null), [15, 20]], [mass("A"), [30, 40]], [mass([10 * MM, 5 * MM]), [6 - 4, 8 + 3]]] as [Vec, Vec][]) {
    near(found[0], x * MM);
    near(found[1], y * MM);
  }
});

test("a force is aimed along the guide, then upright, then in steps, unless it is free", () => {
  const stand = standing(), pull = (angle: number, long = 120): Vec => [long * Math.cos(angle * DEGREE), long * Math.sin(angle * DEGREE)];
  const found = (angle: number, link = "ram", free = false) => aimed(pull(angle), link, stand, free);
  const expected: [number, number, string][] = [[23, 200, "guide"], [197, 20, "guide"], [88, 270, "vertical"], [181.5, 0, "horizontal"], [47, 225, "steps"]];
  for (const [angle, way, snapped] of expected) {
    assert.equal(found(angle).snapped, snapped, `${angle}`);
    near(between(found(angle).angle, way * DEGREE), 0);
  }
  assert.deepEqual([found(23, "ram", true).snapped, found(52.5).snapped], ["", ""]);
  assert.equal(found(Math.atan2(20, 120) / DEGREE, "coupler").snapped, "link");
});

test("a force along a guide turns with it, one upright stays in space", () => {
  const stand = standing(), along = direction({ angle: 200 * DEGREE, snapped: "guide" }, "ram", stand), up = direction({ angle: 90 * DEGREE, snapped: "vertical" }, "ram", stand);
  assert.deepEqual([along.key, up.key], ["in_link", "direction"]);
  near(between(along.angle, Math.PI), 0);
  near(up.angle, Math.PI / 2);
});

test("a transmission angle is the acute one, whichever way the links go", () => {
  for (let k = 0; k < 200; k++) {
    const [a, b] = [7 * Math.random(), 7 * Math.random()], { from, to, back } = wedge([0, 0], a, b);
    near(Math.abs(to - from), Math.acos(Math.min(1, Math.abs(Math.cos(a - b)))), 1e-7);
    assert.equal(back !== null, Math.cos(a - b) < -1e-9);
    near(Math.sin(to - b), 0, 1e-7);
  }
});

test("a curve goes through the clicked places and back to the first where it is closed", () => {
  const places: Vec[] = [[0, 0], [3, 1], [4, 4], [-1, 3]];
  for (const closed of [true, false]) {
    const curve = through(places, closed), gaps = curve.map((p, k) => Math.hypot(p[0] - curve.at(k - 1)![0], p[1] - curve.at(k - 1)![1]));
    for (const [x, y] of places) assert.ok(curve.some(([u, v]) => Math.hypot(u - x, v - y) < 1e-12));
    assert.equal(Math.max(...gaps) < 1, closed);
  }
});

test("two places of a picture are as far apart as was typed, the first one stays", () => {
  const photo = { href: "", corner: [0.1, 0.4] as Vec, width: 0.3, shape: 0.75, opacity: 0.5, locked: false };
  const share = ([x, y]: Vec, { corner, width }: typeof photo): Vec => [(x - corner[0]) / width, (corner[1] - y) / width];
  const [a, b] = [[0.15, 0.3], [0.25, 0.22]] as [Vec, Vec], found = scaled(photo, [a, b], 0.5)!, [u, v] = share(b, photo);
  const moved: Vec = [found.corner[0] + u * found.width, found.corner[1] - v * found.width];
  near(Math.hypot(moved[0] - a[0], moved[1] - a[1]), 0.5);
  share(a, found).forEach((each, k) => near(each, share(a, photo)[k]));
  assert.equal(scaled(photo, [a, a], 0.5), null);
});

test("a scale's arrow is as long as its value is drawn", () => {
  const { long, text } = scale("velocity", 2 / 90);
  assert.equal(text, "1 m/s");
  near(long, 45);
});

test("numbers are written as a person would", () => {
  assert.deepEqual(
    [written(250, "force"), written(12500, "force"), written(-Math.PI, "angle"), written(0.0803, "length"), written(-1e-12, "length"), written(2000, "stiffness"), written(2 * Math.PI, "rate")],
    ["250 N", "12.5 kN", "180 deg", "80.3 mm", "0 mm", "2 N/mm", "60 rpm"],
  );
});

test("the values in hand stand beside the pointer, off the element and inside of the sheet", () => {
  const size: Vec = [180, 90], sheet: Vec = [900, 500];
  for (let k = 0; k < 500; k++) {
    const at: Vec = [40 + 820 * Math.random(), 40 + 420 * Math.random()], from: Vec = [900 * Math.random(), 500 * Math.random()];
    const [x, y] = beside(at, size, sheet, from), covers = ([u, v]: Vec) => u > x && u < x + size[0] && v > y && v < y + size[1];
    assert.ok(x >= 0 && y >= 0 && x + size[0] <= sheet[0] && y + size[1] <= sheet[1] && !covers(at));
  }
  assert.ok(beside([700, 200], size, sheet, [400, 300])[1] < 200, "away from where the element comes from");
});

test("a stroke closes where it comes by its start, and not where it only begins", () => {
  const round = (turns: number) => Array.from({ length: 100 }, (_, k): Vec => [100 * Math.cos((k / 99) * turns * 2 * Math.PI), 100 * Math.sin((k / 99) * turns * 2 * Math.PI)]);
  near(closing(round(1.1), 14)! / 99, 1 / 1.1, 0.01);
  assert.equal(closing(round(0.7), 14), null);
  assert.equal(closing(round(1), 14), 99);
});

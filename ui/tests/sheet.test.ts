// The sheet without a browser: camera, grid, what a place snaps to, what is under a place.
import assert from "node:assert/strict";
import test from "node:test";
import type { Picture } from "../src/studio/picture";
import type { Vec } from "../src/shapes";
import { Camera, FULL } from "../src/studio/sheet/camera";
import { inside, nearestOn } from "../src/studio/sheet/geometry";
import { spacing } from "../src/studio/sheet/grid";
import { boxed, under } from "../src/studio/sheet/hits";
import { pretty } from "../src/studio/sheet/names";
import { Scene } from "../src/studio/sheet/scene";
import { type Around, snap } from "../src/studio/sheet/snap";
import { allNear, near } from "./near";

const PICTURE: Picture = {
  points: { O1: [0, 0], O2: [0.16, 0], A: [0, 0.06], B: [0.14, 0.1], P: [0.05, 0.15], F: [0.3, 0.07] }, fixed: ["O1", "O2"],
  links: { crank: ["O1", "A"], coupler: ["A", "B", "P"], rocker: ["B", "O2"] }, driver: "crank", guided: [], loads: {},
};

function sheet(anchor: Vec | null = null, more: Partial<Around> = {}): Around {
  const camera = new Camera();
  [camera.scale, camera.origin, camera.size] = [FULL, [400, 500], [1000, 700]];
  return { scene: new Scene(PICTURE, null, 0), camera, anchor, avoid: [], keep: null, grid: 0.01, reach: 10, say: (key, values) => `${key} ${values?.name ?? ""}`.trim(), named: (name) => name, ...more };
}

test("the camera leads to the screen and back, and what is at a place stays there when it zooms", () => {
  const { camera } = sheet(), place: Vec = [0.03, -0.02];
  allNear(camera.screen(place), [400 + 72, 500 + 48]);
  allNear(camera.world(camera.screen(place)), place);
  const before = camera.world([130, 220]);
  for (const factor of [1.7, 0.2, 1e9]) {
    camera.zoom(factor, [130, 220]);
    allNear(camera.world([130, 220]), before, 1e-9);
  }
  camera.fit([-1, 0, 1, 0.5], 50);
  allNear(camera.screen([-1, 0.25]), [50, 350], 1e-9);
  allNear(camera.screen([1, 0.25]), [950, 350], 1e-9);
  // 100 px more at the left and 40 at the foot.
  camera.fit([-1, 0, 1, 0.5], 50, [100, 0, 0, 40]);
  allNear(camera.screen([-1, 0.25]), [150, 330], 1e-9);
  allNear(camera.screen([1, 0.25]), [950, 330], 1e-9);
});

test("lines of the grid are 1, 2 or 5 times a power of ten apart, never closer than can be told apart", () => {
  for (let scale = 2; scale < 1e6; scale *= 1.37) {
    const step = spacing(scale, 0), digit = step / 10 ** Math.floor(Math.log10(step) + 1e-9);
    assert.ok([1, 2, 5].some((each) => Math.abs(digit - each) < 1e-6), `${step}`);
    assert.ok(step * scale >= 14 * (1 - 1e-6) && step * scale < 35 * (1 + 1e-6), `${step * scale}`);
  }
  assert.equal(spacing(FULL, 0.01), 0.01);
  near(spacing(10, 0.01), 1.25);
});

test("a joint comes before all else, then what is aimed at on the grid, then lengths, links and directions", () => {
  const of = (place: Vec, anchor: Vec | null = null, more: Partial<Around> = {}) => snap(place, sheet(anchor, more));
  assert.deepEqual([of([0.1397, 0.1013])?.kind, of([0.1397, 0.1013])?.name], ["point", "B"]);
  assert.equal(of([0.1397, 0.1013], null, { avoid: ["B"] })?.kind, "grid");
  assert.deepEqual(of([0.2304, 0.0496])!.at, [0.23, 0.05]);
  const onLink = of([0.0015, 0.0347])!;
  assert.deepEqual([onLink.kind, onLink.name], ["link", "crank"]);
  allNear(onLink.at, [0, 0.0347]);
  // From F on: as long as the crank, 60 mm, in a direction that is not liked.
  const long = of([0.3 + 0.061 * Math.cos(1), 0.07 + 0.061 * Math.sin(1)], [0.3, 0.07])!;
  assert.deepEqual([long.kind, long.name], ["length", "crank"]);
  near(Math.hypot(long.at[0] - 0.3, long.at[1] - 0.07), 0.06);
  const level = of([0.4237, 0.0712], [0.3, 0.07])!;
  assert.deepEqual([level.kind, level.sentence], ["line", "sheet.snap_horizontal"]);
  allNear(level.at, [0.42, 0.07], 1e-9);
  const steep = of([0.3 + 0.133 * Math.cos(1.05), 0.07 + 0.133 * Math.sin(1.05)], [0.3, 0.07])!;
  assert.deepEqual([steep.kind, steep.sentence], ["angle", "60°"]);
  near(Math.atan2(steep.at[1] - 0.07, steep.at[0] - 0.3), Math.PI / 3);
  const rocker = Math.atan2(-0.1, 0.02), across = of([0.3 + 0.117 * Math.cos(rocker + Math.PI / 2), 0.07 + 0.117 * Math.sin(rocker + Math.PI / 2)], [0.3, 0.07])!;
  assert.equal(across.sentence, "sheet.snap_square_to rocker");
});

test("a direction that is held stays, the length goes by the grid; without snaps a place is as it is", () => {
  const held = snap([0.35, 0.2], sheet([0.3, 0.07], { keep: 0.5, grid: 0.005 }))!;
  near(Math.atan2(held.at[1] - 0.07, held.at[0] - 0.3), 0.5);
  const length = Math.hypot(held.at[0] - 0.3, held.at[1] - 0.07) / 0.005;
  near(length, Math.round(length), 1e-9);
  assert.equal(snap([0.2304, 0.0496], sheet(null, { grid: 0 })), null);
});

test("joints are under the pointer before points, points before links, and a click again finds the next", () => {
  const { scene, camera } = sheet(), at = (place: Vec) => under(camera.screen(place), scene, camera, 10).map(({ kind, name }) => `${kind} ${name}`);
  assert.deepEqual(at([0, 0.06]), ["point A", "link crank", "link coupler"]);
  assert.deepEqual(at([0.05, 0.15]), ["point P", "link coupler"]);
  assert.deepEqual(at([0.06, 0.1]), ["link coupler"]);
  assert.deepEqual(at([0.15, 0.05]), ["link rocker"]);
  assert.deepEqual(at([0.08, 0]), []);
});

test("a box to the right takes what is inside of it, to the left what it touches", () => {
  const { scene, camera } = sheet(), box = (whole: boolean) => boxed(camera.screen([-0.02, -0.02]), camera.screen([0.03, 0.08]), whole, scene, camera).map(({ name }) => name);
  assert.deepEqual(box(true), ["O1", "A", "crank"]);
  assert.deepEqual(box(false), ["O1", "A", "crank", "coupler"]);
  const across = boxed(camera.screen([0.07, 0.07]), camera.screen([0.09, 0.09]), false, scene, camera).map(({ name }) => name);
  assert.deepEqual(across, ["coupler"]);
});

test("places on stretches and in polygons; names with their index below", () => {
  allNear(nearestOn([3, 4], [0, 0], [10, 0]).at, [3, 0]);
  allNear(nearestOn([-3, 4], [0, 0], [10, 0]).at, [0, 0]);
  const square: Vec[] = [[0, 0], [2, 0], [2, 2], [0, 2]];
  assert.deepEqual([inside([1, 1], square), inside([3, 1], square), inside([1, -1], square)], [true, false, false]);
  assert.deepEqual(["O2", "A", "coupler.P", "crank", "B_12"].map(pretty), ["O₂", "A", "P", "crank", "B₁₂"]);
});

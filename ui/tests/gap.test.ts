import assert from "node:assert/strict";
import test from "node:test";
import type { Picture } from "../src/studio/picture";
import type { Session } from "../src/session";
import type { Vec } from "../src/shapes";
import type { Gap } from "../src/studio/outline";
import { boxOf, comeApart, placed } from "../src/studio/sheet/gap";
import { Scene } from "../src/studio/sheet/scene";

const GAP: Gap = {
  title: "", sentence: "", input: "110°", point: "B", ends: [[0.09, 0.03], [0.13, 0.02]], missing: 0.04, drawn: true, way: { centre: [0, 0], radius: 0.06, zero: 0 },
  reaches: [{ name: "coupler", centre: [-0.02, 0.056], radius: 0.11 }, { name: "rocker", centre: [0.22, 0], radius: 0.09 }],
  points: { O1: [0, 0], O2: [0.22, 0], A: [-0.02, 0.056] }, chains: [["coupler"], ["rocker"]], possible: [[-63, 63]], unit: "deg", lengths: [], remedies: [],
};
const PICTURE: Picture = {
  points: { O1: [0, 0], O2: [0.22, 0], A: [-0.02, 0.056], B: [0.1, 0.06] }, fixed: ["O1", "O2"], guided: [], driver: "crank", loads: {},
  links: { crank: ["O1", "A"], coupler: ["A", "B"], rocker: ["O2", "B"] },
} as unknown as Picture;

test("links that do not meet have their own ends", () => {
  const scene = comeApart(GAP, PICTURE, undefined, null);
  assert.deepEqual(scene.corners("coupler"), [[-0.02, 0.056], [0.09, 0.03]]);
  assert.deepEqual(scene.corners("rocker"), [[0.22, 0], [0.13, 0.02]]);
  assert.deepEqual(scene.at("B"), [0.09, 0.03]);
});

test("a block keeps the end on its guide, the rod gets its own", () => {
  const scene = comeApart(GAP, { ...PICTURE, guided: ["B"] }, undefined, null);
  assert.deepEqual(scene.at("B"), [0.13, 0.02]);
  assert.deepEqual(scene.corners("coupler"), [[-0.02, 0.056], [0.09, 0.03]]);
});

test("a point in hand is where the hand has it, for both links", () => {
  const scene = comeApart(GAP, PICTURE, undefined, { B: [0.1, 0.1] });
  assert.deepEqual([scene.corners("coupler")[1], scene.corners("rocker")[1]], [[0.1, 0.1], [0.1, 0.1]]);
});

test("links that hang loose go along with their joints, those that lie apart stay", () => {
  const place = { B: [0.2, 0.1], O1: [0, 0], O2: [0.22, 0], A: [0.05, 0.03] } as Record<string, Vec>;
  const row = (name: string) => [place[name.slice(2, -2)][name.endsWith("x") ? 0 : 1]];
  const session = { data: { points: Object.keys(place).map((key) => ({ key })) }, model: { main: { row, n: 1 }, solver: { whole: () => null } } } as unknown as Session;
  const points = { ...PICTURE.points, Y: [0.2, 0.16], Z: [0.3, 0.16], P: [1, 1], Q: [2, 1] } as Picture["points"];
  const links = { ...PICTURE.links, more: ["Y", "Z"], extra: ["B", "Y"], island: ["P", "Q"] };
  const scene = new Scene({ ...PICTURE, points, links, loose: ["more", "extra", "island"] }, session, 0);
  const places = ["Y", "Z", "P"].map((name) => scene.at(name)!.map((each) => Math.round(1000 * each)));
  assert.deepEqual(places, [[300, 200], [400, 200], [1000, 1000]]);
});

test("the box has what the links reach, only where the gap is drawn there", () => {
  const whole = boxOf(GAP, [0, 0, 0.22, 0.06])!;
  assert.deepEqual(whole.map((each) => Math.round(1000 * each)), [-130, -90, 310, 166]);
  assert.deepEqual(boxOf({ ...GAP, drawn: false }, [0, 0, 0.22, 0.06])!.map((each) => Math.round(1000 * each)), [-60, -60, 220, 60]);
});

test("a callout stays in the sheet and off the gap", () => {
  const size: Vec = [328, 240];
  for (const spot of [[100, 100], [900, 100], [900, 500], [100, 500], [500, 300]] as Vec[]) {
    const [x, y] = placed(size, spot, [spot], [1000, 600]);
    assert.ok(x >= 16 && y >= 16 && x + size[0] <= 984 && y + size[1] <= 584, String([x, y]));
    assert.ok(spot[0] < x || spot[0] > x + size[0] || spot[1] < y || spot[1] > y + size[1], String(spot));
  }
});

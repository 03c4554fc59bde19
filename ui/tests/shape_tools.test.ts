import assert from "node:assert/strict";
import test from "node:test";
import type { Action, Picture } from "../src/studio/picture";
import type { Vec } from "../src/shapes";
import type { Item } from "../src/studio/bench";
import { Camera } from "../src/studio/sheet/camera";
import { Scene } from "../src/studio/sheet/scene";
import { centres, radii, wheels } from "../src/studio/tools/gears";
import { dist } from "../src/studio/sheet/geometry";
import { meeting } from "../src/studio/tools/hand";
import { driven } from "../src/studio/tools/measure";
import { SHAPES } from "../src/studio/tools/shapes";
import type { Overlay, Sheet, Snap, Spot, Tool } from "../src/studio/tools/tool";
import { near } from "./near";

type Shape = keyof typeof SHAPES;
type Entries = Record<string, Record<string, string>>;

const MM = 1e-3, NEAR = 10;
const at = (x: number, y: number): Vec => [x * MM, y * MM];

// Two pivots, a crank and a coupler with a free end, a bar from the second pivot, a block that slides, and a lone point.
const PICTURE: Picture = {
  points: { O1: at(0, 0), O2: at(180, -20), A: at(28, 53), B: at(161, 96), C: at(240, 40), D: at(300, 0), L: at(0, 200) },
  fixed: ["O1", "O2"], links: { crank: ["O1", "A"], coupler: ["A", "B"], arm: ["O2", "C"], block: ["D"], plate: ["A", "B", "C"] },
  driver: null, guided: ["D"], loads: {},
};
const JOINTS: Entries = { guide1: { kind: "prismatic", guide: "frame", block: "block", at: "D" } };

/** A sheet without a browser: what a tool does to the text, says and selects. */
class Desk {
  readonly done: Action[][] = [];
  readonly said: string[] = [];
  selection: Item[] = [];
  spot: Spot | null = null;
  readonly scene: Scene;
  readonly camera = new Camera();
  readonly tool: Tool;
  admits = true;

  constructor(name: Shape, picture: Picture = PICTURE, joints: Entries = JOINTS) {
    const desk = { solved: { value: { outline: { entries: { joints }, lines: {} } } } };
    this.scene = new Scene(structuredClone(picture), null, 0);
    this.camera.scale = 2000;
    let made: Item[] = [];
    const bench = {
      desk, selectMade: (item: Item) => (this.selection = made = [item]), settings: { value: { unit: "mm" } }, locked: { value: new Set(["coupler.length"]) }, say: (key: string) => key, select: (...items: Item[]) => (this.selection = items),
    };
    Object.defineProperty(bench, "chosen", { get: () => (this.selection.length === 1 && this.selection !== made ? this.selection[0] : null) });
    const sheet = {
      bench, camera: this.camera, scene: this.scene, redraw() {}, take() {}, refuse: (key: string) => this.said.push(key),
      act: (actions: Action[]) => {
        if (this.admits) this.done.push(actions);
        for (const { places, point, at: there } of this.admits ? (actions as unknown as { places?: Record<string, Vec>; point?: string; at?: Vec }[]) : [])
          for (const [each, place] of Object.entries({ ...places, ...(point && there && { [point]: there }) }))
            this.scene.points.set(each, { name: each, key: "", at: place, fixed: false, links: [] });
        return Promise.resolve(this.admits ? ["made"] : null);
      },
    };
    Object.defineProperty(sheet, "spot", { get: () => this.spot });
    this.tool = SHAPES[name](sheet as unknown as Sheet);
  }

  look([x, y]: Vec): Spot {
    const free = at(x, y), { scene, camera } = this, under: Item[] = [];
    let snap: Snap | null = null;
    for (const point of scene.points.values())
      if (dist(point.at, free) * camera.scale < NEAR) {
        snap ??= { kind: "point", sentence: "", at: point.at, name: point.name };
        under.push({ kind: "point", name: point.name });
      }
    for (const link of Object.keys(scene.links)) {
      const corners = scene.corners(link);
      const on = corners.some((a, k) => {
        const b = corners[(k + 1) % corners.length], t = ((free[0] - a[0]) * (b[0] - a[0]) + (free[1] - a[1]) * (b[1] - a[1])) / dist(a, b) ** 2;
        return t > 0 && t < 1 && Math.abs((free[0] - a[0]) * (b[1] - a[1]) - (free[1] - a[1]) * (b[0] - a[0])) * camera.scale < NEAR * dist(a, b);
      });
      if (!on) continue;
      snap ??= { kind: "link", sentence: "", at: free, name: link };
      under.push({ kind: "link", name: link });
    }
    return { screen: camera.screen(free), place: snap?.at ?? free, free, snap, under, shift: false, alt: false, touch: false };
  }

  move(place: Vec): void {
    this.spot = this.look(place);
    this.tool.move?.(this.spot);
    const over: Overlay = { path() {}, circle() {}, text() {}, dimension() {} };
    this.tool.draw?.(over);
    this.tool.fields?.();
    this.tool.hint();
  }

  /** Does a step: a click (numbers), a typed value ("length=140"), Enter or Escape; lets the text follow. */
  async step(each: Vec | string): Promise<void> {
    if (each === "Enter") this.tool.enter?.();
    else if (each === "Escape") this.tool.escape();
    else if (typeof each === "string") assert.equal(this.tool.type!(each.split("=")[0], each.split("=")[1]), null, each);
    else {
      this.move(each);
      this.tool.down?.(this.spot!);
      this.tool.up?.(this.spot!);
    }
    await new Promise((go) => setImmediate(go));
    if (this.spot) this.move([this.spot.free[0] / MM, this.spot.free[1] / MM]);
  }

  async steps(all: (Vec | string)[]): Promise<this> {
    for (const each of all) await this.step(each);
    return this;
  }
}

const O1: Vec = [0, 0], O2: Vec = [180, -20], A: Vec = [28, 53], B: Vec = [161, 96], C: Vec = [240, 40], D: Vec = [300, 0], CRANK: Vec = [14, 26.5], ARM: Vec = [210, 10], NOWHERE: Vec = [-60, 120];

/** Numbers to a tenth of a micrometre, as places come out of angles. */
const rounded = (value: unknown): unknown =>
  typeof value === "number" ? Math.round(value * 1e7) / 1e7 + 0 : Array.isArray(value) ? value.map(rounded) : value && typeof value === "object" ? Object.fromEntries(Object.entries(value).map(([key, each]) => [key, rounded(each)])) : value;

const ROWS: [what: string, tool: Shape, steps: (Vec | string)[], made: Action[][]][] = [
  ["a pivot where nothing is", "pivot", [NOWHERE], [[{ do: "point", name: "O3", at: at(...NOWHERE), fixed: true }]]],
  ["a pivot at typed places", "pivot", [NOWHERE, "x=38", "y=7,8", "Enter"], [[{ do: "point", name: "O3", at: at(...NOWHERE), fixed: true }], [{ do: "point", name: "O3", at: at(38, 7.8), fixed: true }]]],
  ["a pivot of a joint, a joint of a pivot", "pivot", [B, O1], [[{ do: "fix", point: "B", fixed: true }], [{ do: "fix", point: "O1", fixed: false }]]],
  ["a pivot on a link", "pivot", [CRANK], [[{ do: "add_point", link: "crank", point: "O3", at: at(...CRANK) }, { do: "fix", point: "O3", fixed: true }]]],
  ["a chain of links that ends at its last joint", "link", [B, O2, NOWHERE, NOWHERE, O1], [
    [{ do: "link", points: ["B", "O2"], places: {} }], [{ do: "link", points: ["O2", "E"], places: { E: at(...NOWHERE) } }],
  ]],
  ["a link of typed length and angle, wherever the pointer is", "link", [O1, "length=140", "angle=90", "Enter"], [[{ do: "link", points: ["O1", "E"], places: { E: at(0, 140) }, length: "140 mm" }]]],
  ["a link of typed length towards the pointer", "link", [O1, "length=4 in", [-30, 40], "Escape"], [[{ do: "link", points: ["O1", "E"], places: { E: [-0.06096, 0.08128] }, length: "4 in" }]]],
  ["a typed length to a joint of the drawing", "link", [B, "length=120", O2], [[{ do: "link", points: ["B", "O2"], places: {}, length: "120 mm" }]]],
  ["a typed length whose place is a joint", "link", [O1, "length=200", "angle=90", "Enter"], [[{ do: "link", points: ["O1", "L"], places: {}, length: "200 mm" }]]],
  ["a link from a link to a link", "link", [CRANK, ARM], [[
    { do: "add_point", link: "crank", point: "E", at: at(...CRANK) }, { do: "add_point", link: "arm", point: "F", at: at(...ARM) },
    { do: "link", points: ["E", "F"], places: { E: at(...CRANK), F: at(...ARM) } },
  ]]],
  ["a plate that Enter closes", "plate", [O2, NOWHERE, [-60, 160], "Enter"], [[{ do: "link", points: ["O2", "E", "F"], places: { E: at(...NOWHERE), F: at(-60, 160) } }]]],
  ["a plate of three typed sides", "plate", [O1, "length=300", [400, 0], "length=400", "back=500", [300, 100], O1], [[
    { do: "link", points: ["O1", "E", "F"], places: { E: at(300, 0), F: at(300, 400) }, sides: ["300 mm", "400 mm", "500 mm"] },
  ]]],
  ["a guide in steps of 15°", "slider", [B, [261, 100]], [[{ do: "guide", at: "B", angle: 0 }]]],
  ["a guide of a typed angle", "slider", [B, "angle=-12,5°", "Enter"], [[{ do: "guide", at: "B", angle: -12.5 }]]],
  ["a guide in another link", "slider", [B, ARM], [[{ do: "slot", along: "arm", at: "B" }]]],
  ["a guide for a new point of a link", "slider", [CRANK, [14, 126]], [[{ do: "add_point", link: "crank", point: "E", at: at(...CRANK) }, { do: "guide", at: "E", angle: 90 }]]],
  ["a slot", "slot", [ARM, B], [[{ do: "slot", along: "arm", at: "B" }]]],
  ["a weld", "weld", [A], [[{ do: "weld", point: "A", on: true }]]],
  ["gears by their meeting point", "gears", [CRANK, ARM, [60, -20 / 3]], [[{ do: "gear", links: ["crank", "arm"], teeth: "20:40", inside: false }]]],
  ["gears by typed teeth, one inside", "gears", [CRANK, ARM, "teeth=20 : -60", "Enter"], [[{ do: "gear", links: ["crank", "arm"], teeth: "20:60", inside: true }]]],
  ["a rack", "rack", [CRANK, D], [[{ do: "rack", pinion: "crank", rack: "block" }]]],
  ["a cam with a typed lift", "cam", [CRANK, D, "lift=20", "Enter"], [[{ do: "cam", cam: "crank", at: "D", lift: "20 mm" }]]],
  ["a cam whose lift is clicked", "cam", [CRANK, D, [325, 0]], [[{ do: "cam", cam: "crank", at: "D", lift: "25 mm" }]]],
  ["the length of a link", "dimension", [CRANK, NOWHERE, "length=75", "Enter"], [[{ do: "set", path: ["links", "crank", "length"], value: "75 mm" }]]],
  ["the length between the joints of a link", "dimension", [O1, A, "length=75", "Enter"], [[{ do: "set", path: ["links", "crank", "length"], value: "75 mm" }]]],
  ["the distance of two pivots", "dimension", [O1, O2, [80, -80], "length=362.2154055", "Enter"], [[{ do: "set", path: ["frame", "points", "O2"], value: ["360 mm", "-40 mm"] }]]],
  ["the distance of a joint from a pivot, clicked either way", "dimension", [[0, 200], O1, [-40, 90], "length=100", "Enter"], [[{ do: "move", points: { L: at(0, 100) }, locked: ["coupler.length"] }]]],
];

for (const [what, name, steps, made] of ROWS) {
  test(`${name}: ${what}`, async () => {
    const desk = await new Desk(name).steps(steps);
    assert.deepEqual(rounded(desk.done), rounded(made));
    assert.deepEqual(desk.said, []);
  });
}

test("Escape at every step leaves the text as it was, and the tool as it was", async () => {
  for (const [what, name, steps, made] of ROWS)
    for (let k = 1; k < steps.length; k++) {
      const desk = await new Desk(name).steps(steps.slice(0, k)), before = desk.done.length;
      for (let n = 0; n < 12 && desk.tool.escape(); n++);
      assert.equal(desk.tool.escape(), false, `${name}: ${what}`);
      assert.equal(desk.done.length, before);
      assert.equal(desk.tool.anchor?.() ?? null, null);
      desk.done.length = 0;
      desk.selection = [];
      for (const point of desk.scene.points.keys()) if (!(point in PICTURE.points)) desk.scene.points.delete(point);
      await desk.steps(steps);
      assert.deepEqual(rounded(desk.done), rounded(made), `${name} once more: ${what}`);
    }
});

test("refused clicks say why, and write nothing", async () => {
  const rows: [tool: Shape, steps: (Vec | string)[], said: string][] = [
    ["link", [O1, A], "refuse.link_there"], ["plate", [O1, NOWHERE, "Enter"], "refuse.plate_few"], ["plate", [O1, A, B, A], "refuse.plate_twice"],
    ["plate", [O1, A, "length=1", "back=1", NOWHERE], "refuse.plate_sides"], ["slider", [NOWHERE], "refuse.slider_point"], ["slider", [O2], "refuse.slider_pivot"],
    ["slider", [[0, 200]], "refuse.slider_loose"], ["slider", [D], "refuse.slider_there"], ["slot", [NOWHERE], "refuse.slot_link"], ["slot", [D], "refuse.slot_short"],
    ["slot", [ARM, NOWHERE], "refuse.slot_point"], ["slot", [ARM, C], "refuse.slot_own"], ["weld", [NOWHERE], "refuse.weld_joint"], ["weld", [[0, 200]], "refuse.weld_single"],
    ["gears", [NOWHERE], "refuse.gears_link"], ["gears", [CRANK, CRANK], "refuse.gears_twice"], ["gears", [D], "refuse.gears_pivot"], ["gears", [CRANK, D], "refuse.gears_apart"],
    ["gears", [CRANK, ARM, "teeth=20:-20", "Enter"], "refuse.gears_inside"], ["rack", [D], "refuse.rack_pivot"], ["rack", [CRANK, ARM], "refuse.rack_slider"],
    ["rack", [CRANK, NOWHERE], "refuse.rack_none"], ["cam", [[94.5, 74.5]], "refuse.cam_pivot"], ["cam", [CRANK, NOWHERE], "refuse.cam_point"], ["cam", [CRANK, A], "refuse.cam_own"],
    ["cam", [CRANK, [0, 200]], "refuse.cam_follower"], ["cam", [CRANK, D, O1], "refuse.cam_lift"], ["dimension", [NOWHERE], "refuse.dimension_first"],
    ["dimension", [O1, NOWHERE], "refuse.dimension_second"],
  ];
  for (const [name, steps, said] of rows) {
    const desk = await new Desk(name).steps(steps);
    assert.deepEqual([desk.said, desk.done], [[said], []], `${name} ${said}`);
  }
});

test("typed texts that are no such value are refused with a sentence", () => {
  const link = new Desk("link");
  assert.deepEqual([link.tool.type!("length", "-3"), link.tool.type!("length", "3 kg"), link.tool.type!("angle", "north")], ["refuse.length", "refuse.length", "refuse.angle"]);
  assert.equal(new Desk("gears").tool.type!("teeth", "20"), "refuse.teeth");
});

test("what the text does not admit is in hand again", async () => {
  const desk = new Desk("link");
  desk.admits = false;
  await desk.steps([B, NOWHERE]);
  assert.deepEqual(desk.tool.anchor!(), at(...B));
  desk.admits = true;
  await desk.step(NOWHERE);
  assert.deepEqual(desk.done, [[{ do: "link", points: ["B", "E"], places: { E: at(...NOWHERE) } }]]);
  assert.deepEqual(desk.selection, [{ kind: "link", name: "made" }]);
});

test("after an undo a chain goes on from the joint before", async () => {
  const desk = await new Desk("link").steps([B, NOWHERE, [-60, 160]]);
  assert.deepEqual(desk.tool.anchor!(), at(-60, 160));
  desk.scene.points.delete("F");
  assert.deepEqual(desk.tool.anchor!(), at(...NOWHERE));
  desk.scene.points.delete("E");
  desk.scene.points.delete("B");
  assert.equal(desk.tool.anchor!(), null);
});

test("a drag draws a link from where it begins to where it ends", async () => {
  const desk = new Desk("link");
  desk.move(B);
  desk.tool.down!(desk.spot!);
  for (const place of [[170, 60], [176, 20], O2] as Vec[]) desk.move(place);
  desk.tool.up!(desk.spot!);
  assert.deepEqual(desk.done, [[{ do: "link", points: ["B", "O2"], places: {} }]]);
});

test("with a link selected a click of Plate adds a point to it, but not to the plate that was just drawn", async () => {
  const desk = new Desk("plate");
  desk.selection = [{ kind: "link", name: "coupler" }];
  await desk.steps([NOWHERE, C, A]);
  assert.deepEqual(desk.done, [[{ do: "add_point", link: "coupler", point: "E", at: at(...NOWHERE) }], [{ do: "add_point", link: "coupler", point: "C", at: at(...C) }]]);
  assert.deepEqual(desk.said, ["refuse.plate_own"]);
  assert.equal(desk.tool.escape(), true);
  assert.deepEqual(desk.selection, []);
  await desk.steps([O1, O2, NOWHERE, "Enter", C]);
  assert.equal(desk.done.length, 3);
  assert.deepEqual(desk.tool.anchor!(), at(...C));
});

test("a weld is taken back, and an angle of two links turns the second one", async () => {
  const weld = await new Desk("weld", PICTURE, { weld1: { kind: "weld", at: "A" } }).steps([A]);
  assert.deepEqual(weld.done, [[{ do: "weld", point: "A", on: false }]]);
  const right: Picture = { ...PICTURE, points: { O1: at(0, 0), A: at(100, 0), B: at(200, 0) }, fixed: ["O1"], links: { crank: ["O1", "A"], coupler: ["A", "B"] }, guided: [] };
  const angle = await new Desk("dimension", right).steps([[50, 0], [150, 0], [90, 30], "angle=90", "Enter"]), move = angle.done[0][0] as unknown as { points: Record<string, Vec> };
  near(dist(move.points.B, at(100, 0)), 0.1, 1e-12);
  near(move.points.B[0], 0.1, 1e-12);
  // The arm ends at a pivot: the crank turns, a quarter turn from the arm that goes straight up.
  const closed: Picture = { ...right, points: { O1: at(0, 0), A: at(100, 0), O2: at(100, 50) }, fixed: ["O1", "O2"], links: { crank: ["O1", "A"], arm: ["A", "O2"] } };
  const other = await new Desk("dimension", closed).steps([[50, 0], [100, 25], [90, 30], "angle=90", "Enter"]);
  assert.deepEqual(rounded(other.done[0][0].points), { O2: at(100, 50) });
  const open: Picture = { ...closed, fixed: ["O2"] };
  const turn = await new Desk("dimension", open).steps([[50, 0], [100, 25], [90, 30], "angle=180", "Enter"]);
  assert.deepEqual(rounded(turn.done[0][0].points), { O1: at(100, -100) });
});

test("a side of a plate is written where the text has it", () => {
  const scene = new Scene({ ...PICTURE, links: { plate: ["O1", "O2", "B"] } }, null, 0), bent = { plate: { points: ["O1", "O2", "B"], lengths: ["181 mm", "c"], angle: "30 deg" } };
  const set = (points: [string, string], entries = {}) => driven(scene, { kind: "distance", points }, 0.05, "50 mm", [], entries)[0];
  assert.deepEqual(set(["O2", "O1"], bent), { do: "set", path: ["links", "plate", "lengths"], value: ["50 mm", "c"] });
  assert.deepEqual(set(["O1", "B"], bent), { do: "set", path: ["links", "plate", "lengths"], value: ["181 mm", "50 mm"] });
  assert.deepEqual(set(["O2", "B"], bent), { do: "set", path: ["links", "plate", "angle"], value: "acos(((181 mm)^2 + (c)^2 - (50 mm)^2)/(2*(181 mm)*(c)))" });
  assert.equal(set(["O1", "B"], { plate: { points: ["O1", "O2"], length: "181 mm" } }).do, "move");
});

test("wheels meet where the pointer is: between the pivots outside each other, beyond one inside", () => {
  const a = at(0, 0), b = at(60, 0);
  assert.deepEqual(wheels(a, b, at(20, 5)), { teeth: [20, 40], inside: false });
  assert.deepEqual(wheels(a, b, at(40, -5)), { teeth: [40, 20], inside: false });
  assert.deepEqual(wheels(a, b, at(-30, 0)), { teeth: [20, 60], inside: true });
  assert.deepEqual(wheels(a, b, at(90, 0)), { teeth: [60, 20], inside: true });
  assert.deepEqual([wheels(a, b, at(20.4, 0)).teeth, wheels(a, b, at(20.4, 0), 1).teeth], [[20, 40], [20, 39]]);
  assert.deepEqual(radii({ teeth: [20, 40], inside: false }, 60), [20, 40]);
  assert.deepEqual(radii({ teeth: [20, 60], inside: true }, 40), [20, 60]);
});

test("wheels turn on the frame where they can, else on a link that is pinned to both", () => {
  const points = { O1: at(0, 0), S: at(5, 5), P: at(40, 0), Q: at(40, 9), O2: at(90, 0), R: at(90, 9) };
  const scene = new Scene({ ...PICTURE, points, fixed: ["O1", "O2"], links: { sun: ["O1", "S"], arm: ["O1", "P"], planet: ["P", "Q"], wheel: ["O2", "R"] } }, null, 0);
  assert.deepEqual([centres(scene, "sun", "wheel"), centres(scene, "sun", "planet"), centres(scene, "planet", "wheel")], [["O1", "O2"], ["O1", "P"], null]);
});

test("circles meet on the side that is asked for, by Pythagoras", () => {
  assert.deepEqual(rounded(meeting([0, 0], 4, [3, 0], 5, [-1, 1])), [0, 4]);
  assert.deepEqual(rounded(meeting([0, 0], 4, [3, 0], 5, [-1, -1])), [0, -4]);
  assert.equal(meeting([0, 0], 1, [3, 0], 1, [0, 1]), null);
});

import assert from "node:assert/strict";
import test from "node:test";
import type { Action, Picture } from "../src/studio/picture";
import type { Vec } from "../src/shapes";
import type { Item } from "../src/studio/bench";
import { Camera } from "../src/studio/sheet/camera";
import { Stand } from "../src/studio/sheet/loads";
import { Scene } from "../src/studio/sheet/scene";
import { makeDrive } from "../src/studio/tools/drive";
import { makeForce } from "../src/studio/tools/force";
import { makeMass } from "../src/studio/tools/mass";
import { makeSpring } from "../src/studio/tools/spring";
import type { MakeTool, Sheet, Snap, Spot, Tool } from "../src/studio/tools/tool";
import { makeTorque } from "../src/studio/tools/torque";

const MM = 1e-3, at = (x: number, y: number): Vec => [x * MM, y * MM];

// A crank with a pivot, a coupler, and a ram on a level guide.
const PICTURE: Picture = {
  points: { O1: at(0, 0), A: at(0, 50), B: at(120, 0), G: at(120, 0) }, fixed: ["O1", "G"], links: { crank: ["O1", "A"], coupler: ["A", "B"], ram: ["B"] },
  driver: null, guided: ["B"], loads: {}, masses: {}, drives: {},
  guides: { guide: { guide: "frame", through: "G", block: "ram", at: "B", direction: 0, ray: [] } },
};

/** A sheet without a browser: what a tool does to the text, says and selects. */
class Desk {
  readonly acted: Action[][] = [];
  readonly refused: string[] = [];
  picture: Picture = PICTURE;
  selected: Item[] = [];
  spring = "spring";
  readonly sheet: Sheet;
  tool: Tool;

  constructor(make: MakeTool, more: Partial<Picture> = {}) {
    this.picture = { ...PICTURE, ...more };
    const scene = new Scene(this.picture, null, 0), camera = Object.assign(new Camera(), { scale: 2000, origin: [300, 400] as Vec, size: [900, 700] as Vec });
    const bench = {
      say: (key: string) => key, select: (...items: Item[]) => (this.selected = items), settings: { value: { unit: "mm" } }, spring: { value: "spring" },
      desk: { solved: { value: { picture: this.picture, outline: { entries: {} } } } },
    };
    this.sheet = {
      bench, camera, scene, spot: null, stand: new Stand(scene, this.picture, null, 0), redraw: () => {},
      act: (actions: Action[]) => { this.acted.push(actions); return Promise.resolve(["made1"]); }, refuse: (key: string) => this.refused.push(key),
    } as unknown as Sheet;
    this.tool = make(this.sheet);
  }

  spot(place: Vec, under: Item[] = [], snap: Snap | null = null, alt = false): Spot {
    const spot = { screen: this.sheet.camera.screen(place), place, free: place, snap, under, shift: false, alt, touch: false };
    Object.assign(this.sheet, { spot });
    return spot;
  }

  click(spot: Spot): void {
    for (const step of ["move", "down", "up"] as const) this.tool[step]?.(spot);
  }

  drag(...spots: Spot[]): void {
    this.tool.move?.(spots[0]);
    this.tool.down?.(spots[0]);
    for (const spot of spots) this.tool.move?.(spot);
    this.tool.up?.(spots.at(-1)!);
  }

  on(name: string): Spot {
    const place = this.sheet.scene.at(name)!;
    return this.spot(place, [{ kind: "point", name }], { kind: "point", sentence: name, at: place, name });
  }

  along(link: string, place: Vec): Spot {
    return this.spot(place, [{ kind: "link", name: link }], { kind: "link", sentence: link, at: place, name: link });
  }

  get entry(): Record<string, unknown> {
    return this.acted[0].at(-1)!.entry as Record<string, unknown>;
  }
}

test("a force on the ram is aimed along its guide, with the size of its arrow", () => {
  const desk = new Desk(makeForce);
  desk.drag(desk.on("B"), desk.spot(at(150, 3)), desk.spot(at(180, 2)));
  const { magnitude, ...rest } = desk.entry;
  assert.deepEqual(rest, { kind: "force", on: "ram", at: "B", in_link: "180 deg" });
  // 60 mm are 120 px, of which the block takes 22; a pixel is 2 N where there is no force yet.
  assert.ok(Math.abs(Number.parseFloat(String(magnitude)) - 196) <= 10);
});

test("a force that is free points exactly where the hand is", () => {
  const desk = new Desk(makeForce);
  desk.click(desk.on("A"));
  desk.tool.move!(desk.spot(at(30, 77), [], null, true));
  desk.tool.down!(desk.spot(at(30, 77), [], null, true));
  desk.tool.up!(desk.spot(at(30, 77), [], null, true));
  const angle = (Math.atan2(-27, -30) * 180) / Math.PI;
  assert.equal(desk.entry.direction, `${Number(angle.toFixed(1))} deg`);
});

test("a press on a link makes a point there first; typed values win", () => {
  const desk = new Desk(makeForce);
  desk.click(desk.along("crank", at(0, 20)));
  desk.tool.move!(desk.spot(at(0, 60)));
  assert.equal(desk.tool.type!("size", "1.2 kN"), null);
  assert.equal(desk.tool.type!("direction", "35 deg"), null);
  assert.notEqual(desk.tool.type!("size", "much"), null);
  desk.tool.enter!();
  const [made, added] = desk.acted[0];
  assert.deepEqual([made.do, made.link, made.at], ["add_point", "crank", at(0, 20)]);
  assert.deepEqual(added.entry, { kind: "force", on: "crank", at: made.point, direction: "35 deg", magnitude: "1.2 kN" });
});

test("a torque has the sense and the share of a turn that the hand has gone", () => {
  for (const sense of [1, -1]) {
    const desk = new Desk(makeTorque), middle = at(0, 25), round = (angle: number) => desk.spot([middle[0] + 0.02 * Math.cos(angle), middle[1] + 0.02 * Math.sin(angle)], [{ kind: "link", name: "crank" }]);
    desk.drag(...Array.from({ length: 19 }, (_, k) => round(Math.PI / 2 + (sense * k * Math.PI) / 36)));
    const size = Number.parseFloat(String(desk.entry.magnitude));
    assert.ok(Math.abs(size - sense * 10) <= 0.5, `${size}`);
    assert.equal(desk.entry.on, "crank");
  }
});

test("a spring is as long as it is drawn; both ends on one body are refused", () => {
  const desk = new Desk(makeSpring);
  desk.click(desk.on("A"));
  desk.click(desk.along("coupler", at(60, 25)));
  assert.deepEqual(desk.refused, ["refuse.spring_link"]);
  desk.click(desk.spot(at(0, 90)));
  assert.deepEqual(desk.acted[0].map((each) => each.do), ["point", "add"]);
  const { between, free_length: free } = desk.entry as { between: string[]; free_length: string };
  assert.deepEqual([between[0], between[1].split(".")[0], free], ["coupler.A", "frame", "40 mm"]);
});

test("a link is driven about its pivot, a slider along its guide, again and it is not", () => {
  const desk = new Desk(makeDrive);
  desk.click(desk.along("crank", at(0, 20)));
  desk.click(desk.on("B"));
  desk.click(desk.along("coupler", at(60, 25)));
  assert.deepEqual(desk.acted.map(([first]) => first), [{ do: "driver", link: "crank", about: "O1" }, { do: "driver", slide: "guide" }]);
  assert.deepEqual(desk.acted[1][1], { do: "set", path: ["cycle"], value: "rock" });
  assert.deepEqual(desk.refused, ["refuse.drive_link"]);
  const driven = new Desk(makeDrive, { drives: { driver: { turn: "crank", about: "O1", slide: "", speed: "60 rpm", rate: 6 } } });
  driven.click(driven.along("crank", at(0, 20)));
  assert.deepEqual(driven.acted, [[{ do: "remove", items: [{ kind: "driver", name: "driver" }] }]]);
});

test("a mass is typed for a link, and its centre goes where it is dragged, in the link's axes", () => {
  const desk = new Desk(makeMass);
  desk.click(desk.along("coupler", at(60, 25)));
  desk.tool.type!("mass", "300 g");
  desk.tool.enter!();
  assert.deepEqual(desk.acted[0], [{ do: "mass", link: "coupler", mass: "300 g" }]);
  const heavy = new Desk(makeMass, { masses: { crank: { mass: 1, size: "1 kg", centre: null } } });
  heavy.drag(heavy.spot(at(0, 25)), heavy.spot(at(5, 30)), heavy.spot(at(10, 40)));
  // The crank's axes are turned by a right angle: 40 mm along it, 10 mm to its right.
  assert.deepEqual(heavy.acted[0], [{ do: "set", path: ["links", "crank", "mass_centre"], value: ["40 mm", "-10 mm"] }]);
});

test("Escape goes back one step at a time and leaves nothing behind", () => {
  for (const make of [makeForce, makeTorque, makeSpring, makeMass]) {
    const desk = new Desk(make), [field] = (desk.click(desk.along("crank", at(0, 20))), desk.tool.fields!());
    desk.tool.move!(desk.spot(at(60, 80)));
    assert.equal(desk.tool.type!(field.key, { force: "5 N", torque: "5 N·m", stiffness: "5 N/mm", mass: "5 kg" }[field.quantity as "force"]), null);
    assert.ok(desk.tool.escape(), "the value");
    assert.ok(desk.tool.escape(), "what was begun");
    assert.equal(desk.tool.escape(), false, "then there is nothing to go back");
    assert.deepEqual([desk.acted, desk.tool.fields!()], [[], []]);
  }
});

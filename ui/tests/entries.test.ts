import assert from "node:assert/strict";
import test from "node:test";
import { addressPath, at, driverOf, guideOf, isFixed, itemAtLine, linesOf, linksAt, loadsOn, type Table, written } from "../src/studio/inspector/entries";

const TEXT = `format: 1
frame:
  points: {O1: [0 mm, 0 mm], O2: [180 mm, -20 mm]}
links:
  crank: {points: [O1, A], length: 60 mm}
  coupler: {points: [A, B], length: 140 mm,
    also: {P: [50 mm, 30 mm]}} # the plate

  ram:
    points: [B]
    mass: 2 kg
joints:
  guide: {kind: prismatic, guide: frame, through: O2, direction: 0 deg, block: ram, at: B}
driver: {turn: crank, about: O1, speed: 60 rpm}
`;
const entries: Table = {
  format: "1", frame: { points: { O1: ["0 mm", "0 mm"], O2: ["180 mm", "-20 mm"] } },
  links: {
    crank: { points: ["O1", "A"], length: "60 mm" }, coupler: { points: ["A", "B"], length: "140 mm", also: { P: ["50 mm", "30 mm"] } }, ram: { points: ["B"], mass: "2 kg" },
    plate: { points: ["C", "D", "E"], lengths: ["140 mm", "90 mm"], angle: "40 deg", mass_centre: ["3 mm", "4 mm"] },
  },
  joints: { guide: { kind: "prismatic", guide: "frame", through: "O2", direction: "0 deg", block: "ram", at: "B" } },
  driver: { turn: "crank", about: "O1", speed: "60 rpm" },
  loads: { work: { kind: "force", on: "ram", at: "B", direction: "180 deg", magnitude: "1 kN" }, back: { kind: "spring", between: ["frame.O2", "ram.B"], stiffness: "2 N/mm" }, wind: { kind: "force", on: "plate", at: "C", components: ["10 N", "-20 N"] } },
  gravity: ["0", "-9.81 m/s²"], parameters: { H: "150 mm" },
};
const lines = { frame: 2, "frame.points": 3, "frame.points.O1": 3, links: 4, "links.crank": 5, "links.coupler": 6, "links.coupler.also": 7, "links.ram": 9, "links.ram.mass": 11, "joints.guide": 13, driver: 14 };
const outline = { entries, lines };

test("links, guides, loads and drives are found by the names of elements", () => {
  assert.deepEqual(linksAt(entries, "A"), ["crank", "coupler"]);
  assert.deepEqual(linksAt(entries, "P"), ["coupler"]);
  assert.ok(isFixed(entries, "O2") && !isFixed(entries, "A"));
  assert.equal(guideOf(entries, "ram")?.[0], "guide");
  assert.deepEqual(loadsOn(entries, "ram"), ["work", "back"]);
  assert.deepEqual(driverOf(entries, "crank")?.path, ["driver"]);
  const several = { drivers: { left: { turn: "a" }, lift: { slide: "guide" } } };
  assert.deepEqual(driverOf(several, "guide")?.path, ["drivers", "lift"]);
  assert.equal(driverOf({}, "driver"), null);
});

test("an address of a dimension leads to the value that the text has", () => {
  const rows: [address: string, value: string | undefined][] = [
    ["crank.length", "60 mm"], ["frame.O2.y", "-20 mm"], ["coupler.P.x", "50 mm"], ["guide.direction", "0 deg"], ["driver.speed", "60 rpm"], ["loads.work.magnitude", "1 kN"],
    ["plate.lengths.1", "90 mm"], ["plate.mass_centre.y", "4 mm"], ["loads.wind.components.y", "-20 N"], ["gravity.y", "-9.81 m/s²"], ["H", "150 mm"], ["nothing.here", undefined], ["gap", undefined],
  ];
  for (const [address, value] of rows) {
    const path = addressPath(entries, address);
    assert.equal(path === null ? undefined : at(entries, ...path), value, address);
  }
});

test("what stands in the file is its own lines, or the entry on one where it shares a line", () => {
  assert.equal(written(TEXT, outline, ["links", "crank"]), "crank: {points: [O1, A], length: 60 mm}");
  assert.equal(written(TEXT, outline, ["links", "coupler"]), "coupler: {points: [A, B], length: 140 mm,\n  also: {P: [50 mm, 30 mm]}} # the plate");
  assert.equal(written(TEXT, outline, ["links", "ram"]), "ram:\n  points: [B]\n  mass: 2 kg");
  assert.equal(written(TEXT, outline, ["frame", "points", "O2"]), "O2: [180 mm, -20 mm]");
  assert.equal(written(TEXT, outline, ["links", "none"]), "");
  assert.deepEqual(linesOf(TEXT, outline, ["links", "coupler"]), [6, 7]);
});

test("a line belongs to the element in which it stands", () => {
  assert.deepEqual(itemAtLine(outline, 7), { kind: "link", name: "coupler" });
  assert.deepEqual(itemAtLine(outline, 11), { kind: "link", name: "ram" });
  assert.deepEqual(itemAtLine(outline, 13), { kind: "pair", name: "guide" });
  assert.deepEqual(itemAtLine(outline, 14), { kind: "driver", name: "driver" });
  assert.equal(itemAtLine(outline, 1), null);
});

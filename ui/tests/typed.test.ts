import assert from "node:assert/strict";
import test from "node:test";
import { reads, shown, typed, type Quantity } from "../src/studio/tools/typed";
import { near } from "./near";

const DEGREE = Math.PI / 180;

test("a typed quantity is read with decimal comma or point, with any unit of its kind, and written as the file has it", () => {
  const rows: [text: string, quantity: Quantity, value: number, written: string][] = [
    ["140", "length", 0.14, "140 mm"], ["  117.70 ", "length", 0.1177, "117.70 mm"], ["4 in", "length", 0.1016, "4 in"], ['4"', "length", 0.1016, "4 in"],
    ["0,12 m", "length", 0.12, "0.12 m"], [".5m", "length", 0.5, "0.5 m"], ["12.", "length", 0.012, "12 mm"], ["１４０ 毫米", "length", 0.14, "140 mm"],
    ["-20", "length", -0.02, "-20 mm"], ["−20MM", "length", -0.02, "-20 mm"], ["007", "length", 0.007, "7 mm"], ["1e3 µm", "length", 1e-3, "1e3 µm"],
    ["35", "angle", 35 * DEGREE, "35 deg"], ["35°", "angle", 35 * DEGREE, "35 deg"], ["−80,9 度", "angle", -80.9 * DEGREE, "-80.9 deg"], ["1 rad", "angle", 1, "1 rad"],
    ["250", "force", 250, "250 N"], ["1.2 kN", "force", 1200, "1.2 kN"], ["3 kn", "force", 3000, "3 kN"], ["2 mN", "force", 0.002, "2 mN"], ["5 Nm", "torque", 5, "5 N·m"],
    ["2.4", "stiffness", 2400, "2.4 N/mm"], ["300 g", "mass", 0.3, "300 g"], ["3", "number", 3, "3"],
    ["20 : 40", "teeth", 2, "20:40"], ["20：40", "teeth", 2, "20:40"], ["20/-60", "teeth", -3, "20:-60"], ["17 34", "teeth", 2, "17:34"],
  ];
  for (const [text, quantity, value, written] of rows) {
    const found = typed(text, quantity);
    assert.ok(found, text);
    near(found.value, value, 1e-12);
    assert.equal(found.text, written, text);
  }
  for (const [text, quantity] of [["", "length"], ["abc", "length"], ["12 N", "length"], ["1.2.3", "length"], ["5 deg", "length"], ["4 mn", "force"], ["20", "teeth"], ["0:20", "teeth"], ["3 mm", "number"]] as [string, Quantity][])
    assert.equal(typed(text, quantity), null, text);
});

test("a bare length is in the unit of the sheet", () => {
  assert.deepEqual([typed("4", "length", "in"), typed("4", "length", "cm"), typed("4 mm", "length", "in")].map((each) => each?.text), ["4 in", "4 cm", "4 mm"]);
  near(typed("4", "length", "in")!.value, 0.1016, 1e-12);
});

test("values are shown without digits that mean nothing", () => {
  assert.deepEqual(shown(0.1177, "length"), ["117.7", "mm"]);
  assert.deepEqual(shown(0.14, "length"), ["140", "mm"]);
  assert.deepEqual(shown(-0.00001, "length"), ["0", "mm"]);
  assert.deepEqual(shown(0.1016, "length", "in"), ["4", "in"]);
  assert.deepEqual(shown(-80.9 * DEGREE, "angle"), ["−80.9", "°"]);
  assert.deepEqual([reads(2, "length", "m"), reads(Math.PI / 2, "angle"), reads(250, "force"), reads(3, "number")], ["2 m", "90°", "250 N", "3"]);
});

import assert from "node:assert/strict";
import test from "node:test";
import { inUnit, read, si, stepped, typed } from "../src/studio/inspector/quantities";
import { near } from "./near";

test("a typed text goes into the file with the unit of its field, as it was typed otherwise", () => {
  const rows: [text: string, unit: string, written: string][] = [
    ["100", "mm", "100 mm"], ["4 in", "mm", "4 in"], ["0,12 m", "mm", "0.12 m"], ["−80,9", "deg", "-80.9 deg"], ["１２", "mm", "12 mm"], ["35°", "deg", "35 deg"],
    ["179.5", "kg·mm²", "179.5 kg·mm²"], ["0.3", "", "0.3"], ["2*a + 5 mm", "mm", "2*a + 5 mm"], ["1,200", "mm", "1,200"], ["abc", "mm", "abc"], ["60 rpm", "rad/s", "60 rpm"], ["", "mm", ""],
  ];
  for (const [text, unit, written] of rows) assert.equal(typed(text, unit), written, text);
});

test("what the file has is a number with its unit, or an expression", () => {
  assert.deepEqual(read("60.5 mm"), { number: "60.5", unit: "mm", text: "60.5 mm" });
  assert.deepEqual(read("-9.81 m/s²"), { number: "-9.81", unit: "m/s²", text: "-9.81 m/s²" });
  assert.deepEqual(read("H/(2*sin(upper))"), { number: "", unit: "", text: "H/(2*sin(upper))" });
  assert.equal(read("2 mm*sin(t)").number, "");
});

test("arrow keys go by about a hundredth of the number's size, teeth by one", () => {
  const rows: [number: string, way: 1 | -1, share: number, next: string][] = [
    ["140", 1, 1, "141"], ["140", -1, 10, "130"], ["0.110", 1, 1, "0.111"], ["0.05", 1, 1, "0.051"], ["60", 1, 0.1, "60.1"], ["-170", 1, 1, "-169"], ["0", 1, 1, "1"], ["0.2", -1, 1, "0.199"],
  ];
  for (const [number, way, share, next] of rows) assert.equal(stepped(number, way, share), next, number);
  assert.equal(stepped("20", 1, 1, true), "21");
});

test("known units have their SI values", () => {
  near(si("4 in"), 0.1016);
  near(si("30 rpm"), Math.PI);
  near(si("2 kN"), 2000);
  near(si("180 deg"), Math.PI);
  assert.ok(Number.isNaN(si("3 furlongs")));
  assert.equal(inUnit(0.1177, "mm"), "117.7");
  assert.equal(inUnit(Math.PI / 6, "deg"), "30");
});

import assert from "node:assert/strict";
import test from "node:test";
import { Model } from "../src/model";
import { digits, quantity, unitFor, Words } from "../src/words";
import { readBack, written } from "../src/written";
import { dimension, sliderCrank } from "./machine";
import { near } from "./near";

/** A model of a text in which {name} stands for a number of 1, with the units of the names. */
function holding(text: string, units: Record<string, number>) {
  const { data, code } = sliderCrank(8), found: [string, number, number][] = [];
  const plain = text.split(/(\{\w+\})/).reduce((done, part) => {
    const name = /^\{(\w+)\}$/.exec(part)?.[1];
    if (!name) return done + part;
    const start = Array.from(done).length;
    found.push([name, start, start + 1]);
    return done + "1";
  }, "");
  data.text = plain;
  for (const [name, start, end] of found) {
    data.values[name] = units[name];
    data.dimensions.push(dimension(name, units[name], { factor: units[name], written: [start, end, "", ""] }));
  }
  return new Model(data, code);
}

test("changed numbers stand in their places, behind characters of every plane", () => {
  const model = holding("# 𝔸 🂡 曲柄\na: {one} mm # one\nb: {two} deg\n", { one: 1e-3, two: Math.PI / 180 });
  model.values = { ...model.values, one: 0.0125, two: Math.PI / 4 };
  assert.deepEqual(written(model), { text: "# 𝔸 🂡 曲柄\na: 12.5 mm # one\nb: 45 deg\n", missing: [] });
});

test("numbers that are written are read as the same, in few digits where they have few", () => {
  for (const [value, factor] of [[0.1 + 0.2, 1], [Math.PI, 1e-3], [1 / 3, Math.PI / 180], [0.0157, 1e-3], [-7e-9, 1]]) {
    const model = holding("{x}\n", { x: factor });
    model.values = { ...model.values, x: value };
    const { text } = written(model);
    near(Number(text) * factor, value, 3e-16);
    if (value === 0.0157) assert.equal(text, "15.7\n");
  }
});

test("what the text does not hold is said, what a drawing holds is not", () => {
  const model = holding("{x}\n", { x: 1 });
  model.data.dimensions.push(dimension("hidden", 1), dimension("drawn", 1, { drawn: true }));
  model.values = { ...model.values, hidden: 2, drawn: 2 };
  assert.deepEqual(written(model), { text: "1\n", missing: ["hidden"] });
});

test("the coordinates of a drawing are those of the machine where its drawing has it", () => {
  const { data, code } = sliderCrank(8);
  data.text = "B: [0, 0]\n";
  data.dimensions[1] = { ...data.dimensions[1], moves: true, written: null, drawn: true };
  // Drawn at 0.5 rad, which is no position.
  data.drawing = { input: 0.5, at: 0, places: [["p:B.x", [4, 5, "", " mm"], 1e-3], ["p:B.y", [7, 8, "", " mm"], 1e-3]] };
  const model = new Model(data, code);
  model.change({ ...model.values, "rod.length": 0.25 });
  const found = /^B: \[(\S+) mm, (\S+) mm\]\n$/.exec(written(model).text)!;
  near(Number(found[1]), 1e3 * (0.05 * Math.cos(0.5) + Math.sqrt(0.25 ** 2 - (0.05 * Math.sin(0.5) - 0.01) ** 2)), 1e-13);
  near(Number(found[2]), 10, 1e-13);
});

test("a text with other numbers in their places gives them, any other text is of another machine", () => {
  const own = "# 𝔸 (曲柄)\na: {one} mm # a+b?\nb: {two} deg\n", { data } = holding(own, { one: 1e-3, two: Math.PI / 180 });
  const now = Object.fromEntries(data.dimensions.map(({ address, value }) => [address, value]));
  const text = (one: string, two: string) => own.replace("{one}", one).replace("{two}", two);
  assert.deepEqual(readBack(data.text, data), now);
  assert.deepEqual(readBack(text("12.5", "-4.5e1"), data), { ...now, one: 0.0125, two: -45 * (Math.PI / 180) });
  for (const other of [text("1 ", "1"), text("one", "1"), text("1", "1..5"), text("1", "1e999"), text("2", "1").replace("曲柄", "摇杆"), `${text("2", "1")}c: 1\n`, "", ".*"])
    assert.equal(readBack(other, data), null, other);
});

test("numbers that a text has not yet, and its drawing, are read where a page writes them", () => {
  const model = holding("x: {x}\n", { x: 1 }), { data } = model;
  data.dimensions.push(dimension("turn", 0, { factor: 0.5, written: [4, 4, ", turn: ", " half"] }));
  data.drawing.places = [["p:B.x", [0, 1, "", ""], 1]];
  assert.equal(readBack("7: 3, turn: 8 half\n", data)!.turn, 4);
  assert.equal(readBack("7: 3\n", data)!.turn, 0);
  data.dimensions.push(dimension("rod", 1, { drawn: true }));
  assert.equal(readBack("7: 3\n", data), null);
  assert.equal(readBack("x: 3\n", data)!.x, 3);
});

test("digits as they are read", () => {
  const said: [number, string][] = [
    [1234.5678, "1235"], [0.1, "0.1"], [-2.5, "−2.5"], [100, "100"], [0, "0"], [1e-13, "0"], [NaN, "–"], [Infinity, "–"],
    [123456789, "1.23·10⁸"], [-5e12, "−5.00·10¹²"], [0.00001234, "0.00001234"], [120, "120"],
  ];
  for (const [value, text] of said) assert.equal(digits(value), text);
  assert.equal(digits(2 / 3, 2), "0.67");
});

test("quantities in units that read well for their size, rounding as nought", () => {
  assert.deepEqual(["m", "mm"], [unitFor("length", 1).symbol, unitFor("length", 0.999).symbol]);
  assert.equal(quantity(0.0125, "length"), "12.5 mm");
  assert.equal(quantity(Math.PI / 6, "angle"), "30°");
  assert.equal(quantity(25_000, "force"), "25 kN");
  assert.equal(quantity(500, "force", 25_000), "0.5 kN");
  assert.equal(quantity(1e-12, "length", 1), "0 m");
  assert.equal(quantity(1.5, "ratio"), "1.5");
});

test("sentences of the language that is chosen, with their values", () => {
  const words = new Words({ language: "en", words: { en: { a: "{x} of {y}" }, zh: { a: "{y} 的 {x}" } }, models: [] }, "en");
  assert.equal(words.say("a", { x: "1", y: "2" }), "1 of 2");
  words.language = "zh";
  assert.equal(words.say("a", { x: "1", y: "2" }), "2 的 1");
});

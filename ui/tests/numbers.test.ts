import assert from "node:assert/strict";
import test from "node:test";
import { Drive, through } from "../src/drive";
import { Model } from "../src/model";
import { formed } from "../src/numbers";
import { CRANK, OFFSET, packed, ROD, slider, sliderCrank } from "./machine";
import { near } from "./near";

const [OUT, IN] = [ROD + CRANK, ROD - CRANK].map((length) => Math.sqrt(length ** 2 - OFFSET ** 2));

test("stroke, quick return and least place are those between the positions", () => {
  for (const count of [23, 72, 97]) {
    const { data, code } = sliderCrank(count), numbers = new Model(data, code).numbers();
    near(numbers.range, OUT - IN, 1e-12);
    near(numbers.least, IN, 1e-12);
    // Both limits have crank and rod in a line.
    const way = Math.PI + Math.asin(OFFSET / (ROD - CRANK)) - Math.asin(OFFSET / (ROD + CRANK));
    near(numbers.ratio, way / (2 * Math.PI - way), 1e-9);
  }
});

test("largest value and mean square of a sine", () => {
  for (const [count, close] of [[37, 1e-8], [144, 1e-15]]) {
    const { data, code } = sliderCrank(count), numbers = new Model(data, code).numbers();
    near(numbers.largest, CRANK, 1e-12);
    near(numbers.rms, CRANK * Math.SQRT1_2, close);
  }
});

test("numbers follow a change of the dimensions", () => {
  const { data, code } = sliderCrank(72), model = new Model(data, code);
  model.change({ ...model.values, "crank.length": 0.06, "guide.offset": 0 });
  near(model.numbers().range, 0.12, 1e-12);
  near(model.numbers().ratio, 1, 1e-9);
  assert.equal(model.wall, null);
});

test("angles go on through turns, sizes and angles are made of two rows", () => {
  const { data, code } = sliderCrank(12), row = new Model(data, code).row("angle:crank");
  row.forEach((angle, i) => near(angle, (i * Math.PI) / 6, 1e-12));
  const signal = { id: "", rows: [], kind: "", name: { en: "", zh: "" } };
  assert.equal(formed({ ...signal, form: "size" }, 3, -4), 5);
  near(formed({ ...signal, form: "angle" }, -1, 1), 0.75 * Math.PI);
});

test("polynomials go through their samples and give those of their degree", () => {
  for (const count of [2, 5, 8])
    for (const x of [0.3, 1.7, count - 1.2]) {
      const weights = through(x, count), value = (of: (k: number) => number) => weights.reduce((sum, w, k) => sum + w * of(k), 0);
      for (let power = 0; power < count; power++) near(value((k) => k ** power), x ** power, 1e-9);
    }
  assert.deepEqual(through(2, 4).map((w) => Math.abs(w)), [0, 0, 1, 0]);
});

test("drivers between the positions follow their law within its pieces", () => {
  // A rise by t³ up to place 9, then standing still; five rows fit the cubic as it is.
  const law = (place: number) => (place < 9 ? (place / 9) ** 3 : 1), places = Array.from({ length: 20 }, (_, i) => i);
  const drive = new Drive({
    count: 20, closed: false, period: null, drift: 0, steady: null, modes: {}, breaks: [9], time: packed(places.map((i) => 2 + 0.1 * i)),
    arrays: { "rate:driver": packed(places.map((i) => (i < 9 ? i ** 2 / 243 : 0))) },
    inputs: [{ name: "driver", turns: true, values: packed(places.map(law)) }],
  });
  for (const place of [0.5, 4.25, 8.9, 9.1, 13.5, 18.7]) {
    const found = drive.at(place)!;
    near(found.time, 2 + 0.1 * place);
    near(found.input, law(place), 1e-12);
    near(found["cos:driver"], Math.cos(law(place)), 1e-12);
    near(found["rate:driver"], place < 9 ? place ** 2 / 243 : 0, 1e-12);
  }
  const short = new Drive({
    count: 6, closed: false, period: null, drift: 0, steady: null, modes: {}, breaks: [2], time: packed([0, 1, 2, 3, 4, 5]), arrays: {},
    inputs: [{ name: "driver", turns: true, values: packed([0, 1, 2, 3, 4, 5]) }],
  });
  assert.equal(short.at(1), null);
});

test("the slider is where Pythagoras has it, at the positions and between them", () => {
  const { data, code } = sliderCrank(8), model = new Model(data, code);
  model.row("s:guide").forEach((x, i) => near(x, slider((i * Math.PI) / 4)));
  for (const place of [0.5, 3.3, 7.9, -0.4, 11.25])
    near(model.solver.valueAt(place, (call) => call.row("s:guide")[0]), slider((place * Math.PI) / 4));
});

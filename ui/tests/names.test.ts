import assert from "node:assert/strict";
import test from "node:test";
import { Element, numbersOf } from "./paper";
import { Names } from "../src/names";
import type { Vec } from "../src/shapes";

type Box = [left: number, top: number, right: number, bottom: number];

/** Names written on paper of 400 by 300; their boxes, null where hidden. */
function written(places: Record<string, Vec>, ink: number[] = []) {
  const layer = new Element("g"), names = new Names(Object.keys(places), layer.svg), texts = layer.children as Element[];
  const boxes = (): (Box | null)[] => texts.map((text) => {
    if (text.attributes.visibility === "hidden") return null;
    // Letters of 14 pixels: the shift goes to the left end of their line.
    const [[x, y]] = numbersOf(text.attributes.transform), wide = 0.56 * 14 * text.textContent.length;
    return [x, y - 0.7 * 14, x + wide, y];
  });
  const write = (at: Record<string, Vec> = places, strokes = ink) => names.write((key) => at[key], strokes, 1, 400, 300);
  write();
  return { names, texts, boxes, write };
}

const meet = (a: Box, b: Box) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];

test("names of crowded points neither meet nor leave the paper", () => {
  const places: Record<string, Vec> = {};
  for (let k = 0; k < 12; k++) places[`P${k}`] = [200 + 25 * Math.cos(k), 150 + 25 * Math.sin(k)];
  Object.assign(places, { corner: [2, 2], far: [398, 298] });
  const shown = written(places).boxes();
  assert.equal(shown.length, 14);
  shown.forEach((box, i) => {
    assert.ok(box);
    assert.ok(box[0] >= 0 && box[1] >= 0 && box[2] <= 400 && box[3] <= 300);
    for (const other of shown.slice(0, i)) assert.ok(!meet(box, other!));
  });
});

test("a name keeps clear of strokes where it can, and stays while its place is free", () => {
  // Strokes to the right of and above the point.
  const { boxes, write } = written({ A: [200, 150] }, [200, 150, 300, 150, 200, 150, 200, 50, 200, 150, 300, 50]);
  const [box] = boxes();
  assert.ok(box![2] < 200 || box![1] > 150, String(box));
  write({ A: [200, 150] }, []);
  assert.deepEqual(boxes()[0], box);
  write({ A: [210, 150] }, []);
  assert.deepEqual(boxes()[0], [box![0] + 10, box![1], box![2] + 10, box![3]]);
});

test("a name without room is left out", () => {
  const { boxes, write } = written({ A: [200, 150] });
  assert.ok(boxes()[0]);
  write({ A: [-300, 150] });
  assert.equal(boxes()[0], null);
});

test("numbers behind short names are indices, longer names are whole, links are left out", () => {
  const { texts, names } = written({ "jaw.O12": [50, 50], foot2x: [100, 100], "A'": [150, 150], 轴3: [250, 250] });
  assert.equal(names.count, 4);
  assert.deepEqual(texts.map((each) => each.textContent), ["O12", "foot2x", "A'", "轴3"]);
  const indices = texts.map((each) => each.children.filter((child) => typeof child !== "string").map((child) => child.textContent));
  assert.deepEqual(indices, [["12"], [], [], ["3"]]);
});

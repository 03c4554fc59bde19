import assert from "node:assert/strict";
import test from "node:test";
import type { Glyph } from "../src/data";
import type { Model } from "../src/model";
import { amount, Shapes } from "../src/shapes";
import { near } from "./near";

const N = 72, TURN = 2 * Math.PI;
const plain = (value: number) => ({ value, factor: value, times: [], over: [] });

/** A model with these symbols, its rows given by functions of the position. */
function model(glyphs: Glyph[], rows: Record<string, (q: number) => number>, values: Record<string, number> = {}): Model {
  const made = Object.fromEntries(Object.entries(rows).map(([name, of]) => [name, Float64Array.from({ length: N }, (_, i) => of((i * TURN) / N))]));
  return { n: N, values, data: { glyphs }, main: { has: (name: string) => name in made, row: (name: string) => made[name] } } as unknown as Model;
}

test("amounts are products of dimensions where all are there", () => {
  assert.equal(amount({ value: 7, factor: 2, times: ["a", "b"], over: ["c"] }, { a: 3, b: 5, c: 10 }), 3);
  assert.equal(amount({ value: 7, factor: 2, times: ["a", "b"], over: ["c"] }, { a: 3, b: 5 }), 7);
});

/** A disc of radius R whose middle is e off its axis lifts a roller of radius r on the axis's vertical. */
function disc(touch: "roller" | "flat") {
  const [R, e, r, w] = [0.04, 0.012, 0.01, 5], high = (q: number) => (touch === "flat" ? e * Math.sin(q) + R : e * Math.sin(q) + Math.sqrt((R + r) ** 2 - (e * Math.cos(q)) ** 2));
  const h = 1e-6, rate = (q: number) => (w * (high(q + h) - high(q - h))) / (2 * h);
  const glyph: Glyph = {
    kind: "cam", layer: "", at: "O", trace: "P", link: "cam", follower: "held", carrier: "frame", joint: "guide", touch,
    radius: plain(touch === "flat" ? 0 : r), base: plain(R), groove: touch === "roller",
  };
  const zero = () => 0;
  const shapes = new Shapes(model([glyph], {
    "p:O.x": zero, "p:O.y": zero, "v:O.x": zero, "v:O.y": zero, "p:P.x": zero, "p:P.y": high, "v:P.x": zero, "v:P.y": rate,
    "e:cam.x": Math.cos, "e:cam.y": Math.sin, "w:cam": () => w, "d:guide.x": zero, "d:guide.y": () => 1,
  }));
  return { R, e, r, shape: shapes.cam(glyph) };
}

test("the cam of an eccentric's roller is the eccentric, its groove's walls and pitch curve circles about it", () => {
  const { R, e, r, shape } = disc("roller");
  assert.ok(shape.closed);
  for (const [curve, radius] of [[shape.profile, R], [shape.pitch, R + r], [shape.outer, R + 2 * r]] as const) {
    assert.equal(curve.length, N);
    for (const [x, y] of curve) near(Math.hypot(x - e, y), radius, 1e-7);
  }
});

test("a flat face touches the eccentric where it is highest, as far off as the eccentric goes", () => {
  const { R, e, shape } = disc("flat");
  for (const [x, y] of shape.profile) near(Math.hypot(x - e, y), R, 1e-7);
  const more = 0.1 * Math.max(2 * e, R);
  near(shape.face[0], -e - more, 1e-7);
  near(shape.face[1], e + more, 1e-7);
});

test("teeth of two wheels mesh: a tooth of one stands in a gap of the other on the line of centres", () => {
  const [line, a, b] = [0.4, 1.1, -0.7], [za, zb] = [17, 23];
  const wheel = (link: string, at: string, teeth: number, mesh?: number): Glyph => ({ kind: "wheel", layer: "", link, at, teeth, mesh, radius: plain(teeth / 1000) });
  const shapes = new Shapes(model([wheel("first", "A", za), wheel("second", "B", zb, 0)], {
    "p:A.x": () => 0, "p:A.y": () => 0, "p:B.x": () => Math.cos(line), "p:B.y": () => Math.sin(line),
    "e:first.x": () => Math.cos(a), "e:first.y": () => Math.sin(a), "e:second.x": () => Math.cos(b), "e:second.y": () => Math.sin(b),
  }));
  const u = ((line - a - shapes.tooth(0)) * za) / TURN, v = ((line + Math.PI - b - shapes.tooth(1)) * zb) / TURN;
  near(Math.abs(u + v - Math.floor(u + v) - 0.5), 0, 1e-12);
});

test("a wheel's radius follows from the distance of the centres and the ratio", () => {
  const rows = { "p:A.x": () => 0, "p:A.y": () => 0, "p:B.x": () => 0.09, "p:B.y": () => 0 };
  const pair = (ratio: number) => [false, true].map((second) => {
    const glyph: Glyph = { kind: "wheel", layer: "", points: ["A", "B"], ratio: plain(ratio), second };
    return new Shapes(model([glyph], rows)).radius(glyph);
  });
  const [big, small] = pair(-2);
  near(big + small, 0.09);
  near(Math.max(big, small) / Math.min(big, small), 2);
  const [ring, inner] = pair(2);
  near(Math.abs(ring - inner), 0.09);
});

test("a rack reaches as far as its pinion rolls", () => {
  const r = 0.02, z = 20, roll = (q: number) => r * Math.sin(q);
  const pinion: Glyph = { kind: "wheel", layer: "", link: "pinion", at: "C", teeth: z, radius: plain(r) };
  const rack: Glyph = { kind: "rack", layer: "", link: "rack", at: "G", mesh: 0, turn: plain(0) };
  const shapes = new Shapes(model([pinion, rack], {
    "p:C.x": roll, "p:C.y": () => r, "p:G.x": () => 0, "p:G.y": () => 0,
    "e:pinion.x": (q) => Math.cos(Math.sin(q)), "e:pinion.y": (q) => -Math.sin(Math.sin(q)),
  }));
  const { low, high, pitch, tooth } = shapes.rack(rack);
  near(low, -r, 1e-12);
  near(high, r, 1e-12);
  near(pitch!, (TURN * r) / z);
  // The pinion's tooth at angle 0 is a quarter turn, five teeth, from where it meets the rack: there the rack has a gap.
  near(Math.abs(tooth / pitch! - Math.round(tooth / pitch!)), 0.5, 1e-9);
});

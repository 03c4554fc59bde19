// Loads as they are drawn over the machine or the sketch: arrows as long as they are large, springs, weights, their sizes.
import type { Vec } from "../../shapes";
import { away, dashpot, line, unit, zigzag } from "../../strokes";
import type { Sheet, Overlay } from "../tools/tool";
import { quantity } from "../../words";
import { arcPath, arrowPath, type DrawnLoad, drawnLoads, ROUND, type Stand } from "./loads";

// Names that were given by the program say nothing beside the load.
const GIVEN = /^(force|load|torque|spring|damper|gas_spring|cylinder|torsion_spring)\d*$/;
const force = (size: number) => quantity(size, "force", size, 3);
// Lengths of a weight's arrow and of a cylinder's barrel, its half width, px.
const WEIGHT = 34, BARREL = 0.55, WIDE = 6;

/** Draws all loads. */
export function drawLoadMarks(sheet: Sheet, over: Overlay): void {
  const { bench, camera, stand } = sheet;
  if (!bench.shows("loads")) return;
  for (const each of drawnLoads(stand, camera)) {
    // The sketch of a text without a machine draws every pivot.
    if (stand.session) anchor(over, each, stand);
    const item = { kind: "load" as const, name: each.name }, on = bench.has(item), hot = bench.hovered.value?.kind === "load" && bench.hovered.value.name === each.name;
    drawOne(over, each, on || hot, stand.session !== null);
    const label = labelOf(each, stand);
    if (label) over.text(label.at, label.text, `${label.style}${on ? " strong" : ""}`);
  }
  weights(sheet, over, stand);
}

function drawOne(over: Overlay, load: DrawnLoad, lit: boolean, solved: boolean): void {
  const { form, from, to, acts, sense } = load, idle = acts ? "" : " dashed idle";
  switch (form) {
    case "arrow": {
      const [shaft, head] = arrowPath(from, to);
      if (lit) over.path(line([from, to]), "halo load");
      over.path(shaft, `load thick${idle}`);
      over.path(head, `load head${idle}`);
      if (lit) over.circle(from, 5, "load pin");
      return;
    }
    case "arc": {
      const [arc, head] = arcPath(from, ROUND, sense > 0 ? -0.5 : Math.PI + 0.5, sense > 0 ? Math.PI * 1.1 : -Math.PI * 0.1);
      if (lit) over.circle(from, ROUND, "halo load");
      over.path(arc, "load thick");
      over.path(head, "load head");
      return;
    }
    case "ring": case "twist": {
      if (lit) over.circle(from, ROUND, "halo load");
      if (!solved) over.circle(from, ROUND, "load dashed");
      return;
    }
  }
  if (lit) over.path(line([from, to]), "halo load");
  over.path(between(form, from, to), "coil");
}

/** The frame under an end of a spring that is held there by nothing else. */
function anchor(over: Overlay, { name, from, to, form }: DrawnLoad, { loads, scene }: Stand): void {
  if (form === "arrow" || form === "arc" || form === "ring" || form === "twist") return;
  (loads[name].between ?? []).forEach(([link, point], k) => {
    if (link !== "frame" || (scene.points.get(point)?.links.length ?? 0) > 0) return;
    const [at, other] = k ? [to, from] : [from, to], u = unit(other, at), spot = (far: number, side: number) => away(at, u, far, side);
    const hatch = [-11, -5, 1, 7, 13].map((side) => line([spot(16, side), spot(22, side - 5)])).join("");
    over.path(line([spot(3, -3), spot(16, -9), spot(16, 9), spot(3, 3)]) + line([spot(16, -14), spot(16, 14)]), "ground");
    over.path(hatch, "soft");
    over.circle(at, 5, "anchor pin");
  });
}

/** A spring, damper, gas spring or cylinder between two places. */
export function between(form: DrawnLoad["form"], from: Vec, to: Vec): string {
  if (form === "damper") return dashpot(from, to);
  if (form === "spring") return line(zigzag(from, to));
  const u = unit(from, to), long = Math.hypot(to[0] - from[0], to[1] - from[1]), end = BARREL * long, piston = form === "cylinder" ? 0.7 * end : 0.4 * end;
  const box: Vec[] = [[6, -WIDE], [end, -WIDE], [end, WIDE], [6, WIDE]];
  const rod = line([away(from, u, piston), to]) + line([away(from, u, piston, -WIDE), away(from, u, piston, WIDE)]);
  return line([from, away(from, u, 6)]) + line(box.map(([x, y]) => away(from, u, x, y)), true) + rod;
}

/** The size of a load, with a name that a person has given, and where it stands; null: nothing is to be said. */
function labelOf(load: DrawnLoad, stand: Stand): { at: Vec; text: string; style: string } | null {
  const { name, form, from, to, size, acts } = load, called = GIVEN.test(name) ? "" : `${name} `, solved = stand.force(name, stand.loads[name])?.force;
  const constant = stand.loads[name].magnitude, push = stand.loads[name].preload, now = (form === "gas" || form === "cylinder") && push ? force(Math.abs(push)) : form === "arrow" && solved ? force(Math.hypot(...solved)) : size;
  const text = `${called}${form === "arrow" && !acts ? (typeof constant === "number" ? `(${force(Math.abs(constant))})` : "") : now}`.trim().replace(" -", " −");
  if (!text) return null;
  if (form !== "arrow") {
    const [x, y] = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2], round = form === "arc" || form === "ring" || form === "twist";
    return { at: [x + (round ? ROUND + 5 : 14), y + (round ? -ROUND : 4)], text, style: `${round ? "load" : "soft"} start` };
  }
  const [u, v] = unit(from, to), flat = Math.abs(u) > 0.8;
  // Above the arrow, from its head on outwards: there is room where the load comes from.
  if (flat) return { at: [to[0] - 6 * Math.sign(u), to[1] - 8 - Math.abs(v) * 30], text, style: `load ${u > 0 ? "end" : "start"}` };
  return { at: [from[0] + (u <= 0 ? 8 : -8), from[1] + (v > 0 ? -2 : 10)], text, style: `load ${u <= 0 ? "start" : "end"}` };
}

// Of letters of labels: about how wide they are (of Chinese ones as well) and how far they rise and sink, px.
const WIDTH = 6.7, SQUARE = 13, RISE = 12, SINK = 4;

/** The box of all loads with their labels on the screen: left, top, right, bottom; null where none is drawn. */
export function loadsBox({ bench, camera, stand }: Sheet): [number, number, number, number] | null {
  const xs: number[] = [], ys: number[] = [];
  for (const each of bench.shows("loads") ? drawnLoads(stand, camera) : []) {
    const round = each.form === "arc" || each.form === "ring" || each.form === "twist" ? ROUND : 0, label = labelOf(each, stand);
    for (const [x, y] of [each.from, each.to]) {
      xs.push(x - round, x + round);
      ys.push(y - round, y + round);
    }
    if (!label) continue;
    const { at: [x, y], text, style } = label, wide = Array.from(text, (letter) => (letter > "\u2e80" ? SQUARE : WIDTH)).reduce((sum, one) => sum + one, 0);
    xs.push(x, style.endsWith("end") ? x - wide : x + wide);
    ys.push(y - RISE, y + SINK);
  }
  return xs.length ? [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)] : null;
}

/** Weights of links from their mass centres, where there is gravity. */
function weights({ bench, camera }: Sheet, over: Overlay, stand: Stand): void {
  const { gravity, masses = {} } = stand.picture, pull = gravity ? Math.hypot(...gravity) : 0;
  if (!gravity || !(pull > 0)) return;
  for (const link of Object.keys(masses)) {
    const { mass } = masses[link], centre = stand.centre(link);
    if (!centre || !mass) continue;
    const from = camera.screen(centre), to: Vec = [from[0] + (WEIGHT * gravity[0]) / pull, from[1] - (WEIGHT * gravity[1]) / pull], [shaft, head] = arrowPath(from, to);
    over.path(shaft, "load");
    over.path(head, "load head");
    if (bench.shows("centres") || bench.has({ kind: "link", name: link })) over.text([to[0] - 6, to[1] + 2], force(mass * pull), "load end");
  }
}

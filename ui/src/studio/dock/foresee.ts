// What is looked at but not taken yet, drawn over the sheet: a candidate's linkage with its curve.
import type { Drawing } from "../desk";
import { hull, line } from "../../strokes";
import type { Vec } from "../../shapes";
import type { Bench } from "../bench";
import type { Overlay } from "../tools/tool";

const layers = new WeakMap<Bench, Map<string, (over: Overlay) => void>>();

/** Draws a layer in place of the one that it was before; null takes it away. */
export function lay(bench: Bench, name: string, draw: ((over: Overlay, place: (at: Vec) => Vec) => void) | null): void {
  const sheet = bench.sheet.value, known = layers.get(bench) ?? new Map<string, (over: Overlay) => void>(), before = known.get(name);
  layers.set(bench, known);
  if (!sheet) return;
  if (before) sheet.layers.delete(before);
  known.delete(name);
  if (draw) {
    const layer = (over: Overlay) => draw(over, (at) => sheet.camera.screen(at));
    sheet.layers.add(layer);
    known.set(name, layer);
  }
  sheet.redraw();
}

/** Shows a candidate over the sheet; null: none. */
export function foresee(bench: Bench, candidate: { drawing: Drawing; curve: Vec[] } | null): void {
  lay(bench, "candidate", candidate && ((over, place) => {
    const { points, links, fixed } = candidate.drawing;
    if (candidate.curve.length > 1) over.path(line(candidate.curve.map(place)), "input");
    for (const own of Object.values(links)) {
      const at = own.map((name) => place(points[name]));
      if (at.length > 2) over.path(line(hull(at), true), "hand fill");
      else if (at.length === 2) over.path(line(at), "hand thick");
    }
    for (const [name, at] of Object.entries(points)) over.circle(place(at), fixed.includes(name) ? 6 : 4.5, "hand pin");
  }));
}

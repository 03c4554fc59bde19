// Names of elements in sentences: points with their index below, links with the points between which they are.
import type { Bench, Item } from "../bench";
import { reads } from "../tools/typed";
import { dist } from "./geometry";
import type { Scene } from "./scene";

const LOW = "₀₁₂₃₄₅₆₇₈₉", INDEXED = /^(\p{L}{1,2}'*)_?(\d+)$/u;

/** "O2" as "O₂". */
export function pretty(name: string): string {
  const short = name.replace(/.*\./, ""), [, stem, index] = INDEXED.exec(short) ?? [];
  return index ? stem + Array.from(index, (digit) => LOW[Number(digit)]).join("") : short;
}

/** What a point is called: pivot, joint or point. */
export function pointWords(bench: Bench, scene: Scene, name: string): string {
  const point = scene.points.get(name), kind = point?.fixed ? "pivot" : (point?.links.length ?? 0) > 1 ? "joint" : "point";
  const key = `sheet.${kind}_named`;
  return bench.say(key, { name: pretty(name) });
}

/** An element as it is spoken: "coupler, link from A to B, 140 mm". */
export function spoken(bench: Bench, scene: Scene, { kind, name }: Item): string {
  const { unit } = bench.settings.value;
  if (kind === "point") {
    const at = scene.at(name), [x, y] = at ? at.map((each) => reads(each, "length", unit)) : ["", ""];
    return bench.say("sheet.point_spoken", { name: pointWords(bench, scene, name), x, y });
  }
  if (kind === "link") {
    const points = scene.links[name] ?? [], corners = scene.corners(name);
    if (points.length === 2 && corners.length === 2)
      return bench.say("sheet.link_spoken", { name, from: pretty(points[0]), to: pretty(points[1]), length: reads(dist(corners[0], corners[1]), "length", unit) });
    return bench.say("sheet.plate_spoken", { name, points: points.map(pretty).join(", ") });
  }
  return name;
}

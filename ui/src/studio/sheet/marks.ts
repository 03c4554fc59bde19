// What is marked on the drawing: the selection, what is under the pointer, lengths and names of links.
import type { Vec } from "../../shapes";
import { away, far, hull, line, unit as along } from "../../strokes";
import type { Item } from "../bench";
import { reads } from "../tools/typed";
import { dist } from "./geometry";
import type { Pencil } from "./overlay";
import type { Board } from "./sheet";

/** Where the texts of lengths stand on the screen, by the address of the dimension. */
export type Placed = Map<string, Vec>;

// What pins take of a bar's ends; the least length of a bar with its length and its name beside it, px.
const PIN = 5.5, LEAST = 44, ASIDE = 15;

/** Marks under the machine and over it; gives where lengths stand. */
export function drawMarks(board: Board, below: Pencil, above: Pencil): Placed {
  const { bench } = board, hovered = bench.hovered.value, placed: Placed = new Map();
  for (const item of bench.selection.value) mark(board, item, below, above, true);
  if (hovered && !bench.has(hovered)) mark(board, hovered, below, above, false);
  lengths(board, above, placed, bench.shows("dimensions"));
  if (bench.shows("names")) linkNames(board, above);
  return placed;
}

function mark({ scene, camera }: Board, { kind, name }: Item, below: Pencil, above: Pencil, selected: boolean): void {
  const halo = selected ? "halo" : "halo faint";
  if (kind === "link") {
    const corners = scene.corners(name).map((each) => camera.screen(each));
    if (!corners.length) return;
    const wide = corners.length > 2, around = wide ? hull(corners) : corners;
    below.path(corners.length > 1 ? line(around, wide) : `M${corners[0][0] - 12} ${corners[0][1]}h24`, halo);
    if (selected && corners.length > 1)
      for (let k = wide ? 0 : 1; k < around.length; k++) {
        const [a, b] = [around.at(k - 1)!, around[k]], u = along(a, b);
        if (far(a, b) > 2 * PIN) above.path(line([away(a, u, PIN), away(b, u, -PIN)]), "selected");
      }
  }
  const at = kind === "point" ? scene.at(name) : kind === "pair" ? scene.pairs.find((each) => each.name === name)?.at : null;
  if (!at) return;
  if (selected) below.circle(camera.screen(at), 12, "halo round");
  above.circle(camera.screen(at), 5, selected ? "selected" : "hovered");
}

/** Lengths of bars: all of them, or those that a hand is changing. */
function lengths({ scene, camera, bench, measured }: Board, above: Pencil, placed: Placed, all: boolean): void {
  const { unit } = bench.settings.value, middle = centre([...scene.points.values()].map(({ at }) => camera.screen(at)));
  for (const [name, points] of Object.entries(scene.links)) {
    const [a, b] = scene.corners(name);
    const moved = measured.includes(name);
    if (points.length !== 2 || !a || !b || !(all || moved)) continue;
    const [p, q] = [camera.screen(a), camera.screen(b)];
    if (far(p, q) < LEAST) continue;
    const side = outer(p, q, middle), text = reads(dist(a, b), "length", unit), on = moved || bench.has({ kind: "link", name }) || bench.has({ kind: "dimension", name: `${name}.length` });
    above.dimension(p, q, text, on ? "hand" : "soft", 24 * side);
    const u = along(p, q);
    placed.set(`${name}.length`, [(p[0] + q[0]) / 2 + 24 * side * u[1], (p[1] + q[1]) / 2 - 24 * side * u[0]]);
  }
}

function linkNames({ scene, camera, bench }: Board, above: Pencil): void {
  const middle = centre([...scene.points.values()].map(({ at }) => camera.screen(at)));
  for (const name of Object.keys(scene.links)) {
    const corners = scene.corners(name).map((each) => camera.screen(each)), on = bench.has({ kind: "link", name });
    if (corners.length < 2 || Math.max(...corners.map((each) => far(each, corners[0]))) < LEAST) continue;
    if (corners.length > 2) {
      above.text(centre(corners), name, on ? "link-name hand" : "link-name");
      continue;
    }
    const [p, q] = corners, side = -outer(p, q, middle), u = along(p, q), at: Vec = [(p[0] + q[0]) / 2 + ASIDE * side * u[1], (p[1] + q[1]) / 2 - ASIDE * side * u[0] + 4];
    const flat = Math.abs(u[0]) > 0.8, style = flat ? "" : side * u[1] > 0 ? " start" : " end";
    above.text(at, name, `link-name${style}${on ? " hand" : ""}`);
  }
}

/** On which side of a bar the middle of the drawing is not: 1 or -1. */
function outer(p: Vec, q: Vec, middle: Vec): number {
  return (q[0] - p[0]) * (middle[1] - p[1]) - (q[1] - p[1]) * (middle[0] - p[0]) > 0 ? 1 : -1;
}

function centre(all: Vec[]): Vec {
  return all.length ? ([0, 1].map((k) => all.reduce((sum, each) => sum + each[k], 0) / all.length) as Vec) : [0, 0];
}

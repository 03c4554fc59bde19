// What is marked on the drawing: the selection, what is under the pointer, lengths and names of links.
import type { Vec } from "../../shapes";
import { away, far, hull, line, unit as along } from "../../strokes";
import type { Item } from "../bench";
import { exactly, reads, typed } from "../tools/typed";
import { dist } from "./geometry";
import type { Entry } from "../outline";
import type { Pencil } from "./overlay";
import type { Board } from "./sheet";

/** Where the texts of lengths stand on the screen, by the address of the dimension: their middles and their half widths
 *  along their lines. */
export type Placed = Map<string, { at: Vec; half: Vec }>;

// What pins take of a bar's ends; the least length of a bar with its length and its name beside it; how far these are from it; half a letter, px.
const PIN = 5.5, LEAST = 44, ASIDE = 15, OFF = 24, LETTER = 3.2;

/** Marks under the machine and over it; gives where lengths stand. */
export function drawMarks(board: Board, below: Pencil, above: Pencil): Placed {
  const { bench } = board, hovered = bench.hovered.value, placed: Placed = new Map();
  for (const item of bench.selection.value) mark(board, item, below, above, true);
  if (hovered && !bench.has(hovered)) mark(board, hovered, below, above, false);
  for (const { link, ends: [a, b], side, text, hand } of lengths(board)) {
    const u = along(a, b);
    above.dimension(a, b, text, hand ? "hand" : "soft", OFF * side);
    const out = OFF + 8, half = LETTER * text.length;
    placed.set(`${link}.length`, { at: [(a[0] + b[0]) / 2 + out * side * u[1], (a[1] + b[1]) / 2 - out * side * u[0]], half: [half * u[0], half * u[1]] });
  }
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
  const driven = kind === "driver" ? scene.drives.find((each) => each.name === name)?.at : null;
  if (driven) above.circle(camera.screen(driven), 24, "halo input");
  const at = kind === "point" ? scene.at(name) : kind === "pair" ? scene.pairs.find((each) => each.name === name)?.at : null;
  if (!at) return;
  if (selected) below.circle(camera.screen(at), 12, "halo round");
  above.circle(camera.screen(at), 5, selected ? "selected" : "hovered");
}

/** A length beside its bar, on the screen. */
export interface Length {
  link: string;
  ends: [Vec, Vec];
  /** On which side of the way from the first end to the second: 1 or -1. */
  side: number;
  text: string;
  hand: boolean;
}

/** Lengths of bars: all of them where dimensions are shown, else those that a hand is changing. */
export function lengths(board: Board): Length[] {
  const { scene, camera, bench, measured } = board, { unit } = bench.settings.value, all = bench.shows("dimensions");
  return Object.entries(scene.links).flatMap(([link, points]) => {
    const corners = scene.corners(link), moved = measured.includes(link);
    if (points.length !== 2 || corners.length !== 2 || !(all || moved)) return [];
    const ends = corners.map((each) => camera.screen(each)) as [Vec, Vec];
    if (far(...ends) < LEAST) return [];
    const hand = moved || bench.has({ kind: "link", name: link }) || bench.has({ kind: "dimension", name: `${link}.length` });
    return [{ link, ends, side: sideOf(board, link), text: moved || board.lifted ? reads(dist(corners[0], corners[1]), "length", unit) : lengthText(board, link, corners), hand }];
  });
}

const read = new WeakMap<object, Record<string, number>>();

/** The lengths that links have in the file, m. */
function writtenOf(links: Entry | undefined): Record<string, number | undefined> {
  if (typeof links !== "object" || Array.isArray(links)) return {};
  const known = read.get(links);
  if (known) return known;
  const found = Object.fromEntries(Object.entries(links).flatMap(([link, own]) => {
    const length = typeof own === "object" && !Array.isArray(own) && typeof own.length === "string" ? typed(own.length, "length") : null;
    return length ? [[link, length.value]] : [];
  }));
  read.set(links, found);
  return found;
}

/** A length as the file has it, where it does; else as it is drawn. */
function lengthText({ bench, solved }: Board, link: string, [a, b]: Vec[]): string {
  const { unit } = bench.settings.value, written = writtenOf(bench.desk.solved.value.outline?.entries.links)[link];
  const now = solved?.model.values[`${link}.length`] ?? written;
  if (now === undefined) return reads(dist(a, b), "length", unit);
  // What is tried out on the machine is in steps of a hand; what is written has its own digits.
  return written !== undefined && Math.abs(now - written) <= 1e-9 * written ? exactly(written, unit) : reads(now, "length", unit);
}

/** Strokes of lengths and their texts, which names keep clear of. */
export function inkOf(all: Length[]): number[] {
  return all.flatMap(({ ends: [a, b], side, text }) => {
    const u = along(a, b), out = ([x, y]: Vec, by: number): Vec => [x + by * side * u[1], y - by * side * u[0]], [p, q] = [out(a, OFF), out(b, OFF)];
    const middle = out([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], OFF + 8), half = LETTER * text.length;
    return [...p, ...q, ...out(a, 9), ...p, ...out(b, 9), ...q, middle[0] - half * u[0], middle[1] - half * u[1], middle[0] + half * u[0], middle[1] + half * u[1]];
  });
}

/** The side of a bar that is away from the middle of the drawing; it stays while the machine moves. */
function sideOf({ scene, camera, sides }: Board, link: string): number {
  const known = sides.get(link);
  if (known) return known;
  const [p, q] = scene.corners(link).map((each) => camera.screen(each)), middle = centre([...scene.points.values()].map(({ at }) => camera.screen(at)));
  const side = (q[0] - p[0]) * (middle[1] - p[1]) - (q[1] - p[1]) * (middle[0] - p[0]) > 0 ? 1 : -1;
  sides.set(link, side);
  return side;
}

function linkNames(board: Board, above: Pencil): void {
  const { scene, camera, bench } = board;
  for (const name of Object.keys(scene.links)) {
    const corners = scene.corners(name).map((each) => camera.screen(each)), on = bench.has({ kind: "link", name });
    if (corners.length < 2 || Math.max(...corners.map((each) => far(each, corners[0]))) < LEAST) continue;
    if (corners.length > 2) {
      above.text(centre(corners), name, on ? "link-name hand" : "link-name");
      continue;
    }
    const [p, q] = corners, side = -sideOf(board, name), u = along(p, q), at: Vec = [(p[0] + q[0]) / 2 + ASIDE * side * u[1], (p[1] + q[1]) / 2 - ASIDE * side * u[0] + 4];
    const flat = Math.abs(u[0]) > 0.8, style = flat ? "" : side * u[1] > 0 ? " start" : " end";
    above.text(at, name, `link-name${style}${on ? " hand" : ""}`);
  }
}

function centre(all: Vec[]): Vec {
  return all.length ? ([0, 1].map((k) => all.reduce((sum, each) => sum + each[k], 0) / all.length) as Vec) : [0, 0];
}

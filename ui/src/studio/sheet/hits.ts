// What is under the pointer, in the order of selection: heads of loads, joints, points, dimensions, links.
import type { Vec } from "../../shapes";
import { hull } from "../../strokes";
import type { Item } from "../bench";
import type { Camera } from "./camera";
import { dist, inside, minus, nearestOn, plus } from "./geometry";
import { type DrawnLoad, offLoad } from "./loads";
import type { Placed } from "./marks";
import type { Scene } from "./scene";

/** How near the pointer must come, px: a mouse, a finger. */
export const NEAR = 10, FINGER = 22;
// A block that slides reaches this far from its point, px.
const BLOCK: Vec = [15, 9];
// How near to the middle line of a text the pointer is on it, px.
const TEXT = 9;
// The arrow of what is driven is a part of a circle about its pivot between these radii, px.
const DRIVER: Vec = [19, 30];

/** The elements under a place of the screen; a click takes the first, another click there the next. */
export function under(screen: Vec, scene: Scene, camera: Camera, near: number, loads: DrawnLoad[] = [], marks: Placed = new Map()): Item[] {
  const found: { rank: number; far: number; item: Item }[] = [];
  const add = (rank: number, far: number, item: Item, most = near) => {
    if (far <= most) found.push({ rank, far, item });
  };
  for (const load of loads) add(0, offLoad(screen, load), { kind: "load", name: load.name });
  for (const { name, at, fixed, links } of scene.points.values())
    add(fixed || links.length > 1 ? 1 : 2, dist(screen, camera.screen(at)), { kind: "point", name });
  for (const [name, { at, half }] of marks) add(3, dist(screen, nearestOn(screen, minus(at, half), plus(at, half)).at), { kind: "dimension", name }, TEXT);
  for (const { name, at } of scene.pairs) {
    const place = at && camera.screen(at);
    if (place && Math.abs(screen[0] - place[0]) <= BLOCK[0] && Math.abs(screen[1] - place[1]) <= BLOCK[0]) add(4, dist(screen, place), { kind: "pair", name }, Infinity);
  }
  for (const { name, at } of scene.drives) {
    const far = at ? dist(screen, camera.screen(at)) : Infinity;
    if (far > DRIVER[0] && far < DRIVER[1]) add(6, 0, { kind: "driver", name });
  }
  for (const name of Object.keys(scene.links)) add(5, linkDistance(screen, scene, camera, name), { kind: "link", name });
  return found.sort((a, b) => a.rank - b.rank || a.far - b.far).map(({ item }) => item);
}

/** How far a place of the screen is from a link, px; inside of a plate: a little, so that a bar on it comes first. */
export function linkDistance(screen: Vec, scene: Scene, camera: Camera, link: string): number {
  const corners = scene.corners(link).map((each) => camera.screen(each));
  if (corners.length < 2) return Infinity;
  const around = corners.length > 2 ? hull(corners) : corners;
  let best = Infinity;
  for (let k = 0; k < around.length; k++) best = Math.min(best, dist(screen, nearestOn(screen, around[k], around[(k + 1) % around.length]).at));
  return around.length > 2 && inside(screen, around) ? Math.min(best, 4) : best;
}

/** The elements in a box of the screen: all of each inside, or touched. */
export function boxed([ax, ay]: Vec, [bx, by]: Vec, whole: boolean, scene: Scene, camera: Camera): Item[] {
  const [left, right, top, low] = [Math.min(ax, bx), Math.max(ax, bx), Math.min(ay, by), Math.max(ay, by)];
  const within = ([x, y]: Vec) => x >= left && x <= right && y >= top && y <= low;
  const found: Item[] = [];
  for (const { name, at } of scene.points.values()) if (within(camera.screen(at))) found.push({ kind: "point", name });
  for (const name of Object.keys(scene.links)) {
    const corners = scene.corners(name).map((each) => camera.screen(each));
    if (!corners.length) continue;
    const touched = corners.some(within) || corners.some((a, k) => crosses(a, corners[(k + 1) % corners.length], [left, top, right, low]));
    if (whole ? corners.every(within) : touched) found.push({ kind: "link", name });
  }
  return found;
}

/** Whether a stretch crosses a box. */
function crosses(a: Vec, b: Vec, [left, top, right, low]: [number, number, number, number]): boolean {
  let first = 0, last = 1;
  for (const [from, step, least, most] of [[a[0], b[0] - a[0], left, right], [a[1], b[1] - a[1], top, low]]) {
    if (!step) {
      if (from < least || from > most) return false;
      continue;
    }
    const [p, q] = [(least - from) / step, (most - from) / step];
    first = Math.max(first, Math.min(p, q));
    last = Math.min(last, Math.max(p, q));
  }
  return last > first;
}

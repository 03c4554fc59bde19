// To what a place in hand snaps: joints and points, ends of equal lengths, links, directions, the grid, in this order.
import type { Vec } from "../../shapes";
import type { Snap } from "../tools/tool";
import type { Camera } from "./camera";
import { dist, heading, minus, nearestOn, plus, polar, times } from "./geometry";
import type { Scene } from "./scene";

/** How near a snap takes hold, px; directions take hold nearer, for there are many of them. */
export const REACH = 10;
const DIRECTION = 6, AIMED = 3, STEP = Math.PI / 12, SAME = 1e-9;

/** What a place is snapped with. `anchor`: from where lengths run; `avoid`: points in hand; `keep`: a direction that is
 *  held (rad); `grid`: spacing, m, 0: none; `say`: the sentences. */
export interface Around {
  scene: Scene;
  camera: Camera;
  anchor: Vec | null;
  avoid: string[];
  keep: number | null;
  grid: number;
  reach: number;
  say: (key: string, values?: Record<string, string>) => string;
  named: (point: string) => string;
}

export function snap(free: Vec, around: Around): Snap | null {
  if (around.keep !== null && around.anchor) return held(free, around);
  return onPoint(free, around) ?? onCorner(free, around) ?? ofLength(free, around) ?? onLink(free, around) ?? inDirection(free, around) ?? onGrid(free, around);
}

/** Who aims at a corner of the grid means it, though lengths and directions are near. */
function onCorner(free: Vec, around: Around): Snap | null {
  const found = onGrid(free, around);
  if (!found || pixels(around, free, found.at) > AIMED || around.grid * around.camera.scale < 4 * AIMED) return null;
  return { ...(inDirection(found.at, around, SAME) ?? found), at: found.at };
}

const pixels = ({ camera }: Around, a: Vec, b: Vec) => dist(a, b) * camera.scale;

function onPoint(free: Vec, around: Around): Snap | null {
  let best = around.reach, found: Snap | null = null;
  for (const { name, at } of around.scene.points.values()) {
    const far = around.avoid.includes(name) ? Infinity : pixels(around, free, at);
    if (far <= best) [best, found] = [far, { kind: "point", sentence: around.named(name), at, name }];
  }
  return found;
}

/** Where the length from the anchor is that of another link, near a direction that is liked, too. */
function ofLength(free: Vec, around: Around): Snap | null {
  const { anchor, scene, avoid } = around;
  if (!anchor) return null;
  const length = dist(anchor, free), angle = heading(anchor, free);
  let best = DIRECTION, found: Snap | null = null;
  for (const link of Object.keys(scene.links)) {
    const points = scene.links[link], corners = scene.corners(link);
    if (corners.length !== 2 || points.some((each) => avoid.includes(each))) continue;
    const own = dist(corners[0], corners[1]), off = Math.abs(own - length) * around.camera.scale;
    if (off < best && own > 0) {
      const way = liked(free, around)?.angle ?? angle;
      [best, found] = [off, { kind: "length", sentence: around.say("sheet.snap_as_long", { name: link }), at: plus(anchor, polar(own, way)), name: link }];
    }
  }
  return found;
}

function onLink(free: Vec, around: Around): Snap | null {
  const { scene, avoid } = around;
  let best = around.reach, found: Snap | null = null;
  for (const link of Object.keys(scene.links)) {
    const corners = scene.corners(link);
    if (corners.length < 2 || scene.links[link].some((each) => avoid.includes(each))) continue;
    for (let k = 0; k < (corners.length > 2 ? corners.length : 1); k++) {
      const { at, share } = nearestOn(free, corners[k], corners[(k + 1) % corners.length]), far = pixels(around, free, at);
      if (share > 0 && share < 1 && far < best) [best, found] = [far, { kind: "link", sentence: around.say("sheet.snap_on_link", { name: link }), at, name: link }];
    }
  }
  return found;
}

/** The direction from the anchor that is nearest: across or up, square or parallel to a link, in steps of 15°. */
function liked(free: Vec, around: Around, reach = DIRECTION): { angle: number; sentence: string; name: string; kind: Snap["kind"] } | null {
  const { anchor, scene, avoid } = around;
  if (!anchor || dist(anchor, free) < SAME) return null;
  const angle = heading(anchor, free), length = dist(anchor, free) * around.camera.scale;
  const away = (other: number) => {
    const turn = Math.abs(Math.atan2(Math.sin(angle - other), Math.cos(angle - other)));
    return turn < 1 ? length * Math.sin(turn) : Infinity;
  };
  const nearest = STEP * Math.round(angle / STEP), square = Math.abs(Math.sin(2 * nearest)) < SAME;
  if (square && away(nearest) <= reach)
    return { angle: nearest, sentence: around.say(Math.abs(Math.sin(nearest)) < 0.5 ? "sheet.snap_horizontal" : "sheet.snap_vertical"), name: "", kind: "line" };
  for (const link of Object.keys(scene.links)) {
    const corners = scene.corners(link);
    if (corners.length !== 2 || scene.links[link].some((each) => avoid.includes(each))) continue;
    const own = heading(corners[0], corners[1]);
    for (let k = 0; k < 4; k++) {
      const way = own + (k * Math.PI) / 2;
      if (away(way) <= reach / 2) return { angle: way, sentence: around.say(k % 2 ? "sheet.snap_square_to" : "sheet.snap_parallel_to", { name: link }), name: link, kind: "line" };
    }
  }
  if (away(nearest) > reach) return null;
  return { angle: nearest, sentence: `${Math.round((nearest * 180) / Math.PI)}°`.replace("-", "−"), name: "", kind: "angle" };
}

function inDirection(free: Vec, around: Around, reach = DIRECTION): Snap | null {
  const { anchor } = around, found = liked(free, around, reach);
  if (!anchor || !found) return null;
  return { kind: found.kind, sentence: found.sentence, name: found.name, at: along(anchor, free, found.angle, around.grid) };
}

/** A place in a direction from the anchor, its length in steps of the grid. */
function along(anchor: Vec, free: Vec, angle: number, grid: number): Vec {
  const [u, v] = polar(1, angle), [x, y] = minus(free, anchor), length = x * u + y * v;
  return plus(anchor, times(grid ? grid * Math.round(length / grid) : length, [u, v]));
}

function held(free: Vec, around: Around): Snap {
  const angle = around.keep!, at = along(around.anchor!, free, angle, around.grid);
  return { kind: "angle", sentence: around.say("sheet.snap_kept", { angle: `${Math.round((angle * 1800) / Math.PI) / 10}°`.replace("-", "−") }), at, name: "" };
}

function onGrid(free: Vec, { grid }: Around): Snap | null {
  if (!grid) return null;
  const near = (value: number) => Math.round(value / grid) * grid;
  return { kind: "grid", sentence: "", at: [near(free[0]), near(free[1])], name: "" };
}

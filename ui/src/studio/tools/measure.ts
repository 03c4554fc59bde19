// What a dimension measures, and how its value drives the drawing: lengths of links, sides of plates, distances, angles.
import type { Action } from "../picture";
import type { Vec } from "../../shapes";
import type { Item } from "../bench";
import type { Entry } from "../outline";
import type { Scene } from "../sheet/scene";
import { dist, heading } from "../sheet/geometry";
import { beyond, pivotOf, turned } from "./hand";

/** What is measured: the length of a bar, the distance of two points, the angle of the second link from the first. */
export type Measure =
  | { kind: "length"; link: string; points: [string, string] }
  | { kind: "distance"; points: [string, string] }
  | { kind: "angle"; links: [string, string]; arms: [Arm, Arm] };

/** A link seen as a direction: from the point about which it would turn to another one. */
type Arm = [from: string, to: string];

/** What the picked elements measure; null: there is one more to pick. */
export function measured(scene: Scene, picked: Item[]): Measure | null {
  const [first, second] = picked;
  if (first?.kind === "link" && second) return between(scene, first.name, second.name);
  if (first?.kind === "link") return ends(scene, scene.links[first.name].slice(0, 2) as [string, string]);
  return second ? ends(scene, [first.name, second.name]) : null;
}

function ends(scene: Scene, points: [string, string]): Measure {
  const link = Object.keys(scene.links).find((name) => scene.links[name].length === 2 && points.every((each) => scene.links[name].includes(each)));
  return link ? { kind: "length", link, points } : { kind: "distance", points };
}

/** The angle at the joint of two links; where they have none, as each turns about its pivot or its first point. */
function between(scene: Scene, a: string, b: string): Measure {
  const common = scene.links[a].find((point) => scene.links[b].includes(point));
  const arm = (link: string): Arm => {
    const from = common ?? pivotOf(scene, link) ?? scene.links[link][0];
    return [from, scene.links[link].find((point) => point !== from)!];
  };
  return { kind: "angle", links: [a, b], arms: [arm(a), arm(b)] };
}

/** The directions of the two arms of an angle. */
export function directions(scene: Scene, { arms }: Measure & { kind: "angle" }): [number, number] {
  return arms.map(([from, to]) => heading(scene.at(from)!, scene.at(to)!)) as [number, number];
}

export function sizeOf(scene: Scene, measure: Measure): number {
  if (measure.kind !== "angle") return dist(scene.at(measure.points[0])!, scene.at(measure.points[1])!);
  const [a, b] = directions(scene, measure);
  return Math.abs(turned(b - a));
}

/** What gives a measure its value (SI), with its text; `links`: their entries in the text. */
export function driven(scene: Scene, measure: Measure, value: number, text: string, locked: string[], links: { [link: string]: Entry } = {}): Action[] {
  if (measure.kind === "length") return [{ do: "set", path: ["links", measure.link, "length"], value: text }];
  const whole = measure.kind === "distance" && written(scene, measure.points, text, links);
  if (whole) return [whole];
  if (measure.kind === "angle") return [{ do: "move", points: turnedTo(scene, measure, value), locked }];
  // The point that is clicked last moves, but a pivot only where both are pivots.
  const fixed = (point: string) => scene.points.get(point)!.fixed, [a, b] = measure.points;
  const [from, to] = fixed(b) && !fixed(a) ? [b, a] : [a, b], at = beyond(scene.at(from)!, value, heading(scene.at(from)!, scene.at(to)!));
  if (fixed(to)) return [{ do: "set", path: ["frame", "points", to], value: at.map((each) => `${Number((1e3 * each).toFixed(4))} mm`) }];
  return [{ do: "move", points: { [to]: at }, locked }];
}

/** Where the points of a link are when it has been turned to an angle: of the second link, unless only the first is free to turn. */
function turnedTo(scene: Scene, measure: Measure & { kind: "angle" }, value: number): Record<string, Vec> {
  const [a, b] = directions(scene, measure), bent = turned(b - a), turn = (bent < 0 ? -value : value) - bent;
  const others = measure.links.map((link, k) => scene.links[link].filter((point) => point !== measure.arms[k][0] && scene.at(point)));
  const [first, second] = others.map((points) => points.every((point) => !scene.points.get(point)!.fixed)), k = first && !second ? 0 : 1;
  const centre = scene.at(measure.arms[k][0])!, by = k ? turn : -turn;
  return Object.fromEntries(others[k].map((point) => {
    const place = scene.at(point)!;
    return [point, beyond(centre, dist(centre, place), heading(centre, place) + by)];
  }));
}

/** Writes the side of a plate that the text has as a number; null where it has none. */
function written(scene: Scene, points: [string, string], text: string, links: { [link: string]: Entry }): Action | null {
  for (const [link, entry] of Object.entries(links)) {
    const at = points.map((point) => scene.links[link]?.indexOf(point) ?? -1).sort((a, b) => a - b).join();
    if (typeof entry === "string" || Array.isArray(entry)) continue;
    const { length, lengths } = entry;
    if (at === "0,1" && typeof length === "string") return { do: "set", path: ["links", link, "length"], value: text };
    if (!Array.isArray(lengths) || lengths.length !== 2) continue;
    const [a, c] = lengths.map(String), set = (path: string[], value: unknown) => ({ do: "set", path: ["links", link, ...path], value });
    if (at === "0,1") return set(["lengths"], [text, c]);
    if (at === "0,2") return set(["lengths"], [a, text]);
    // The third side is that of the angle between the two.
    const [o, p, q] = scene.corners(link), right = (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]) < 0;
    if (at === "1,2") return set(["angle"], `${right ? "-" : ""}acos(((${a})^2 + (${c})^2 - (${text})^2)/(2*(${a})*(${c})))`);
  }
  return null;
}

/** A bar as it is, of a plate the two points whose side is nearest to a place. */
export function nearestSide(scene: Scene, link: string, at: Vec): Item[] {
  const points = scene.links[link].filter((point) => scene.at(point));
  if (points.length < 3) return [{ kind: "link", name: link }];
  const sides = points.map((point, k) => [point, points[(k + 1) % points.length]]);
  // How much longer the way over the place is than the side itself.
  const off = (each: string[]) => each.reduce((sum, point) => sum + dist(scene.at(point)!, at), 0) - dist(scene.at(each[0])!, scene.at(each[1])!);
  return sides.reduce((best, each) => (off(each) < off(best) ? each : best)).map((name) => ({ kind: "point", name }));
}

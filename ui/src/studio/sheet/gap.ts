// A gap on the sheet: the ends that do not meet, how far the links to them reach, where the driven link can go.
import type { Picture } from "../picture";
import type { Vec } from "../../shapes";
import { line, tenth } from "../../strokes";
import type { Entry, Gap, Remedy } from "../outline";
import type { Overlay } from "../tools/tool";
import { reads } from "../tools/typed";
import type { Camera } from "./camera";
import { dist } from "./geometry";
import { Scene } from "./scene";

const DEGREE = Math.PI / 180;
// Distance of the dimension from the gap, of words from what they name; radius of a joint, px.
const ASIDE = 22, CLEAR = 12, PIN = 5;

/** The words of what is drawn, in the language of the page. */
export interface Words {
  reach(link: string): string;
  unit: "mm" | "cm" | "m" | "in";
  reaches: boolean;
  /** Which end has its name already. */
  named: number | null;
}

/** What is said of a gap where a picture has been drawn of the machine. */
export const namedEnd = ({ drawn, point }: Gap, picture: Picture) => (drawn ? ownEnd(point, picture) : null);


/** What stands on the sheet where the drawn position cannot be assembled: each end at its own link. */
export function comeApart({ points, ends, point, chains }: Gap, picture: Picture, joints: Entry | undefined, lifted: Record<string, Vec> | null): Scene {
  const own = ownEnd(point, picture), there = { ...points, ...(ends ? { [point]: ends[own] } : {}) };
  const known = Object.fromEntries(Object.keys(picture.points).filter((name) => name in there).map((name) => [name, there[name]]));
  const scene = new Scene({ ...picture, points: { ...known, ...there } }, null, 0, joints, lifted);
  if (ends && !lifted) for (const link of chains[1 - own]) scene.apart[link] = { [point]: ends[1 - own] };
  return scene;
}

/** Which of the two ends has the point itself: of a block the one on its guide. */
const ownEnd = (point: string, { guided }: Picture) => (guided.includes(point) ? 1 : 0);

/** Draws a gap over the sheet. */
export function drawGap(over: Overlay, gap: Gap, camera: Camera, words: Words): void {
  if (words.reaches && gap.drawn) gap.reaches.forEach((each, k) => reach(over, camera, each, k ? "reach two" : "reach", words.reach(each.name)));
  way(over, gap, camera);
  if (!gap.ends) return;
  if (!gap.drawn) broken(over, gap, camera);
  const [a, b] = gap.ends.map((each) => camera.screen(each));
  over.path(line([a, b]), "rift");
  over.dimension(a, b, reads(gap.missing, "length", words.unit), "bad strong", b[0] < a[0] ? -ASIDE : ASIDE);
  for (const at of [a, b]) over.circle(at, PIN, "bad pin");
  [a, b].forEach((at, k) => {
    if (k !== words.named) over.text([at[0] + (at[0] < (k ? a : b)[0] ? -CLEAR : CLEAR) / 2, at[1] + (k === 0 && words.named === 1 ? -14 : 24)], gap.point, "name");
  });
}

function reach(over: Overlay, camera: Camera, { centre, radius }: Gap["reaches"][number], style: string, text: string): void {
  const at = camera.screen(centre), size = radius * camera.scale, two = style !== "reach";
  over.circle(at, tenth(size), style);
  const corner: Vec = two ? [at[0] + 0.62 * size, at[1] - 0.79 * size] : [at[0] - 0.62 * size, at[1] - 0.79 * size];
  over.text([corner[0] + (two ? CLEAR : -CLEAR), corner[1] - 4], text, two ? "soft start" : "soft end");
}

/** The circle of the driven pin, its possible parts strong, with the angles of their ends. */
function way(over: Overlay, { way: circle, possible, unit }: Gap, camera: Camera): void {
  if (!circle || unit !== "deg") return;
  const at = camera.screen(circle.centre), size = circle.radius * camera.scale;
  over.circle(at, tenth(size), "crank-way");
  for (const [low, high] of possible) {
    const [from, to] = [low, high].map((each) => each * DEGREE + circle.zero), [p, q] = [from, to].map((each) => on(at, size, each));
    over.path(`M${tenth(p[0])} ${tenth(p[1])}A${tenth(size)} ${tenth(size)} 0 ${to - from > Math.PI ? 1 : 0} 0 ${tenth(q[0])} ${tenth(q[1])}`, "good can");
    for (const [angle, value] of [[from, low], [to, high]]) {
      const [x, y] = on(at, size, angle), right = Math.cos(angle) > -0.2;
      over.text([x + (right ? CLEAR : -CLEAR), y + (Math.sin(angle) < 0 ? 16 : -4)], degrees(value), right ? "good start" : "good end");
    }
  }
}

const on = ([x, y]: Vec, r: number, angle: number): Vec => [x + r * Math.cos(angle), y - r * Math.sin(angle)];
const degrees = (value: number) => `${value.toFixed(0).replace(/^-0$/, "0").replace("-", "−")}°`;

/** The two chains and what leads them, at a position that is not the drawn one. */
function broken(over: Overlay, { chains, ends, reaches, way: circle }: Gap, camera: Camera): void {
  chains.forEach((links, k) => {
    const centre = reaches.find(({ name }) => links.includes(name))?.centre;
    if (centre) over.path(line([camera.screen(centre), camera.screen(ends![k])]), "apart");
    if (k === 0 && centre && circle && Math.abs(dist(centre, circle.centre) - circle.radius) < 1e-6 * circle.radius) {
      over.path(line([camera.screen(circle.centre), camera.screen(centre)]), "apart");
      over.circle(camera.screen(centre), PIN, "pin soft");
    }
  });
}

/** How the machine would stand by a remedy. */
export function drawRemedy(over: Overlay, { places }: Remedy, links: Record<string, string[]>, fixed: string[], camera: Camera): void {
  for (const points of Object.values(links)) {
    const corners = points.map((name) => places[name]).filter((each) => each !== undefined);
    if (corners.length > 1) over.path(line(corners.map((each) => camera.screen(each)), corners.length > 2), "ghost");
  }
  for (const [name, at] of Object.entries(places)) if (Object.values(links).flat().includes(name) || fixed.includes(name)) over.circle(camera.screen(at), PIN, "pin ghost");
}

type Box = [number, number, number, number];

/** The box of the drawing with what is drawn of a gap, m. */
export function boxOf({ reaches, way: circle, ends, drawn }: Gap, own: Box | null): Box | null {
  const boxes = [...(drawn ? reaches : []), ...(circle ? [circle] : [])].map(({ centre: [x, y], radius: r }): Box => [x - r, y - r, x + r, y + r]);
  return around(own, ...boxes, ...(ends ?? []).map(([x, y]): Box => [x, y, x, y]));
}

/** The box of boxes; null where there are none. */
export function around(...all: (Box | null)[]): Box | null {
  const boxes = all.filter((each) => each !== null), most = (k: number, pick: (...values: number[]) => number) => pick(...boxes.map((each) => each[k]));
  return boxes.length ? [most(0, Math.min), most(1, Math.min), most(2, Math.max), most(3, Math.max)] : null;
}

/** Where on the sheet the gap is, px; null: nowhere in particular. */
export function spotOf({ ends, reaches, way: circle }: Gap, camera: Camera): Vec | null {
  if (ends) {
    const [a, b] = ends.map((each) => camera.screen(each));
    return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  }
  const centre = reaches[0]?.centre ?? circle?.centre;
  return centre ? camera.screen(centre) : null;
}

/** Where a callout of a size stands: in the sheet, off the gap, over as little of the drawing as may be. */
export function placed([wide, tall]: Vec, spot: Vec | null, drawing: Vec[], [w, h]: Vec, margin = 16): Vec {
  const right = Math.max(margin, w - wide - margin), foot = Math.max(margin, h - tall - margin - 48);
  if (!spot) return [right, margin];
  const beside = (x: number) => Math.min(right, Math.max(margin, x));
  const tries: Vec[] = [[right, margin], [beside(spot[0] + 70), margin], [margin, margin], [right, foot], [margin, foot], [beside(spot[0] - wide - 70), margin]];
  const covered = ([x, y]: Vec) => {
    const inside = ([a, b]: Vec, off: number) => a > x - off && a < x + wide + off && b > y - off && b < y + tall + off;
    return (inside(spot, 24) ? 100 : 0) + drawing.filter((each) => inside(each, 12)).length;
  };
  return tries.reduce((best, each) => (covered(each) < covered(best) ? each : best));
}

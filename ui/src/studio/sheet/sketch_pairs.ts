// Pairs of a drawing that is no machine yet: blocks in their guides, meshing wheels, racks, cams, welds, where the text has them.
import type { Vec } from "../../shapes";
import { away, element, line, round, toothed } from "../../strokes";
import type { Camera } from "./camera";
import { dist, heading, plus, polar } from "./geometry";
import type { Stand } from "./loads";
import type { Scene } from "./scene";
import type { Entry } from "../outline";
import { typed } from "../tools/typed";

// Half a block, half the rail under it, how far that is from the point; half of a rack, px.
const BLOCK: Vec = [15, 9], RAIL = 52, UNDER = 10.3, RACK = 80;

type Layer = "wheels" | "blocks" | "bodies";
type Table = Record<string, Entry>;

const word = (entry: Entry | undefined) => (typeof entry === "string" ? entry : "");
const words = (entry: Entry | undefined) => (Array.isArray(entry) ? entry.map(word) : []);
const length = (entry: Entry | undefined) => typed(word(entry), "length")?.value ?? null;
const isTable = (entry: Entry | undefined): entry is Table => typeof entry === "object" && !Array.isArray(entry);

/** The point about which a wheel turns: that on the frame, else one that another link has too. */
export function centreOf(scene: Scene, link: string): string | null {
  const points = scene.links[link] ?? [];
  return points.find((name) => scene.points.get(name)?.fixed) ?? points.find((name) => (scene.points.get(name)?.links.length ?? 0) > 1) ?? points[0] ?? null;
}

/** Two wheels that mesh: their centres and pitch radii, m, the second of which may be a ring about the first. */
function wheels(scene: Scene, entry: Table): { at: Vec; r: number; teeth: number; ring: boolean }[] {
  const [a, b] = words(entry.links).map((link) => scene.at(centreOf(scene, link) ?? "")), [m, n] = words(entry.teeth).map(Number);
  if (!a || !b || !(m > 0) || !(n > 0)) return [];
  const far = dist(a, b), inner = word(entry.mesh) === "internal", r = inner ? (far * m) / Math.abs(n - m) : (far * m) / (m + n);
  return [{ at: a, r, teeth: m, ring: inner && m > n }, { at: b, r: (r * n) / m, teeth: n, ring: inner && n > m }];
}

/** Where a pair is on the sheet: where wheels touch, a cam its roller, a block its guide. */
export function placeOf(scene: Scene, entry: Table): Vec | null {
  const at = scene.at(word(entry.at)), [first, second] = wheels(scene, entry);
  if (at || !first) return at;
  // Rings touch beyond the smaller wheel, as seen from the larger one.
  const [from, to] = first.ring ? [first, second] : second.ring ? [second, first] : [first, second];
  return plus(from.at, polar(from.r, heading(from.at, to.at)));
}

export function drawPairs(layers: Record<Layer, SVGElement>, stand: Stand, joints: Entry | undefined, camera: Camera): void {
  const { scene } = stand;
  for (const entry of Object.values(isTable(joints) ? joints : {})) {
    if (!isTable(entry)) continue;
    const kind = word(entry.kind);
    if (entry.block) block(layers.blocks, stand, entry, camera);
    else if (kind === "gear") for (const each of wheels(scene, entry)) wheel(layers.wheels, camera.screen(each.at), each.r * camera.scale, each.teeth, each.ring);
    else if (kind === "rack") rack(layers.wheels, stand, entry, camera);
    else if (kind === "cam") cam(layers.wheels, stand, entry, camera);
    else if (kind === "weld") weld(layers.bodies, scene, entry, camera);
  }
}

function block(layer: SVGElement, stand: Stand, entry: Table, camera: Camera): void {
  const place = stand.scene.at(word(entry.at)), angle = stand.guideOf(word(entry.block))?.angle ?? 0;
  if (!place) return;
  const at = camera.screen(place), u: Vec = [Math.cos(angle), -Math.sin(angle)], spot = (x: number, y: number) => away(at, u, x, y);
  const [w, h] = BLOCK;
  if (word(entry.guide) === "frame") {
    // The ground is below, or to the right of a guide that stands.
    const side = u[0] > 1e-6 || (Math.abs(u[0]) <= 1e-6 && u[1] < 0) ? 1 : -1, y = side * UNDER;
    element("path", { class: "lw-ground", d: line([spot(-RAIL, y), spot(RAIL, y)]) }, layer);
    let hatch = "";
    for (let x = -RAIL + 4; x <= RAIL; x += 6) hatch += line([spot(x, y), spot(x - 5.25, y + 7 * side)]);
    element("path", { class: "lw-hatch", d: hatch }, layer);
  }
  element("path", { class: "lw-block", d: line([spot(-w, -h), spot(w, -h), spot(w, h), spot(-w, h)], true) }, layer);
}

function wheel(layer: SVGElement, [x, y]: Vec, r: number, teeth: number | null, ring = false): void {
  const group = element("g", { transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})` }, layer);
  if (ring) element("path", { class: "lw-support", d: round([0, 0], r + 14) }, group);
  element("path", { class: "lw-gear", d: toothed(r, teeth, 0, ring ? -1 : 1) }, group);
  element("path", { class: "lw-pitch", d: round([0, 0], r) }, group);
}

function rack(layer: SVGElement, stand: Stand, entry: Table, camera: Camera): void {
  const { scene } = stand, centre = scene.at(centreOf(scene, word(entry.pinion)) ?? ""), through = scene.at(word(entry.through)), r = length(entry.radius);
  const angle = stand.guideOf(word(entry.rack))?.angle;
  if (!centre || !through || r === null || angle === undefined) return;
  wheel(layer, camera.screen(centre), r * camera.scale, null);
  const at = camera.screen(through), u: Vec = [Math.cos(angle), -Math.sin(angle)];
  element("path", { class: "lw-ground", d: line([away(at, u, -RACK), away(at, u, RACK)]) }, layer);
}

function cam(layer: SVGElement, { scene }: Stand, entry: Table, camera: Camera): void {
  const centre = scene.at(centreOf(scene, word(entry.cam)) ?? ""), base = length(entry.base_radius), at = scene.at(word(entry.at)), roller = length(entry.roller_radius);
  if (centre && base) element("path", { class: "lw-plate", d: round(camera.screen(centre), base * camera.scale) }, layer);
  if (at && roller) element("path", { class: "lw-ground", d: round(camera.screen(at), roller * camera.scale) }, layer);
}

/** A filled corner between two links that are one. */
function weld(layer: SVGElement, scene: Scene, entry: Table, camera: Camera): void {
  const name = word(entry.at), point = scene.points.get(name);
  if (!point) return;
  const at = camera.screen(point.at), ways = point.links.map((link) => (scene.links[link] ?? []).find((each) => each !== name)).map((each) => scene.at(each ?? "")).filter((each) => each !== null);
  const corner = ways.slice(0, 2).map((each): Vec => {
    const [x, y] = camera.screen(each), far = Math.hypot(x - at[0], y - at[1]) || 1;
    return [at[0] + (14 * (x - at[0])) / far, at[1] + (14 * (y - at[1])) / far];
  });
  if (corner.length === 2) element("path", { class: "lw-weld", d: line([at, ...corner], true) }, layer);
}

// What of a text can be drawn before it is a machine, in the same symbols: bars, plates, pivots, blocks in their guides.
import { Names } from "../../names";
import type { Picture } from "../picture";
import type { Vec } from "../../shapes";
import { element, hull, line, tint } from "../../strokes";
import { digitsOf } from "../colour";
import type { Camera } from "./camera";
import type { Stand } from "./loads";
import type { Scene } from "./scene";
import { at as entryAt, word } from "../inspector/entries";
import type { Entry } from "../outline";
import { drawPairs } from "./sketch_pairs";

const LAYERS = ["wheels", "bodies", "blocks", "supports", "pins", "names"];
const PIN = 5, POINT = 2.8;

export class Sketch {
  readonly svg: SVGElement;
  private readonly layers: Record<string, SVGElement>;
  private names: Names | null = null;
  private labelled = "";

  constructor(host: HTMLElement, private readonly symbols: Record<string, string>) {
    this.svg = element("svg", { class: "machine sketch", "aria-hidden": "true" }, host);
    this.layers = Object.fromEntries(LAYERS.map((name) => [name, element("g", { class: `lw-${name}` }, this.svg)]));
  }

  clear(): void {
    for (const each of Object.values(this.layers)) if (each.firstChild) each.replaceChildren();
    [this.labelled, this.names] = ["", null];
  }

  /** All of a picture, or what another one has not; `taken`: strokes which names keep clear of, too. */
  draw(stand: Stand, entries: { [key: string]: Entry } | undefined, camera: Camera, names: boolean, known: Picture | null, taken: number[]): void {
    const { scene } = stand, layer = this.layers;
    for (const name of LAYERS) if (name !== "names") layer[name].replaceChildren();
    const ink = [...taken], [w, h] = camera.size, labelled: string[] = [];
    const inked = (corners: Vec[]) => corners.forEach((corner, k) => k && ink.push(...corners[k - 1], ...corner));
    for (const name of Object.keys(scene.links)) {
      if (known && same(known.links[name], scene.links[name])) continue;
      const corners = scene.corners(name).map((each) => camera.screen(each)), wide = corners.length > 2;
      const around = wide ? hull(corners) : corners;
      inked(wide ? [...around, around[0]] : around);
      const body = element("path", { class: `${wide ? "lw-plate" : "lw-bar"}${name === scene.driver ? " driven" : ""}`, d: line(around, wide) }, layer.bodies);
      if (name !== scene.driver) tint(body, digitsOf(word(entryAt(entries?.links, name, "colour"))));
    }
    if (!known) drawPairs(layer, stand, entries?.joints, camera);
    for (const { name, key, at, fixed, links } of scene.points.values()) {
      const old = known && name in known.points && known.fixed.includes(name) === fixed && known.guided.includes(name) === scene.guided.includes(name);
      if ((old && linksOf(known, name) === links.length) || covered(scene, name)) continue;
      const [x, y] = camera.screen(at), put = (symbol: string, host: SVGElement) => {
        element("g", { transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})` }, host).innerHTML = this.symbols[symbol];
      };
      if (fixed) {
        put("fixed_pivot", layer.supports);
        inked([[x - 16, y + 18], [x + 16, y + 18], [x, y + 6], [x - 16, y + 25], [x + 16, y + 25]]);
      }
      if (scene.guided.includes(name)) {
        // Its joint draws a block, unless it is not known yet.
        if (known || !scene.pairs.some((pair) => pair.point === name)) put("slider", layer.blocks);
        inked([[x - 15, y - 9], [x + 15, y + 9], [x - 15, y + 9], [x + 15, y - 9]]);
      }
      const inner = !fixed && links.length === 1 && scene.links[links[0]].length > 2 && !scene.guided.includes(name);
      element("circle", { class: inner ? "lw-point" : "lw-pin", cx: x.toFixed(1), cy: y.toFixed(1), r: inner ? POINT : PIN }, layer.pins);
      inked([[x - 5, y - 5], [x + 5, y + 5], [x - 5, y + 5], [x + 5, y - 5]]);
      // Points of the machine have their names there.
      if (!known || (!key && !(name in known.points))) labelled.push(name);
    }
    // Names stay where they are while the points are the same.
    const shown = names ? labelled.join() : "";
    if (shown !== this.labelled) {
      layer.names.replaceChildren();
      this.names = shown ? new Names(labelled, layer.names) : null;
    }
    this.labelled = shown;
    this.names?.write((name) => camera.screen(scene.at(name)!), ink, 1, w, h);
  }
}

const same = (a: string[] | undefined, b: string[]) => a?.join() === b.join();
const linksOf = (picture: Picture, point: string) => Object.values(picture.links).filter((points) => points.includes(point)).length;

/** Points that no link has, which a machine leaves out. */
export const bareOf = (scene: Scene) => [...scene.points.values()].filter(({ name, links }) => !links.length && !covered(scene, name)).map(({ name }) => name);

/** Whether a fixed point is under a block that it guides. */
function covered({ guided, points, throughs }: Scene, name: string): boolean {
  const point = points.get(name)!;
  if (!point.links.length && throughs.has(name)) return true;
  return point.fixed && !point.links.length && guided.some((block) => {
    const at = points.get(block)?.at;
    return at && Math.hypot(at[0] - point.at[0], at[1] - point.at[1]) < 1e-6;
  });
}

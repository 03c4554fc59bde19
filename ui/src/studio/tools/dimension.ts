// Dimension: click a link, two points or two links, then where the dimension stands, and type its value: it drives the drawing.
import type { Bench, Item } from "../bench";
import type { Entry } from "../outline";
import { dist } from "../sheet/geometry";
import { beyond, ClickTool, turned, TypedValues } from "./hand";
import { line, outline } from "./marks";
import { directions, driven, type Measure, measured, nearestSide, sizeOf } from "./measure";
import type { Field, MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";
import { reads } from "./typed";

// Least length, m; distance of the line from what it measures and radius of an arc, at least, px.
const LEAST = 5e-5, OFF = 14, ARC = 24;

class DimensionTool extends ClickTool implements Tool {
  readonly name = "dimension";
  private values: TypedValues;
  private picked: Item[] = [];
  /** Where its line stands; null: it follows the pointer. */
  private stands: Spot | null = null;

  constructor(sheet: Sheet) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, { length: "length", angle: "angle" });
  }

  hint(): [string] {
    const step = !this.picked.length ? "first" : !this.measure ? "second" : this.stands ? "value" : "place";
    return [`hint.dimension.${step}`];
  }

  enter(): void {
    const { spot } = this.sheet;
    if (this.measure && (this.values.any || this.stands)) void this.set();
    else if (spot) this.click(spot);
  }

  escape(): boolean {
    if (this.clicks.drop()) return true;
    const back = this.values.clear() || this.stands !== null || this.picked.splice(-1).length > 0;
    this.stands = null;
    this.sheet.redraw();
    return back;
  }

  /** What is picked measures; what is not in the drawing any more is let go. */
  private get measure(): Measure | null {
    const { scene } = this.sheet, there = this.picked.every(({ kind, name }) => (kind === "link" ? name in scene.links : scene.points.has(name)));
    if (!there) this.drop();
    return this.picked.length ? measured(scene, this.picked) : null;
  }

  fields(): Field[] {
    const { measure } = this;
    if (!measure) return [];
    const key = measure.kind === "angle" ? "angle" : "length";
    return [this.values.field(key, this.values.value(key) ?? sizeOf(this.sheet.scene, measure))];
  }

  type = (key: string, text: string) => this.values.type(key, text, (value) => (key === "length" ? value > LEAST : value >= 0 && value <= 2 * Math.PI));

  takes = ({ kind }: Item) => kind === "point" || kind === "link" || kind === "dimension";

  protected click(spot: Spot): void {
    const [first, second] = this.picked, found = this.under(spot);
    if (this.measure && (this.stands || this.values.any)) {
      if (this.values.any) void this.set();
      else this.drop();
    } else if (!first) this.begin(spot, found);
    else if (first.kind === "point" && !second) {
      if (found?.kind === "point" && found.name !== first.name) this.picked.push(found);
      else this.sheet.refuse("refuse.dimension_second");
    } else if (first.kind === "link" && !second && found?.kind === "link" && found.name !== first.name) this.picked.push(found);
    else this.stands = spot;
    this.sheet.redraw();
  }

  private begin(spot: Spot, found: Item | null): void {
    const { scene, bench } = this.sheet;
    if (!found) return this.sheet.refuse("refuse.dimension_first");
    const known = found.kind === "dimension" ? found.name.replace(/\.length$/, "") : found.name;
    this.picked = found.kind === "dimension" ? [{ kind: "link", name: known }] : found.kind === "link" ? nearestSide(scene, known, spot.free) : [found];
    if (found.kind !== "dimension") return;
    this.stands = spot;
    bench.select(found);
  }

  private under({ under }: Spot): Item | null {
    const { scene } = this.sheet;
    return under.find(({ kind, name }) => (kind === "point" && scene.at(name)) || (kind === "link" && scene.corners(name).length > 1) || (kind === "dimension" && name.replace(/\.length$/, "") in scene.links)) ?? null;
  }

  private async set(): Promise<void> {
    const { measure } = this, { scene, bench } = this.sheet;
    if (!measure) return;
    const key = measure.kind === "angle" ? "angle" : "length", value = this.values.value(key) ?? sizeOf(scene, measure);
    const text = this.values.written(key) ?? `${Number((1e3 * value).toFixed(1))} mm`, { picked, stands } = this;
    this.drop();
    const made = await this.sheet.act(driven(scene, measure, value, text, [...bench.locked.value], linksOf(bench)));
    if (made && measure.kind === "length") bench.select({ kind: "dimension", name: `${measure.link}.length` });
    else if (!made && !this.picked.length) [this.picked, this.stands] = [picked, stands];
    this.sheet.redraw();
  }

  private drop(): void {
    this.values.clear();
    [this.picked, this.stands] = [[], null];
  }

  draw(over: Overlay): void {
    const { sheet, measure } = this, { scene, camera } = sheet, { unit } = sheet.bench.settings.value, spot = this.stands ?? sheet.spot;
    for (const { kind, name } of this.picked)
      if (kind === "link") over.path(outline(sheet, name), "hand halo");
      else if (scene.at(name)) over.circle(camera.screen(scene.at(name)!), 8, "hand ring");
    if (!measure || !spot) return;
    const key = measure.kind === "angle" ? "angle" : "length", text = reads(this.values.value(key) ?? sizeOf(scene, measure), key, unit);
    if (measure.kind === "angle") return this.arc(over, measure, spot, text);
    const [a, b] = measure.points.map((point) => camera.screen(scene.at(point)!)), far = dist(a, b) || 1;
    const off = ((spot.screen[0] - a[0]) * (b[1] - a[1]) - (spot.screen[1] - a[1]) * (b[0] - a[0])) / far;
    over.dimension(a, b, text, "hand strong", Math.abs(off) < OFF ? (off < 0 ? -OFF : OFF) : off);
  }

  private arc(over: Overlay, measure: Measure & { kind: "angle" }, spot: Spot, text: string): void {
    const { scene, camera } = this.sheet, [a, b] = directions(scene, measure), at = camera.screen(scene.at(measure.arms[1][0])!), r = Math.max(ARC, dist(at, spot.screen));
    const bent = turned(b - a), [from, to, middle] = [beyond(at, r, -a), beyond(at, r, -b), beyond(at, r + 14, -a - bent / 2)];
    over.path(line(at, from) + line(at, to), "soft dashed");
    over.path(`M${from[0].toFixed(1)} ${from[1].toFixed(1)}A${r.toFixed(1)} ${r.toFixed(1)} 0 0 ${bent > 0 ? 0 : 1} ${to[0].toFixed(1)} ${to[1].toFixed(1)}`, "hand");
    over.text([middle[0], middle[1] + 4], text, "hand strong");
  }

  leave(): void {
    this.clicks.drop();
    this.drop();
  }
}

function linksOf({ desk }: Bench): { [link: string]: Entry } {
  const links = desk.solved.value.outline?.entries.links;
  return links && typeof links === "object" && !Array.isArray(links) ? links : {};
}

export const makeDimension: MakeTool = (sheet) => new DimensionTool(sheet);

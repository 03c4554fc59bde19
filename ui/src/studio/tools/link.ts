// Link: click a joint, click the next one; the end of a link begins the next. A typed length is kept whatever the pointer does.
import type { Vec } from "../../shapes";
import { dist, heading } from "../sheet/geometry";
import { beyond, ClickTool, current, dropped, endAt, near, pointAt, type End, TypedValues } from "./hand";
import { inHand, joint } from "./marks";
import type { MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";

// A length is not typed below this; a joint is one of the drawing where it is nearer to it than this, m.
const SAME = 5e-5;

class LinkTool extends ClickTool implements Tool {
  readonly name = "link";
  private readonly values: TypedValues;
  /** Where the link in hand begins. */
  private from: End | null = null;
  /** Where the links before it began. */
  private before: End[] = [];
  /** The direction of the link before, while the pointer says none. */
  private along = 0;
  /** Names that are not in the drawing yet. */
  private coming: string[] = [];

  constructor(sheet: Sheet) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, { length: "length", angle: "angle" });
  }

  hint(): [string] {
    this.look();
    if (!this.from) return ["hint.link.first"];
    return [this.sheet.spot?.touch ? "hint.link.tap" : "hint.link.next"];
  }

  enter(): void {
    const { spot } = this.sheet;
    if (this.from && this.values.any && spot) this.finish(this.end(spot));
    else if (this.from) this.drop();
  }

  escape(): boolean {
    if (this.clicks.drop()) return true;
    if (this.values.clear()) return true;
    return this.drop();
  }

  anchor(): Vec | null {
    this.look();
    return this.start;
  }

  fields() {
    const { spot } = this.sheet;
    if (!this.from || !spot) return [];
    const { at } = this.end(spot), start = this.start!;
    return [this.values.field("length", this.values.value("length") ?? dist(start, at)), this.values.field("angle", this.values.value("angle") ?? this.direction(spot, at))];
  }

  type = (key: string, text: string) => this.values.type(key, text, (value) => key !== "length" || value > SAME);

  takes = ({ kind }: { kind: string }) => kind === "point" || kind === "link";

  /** Where the link in hand begins, m: its joint may have moved since it was clicked. */
  private get start(): Vec | null {
    return this.from && (this.sheet.scene.at(this.from.name) ?? this.from.at);
  }

  /** After an undo the chain goes on from its last joint that is there. */
  private look(): void {
    while (this.from && !this.from.made && !this.sheet.scene.at(this.from.name) && !this.coming.includes(this.from.name)) this.from = this.before.pop() ?? null;
  }

  private drop(): boolean {
    const begun = this.from !== null;
    [this.from, this.before] = [null, []];
    this.sheet.redraw();
    return begun;
  }

  protected override pulls(): boolean {
    return !this.from;
  }

  protected click(spot: Spot): void {
    this.look();
    if (!this.from) {
      this.from = endAt(spot, this.sheet.scene, this.coming);
      this.sheet.redraw();
      return;
    }
    const same = pointAt(spot, this.sheet.scene) === this.from.name || near(spot, this.sheet.camera.screen(this.start!));
    if (same && !this.values.any) this.drop();
    else this.finish(this.end(spot));
  }

  /** Where the link in hand ends: as typed, else where the pointer is. */
  private end(spot: Spot): End {
    const { scene } = this.sheet, start = this.start!, taken = [this.from!.name, ...this.coming], there = endAt(spot, scene, taken);
    const length = this.values.value("length"), angle = this.values.value("angle");
    // A joint or a link under the pointer is what the end goes to; the drawing is then moved to a typed length.
    if (angle === null && there.name !== this.from!.name && (length === null || !there.made || there.on)) return there;
    const along = angle ?? this.direction(spot, spot.place);
    const far = length ?? Math.max(0, (spot.place[0] - start[0]) * Math.cos(along) + (spot.place[1] - start[1]) * Math.sin(along));
    const at = beyond(start, far, along), known = [...scene.points.values()].find((each) => each.name !== this.from!.name && dist(each.at, at) < SAME);
    return known ? { name: known.name, at: known.at, made: false, on: null } : { ...endAt({ ...spot, snap: null }, scene, taken), at };
  }

  /** From where the link begins to a place, as the one before while the pointer is still there. */
  private direction(spot: Spot, to: Vec): number {
    return near(spot, this.sheet.camera.screen(this.start!)) ? this.along : heading(this.start!, to);
  }

  private finish(to: End): void {
    const { scene } = this.sheet, from = current(this.from!, scene, this.coming), length = this.values.written("length");
    if (to.name === from.name || (length === null && dist(this.start!, to.at) < SAME)) return;
    const there = Object.keys(scene.links).find((link) => scene.links[link].length === 2 && [from.name, to.name].every((each) => scene.links[link].includes(each)));
    if (there) return this.sheet.refuse("refuse.link_there", { link: there, a: from.name, b: to.name });
    const ends = [from, to], places = Object.fromEntries(ends.filter(({ made }) => made).map(({ name, at }) => [name, at]));
    const link = { do: "link", points: ends.map(({ name }) => name), places, ...(length && { length }) };
    this.values.clear();
    this.along = heading(this.start!, to.at);
    this.before.push({ ...from, made: false, on: null });
    this.from = { ...to, made: false, on: null };
    this.sheet.redraw();
    void this.make(from, to, [...ends.flatMap(dropped), link]);
  }

  private async make(from: End, to: End, actions: Parameters<Sheet["act"]>[0]): Promise<void> {
    const names = [from, to].filter(({ made }) => made).map(({ name }) => name);
    this.coming.push(...names);
    const made = await this.sheet.act(actions);
    this.coming = this.coming.filter((each) => !names.includes(each));
    if (made?.length) this.sheet.bench.selectMade({ kind: "link", name: made[made.length - 1] });
    // What the drawing did not admit is not there to go on from.
    else if (!made && this.from?.name === to.name) [this.from, this.before] = [from, this.before.slice(0, -1)];
    this.sheet.redraw();
  }

  draw(over: Overlay): void {
    const { spot, camera } = this.sheet;
    if (!this.from) return;
    if (spot && !near(spot, camera.screen(this.start!))) inHand(over, this.sheet, this.start!, this.end(spot).at);
    joint(over, camera.screen(this.start!));
  }

  leave(): void {
    this.values.clear();
    this.clicks.drop();
    this.drop();
  }
}

export const makeLink: MakeTool = (sheet) => new LinkTool(sheet);

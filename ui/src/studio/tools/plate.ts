// Plate: click three or more joints; Enter or the first joint closes it. With a link selected a click adds a point to it.
import type { Action } from "../picture";
import type { Vec } from "../../shapes";
import { dist, heading } from "../sheet/geometry";
import { beyond, ClickTool, current, dropped, endAt, freshPoint, meeting, near, pointAt, type End, TypedValues } from "./hand";
import { arc, inHand, joint, line, taken } from "./marks";
import type { Field, MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";

const SAME = 5e-5;

interface Corner extends End {
  /** Length typed for the side that leads to it. */
  side: string | null;
}

class PlateTool extends ClickTool implements Tool {
  readonly name = "plate";
  private readonly values: TypedValues;
  private corners: Corner[] = [];
  /** Length typed for the side from the last corner back to the first. */
  private back: string | null = null;
  private coming: string[] = [];

  constructor(sheet: Sheet) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, { length: "length", angle: "angle", back: "length" });
  }

  hint(): [string, Record<string, string>?] {
    const link = this.adding;
    if (link) return ["hint.plate.add", { link }];
    const [first] = this.corners, last = this.corners[this.corners.length - 1];
    return this.corners.length < 2 ? [first ? "hint.plate.second" : "hint.plate.first"] : [this.sheet.spot?.touch ? "hint.plate.tap" : "hint.plate.next", { first: first.name, last: last.name }];
  }

  enter(): void {
    const { spot } = this.sheet;
    if (spot && (this.values.any || !this.corners.length)) this.click(spot);
    else this.close();
  }

  escape(): boolean {
    if (this.clicks.drop()) return true;
    const back = this.values.clear() || this.corners.splice(-1).length > 0 || this.adding !== null;
    if (this.adding) this.sheet.bench.select();
    this.back = null;
    this.sheet.redraw();
    return back;
  }

  /** The link that gets further points, selected by hand; null: a new plate is drawn. */
  private get adding(): string | null {
    const { chosen } = this.sheet.bench;
    return !this.corners.length && chosen?.kind === "link" && chosen.name in this.sheet.scene.links ? chosen.name : null;
  }

  anchor(): Vec | null {
    return this.corners.length ? this.at(this.corners[this.corners.length - 1]) : null;
  }

  private at({ name, at }: End): Vec {
    return this.sheet.scene.at(name) ?? at;
  }

  /** The sides that lead to the next corner: from the last one, and from the third on also from the first. */
  fields(): Field[] {
    const { spot } = this.sheet;
    if (!this.corners.length || !spot) return [];
    const first = this.at(this.corners[0]), last = this.anchor()!, { at } = this.next(spot) ?? { at: spot.place };
    const length = this.values.field("length", this.values.value("length") ?? dist(last, at));
    if (this.corners.length === 1) return [length, this.values.field("angle", this.values.value("angle") ?? heading(last, at))];
    const label = (name: string) => this.sheet.bench.say("value.to", { point: name });
    const back = this.values.field("back", this.values.value("back") ?? dist(first, at), { label: label(this.corners[0].name) });
    return [{ ...length, label: label(this.corners[this.corners.length - 1].name) }, back];
  }

  type = (key: string, text: string) => this.values.type(key, text, (value) => key === "angle" || value > SAME);

  takes = ({ kind, name }: { kind: string; name: string }) => (kind === "point" && !this.corners.slice(1).some((each) => each.name === name)) || kind === "link";

  private get names(): string[] {
    return [...this.corners.map(({ name }) => name), ...this.coming];
  }

  /** The next corner, as typed or where the pointer is; null where typed sides do not meet. */
  private next(spot: Spot): End | null {
    const there = endAt(spot, this.sheet.scene, this.names), length = this.values.value("length"), back = this.values.value("back"), angle = this.values.value("angle");
    const first = this.at(this.corners[0]), last = this.anchor()!;
    if (!there.made || (length === null && back === null && angle === null)) return there;
    const free = { ...endAt({ ...spot, snap: null }, this.sheet.scene, this.names) };
    if (length !== null && back !== null) {
      const at = meeting(last, length, first, back, spot.free);
      return at && { ...free, at };
    }
    if (back !== null) return { ...free, at: beyond(first, back, heading(first, spot.place)) };
    const along = angle ?? heading(last, spot.place);
    const far = length ?? Math.max(0, (spot.place[0] - last[0]) * Math.cos(along) + (spot.place[1] - last[1]) * Math.sin(along));
    return { ...free, at: beyond(last, far, along) };
  }

  protected click(spot: Spot): void {
    const { scene, camera } = this.sheet, { adding } = this;
    if (adding) return this.add(adding, spot);
    if (!this.corners.length) {
      this.corners = [{ ...endAt(spot, scene, this.coming), side: null }];
      return this.sheet.redraw();
    }
    const [first] = this.corners, last = this.corners[this.corners.length - 1], point = pointAt(spot, scene), typed = this.values.written("length");
    if (point === first.name || near(spot, camera.screen(this.at(first)))) {
      if (this.corners.length > 2) this.back = typed ?? this.back;
      return this.close();
    }
    if (point === last.name || (!typed && near(spot, camera.screen(this.at(last))))) return;
    if (this.corners.some(({ name }) => name === point)) return this.sheet.refuse("refuse.plate_twice", { point: point! });
    const next = this.next(spot);
    if (!next) return this.sheet.refuse("refuse.plate_sides");
    this.corners.push({ ...next, side: typed });
    this.back = this.values.written("back");
    this.values.clear();
    this.sheet.redraw();
  }

  private close(): void {
    if (!this.corners.length) return;
    if (this.corners.length < 3) return this.sheet.refuse("refuse.plate_few");
    const corners = this.corners.map((each) => ({ ...current(each, this.sheet.scene, this.coming), side: each.side })), sides = [...corners.slice(1).map(({ side }) => side), this.back];
    const places = Object.fromEntries(corners.filter(({ made }) => made).map(({ name, at }) => [name, at]));
    const plate = { do: "link", points: corners.map(({ name }) => name), places, ...(sides.some(Boolean) && { sides }) };
    [this.corners, this.back] = [[], null];
    this.values.clear();
    void this.make(corners, [...corners.flatMap(dropped), plate]);
  }

  private async make(corners: Corner[], actions: Action[]): Promise<void> {
    this.coming = corners.map(({ name }) => name);
    const made = await this.sheet.act(actions);
    this.coming = [];
    if (made?.length) this.sheet.bench.selectMade({ kind: "link", name: made[made.length - 1] });
    else if (!made && !this.corners.length) this.corners = corners;
    this.sheet.redraw();
  }

  /** Adds a point to a link: a joint of the drawing, or a new one. */
  private add(link: string, spot: Spot): void {
    const { scene } = this.sheet, known = pointAt(spot, scene);
    if (known && scene.links[link].includes(known)) return this.sheet.refuse("refuse.plate_own", { point: known, link });
    const at = known ? scene.at(known)! : spot.place;
    void this.sheet.act([{ do: "add_point", link, point: known ?? freshPoint(scene, false), at }]);
  }

  draw(over: Overlay): void {
    const { spot, camera } = this.sheet, { adding, corners } = this, screen = (place: Vec) => camera.screen(place);
    if (adding) {
      taken(over, this.sheet, adding);
      if (spot) joint(over, screen(spot.place), "ghost pin");
    }
    if (!corners.length) return;
    const places = corners.map((each) => this.at(each)), next = spot && this.next(spot), [first] = places, last = places[places.length - 1];
    const all = next && dist(screen(first), screen(next.at)) > 1 ? [...places, next.at] : places;
    over.path(line(...all.map(screen)) + (all.length > 2 ? "Z" : ""), all.length > 2 ? "hand fill" : "ghost");
    if (next && dist(screen(last), screen(next.at)) > 1) {
      inHand(over, this.sheet, last, next.at, false);
      if (places.length > 1) inHand(over, this.sheet, first, next.at, false);
      else arc(over, screen(last), heading(last, next.at));
    }
    for (const place of places) joint(over, screen(place));
  }

  leave(): void {
    this.values.clear();
    this.clicks.drop();
    [this.corners, this.back] = [[], null];
  }
}

export const makePlate: MakeTool = (sheet) => new PlateTool(sheet);

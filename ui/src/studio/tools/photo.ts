// Photo: a picture is chosen or dropped; two clicks on it and their distance bring it to scale; unlocked it is dragged.
import type { Vec } from "../../shapes";
import type { Item } from "../bench";
import { scaled, taken } from "../sheet/backdrop";
import { dist } from "../sheet/geometry";
import { ClickTool, TypedValues } from "./hand";
import { line } from "./marks";
import type { Field, MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";

class PhotoTool extends ClickTool implements Tool {
  readonly name = "photo";
  private readonly values: TypedValues;
  /** Places on it that have been clicked, m. */
  private places: Vec[] = [];
  private pressed: Spot | null = null;
  private from: Vec | null = null;
  private readonly input = this.field();

  constructor(sheet: Sheet) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, { length: "length", opacity: "number" });
    if (!sheet.bench.photo.value) this.choose();
  }

  private get photo() {
    return this.sheet.bench.photo;
  }

  hint(): [string] {
    if (!this.photo.value) return ["hint.photo"];
    return [["hint.photo_first", "hint.photo_second", "hint.photo_length"][this.places.length]];
  }

  /** The field of the page by which the browser hands over a picture, there while the tool is. */
  private field(): HTMLInputElement {
    const input = document.body.appendChild(Object.assign(document.createElement("input"), { type: "file", accept: "image/*", hidden: true }));
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) void showPhoto(this.sheet, file);
    });
    return input;
  }

  /** Asks for a picture; the browser shows its own window. */
  private choose(): void {
    this.input.click();
  }

  override down(spot: Spot): void {
    this.pressed = spot;
    this.from = this.photo.value?.corner ?? null;
    this.clicks.down(spot);
  }

  /** A drag moves the picture, unless it is locked. */
  override move(spot: Spot): void {
    const { pressed, from } = this, photo = this.photo.value;
    this.clicks.move(spot);
    if (pressed && from && photo && !photo.locked && dist(pressed.screen, spot.screen) > 5) {
      this.clicks.drop();
      this.photo.value = { ...photo, corner: [from[0] + spot.free[0] - pressed.free[0], from[1] + spot.free[1] - pressed.free[1]] };
    }
    this.sheet.redraw();
  }

  override up(spot: Spot): void {
    this.pressed = null;
    this.clicks.up(spot);
  }

  protected click(spot: Spot): void {
    if (!this.photo.value) return this.choose();
    if (this.places.length === 2) return this.set();
    const [first] = this.places;
    if (first && dist(this.sheet.camera.screen(first), spot.screen) < 5) return;
    this.places.push(spot.free);
    this.sheet.redraw();
  }

  private set(): void {
    const photo = this.photo.value, length = this.values.value("length"), [a, b] = this.places;
    if (!photo || !a || !b) return;
    if (length === null) return this.sheet.refuse("refuse.photo_length");
    const found = scaled(photo, [a, b], length);
    if (found) this.photo.value = { ...found, locked: true };
    this.sheet.bench.select({ kind: "photo", name: "photo" });
    this.drop();
    this.sheet.redraw();
  }

  enter(): void {
    if (this.places.length === 2) this.set();
    else if (this.sheet.spot) this.click(this.sheet.spot);
  }

  escape(): boolean {
    this.clicks.drop();
    this.pressed = null;
    if (this.values.clear()) return true;
    return this.places.pop() !== undefined;
  }

  fields(): Field[] {
    if (this.places.length < 2) return [];
    return [this.values.field("length", dist(this.places[0], this.places[1]))];
  }

  type = (key: string, text: string) => this.values.type(key, text, (value) => value > 0);

  takes = (_item: Item) => false;

  draw(over: Overlay): void {
    const { camera, spot } = this.sheet, screen = this.places.map((each) => camera.screen(each));
    if (!screen.length) return;
    over.path(line(...(screen.length < 2 && spot ? [...screen, spot.screen] : screen)), "ghost");
    for (const at of screen) over.circle(at, 4, "hand pin");
  }

  private drop(): void {
    this.places = [];
    this.values.clear();
  }

  leave(): void {
    this.input.remove();
    this.drop();
    this.clicks.drop();
    this.pressed = null;
  }
}

/** Puts a picture behind the drawing and takes the tool that brings it to scale. */
export async function showPhoto(sheet: Sheet, file: Blob): Promise<void> {
  try {
    sheet.bench.photo.value = await taken(file, sheet.camera);
  } catch {
    return sheet.refuse("refuse.photo");
  }
  sheet.bench.select({ kind: "photo", name: "photo" });
  sheet.take("photo");
  sheet.redraw();
}

export const makePhoto: MakeTool = (sheet) => new PhotoTool(sheet);

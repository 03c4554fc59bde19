// Erase: what would go turns red under the pointer; a click removes it, a drag all that it goes over.
import { hull, line } from "../../strokes";
import { type Item, same } from "../bench";
import type { MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";

export const makeErase: MakeTool = (sheet) => new Erase(sheet);

class Erase implements Tool {
  readonly name = "erase";
  private over: Item | null = null;
  /** What a drag has gone over; null: nothing is pressed. */
  private gone: Item[] | null = null;

  constructor(private readonly sheet: Sheet) {}

  hint(): [string] {
    return ["sheet.erase_step"];
  }

  down(spot: Spot): void {
    this.gone = [];
    this.move(spot);
  }

  move({ under: [first] }: Spot): void {
    this.over = first ?? null;
    if (first && this.gone && !this.gone.some((each) => same(each, first))) this.gone.push(first);
  }

  up(): void {
    const items = this.gone ?? [];
    [this.gone, this.over] = [null, null];
    if (!items.length) return;
    this.sheet.bench.select(...this.sheet.bench.selection.value.filter((each) => !items.some((item) => same(item, each))));
    void this.sheet.act([{ do: "remove", items }]);
  }

  escape(): boolean {
    const pressed = this.gone !== null;
    this.gone = null;
    return pressed;
  }

  leave(): void {
    this.gone = this.over = null;
  }

  draw(over: Overlay): void {
    const { scene, camera } = this.sheet;
    for (const { kind, name } of this.gone?.length ? this.gone : this.over ? [this.over] : []) {
      const at = kind === "point" ? scene.at(name) : kind === "pair" ? (scene.pairs.find((each) => each.name === name)?.at ?? null) : null;
      if (at) over.circle(camera.screen(at), 9, "bad ring");
      if (kind === "link") {
        const corners = scene.corners(name).map((each) => camera.screen(each)), wide = corners.length > 2;
        over.path(line(wide ? hull(corners) : corners, wide), "bad thick");
      }
      if (kind === "load") for (const end of ends(scene.loads[name])) {
        const place = scene.at(end);
        if (place) over.circle(camera.screen(place), 14, "bad ring");
      }
    }
  }
}

const ends = (load: { at: string; ends: string[] } | undefined) => (load ? [load.at, ...load.ends].filter(Boolean) : []);

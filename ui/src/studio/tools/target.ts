// Target curve: drawn freely, or point by point; where it ends at its start it is closed. Opens the synthesis.
import type { Vec } from "../../shapes";
import type { Item } from "../bench";
import { dist } from "../sheet/geometry";
import { line } from "./marks";
import type { MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";

// Places of a stroke are this far apart, a press that goes farther draws, an end this near the start closes, px.
const APART = 4, STILL = 6, CLOSING = 14;
/** The least number of places that make a curve. */
const FEWEST = 3;
/** Places between clicks through which a smooth curve goes. */
const FINE = 12;

class TargetTool implements Tool {
  readonly name = "target";
  private pressed: Vec | null = null;
  private drawing = false;
  /** Places drawn or clicked, m. */
  private places: Vec[] = [];

  constructor(private readonly sheet: Sheet) {}

  hint(): [string] {
    return [this.places.length ? "hint.target_more" : "hint.target"];
  }

  down(spot: Spot): void {
    this.pressed = spot.screen;
    this.drawing = false;
    this.sheet.redraw();
  }

  move(spot: Spot): void {
    const { pressed } = this;
    if (pressed && !this.drawing && dist(pressed, spot.screen) > STILL && this.places.length === 0) {
      this.drawing = true;
      this.places = [this.sheet.camera.world(pressed)];
    }
    const last = this.places.at(-1);
    if (this.drawing && last && dist(this.sheet.camera.screen(last), spot.screen) >= APART) this.places.push(spot.free);
    this.sheet.redraw();
  }

  up(spot: Spot): void {
    const { pressed, drawing } = this;
    this.pressed = null;
    this.drawing = false;
    if (drawing) this.stroke(spot);
    else if (pressed) this.click(spot);
  }

  /** A stroke that has come by its start again is closed there, however far it goes on. */
  private stroke(spot: Spot): void {
    const { camera } = this.sheet, again = closing(this.places.map((each) => camera.screen(each)), CLOSING);
    if (again === null) return this.finish(this.closes(spot));
    this.places = this.places.slice(0, again);
    this.finish(true);
  }

  private closes({ screen }: Spot): boolean {
    return this.places.length >= FEWEST && dist(this.sheet.camera.screen(this.places[0]), screen) <= CLOSING;
  }

  private click(spot: Spot): void {
    if (this.closes(spot)) return this.finish(true);
    const last = this.places.at(-1);
    if (last && dist(this.sheet.camera.screen(last), spot.screen) < STILL) return this.finish(false);
    this.places.push(spot.place);
    this.sheet.redraw();
  }


  private finish(closed: boolean): void {
    const clicked = this.places.length < 40, { bench } = this.sheet, points = clicked ? through(this.places, closed) : this.places;
    if (this.places.length < FEWEST) {
      if (this.places.length) this.sheet.refuse("refuse.target");
      this.places = [];
      return this.sheet.redraw();
    }
    this.places = [];
    bench.target.value = { points, closed };
    bench.select({ kind: "target", name: "target" });
    bench.dock.value = "synthesis";
    void bench.desk.search("curve", { points, closed, unit: bench.settings.value.unit });
    this.sheet.redraw();
  }

  enter(): void {
    if (this.places.length) this.finish(false);
    else if (this.sheet.spot) this.click(this.sheet.spot);
  }

  escape(): boolean {
    this.pressed = null;
    this.drawing = false;
    if (!this.places.length) return false;
    this.places.pop();
    this.sheet.redraw();
    return true;
  }

  anchor(): Vec | null {
    return this.drawing ? null : (this.places.at(-1) ?? null);
  }

  takes = (_item: Item) => false;

  draw(over: Overlay): void {
    const { places, sheet } = this, { camera, spot } = sheet;
    if (!places.length) return;
    const screen = places.map((each) => camera.screen(each)), ends = this.drawing || !spot ? screen : [...screen, spot.screen];
    over.path(line(...ends), "ghost");
    if (!this.drawing) for (const at of screen) over.circle(at, 3, "hand pin");
    over.circle(screen[0], spot && this.closes(spot) ? CLOSING : 5, "hand pin");
  }

  leave(): void {
    this.places = [];
    this.pressed = null;
    this.drawing = false;
  }
}

/** Where a stroke comes back to its start, as near as it may be, in its second half; null: nowhere. */
export function closing(places: Vec[], near: number): number | null {
  let best = near, found: number | null = null;
  for (let k = Math.ceil(places.length / 2); k < places.length; k++) {
    const far = dist(places[0], places[k]);
    if (far <= best) [best, found] = [far, k];
  }
  return found;
}

/** A smooth curve through clicked places (Catmull and Rom). */
export function through(places: Vec[], closed: boolean): Vec[] {
  const n = places.length, found: Vec[] = [], at = (k: number) => (closed ? places[(k + n) % n] : places[Math.min(n - 1, Math.max(0, k))]);
  for (let k = 0; k < (closed ? n : n - 1); k++) {
    const [p, q, r, s] = [at(k - 1), at(k), at(k + 1), at(k + 2)];
    for (let j = 0; j < FINE; j++) {
      const t = j / FINE, part = (axis: 0 | 1) =>
        0.5 * (2 * q[axis] + (r[axis] - p[axis]) * t + (2 * p[axis] - 5 * q[axis] + 4 * r[axis] - s[axis]) * t * t + (3 * q[axis] - p[axis] - 3 * r[axis] + s[axis]) * t ** 3);
      found.push([part(0), part(1)]);
    }
  }
  return closed ? found : [...found, places[n - 1]];
}

export const makeTarget: MakeTool = (sheet) => new TargetTool(sheet);

// Drive: a click on a link turns it about its pivot, on a slider moves it along its guide, again removes the drive.
import type { Action, Drive } from "../picture";
import { arcPath, type Stand } from "../sheet/loads";
import { ClickTool, pivotOf, TypedValues } from "./hand";
import type { Field, MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";
import type { Item } from "../bench";
import { typed } from "./typed";

/** What can be driven: a link about its pivot, or a joint along which a block slides. */
type Driven = { link: string; about: string } | { slide: string };

class DriveTool extends ClickTool implements Tool {
  readonly name = "drive";
  private values: TypedValues;
  /** The drive that was set last: its speed can still be typed. */
  private last: { name: string; turns: boolean } | null = null;

  constructor(sheet: Sheet) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, { speed: "rate" });
  }

  private get stand(): Stand {
    return this.sheet.stand;
  }

  hint(): [string] {
    return ["hint.drive"];
  }

  /** What an element would be driven as; null: not at all. */
  private driven({ kind, name }: Item): Driven | null {
    const { scene } = this.sheet, guides = this.stand.picture.guides ?? {};
    if (kind === "pair") return name in guides ? { slide: name } : null;
    if (kind === "link") {
      const about = pivotOf(scene, name), slide = this.stand.guideOf(name)?.name;
      return about ? { link: name, about } : slide ? { slide } : null;
    }
    if (kind !== "point") return null;
    const point = scene.points.get(name), slide = Object.keys(guides).find((each) => guides[each].at === name);
    if (slide) return { slide };
    return point?.fixed && point.links.length === 1 ? { link: point.links[0], about: name } : null;
  }

  takes = (item: Item) => this.driven(item) !== null;

  protected click(spot: Spot): void {
    const found = spot.under.map((item) => this.driven(item)).find((each) => each !== null), { drives = {} } = this.stand.picture;
    this.last = null;
    this.values.clear();
    if (!found) return this.refuse(spot);
    const same = Object.keys(drives).find((name) => sameDrive(drives[name], found));
    if (same !== undefined) {
      void this.sheet.act([{ do: "remove", items: [{ kind: "driver", name: same }] }, ...this.cycle(false)]);
      this.sheet.bench.select();
    } else void this.put([{ do: "driver", ...found }, ...this.cycle("slide" in found)], "link" in found);
  }

  /** What moves along a guide goes to and fro between its limits; what turns does so only where it must. */
  private cycle(slides: boolean): Action[] {
    const { cycle } = this.sheet.bench.desk.solved.value.outline?.entries ?? {}, rocks = cycle === "rock";
    if (slides) return cycle === undefined ? [{ do: "set", path: ["cycle"], value: "rock" }] : [];
    return rocks ? [{ do: "unset", path: ["cycle"] }] : [];
  }

  private async put(actions: Action[], turns: boolean): Promise<void> {
    if (!(await this.sheet.act(actions))) return;
    const names = Object.keys(this.stand.picture.drives ?? {}), name = names.at(-1) ?? "driver";
    this.last = { name, turns };
    this.values = new TypedValues(this.sheet.bench, { speed: turns ? "rate" : "velocity" });
    this.sheet.bench.select({ kind: "driver", name });
    this.sheet.redraw();
  }

  private refuse(spot: Spot): void {
    const { scene } = this.sheet, link = spot.under.find(({ kind }) => kind === "link")?.name;
    if (!Object.keys(scene.links).length) return this.sheet.refuse("refuse.no_links");
    if (link) this.sheet.refuse("refuse.drive_link", { name: link });
    else this.sheet.refuse("refuse.drive");
  }

  enter(): void {
    const { last } = this, value = this.values.written("speed");
    this.values.clear();
    if (last && value !== null) void this.sheet.act([{ do: "set", path: last.name === "driver" ? ["driver", "speed"] : ["drivers", last.name, "speed"], value }]);
    else if (this.sheet.spot) this.click(this.sheet.spot);
  }

  escape(): boolean {
    this.clicks.drop();
    const back = this.values.clear();
    this.last = null;
    return back;
  }

  fields(): Field[] {
    const { last } = this, drive = last && this.stand.picture.drives?.[last.name];
    if (!last || !drive) return [];
    const quantity = last.turns ? "rate" : "velocity";
    return [this.values.field("speed", drive.rate ?? typed(drive.speed, quantity)?.value ?? 0, { quiet: true })];
  }

  type = (key: string, text: string) => this.values.type(key, text, (value) => value !== 0);

  draw(over: Overlay): void {
    const { spot, scene, camera } = this.sheet, found = spot?.under.map((item) => this.driven(item)).find((each) => each !== null);
    if (!found) return;
    if ("link" in found) {
      const at = scene.at(found.about);
      if (!at) return;
      const [arc, head] = arcPath(camera.screen(at), 26, -0.3, 1.9);
      over.path(arc, "input");
      over.path(head, "input head");
      return;
    }
    const guide = this.stand.picture.guides?.[found.slide], at = guide && scene.at(guide.at), along = guide && this.stand.guideOf(guide.block);
    if (!at || !along) return;
    const [x, y] = camera.screen(at), [u, v] = [Math.cos(along.angle), -Math.sin(along.angle)];
    over.path(`M${x + 24 * u} ${y + 24 * v}L${x + 56 * u} ${y + 56 * v}`, "input");
    over.path(`M${x + 60 * u} ${y + 60 * v}L${x + 51 * u - 4 * v} ${y + 51 * v + 4 * u}L${x + 51 * u + 4 * v} ${y + 51 * v - 4 * u}Z`, "input head");
  }

  leave(): void {
    this.values.clear();
    this.clicks.drop();
    this.last = null;
  }
}

const sameDrive = ({ turn, slide }: Drive, found: Driven) => ("link" in found ? turn === found.link : slide !== "" && slide === found.slide);

export const makeDrive: MakeTool = (sheet) => new DriveTool(sheet);

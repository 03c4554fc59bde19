// Mass: a click on a link and its mass, the moment of inertia follows; its centre is dragged.
import type { Vec } from "../../shapes";
import type { Stand } from "../sheet/loads";
import { dist } from "../sheet/geometry";
import { ClickTool, linkAt, pointAt, TypedValues } from "./hand";
import { taken } from "./marks";
import type { Field, MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";
import { reads } from "./typed";
import { written } from "./written";

/** How near the pointer is to a centre that it takes, px; the mass of a link that has none. */
const NEAR = 10, USUAL = 1;

class MassTool extends ClickTool implements Tool {
  readonly name = "mass";
  private readonly values: TypedValues;
  private link = "";
  /** The link whose centre is dragged, and to where, m. */
  private dragged: { link: string; to: Vec } | null = null;

  constructor(sheet: Sheet) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, { mass: "mass" });
  }

  private get stand(): Stand {
    return this.sheet.stand;
  }

  hint(): [string] {
    return [this.link ? "hint.mass_value" : Object.keys(this.stand.picture.masses ?? {}).length ? "hint.mass_centre" : "hint.mass"];
  }

  override down(spot: Spot): void {
    const link = this.centreAt(spot);
    if (link) this.dragged = { link, to: spot.place };
    else this.clicks.down(spot);
  }

  override move(spot: Spot): void {
    if (this.dragged) this.dragged.to = spot.place;
    else this.clicks.move(spot);
    this.sheet.redraw();
  }

  override up(spot: Spot): void {
    const { dragged } = this;
    this.dragged = null;
    if (!dragged) return this.clicks.up(spot);
    const from = this.stand.centre(dragged.link);
    if (from && dist(this.sheet.camera.screen(from), spot.screen) < NEAR / 2) this.choose(dragged.link);
    else this.shift(dragged.link, spot);
  }

  /** The link with a mass whose centre is under the pointer. */
  private centreAt({ screen }: Spot): string | null {
    const { stand } = this, far = (link: string) => {
      const at = stand.centre(link);
      return at ? dist(this.sheet.camera.screen(at), screen) : Infinity;
    };
    return Object.keys(stand.picture.masses ?? {}).find((link) => far(link) <= NEAR) ?? null;
  }

  /** The centre as the file has it: a point of the link, midway by itself, or coordinates in the link's axes. */
  private shift(link: string, spot: Spot): void {
    const { scene } = this.sheet, { stand } = this, point = pointAt(spot, scene), path = ["links", link, "mass_centre"];
    const [a] = scene.corners(link), axis = stand.axis(link), middle = stand.middle(link), two = scene.links[link]?.length === 2;
    if (point && scene.links[link].includes(point)) return void this.sheet.act([{ do: "set", path, value: point }]);
    if (middle && two && dist(this.sheet.camera.screen(middle), spot.screen) < NEAR / 2) return void this.sheet.act([{ do: "unset", path }]);
    if (!a || axis === null) return;
    const [x, y] = [spot.place[0] - a[0], spot.place[1] - a[1]], [c, s] = [Math.cos(axis), Math.sin(axis)];
    void this.sheet.act([{ do: "set", path, value: [written(x * c + y * s, "length"), written(y * c - x * s, "length")] }]);
  }

  protected click(spot: Spot): void {
    const link = linkAt(spot, this.sheet.scene), { link: before } = this;
    if (before) this.set();
    if (!link) {
      if (!before) this.sheet.refuse(Object.keys(this.sheet.scene.links).length ? "refuse.mass_link" : "refuse.no_links");
      return;
    }
    if (link !== before) this.choose(link);
  }

  private choose(link: string): void {
    this.link = link;
    this.sheet.bench.select({ kind: "link", name: link });
    this.sheet.redraw();
  }

  private get value(): number {
    return this.stand.picture.masses?.[this.link]?.mass ?? USUAL;
  }

  /** Writes the mass; the moment of inertia becomes that of an even bar, or of what the section says. */
  private set(): void {
    const { link } = this, mass = this.values.written("mass") ?? written(this.value, "mass");
    this.link = "";
    this.values.clear();
    if (link) void this.sheet.act([{ do: "mass", link, mass }]);
    this.sheet.redraw();
  }

  enter(): void {
    if (this.link) this.set();
    else if (this.sheet.spot) this.click(this.sheet.spot);
  }

  escape(): boolean {
    this.clicks.drop();
    if (this.values.clear()) return true;
    const back = this.link !== "" || this.dragged !== null;
    this.link = "";
    this.dragged = null;
    return back;
  }

  fields(): Field[] {
    return this.link ? [this.values.field("mass", this.value)] : [];
  }

  type = (key: string, text: string) => this.values.type(key, text, (value) => value >= 0);

  takes = ({ kind }: { kind: string }) => kind === "link";

  draw(over: Overlay): void {
    const { sheet, link, dragged, stand } = this, { camera } = sheet;
    for (const each of Object.keys(stand.picture.masses ?? {})) {
      const at = stand.centre(each);
      if (at && each !== dragged?.link) over.circle(camera.screen(at), NEAR - 1, "soft");
    }
    if (link) taken(over, sheet, link);
    if (!dragged) return;
    const at = camera.screen(dragged.to);
    over.circle(at, 6, "hand pin");
    over.text([at[0] + 12, at[1] - 8], reads(stand.picture.masses?.[dragged.link]?.mass ?? 0, "mass"), "hand start");
  }

  leave(): void {
    this.link = "";
    this.dragged = null;
    this.values.clear();
    this.clicks.drop();
  }
}

export const makeMass: MakeTool = (sheet) => new MassTool(sheet);

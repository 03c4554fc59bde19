// Force: a press on a point and a drag; the length of the arrow is the size, it pushes towards its point.
import type { Vec } from "../../shapes";
import { arrowPath, forceScale, gapAt, nice, type Stand } from "../sheet/loads";
import { type Aim, aimed, direction } from "./aim";
import { type Grip, grip } from "./grip";
import { beyond, ClickTool, TypedValues } from "./hand";
import { LastLoad } from "./last";
import type { Field, MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";
import { reads } from "./typed";
import { written } from "./written";

/** A size in hand is a whole number of these pixels. */
const COARSE = 5;

class ForceTool extends ClickTool implements Tool {
  readonly name = "force";
  private readonly values: TypedValues;
  private readonly last: LastLoad;
  private held: Grip | null = null;
  /** The force that is aimed again; "": a new one. */
  private aimed = "";
  private pull: Vec = [0, 0];
  private free = false;

  constructor(sheet: Sheet) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, { size: "force", direction: "angle" });
    this.last = new LastLoad(sheet, [{ key: "size", quantity: "force", path: "magnitude" }]);
  }

  private get stand(): Stand {
    return this.sheet.stand;
  }

  hint(): [string] {
    return [this.held ? "hint.force_size" : "hint.force"];
  }

  override move(spot: Spot): void {
    this.clicks.move(spot);
    this.follow(spot);
    this.sheet.redraw();
  }

  private follow({ screen, alt }: Spot): void {
    if (!this.held) return;
    const [x, y] = this.sheet.camera.screen(this.held.at);
    this.pull = [screen[0] - x, y - screen[1]];
    this.free = alt;
  }

  protected override pulls(): boolean {
    return !this.held;
  }

  protected click(spot: Spot): void {
    const { scene, bench } = this.sheet;
    if (this.held) {
      this.follow(spot);
      return this.set();
    }
    this.last.drop();
    this.held = this.again(spot) ?? grip(spot, scene, this.stand);
    if (!this.held) this.sheet.refuse(Object.keys(scene.links).length ? "refuse.no_grip" : "refuse.no_links");
    else bench.select({ kind: "link", name: this.held.link });
    this.pull = [0, 0];
    this.sheet.redraw();
  }

  /** A force whose arrow is pressed is taken in hand again. */
  private again({ under, snap }: Spot): Grip | null {
    const name = under[0]?.kind === "load" && snap?.kind !== "point" ? under[0].name : "", load = this.stand.loads[name], at = load && this.sheet.scene.at(load.at);
    const aimable = load?.kind === "force" && at && (load.held === "space" || load.held === "link") && typeof load.magnitude === "number" && load.always;
    this.aimed = aimable ? name : "";
    return aimable ? { link: load.on, point: load.at, at, made: [] } : null;
  }

  private get aim(): Aim {
    const typed = this.values.value("direction");
    return typed === null ? aimed(this.pull, this.held!.link, this.stand, this.free) : { angle: typed, snapped: "" };
  }

  /** How long the arrow is: its head is beside the point, px. */
  private get reach(): number {
    return Math.max(0, Math.hypot(...this.pull) - gapAt(this.held!.link, this.stand));
  }

  private get size(): number {
    const scale = forceScale(this.stand.loads), coarse = nice(scale * COARSE * (1 + 1e-9));
    return this.values.value("size") ?? Math.max(coarse, coarse * Math.round((this.reach * scale) / coarse));
  }

  /** Puts the force into the text; one that is no longer than a slip of the hand stays in hand. */
  private set(): void {
    const { held } = this;
    if (!held || (Math.hypot(...this.pull) < 2 * COARSE && !this.values.any)) return;
    const { key, angle } = direction(this.aim, held.link, this.stand), name = this.aimed;
    const way = this.values.written("direction") ?? written(angle, "angle"), magnitude = this.values.written("size") ?? written(this.size, "force");
    const entry = { kind: "force", on: held.link, at: held.point, [key]: way, magnitude };
    this.drop();
    if (name) void this.sheet.act([{ do: "set", path: ["loads", name], value: entry }]).then(() => this.sheet.bench.select({ kind: "load", name }));
    else void this.last.put([...held.made, { do: "add", section: "loads", stem: "force", entry }]);
    this.sheet.redraw();
  }

  private drop(): void {
    this.held = null;
    this.aimed = "";
    this.values.clear();
  }

  enter(): void {
    if (this.held) this.set();
    else if (!this.last.set() && this.sheet.spot) this.click(this.sheet.spot);
  }

  escape(): boolean {
    this.clicks.drop();
    if (this.values.clear() || this.last.drop()) return true;
    const back = this.held !== null;
    this.drop();
    return back;
  }

  begins(): Vec | null {
    return this.held?.at ?? null;
  }

  fields(): Field[] {
    if (!this.held) return this.last.fields();
    return [this.values.field("size", this.size), this.values.field("direction", this.aim.angle)];
  }

  type(key: string, text: string): string | null {
    return this.held ? this.values.type(key, text, (value) => key === "direction" || value !== 0) : this.last.type(key, text);
  }

  note(): string {
    const snapped = this.held && Math.hypot(...this.pull) >= COARSE ? this.aim.snapped : "";
    return snapped && snapped !== "steps" ? this.sheet.bench.say(`aim.${snapped}`) : "";
  }

  takes = ({ kind, name }: { kind: string; name: string }) =>
    kind === "link" || kind === "load" || (kind === "point" && (this.sheet.scene.points.get(name)?.links.length ?? 0) > 0);

  draw(over: Overlay): void {
    const { held, sheet } = this;
    if (!held) return;
    const at = sheet.camera.screen(held.at), { angle, snapped } = this.aim;
    over.circle(at, 5, "hand pin");
    if (Math.hypot(...this.pull) < COARSE && !this.values.any) return;
    const u: Vec = [Math.cos(angle), -Math.sin(angle)], tip = beyond(at, -gapAt(held.link, this.stand), -angle), long = Math.max(16, this.reach), tail: Vec = [tip[0] - long * u[0], tip[1] - long * u[1]];
    if (snapped === "guide" || snapped === "link") over.path(`M${at[0] - 300 * u[0]} ${at[1] - 300 * u[1]}L${at[0] + 110 * u[0]} ${at[1] + 110 * u[1]}`, "hand dashed");
    const [shaft, head] = arrowPath(tail, tip);
    over.path(shaft, "load thick");
    over.path(head, "load head");
    over.circle(tail, 5, "load pin");
    over.text([(tail[0] + tip[0]) / 2 + 14 * Math.abs(u[1]), (tail[1] + tip[1]) / 2 - 8 * Math.abs(u[0]) - 2], reads(this.size, "force"), u[1] ** 2 > 0.5 ? "load start" : "load");
  }

  leave(): void {
    this.drop();
    this.last.drop();
    this.clicks.drop();
  }
}

export const makeForce: MakeTool = (sheet) => new ForceTool(sheet);

// Torque: a press on a link and a drag around it; the angle swept is the size, its sense the sign.
import type { Vec } from "../../shapes";
import { arcPath, nice } from "../sheet/loads";
import { ClickTool, linkAt, turned, TypedValues } from "./hand";
import { LastLoad } from "./last";
import { taken } from "./marks";
import type { Field, MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";
import { reads } from "./typed";
import { written } from "./written";

// Radius of the arc in hand, px; the torque of a quarter turn where no load says how large torques are, N·m; the sweep of
// the largest one that is there, and the least that is taken, rad.
const R = 30, USUAL = 10, QUARTER = Math.PI / 2, MOST = 1.5 * Math.PI, LEAST = 0.15;

class TorqueTool extends ClickTool implements Tool {
  readonly name = "torque";
  private readonly values: TypedValues;
  private readonly last: LastLoad;
  private link = "";
  private from = 0;
  private swept = 0;

  constructor(sheet: Sheet) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, { size: "torque" });
    this.last = new LastLoad(sheet, [{ key: "size", quantity: "torque", path: "magnitude" }]);
  }

  hint(): [string] {
    return [this.link ? "hint.torque_size" : "hint.torque"];
  }

  override move(spot: Spot): void {
    this.clicks.move(spot);
    this.follow(spot);
    this.sheet.redraw();
  }

  private get middle(): Vec | null {
    const stand = this.sheet.stand, middle = stand.middle(this.link);
    return middle && this.sheet.camera.screen(middle);
  }

  private angleAt({ screen }: Spot): number {
    const [x, y] = this.middle ?? screen;
    return Math.atan2(y - screen[1], screen[0] - x);
  }

  private follow(spot: Spot): void {
    if (!this.link) return;
    const now = this.angleAt(spot), next = this.swept + turned(now - this.from - this.swept);
    this.swept = Math.max(-2 * Math.PI, Math.min(2 * Math.PI, next));
  }

  protected override pulls(): boolean {
    return !this.link;
  }

  protected click(spot: Spot): void {
    const { scene, bench } = this.sheet;
    if (this.link) {
      this.follow(spot);
      return this.set();
    }
    this.last.drop();
    const link = linkAt(spot, scene);
    if (!link) return this.sheet.refuse(Object.keys(scene.links).length ? "refuse.torque_link" : "refuse.no_links");
    this.link = link;
    [this.from, this.swept] = [this.angleAt(spot), 0];
    bench.select({ kind: "link", name: link });
    this.sheet.redraw();
  }

  /** Newton metres for a radian. */
  private get scale(): number {
    const loads = Object.values(this.sheet.stand.loads);
    const most = Math.max(0, ...loads.map(({ kind, magnitude }) => (kind === "torque" ? Math.abs(magnitude ?? 0) : 0)));
    return most > 0 ? most / MOST : USUAL / QUARTER;
  }

  private get size(): number {
    const coarse = nice(this.scale * 0.12), size = coarse * Math.round((this.swept * this.scale) / coarse);
    return this.values.value("size") ?? (size || coarse);
  }

  private set(): void {
    const { link } = this;
    if (!link || (Math.abs(this.swept) < LEAST && !this.values.any)) return;
    const entry = { kind: "torque", on: link, magnitude: this.values.written("size") ?? written(this.size, "torque") };
    this.link = "";
    this.values.clear();
    void this.last.put([{ do: "add", section: "loads", stem: "torque", entry }]);
    this.sheet.redraw();
  }

  enter(): void {
    if (this.link) this.set();
    else if (!this.last.set() && this.sheet.spot) this.click(this.sheet.spot);
  }

  escape(): boolean {
    this.clicks.drop();
    if (this.values.clear() || this.last.drop()) return true;
    const back = this.link !== "";
    this.link = "";
    return back;
  }

  fields(): Field[] {
    return this.link ? [this.values.field("size", this.size)] : this.last.fields();
  }

  type(key: string, text: string): string | null {
    return this.link ? this.values.type(key, text, (value) => value !== 0) : this.last.type(key, text);
  }

  note(): string {
    return this.link && Math.abs(this.swept) >= LEAST ? this.sheet.bench.say(this.size > 0 ? "aim.left" : "aim.right") : "";
  }

  takes = ({ kind }: { kind: string }) => kind === "link" || kind === "load";

  draw(over: Overlay): void {
    const { link, sheet, middle } = this;
    if (!link || !middle) return;
    taken(over, sheet, link);
    if (Math.abs(this.swept) < 0.02 && !this.values.any) return;
    const way = Math.abs(this.swept) >= LEAST ? this.swept : Math.sign(this.size) * QUARTER, [arc, head] = arcPath(middle, R, this.from, this.from + way);
    over.path(arc, "load thick");
    over.path(head, "load head");
    over.text([middle[0] + R + 8, middle[1] - R], reads(this.size, "torque"), "load start");
  }

  leave(): void {
    this.link = "";
    this.values.clear();
    this.last.drop();
    this.clicks.drop();
  }
}

export const makeTorque: MakeTool = (sheet) => new TorqueTool(sheet);

// Pivot: a click sets one, on a joint it fixes it, on a pivot it frees it.
import { ClickTool, freshPoint, pointAt, TypedValues } from "./hand";
import { joint } from "./marks";
import type { MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";
import type { Vec } from "../../shapes";

class PivotTool extends ClickTool implements Tool {
  readonly name = "pivot";
  private readonly values: TypedValues;
  /** Names of pivots that are not in the drawing yet. */
  private readonly coming = new Set<string>();

  constructor(sheet: Sheet) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, { x: "length", y: "length" });
  }

  hint(): [string] {
    return ["hint.pivot"];
  }

  enter(): void {
    if (this.sheet.spot) this.click(this.sheet.spot);
  }

  escape(): boolean {
    if (this.clicks.drop()) return true;
    return this.values.clear();
  }

  fields() {
    const [x, y] = this.sheet.spot ? this.place(this.sheet.spot) : [0, 0];
    return [this.values.field("x", x, { quiet: true }), this.values.field("y", y, { quiet: true })];
  }

  type = (key: string, text: string) => this.values.type(key, text);

  takes = ({ kind }: { kind: string }) => kind === "point" || kind === "link";

  private place({ place: [x, y] }: Spot): Vec {
    return [this.values.value("x") ?? x, this.values.value("y") ?? y];
  }

  /** The point that a click fixes or frees; none where Alt is held or a place is typed. */
  private on(spot: Spot): string | null {
    return this.values.any || spot.alt ? null : pointAt(spot, this.sheet.scene);
  }

  protected click(spot: Spot): void {
    const { scene } = this.sheet, point = this.on(spot);
    if (point) {
      void this.sheet.act([{ do: "fix", point, fixed: !scene.points.get(point)!.fixed }]);
      this.sheet.bench.select({ kind: "point", name: point });
      return;
    }
    const name = freshPoint(scene, true, this.coming), at = this.place(spot), { snap } = spot;
    const on = snap?.kind === "link" && !this.values.any ? snap.name : null;
    this.values.clear();
    void this.make(name, on ? [{ do: "add_point", link: on, point: name, at }, { do: "fix", point: name, fixed: true }] : [{ do: "point", name, at, fixed: true }]);
  }

  private async make(name: string, actions: Parameters<Sheet["act"]>[0]): Promise<void> {
    this.coming.add(name);
    if (await this.sheet.act(actions)) this.sheet.bench.selectMade({ kind: "point", name });
    this.coming.delete(name);
  }

  draw(over: Overlay): void {
    const { spot, camera } = this.sheet;
    if (!spot || this.on(spot)) return;
    const [x, y] = camera.screen(this.place(spot));
    over.path(`M${x} ${y}L${x - 9} ${y + 16}H${x + 9}ZM${x - 15} ${y + 16}H${x + 15}`, "ghost");
    joint(over, [x, y], "ghost pin");
  }

  leave(): void {
    this.values.clear();
    this.clicks.drop();
  }
}

export const makePivot: MakeTool = (sheet) => new PivotTool(sheet);

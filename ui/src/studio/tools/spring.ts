// Spring and its kin: damper, gas spring and cylinder between two points, torsion spring between two links.
import type { Vec } from "../../shapes";
import type { SpringName } from "../bench";
import type { Stand } from "../sheet/loads";
import { type Grip, grip } from "./grip";
import { dist } from "../sheet/geometry";
import { ClickTool, linkAt, pointAt, TypedValues } from "./hand";
import { LastLoad, type Number } from "./last";
import { inHand, taken } from "./marks";
import type { Field, MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";
import { written } from "./written";

const STIFFNESS: Number = { key: "stiffness", quantity: "stiffness", path: "stiffness" };
const FREE: Number = { key: "free_length", quantity: "length", path: "free_length" };
const PUSH: Number = { key: "preload", quantity: "force", path: "preload" };

/** Of each kind: the load that it is in the file, its numbers as they are to begin with, and those that can be typed. */
const KINDS: Record<SpringName, { kind: string; entry: Record<string, string>; numbers: Number[] }> = {
  spring: { kind: "spring", entry: { stiffness: "2 N/mm", free_length: "" }, numbers: [STIFFNESS, FREE] },
  damper: { kind: "damper", entry: { damping: "200 N·s/m" }, numbers: [{ key: "damping", quantity: "damping", path: "damping" }] },
  // A gas spring pushes from its free length on, a cylinder without regard to its length.
  gas_spring: { kind: "spring", entry: { stiffness: "0.2 N/mm", free_length: "", preload: "-200 N" }, numbers: [PUSH, STIFFNESS, FREE] },
  cylinder: { kind: "spring", entry: { stiffness: "0 N/mm", preload: "-1000 N" }, numbers: [PUSH] },
  torsion_spring: { kind: "torsion_spring", entry: { stiffness: "5 N·m/rad", free_angle: "" }, numbers: [{ key: "twist", quantity: "twist", path: "stiffness" }] },
};

class SpringTool extends ClickTool implements Tool {
  readonly name = "spring";
  private readonly values: TypedValues;
  private last: LastLoad;
  private from: Grip | null = null;
  private link = "";

  constructor(sheet: Sheet) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, { stiffness: "stiffness", free_length: "length", preload: "force", damping: "damping", twist: "twist" });
    this.last = new LastLoad(sheet, []);
  }

  private get variant(): SpringName {
    return this.sheet.bench.spring.value;
  }

  private get begun(): boolean {
    return this.from !== null || this.link !== "";
  }

  private get stand(): Stand {
    return this.sheet.stand;
  }

  hint(): [string] {
    if (this.variant === "torsion_spring") return [this.link ? "hint.twist_second" : "hint.twist"];
    return [this.from ? "hint.spring_second" : "hint.spring"];
  }

  protected override pulls(): boolean {
    return !this.begun;
  }

  protected click(spot: Spot): void {
    this.last.drop();
    if (this.variant === "torsion_spring") this.twist(spot);
    else this.stretch(spot);
    this.sheet.redraw();
  }

  private stretch(spot: Spot): void {
    const { scene } = this.sheet, end = grip(spot, scene, this.stand, { frame: true, taken: this.from ? [this.from.point] : [] });
    if (!Object.keys(scene.links).length) return this.sheet.refuse("refuse.no_links");
    if (!this.from) {
      this.from = end;
      return;
    }
    if (end?.point === this.from.point) return;
    if (end!.link === this.from.link) return this.sheet.refuse(end!.link === "frame" ? "refuse.spring_frame" : "refuse.spring_link", { name: end!.link });
    const { from } = this, { kind, numbers } = KINDS[this.variant], entry = { kind, between: [`${from.link}.${from.point}`, `${end!.link}.${end!.point}`], ...this.entry(dist(from.at, end!.at)) };
    this.put([...from.made, ...end!.made], entry, numbers);
  }

  /** The pin of two links, or one link after the other. */
  private twist(spot: Spot): void {
    const { scene } = this.sheet, pin = pointAt(spot, scene), at = pin === null ? null : scene.points.get(pin)!;
    const joined = at ? [...(at.fixed ? ["frame"] : []), ...at.links] : [];
    const link = linkAt(spot, scene), links = !this.link && joined.length === 2 ? joined : this.link && link && link !== this.link ? [this.link, link] : null;
    if (!links) {
      if (link) this.link = link;
      else this.sheet.refuse("refuse.twist_links");
      return;
    }
    const [a, b] = links.map((each) => this.stand.axis(each)), { kind, numbers } = KINDS.torsion_spring;
    const free = a !== null && b !== null ? Math.atan2(Math.sin(b - a), Math.cos(b - a)) : 0;
    const entry = { kind, links, stiffness: this.values.written("twist") ?? KINDS.torsion_spring.entry.stiffness, free_angle: written(free, "angle") };
    this.put([], entry, numbers);
  }

  /** The numbers of the load, as they were typed or usual ones: it is free as it is drawn. */
  private entry(length: number): Record<string, string> {
    const { entry, numbers } = KINDS[this.variant];
    return Object.fromEntries(Object.entries(entry).map(([path, usual]) => {
      const key = numbers.find((each) => each.path === path)?.key ?? "";
      return [path, (key && this.values.written(key)) || usual || written(length, "length")];
    }));
  }

  private put(made: { do: string }[], entry: Record<string, unknown>, numbers: Number[]): void {
    this.drop();
    this.last = new LastLoad(this.sheet, numbers);
    void this.last.put([...made, { do: "add", section: "loads", stem: this.variant, entry }]);
  }

  private drop(): void {
    this.from = null;
    this.link = "";
    this.values.clear();
  }

  enter(): void {
    if (!this.begun && this.last.set()) return;
    if (this.sheet.spot) this.click(this.sheet.spot);
  }

  escape(): boolean {
    this.clicks.drop();
    if (this.values.clear() || this.last.drop()) return true;
    const { begun } = this;
    this.drop();
    return begun;
  }

  begins(): Vec | null {
    return this.from?.at ?? null;
  }

  fields(): Field[] {
    if (!this.begun) return this.last.fields();
    const { numbers } = KINDS[this.variant], { spot } = this.sheet, length = this.from && spot ? dist(this.from.at, spot.place) : 0;
    return numbers.map(({ key, quantity, path }) => this.values.field(key, path === "free_length" ? length : this.usual(path, quantity)));
  }

  private usual(path: string, quantity: Field["quantity"]): number {
    const text = KINDS[this.variant].entry[path], number = parseFloat(text);
    return quantity === "stiffness" ? 1e3 * number : number;
  }

  type = (key: string, text: string) => (this.begun ? this.values.type(key, text, (value) => key === "preload" || value >= 0) : this.last.type(key, text));

  takes = ({ kind }: { kind: string }) => kind === "point" || kind === "link" || kind === "load";

  draw(over: Overlay): void {
    const { sheet, from, link } = this, { spot } = sheet;
    if (link) taken(over, sheet, link);
    if (!from || !spot) return;
    const end = grip(spot, sheet.scene, this.stand, { frame: true, taken: [from.point] })?.at ?? spot.place;
    inHand(over, sheet, from.at, end, false);
    over.circle(sheet.camera.screen(from.at), 5, "hand pin");
  }

  note(): string {
    return this.begun ? this.sheet.bench.say(`variant.${this.variant}`) : "";
  }

  leave(): void {
    this.drop();
    this.last.drop();
    this.clicks.drop();
  }
}

export const makeSpring: MakeTool = (sheet) => new SpringTool(sheet);

// Tools that take elements one after the other, and perhaps a value, then make something of them: slots, gears, cams and kin.
import type { Action } from "../picture";
import type { Vec } from "../../shapes";
import type { Item, ToolName } from "../bench";
import { ClickTool, linkAt, pivotOf, TypedValues } from "./hand";
import type { Field, MakeTool, Overlay, Sheet, Spot, Tool } from "./tool";

/** What has been clicked: a link or a point, with its place (m) and actions that have to come before it is there. */
export interface Picked {
  name: string;
  at: Vec;
  before: Action[];
}

/** What a tool of this kind has in hand. */
export interface Hand {
  readonly sheet: Sheet;
  readonly picked: Picked[];
  readonly values: TypedValues;
}

export interface Step {
  hint: string;
  /** What is taken at a place; null where nothing is, which has been said. */
  pick(hand: Hand, spot: Spot): Picked | null;
  takes(hand: Hand, item: Item): boolean;
}

export interface Picks {
  name: ToolName;
  /** What is made, to be selected. */
  makes: Item["kind"];
  steps: Step[];
  /** The last step, in which values are in hand; none: what is made is made with the last click. */
  last?: {
    hint: string;
    quantities: Record<string, Field["quantity"]>;
    fields(hand: Hand, spot: Spot): Field[];
    admits?(key: string, value: number): boolean;
    takes?(hand: Hand, item: Item): boolean;
    /** From where its direction runs. */
    anchor?(hand: Hand): Vec;
  };
  /** Whether a drag takes what it begins at. */
  drags?: boolean;
  /** What is made; null where nothing is, which has been said. */
  actions(hand: Hand, spot: Spot): Action[] | null;
  draw(over: Overlay, hand: Hand, spot: Spot | null): void;
}

class PickTool extends ClickTool implements Tool, Hand {
  picked: Picked[] = [];
  readonly values: TypedValues;

  constructor(sheet: Sheet, private readonly picks: Picks) {
    super(sheet);
    this.values = new TypedValues(sheet.bench, picks.last?.quantities ?? {});
  }

  get name() {
    return this.picks.name;
  }

  /** Lets go of what is not in the drawing any more. */
  private look(): void {
    const { scene } = this.sheet, there = ({ name, before }: Picked) => before.length > 0 || name in scene.links || scene.points.has(name);
    if (!this.picked.every(there)) this.picked = [];
  }

  private get step(): Step | undefined {
    return this.picks.steps[this.picked.length];
  }

  hint(): [string, Record<string, string>] {
    this.look();
    return [(this.step ?? this.picks.last!).hint, { first: this.picked[0]?.name ?? "", second: this.picked[1]?.name ?? "" }];
  }

  enter(): void {
    if (this.sheet.spot) this.click(this.sheet.spot);
  }

  escape(): boolean {
    if (this.clicks.drop()) return true;
    const back = this.values.clear() || this.picked.length > 0 && this.picked.splice(-1).length > 0;
    this.sheet.redraw();
    return back;
  }

  anchor(): Vec | null {
    return this.step ? null : this.picks.last?.anchor?.(this) ?? null;
  }

  fields(): Field[] {
    this.look();
    const { spot } = this.sheet;
    return this.step || !spot ? [] : this.picks.last!.fields(this, spot);
  }

  type = (key: string, text: string) => this.values.type(key, text, (value) => this.picks.last?.admits?.(key, value) ?? true);

  takes = (item: Item) => (this.step ?? this.picks.last)?.takes?.(this, item) ?? false;

  protected override pulls(): boolean {
    return !!this.picks.drags && !this.picked.length;
  }

  protected click(spot: Spot): void {
    this.look();
    const { step } = this;
    if (step) {
      const found = step.pick(this, spot);
      if (found) this.picked.push(found);
      this.sheet.redraw();
      if (!found || this.step || this.picks.last) return;
    }
    void this.make(spot);
  }

  private async make(spot: Spot): Promise<void> {
    const { picked } = this, actions = this.picks.actions(this, spot), { bench } = this.sheet;
    if (!actions) {
      if (!this.picks.last) picked.splice(-1);
      return;
    }
    this.picked = [];
    const made = await this.sheet.act([...picked.flatMap(({ before }) => before), ...actions]);
    if (made) {
      if (!this.picked.length) this.values.clear();
      const last = picked[picked.length - 1].name;
      bench.selectMade(made.length ? { kind: this.picks.makes, name: made[made.length - 1] } : { kind: "point", name: last });
    } else if (!this.picked.length) this.picked = this.picks.last ? picked : picked.slice(0, -1);
    this.sheet.redraw();
  }

  draw(over: Overlay): void {
    this.look();
    this.picks.draw(over, this, this.sheet.spot);
  }

  leave(): void {
    this.values.clear();
    this.clicks.drop();
    this.picked = [];
  }
}

export const picking = (picks: Picks): MakeTool => (sheet) => new PickTool(sheet, picks);

/** A click on a link with a pivot; `role` is part of the refusals. */
export function pivoted(role: string, hint: string): Step {
  const fits = ({ sheet: { scene }, picked }: Hand) => (link: string) => pivotOf(scene, link) !== null && picked.every(({ name }) => name !== link);
  return {
    hint,
    takes: (hand, { kind, name }) => kind === "link" && fits(hand)(name),
    pick(hand, spot) {
      const { sheet, picked } = hand, { scene } = sheet, link = linkAt(spot, scene, fits(hand));
      if (link && fits(hand)(link)) return { name: link, at: scene.at(pivotOf(scene, link)!)!, before: [] };
      const twice = picked.some(({ name }) => name === link);
      sheet.refuse(!link ? `refuse.${role}_link` : twice ? `refuse.${role}_twice` : `refuse.${role}_pivot`, { link: link ?? "" });
      return null;
    },
  };
}

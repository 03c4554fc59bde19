// The load that was set last: its numbers can still be typed until the next press.
import type { Action } from "../picture";
import { TypedValues } from "./hand";
import type { Field, Sheet } from "./tool";
import { typed } from "./typed";

export interface Number {
  key: string;
  quantity: Field["quantity"];
  /** Its key in the entry of the load. */
  path: string;
}

export class LastLoad {
  private name = "";
  private entry: Record<string, unknown> = {};
  private readonly values: TypedValues;

  constructor(private readonly sheet: Sheet, private numbers: Number[]) {
    this.values = new TypedValues(sheet.bench, Object.fromEntries(numbers.map(({ key, quantity }) => [key, quantity])));
  }

  /** Puts a load into the text, as the last one of these actions, and selects it. */
  async put(actions: Action[]): Promise<void> {
    const made = await this.sheet.act(actions), name = made?.at(-1), entry = actions.at(-1)!.entry;
    if (name === undefined) return;
    this.name = name;
    this.entry = entry as Record<string, unknown>;
    this.sheet.bench.select({ kind: "load", name });
    this.sheet.redraw();
  }

  fields(): Field[] {
    if (!this.name) return [];
    return this.numbers.filter(({ path }) => path in this.entry).map(({ key, quantity, path }) =>
      this.values.field(key, typed(String(this.entry[path]), quantity)?.value ?? 0, { quiet: true }));
  }

  type = (key: string, text: string) => this.values.type(key, text);

  /** Writes what was typed; whether there was anything. */
  set(): boolean {
    const { name } = this, changed = this.numbers.flatMap(({ key, path }) => {
      const value = this.values.written(key);
      return value === null ? [] : [{ path, value }];
    });
    this.values.clear();
    if (!name || !changed.length) return false;
    for (const { path, value } of changed) this.entry[path] = value;
    void this.sheet.act(changed.map(({ path, value }) => ({ do: "set", path: ["loads", name, path], value })));
    return true;
  }

  /** Lets go of it; whether something typed goes with it. */
  drop(): boolean {
    this.name = "";
    return this.values.clear();
  }
}

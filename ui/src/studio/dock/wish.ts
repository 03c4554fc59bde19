// What an optimisation is asked, as its form holds it and as its section of the file has it.
import type { Dimension } from "../../data";

export const SENSES = ["minimize", "maximize"] as const;
export type Sense = (typeof SENSES)[number];
export type Goal = [Sense, string];
type Pair = [string, string];

export interface Wish {
  vary: Pair[];
  goals: Goal[];
  keep: Pair[];
}

const shown = (value: unknown) => (typeof value === "string" ? value : JSON.stringify(value));

/** What a field says: a text, or a catalogue or list in brackets. */
function read(text: string): unknown {
  if (!/^[[{]/.test(text.trim())) return text.trim();
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}

export function wished(asked: Record<string, unknown>): Wish {
  const pairs = (key: string): Pair[] => Object.entries((asked[key] ?? {}) as Record<string, unknown>).map(([name, value]) => [name, shown(value)]);
  const goals = (sense: Sense) => [asked[sense] ?? []].flat().map((name): Goal => [sense, shown(name)]);
  return { vary: pairs("vary"), goals: SENSES.flatMap(goals), keep: pairs("keep") };
}

/** The section of the file, with what stood in it beside these; numbers that stand alone without a list. */
export function writtenWish(wish: Wish, before: Record<string, unknown>): Record<string, unknown> {
  const table = (pairs: Pair[]) => Object.fromEntries(pairs.filter(([name]) => name.trim()).map(([name, value]) => [name.trim(), read(value)]));
  const goals = (sense: Sense) => {
    const names = wish.goals.filter(([each, name]) => each === sense && name.trim()).map(([, name]) => read(name));
    return names.length > 1 ? names : names[0];
  };
  const { vary: _, minimize: __, maximize: ___, keep: ____, ...rest } = before;
  const own = { vary: table(wish.vary), minimize: goals("minimize"), maximize: goals("maximize"), keep: table(wish.keep) };
  const said = Object.entries(own).filter(([, value]) => value !== undefined && (typeof value !== "object" || Object.keys(value ?? {}).length));
  return { ...Object.fromEntries(said), ...rest };
}

/** A range about the present value, in the unit of the file. */
export function about(dimension: Dimension, value: number, size: number): string {
  const now = value / dimension.factor, reach = 0.2 * (Math.abs(now) || (dimension.geometry ? size / dimension.factor : 5));
  const [low, high] = [now - reach, now + reach].map((each) => Number(each.toPrecision(3)));
  return `${low}..${high} ${dimension.unit}`.trim();
}

/** The ends of a range as it is written; null for what is none. */
export function ranged(text: string): { low: string; high: string; unit: string } | null {
  const [, low, high, unit] = /^\s*([-+]?[\d.eE+-]*?)\s*\.\.\s*([-+]?[\d.]*(?:[eE][-+]?\d+)?)\s*(\S*)\s*$/.exec(text) ?? [];
  return low === undefined ? null : { low, high, unit };
}

/** A demand as a bound and a value; no bound for others. */
export function parted(demand: string): [bound: "at least" | "at most" | "", value: string] {
  const [, bound, value] = /^\s*(at least|at most|>=|<=)\s*(.*)$/.exec(demand) ?? [];
  return bound ? [bound === ">=" ? "at least" : bound === "<=" ? "at most" : (bound as "at least"), value] : ["", demand];
}

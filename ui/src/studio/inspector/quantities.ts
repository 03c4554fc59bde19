// Quantities as people type them and as the file has them: a number, a unit, or an expression of parameters.

import { type Quantity, typed as toolTyped } from "../tools/typed";

/** What stands in the file: `number` and `unit` where it is one quantity, else the text alone. */
export interface Typed {
  number: string;
  unit: string;
  text: string;
}

const NUMBER = String.raw`[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?`;
const QUANTITY = new RegExp(`^(${NUMBER})\\s*([^\\s\\d*/+(),.][^+()]*)?$`);
// A comma before the decimals; with three of them behind one to three digits it may separate thousands.
const COMMA = /^([+-]?\d*),(\d+)(?![\d,])/, THOUSANDS = /^[+-]?[1-9]\d{0,2},\d{3}(?!\d)/;
const FULL = /[\uff0b-\uff0e\uff10-\uff19]/g;

/** How units are shown beside a number. */
export const shownUnit = (unit: string) => (unit === "deg" ? "°" : unit);

export function read(text: string): Typed {
  const found = QUANTITY.exec(text.trim());
  return found ? { number: found[1], unit: found[2]?.trim() ?? "", text } : { number: "", unit: "", text };
}

/** A typed text as the file gets it: with the field's unit where it has none, a point for a decimal comma. */
export function typed(text: string, unit: string): string {
  let plain = text.replace(FULL, (each) => String.fromCharCode(each.charCodeAt(0) - 0xfee0)).replaceAll("−", "-").trim();
  if (!THOUSANDS.test(plain)) plain = plain.replace(COMMA, (_, whole: string, part: string) => `${whole || "0"}.${part}`);
  const found = read(plain);
  if (!found.number) return plain;
  const own = found.unit || unit;
  return own ? (known(`${found.number} ${own}`)?.text ?? `${found.number} ${own}`) : found.number;
}

/** The number a step further: about a hundredth of its size, a power of ten; `whole`: not less than one; `share`: of a step. */
export function stepped(number: string, way: 1 | -1, share = 1, whole = false): string {
  const value = Number(number), power = value ? Math.round(Math.log10(Math.abs(value)) - 2) : 0, step = whole ? 1 : 10 ** power * share;
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return String(Number(((Math.round(value / step) + way) * step).toFixed(digits)));
}

const KNOWN: Quantity[] = ["length", "angle", "force", "torque", "stiffness", "mass"];
const FACTORS: Record<string, number> = {
  s: 1, "m/s²": 1, "m/s": 1, "mm/s": 1e-3, "rad/s": 1, rpm: (2 * Math.PI) / 60, "deg/s": Math.PI / 180, "kg·m²": 1, "kg·mm²": 1e-6, "kg/m³": 1,
};

const known = (text: string) => KNOWN.map((each) => toolTyped(text, each)).find((each) => each !== null);

/** SI value of a quantity with a well-known unit; NaN for anything else. */
export function si(text: string): number {
  const { number, unit } = read(text);
  if (!number) return NaN;
  return unit ? (known(`${number} ${unit}`)?.value ?? Number(number) * (FACTORS[unit] ?? NaN)) : Number(number);
}

/** Units by what they are in SI: dimensions of the sheet ask for them at every frame. */
const factors = new Map<string, number>();

/** A value (SI) in a unit, with as many digits as a drawing has. */
export function inUnit(value: number, unit: string, digits = 5): string {
  const factor = factors.get(unit) ?? (si(`1 ${unit}`) || 1), shown = Number((value / factor).toPrecision(digits));
  factors.set(unit, factor);
  return String(Math.abs(shown) < 1e-9 ? 0 : shown);
}

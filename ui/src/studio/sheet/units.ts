// Lengths, angles and other quantities as a person types them, and as they stand beside the drawing.
import type { Settings } from "../bench";
import type { Field } from "../tools/tool";

type Quantity = Field["quantity"];
type Unit = Settings["unit"];

const LENGTHS: Record<string, number> = { mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254, "毫米": 1e-3, "厘米": 1e-2, "米": 1 };
/** Units that may be typed, by quantity, with their SI values; the first is meant where none is typed. */
const UNITS: Partial<Record<Quantity, Record<string, number>>> = {
  length: LENGTHS,
  angle: { deg: Math.PI / 180, "°": Math.PI / 180, rad: 1, "度": Math.PI / 180 },
  force: { N: 1, kN: 1e3 },
  torque: { "N*m": 1, "N·m": 1, Nm: 1, "kN*m": 1e3, "kN·m": 1e3, kNm: 1e3, "N*mm": 1e-3, "N·mm": 1e-3, Nmm: 1e-3 },
  stiffness: { "N/mm": 1e3, "N/m": 1, "kN/m": 1e3 },
  mass: { kg: 1, g: 1e-3, t: 1e3 },
};
/** What a file has for a unit that is typed in another way. */
const WRITTEN: Record<string, string> = { "°": "deg", "度": "deg", "毫米": "mm", "厘米": "cm", "米": "m", "N·m": "N*m", Nm: "N*m", kNm: "kN*m", "kN·m": "kN*m", Nmm: "N*mm", "N·mm": "N*mm" };
/** How a unit is shown. */
const SYMBOLS: Record<string, string> = { deg: "°", "N*m": "N·m", "kN*m": "kN·m", "N*mm": "N·mm" };
const NUMBER = /^\s*([-−+]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$/;

/** The unit that is meant where none is typed, as a file has it; "": the quantity has none. */
export function meant(quantity: Quantity, unit: Unit): string {
  return quantity === "length" ? unit : Object.keys(UNITS[quantity] ?? {})[0] ?? "";
}

export const symbol = (unit: string) => SYMBOLS[unit] ?? unit;

/** A typed text as a file has it, with its unit: "140" becomes "140 mm", "0,12 m" "0.12 m"; null: it cannot be read. */
export function typed(text: string, quantity: Quantity, unit: Unit): string | null {
  if (quantity === "teeth") return text.trim() || null;
  const [, number, given] = NUMBER.exec(text) ?? [];
  if (number === undefined) return null;
  const plain = number.replace(",", ".").replace("−", "-").replace(/^\+/, "").replace(/^(-?)\./, "$10.").replace(/\.$/, ""), known = UNITS[quantity];
  if (!known) return given ? null : plain;
  const named = given || meant(quantity, unit);
  return named in known ? `${plain} ${WRITTEN[named] ?? named}` : null;
}

/** The SI value of a text with its unit; NaN: it has none. */
export function amount(text: string, quantity: Quantity): number {
  const [, number, given] = NUMBER.exec(text) ?? [], known = UNITS[quantity];
  if (number === undefined) return NaN;
  const value = Number(number.replace(",", ".").replace("−", "-"));
  return known ? value * (known[given] ?? NaN) : value;
}

/** A value as it stands in a field: its number to as many places as a hand can mean, and its unit. */
export function shown(value: number, quantity: Quantity, unit: Unit): { number: string; unit: string } {
  const named = meant(quantity, unit), factor = UNITS[quantity]?.[named] ?? 1;
  return { number: rounded(value / factor, quantity === "length" ? places(unit) : quantity === "angle" ? 1 : 3), unit: symbol(named) };
}

/** A length beside the drawing: "117.7 mm". */
export const length = (value: number, unit: Unit) => said(value, "length", unit);

/** An angle (rad) beside the drawing: "−80.9°". */
export const angle = (value: number) => said(value, "angle", "mm");

function said(value: number, quantity: Quantity, unit: Unit): string {
  const found = shown(value, quantity, unit);
  return `${found.number.replace("-", "−")}${found.unit === "°" ? "" : " "}${found.unit}`;
}

/** Decimal places that show a tenth of a millimetre, about. */
const places = (unit: Unit) => ({ mm: 1, cm: 2, m: 4, in: 3 })[unit];

function rounded(value: number, digits: number): string {
  const text = value.toFixed(digits);
  return (text.includes(".") ? text.replace(/\.?0+$/, "") : text).replace(/^-0$/, "0");
}

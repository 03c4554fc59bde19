// Quantities as people type them ("140", "4 in", "0,12 m", "35°", "20 : 40"): what they are in SI, how the file has them.
import type { Settings } from "../bench";
import type { Field } from "./tool";

export type Quantity = Field["quantity"];

export interface Typed {
  /** SI, angles rad; of teeth their ratio, second to first. */
  value: number;
  /** As the file has it: decimal point, unit. */
  text: string;
}

// A unit as the file has it, its size in SI, and other ways to type it; the first of a quantity is understood where none is typed.
type Unit = [symbol: string, factor: number, ...also: string[]];
const DEGREE = Math.PI / 180;
const UNITS: Partial<Record<Quantity, Unit[]>> = {
  length: [["mm", 1e-3, "毫米"], ["cm", 1e-2, "厘米"], ["m", 1, "米"], ["in", 0.0254, '"', "′′", "inch", "英寸"], ["ft", 0.3048, "英尺"], ["µm", 1e-6, "um", "微米"], ["km", 1e3]],
  angle: [["deg", DEGREE, "°", "度"], ["rad", 1, "弧度"], ["rev", 360 * DEGREE, "r", "turn", "转"]],
  force: [["N", 1, "牛"], ["kN", 1e3, "千牛"], ["MN", 1e6], ["mN", 1e-3], ["lbf", 4.4482216152605], ["kgf", 9.80665, "公斤力"]],
  torque: [["N·m", 1, "nm", "n*m", "牛米", "牛·米"], ["kN·m", 1e3, "knm", "kn*m"], ["N·mm", 1e-3, "nmm", "n*mm"], ["lbf·in", 0.1129848290276167, "lbfin", "in·lbf"]],
  stiffness: [["N/mm", 1e3], ["N/m", 1], ["kN/m", 1e3], ["kN/mm", 1e6], ["lbf/in", 175.12683524647636]],
  twist: [["N·m/rad", 1], ["N·m/deg", 1 / DEGREE, "n·m/°"], ["N·mm/rad", 1e-3]],
  damping: [["N·s/m", 1, "ns/m", "n*s/m"], ["N·s/mm", 1e3, "ns/mm", "n*s/mm"], ["kN·s/m", 1e3]],
  rate: [["rpm", 6 * DEGREE, "r/min", "转/分"], ["rad/s", 1], ["deg/s", DEGREE, "°/s"]],
  velocity: [["mm/s", 1e-3], ["m/s", 1], ["m/min", 1 / 60], ["in/s", 0.0254]],
  mass: [["kg", 1, "千克", "公斤"], ["g", 1e-3, "克"], ["t", 1e3, "吨"], ["lb", 0.45359237, "lbs", "磅"]],
};

const NUMBER = /^([+-]?)(\d+(?:[.,]\d*)?|[.,]\d+)(?:e([+-]?\d+))?\s*(.*)$/i;
const TEETH = /^([1-9]\d{0,4})\s*(?:[:/x×]|\s)\s*(-?)\s*([1-9]\d{0,4})$/;

/** A text as a quantity; null where it is none. `unit`: the one of lengths that stand alone. */
export function typed(text: string, quantity: Quantity, unit: Settings["unit"] = "mm"): Typed | null {
  const plain = text.normalize("NFKC").replaceAll("−", "-").trim();
  if (quantity === "teeth") {
    const teeth = TEETH.exec(plain);
    return teeth && { value: Number(teeth[2] + teeth[3]) / Number(teeth[1]), text: `${teeth[1]}:${teeth[2]}${teeth[3]}` };
  }
  const found = NUMBER.exec(plain);
  if (!found) return null;
  const [, sign, digits, power, symbol] = found, number = tidied(digits) + (power ? `e${Number(power)}` : "");
  const known = unitOf(symbol, quantity, unit), value = Number(number) * (sign === "-" ? -1 : 1) * (known?.[1] ?? 0);
  return known && Number.isFinite(value) ? { value, text: `${sign === "-" ? "-" : ""}${number}${known[0] && ` ${known[0]}`}` } : null;
}

function unitOf(symbol: string, quantity: Quantity, unit: Settings["unit"]): Unit | null {
  const units = UNITS[quantity];
  if (!units) return symbol ? null : ["", 1];
  if (!symbol) return (quantity === "length" && units.find(([name]) => name === unit)) || units[0];
  const asked = symbol.replace(/\s/g, "").replaceAll("μ", "µ").replaceAll("⋅", "·");
  const exact = units.find(([name, , ...also]) => name === asked || also.includes(asked.toLowerCase()));
  // MN and mN differ by a capital only; where no other unit is meant, small letters do.
  const alike = units.filter(([name]) => name.toLowerCase() === asked.toLowerCase());
  return exact ?? (alike.length === 1 ? alike[0] : null);
}

/** Digits with a decimal point, without a bare one at an end. */
function tidied(digits: string): string {
  const [whole, rest = ""] = digits.replace(",", ".").split(".");
  return `${whole.replace(/^0+(?=\d)/, "") || "0"}${rest && `.${rest}`}`;
}

/** The unit of a quantity that stands behind a number, and how the number reads in it (SI; angles rad). */
export function shown(value: number, quantity: Quantity, unit: Settings["unit"] = "mm"): [number: string, symbol: string] {
  const [symbol, factor] = unitOf("", quantity, unit) ?? ["", 1], size = value / factor;
  const places = quantity === "length" ? { mm: 1, cm: 2, m: 4, in: 3, ft: 4 }[symbol] ?? 1 : quantity === "angle" ? 1 : null;
  const text = places === null ? String(Number(size.toPrecision(4))) : size.toFixed(places).replace(/\.?0+$/, "");
  return [(text === "-0" ? "0" : text || "0").replace("-", "−"), symbol === "deg" ? "°" : symbol];
}

/** A length as it reads on the sheet with all digits that make sense. */
export function exactly(value: number, unit: Settings["unit"]): string {
  const [symbol, factor] = unitOf("", "length", unit) ?? ["", 1];
  return `${(value / factor).toFixed({ mm: 3, cm: 4, m: 6, in: 4 }[symbol] ?? 4).replace(/\.?0+$/, "").replace("-", "−")} ${symbol}`;
}

/** A length or angle as it reads on the sheet. */
export function reads(value: number, quantity: Quantity, unit: Settings["unit"] = "mm"): string {
  const [number, symbol] = shown(value, quantity, unit);
  return symbol === "°" ? `${number}°` : `${number} ${symbol}`.trim();
}

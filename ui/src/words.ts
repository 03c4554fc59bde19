// Words of the catalogue in the page's language, and quantities with units.
import type { Language, PageData } from "./data";

export class Words {
  constructor(readonly data: PageData, public language: Language) {}

  say(key: string, values: Record<string, string> = {}): string {
    return this.data.words[this.language][key].replace(/\{(\w+)\}/g, (_, name: string) => values[name] ?? "");
  }
}

interface Unit {
  symbol: string;
  factor: number;
}

const KILO: Record<string, [string, string]> = { force: ["N", "kN"], torque: ["N·m", "kN·m"] };
const PLAIN: Record<string, Unit> = {
  angle: { symbol: "°", factor: Math.PI / 180 },
  angular_velocity: { symbol: "rad/s", factor: 1 },
  angular_acceleration: { symbol: "rad/s²", factor: 1 },
  velocity: { symbol: "m/s", factor: 1 },
  acceleration: { symbol: "m/s²", factor: 1 },
  time: { symbol: "s", factor: 1 },
  ratio: { symbol: "", factor: 1 },
};

/** A value is rounding below this share of the size of its kind. */
const ROUNDING = 1e-9;

/** The unit in which a quantity of about this size reads well. */
export function unitFor(kind: string, size: number): Unit {
  if (kind === "length") return size >= 1 ? { symbol: "m", factor: 1 } : { symbol: "mm", factor: 1e-3 };
  const pair = KILO[kind];
  if (pair) return size >= 1e4 ? { symbol: pair[1], factor: 1e3 } : { symbol: pair[0], factor: 1 };
  return PLAIN[kind] ?? { symbol: "", factor: 1 };
}

export function digits(value: number, count = 4): string {
  if (!Number.isFinite(value)) return "–";
  if (Math.abs(value) < 1e-12) return "0";
  if (Math.abs(value) >= 1e7) {
    const [head, power] = value.toExponential(2).split("e+");
    return `${head.replace("-", "−")}·10${Array.from(power).map((digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]).join("")}`;
  }
  const text = value.toPrecision(count);
  return (text.includes("e") ? String(Number(text)) : text.replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "")).replace("-", "−");
}

export function quantity(value: number, kind: string, size = Math.abs(value), count = 4): string {
  const unit = unitFor(kind, size);
  const gap = unit.symbol === "°" || unit.symbol === "" ? "" : " ";
  return digits(Math.abs(value) < ROUNDING * size ? 0 : value / unit.factor, count) + gap + unit.symbol;
}

// Numbers of loads as a person would write them into the file.
import type { Field } from "./tool";

const UNITS: Partial<Record<Field["quantity"], [symbol: string, factor: number, large?: [symbol: string, factor: number, from: number]]>> = {
  length: ["mm", 1e-3], angle: ["deg", Math.PI / 180], force: ["N", 1, ["kN", 1e3, 1e4]], torque: ["N·m", 1, ["kN·m", 1e3, 1e4]],
  stiffness: ["N/mm", 1e3], twist: ["N·m/rad", 1], damping: ["N·s/m", 1], mass: ["kg", 1], rate: ["rpm", Math.PI / 30], velocity: ["mm/s", 1e-3],
};

/** A value (SI, angles rad) with its unit, rounded to digits that a hand can mean. */
export function written(value: number, quantity: Field["quantity"]): string {
  const [symbol, factor, large] = UNITS[quantity] ?? ["", 1], big = large && Math.abs(value) >= large[2];
  const number = value / (big ? large[1] : factor), places = quantity === "angle" || quantity === "length" ? 1 : null;
  const text = String(Number(places === null ? number.toPrecision(4) : number.toFixed(places)));
  // Half a turn is one, whichever way it is made.
  const usual = ({ "-0": "0", ...(quantity === "angle" && { "-180": "180" }) } as Record<string, string>)[text];
  return `${usual ?? text} ${big ? large[0] : symbol}`.trim();
}

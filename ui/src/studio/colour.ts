// Colours of links: those that have names in a model, and any other by its digits.

export const COLOURS: Record<string, string> = { brown: "#8a6d3b", blue: "#2f6f8f", green: "#5f7f36", purple: "#8a4f7d", red: "#a8503f", grey: "#6b7378" };

/** The digits of a colour; "" where it is none. */
export function digitsOf(colour: string): string {
  const digits = COLOURS[colour] ?? colour;
  return /^#[0-9a-f]{6}$/i.test(digits) ? digits : "";
}

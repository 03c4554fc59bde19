// What the server says of a text beside the machine: its entries, its structure, why it cannot be assembled.
import type { Vec } from "../shapes";

/** A value of the text as it is written. */
export type Entry = string | Entry[] | { [key: string]: Entry };

/** The text as nested values; `lines`: where entries stand, by path ("links.crank"), from 1. */
export interface Outline {
  entries: { [key: string]: Entry };
  lines: Record<string, number>;
}

/** A remedy that is one click: `actions` of drawing, or none where it is a setting of the cycle. */
export interface Remedy {
  title: string;
  change: string;
  note: string;
  actions: { do: string }[];
  /** Where points would be by it, m, at the coordinate of the gap. */
  places: Record<string, Vec>;
}

/** Where a machine comes apart: two ends that ought to be one point, and how far the chains to them reach (m). */
export interface Gap {
  title: string;
  sentence: string;
  /** Coordinate of the driver there, as it is written; "": at every position. */
  input: string;
  point: string;
  ends: [Vec, Vec] | null;
  missing: number;
  reaches: { name: string; centre: Vec; radius: number }[];
  /** Whether it is the drawn position that cannot be assembled: there the sheet shows it in place of the machine. */
  drawn: boolean;
  /** Where the pin of the driven link goes: centre, radius (m), direction (rad) at the driver's zero; null: it does not turn. */
  way: { centre: Vec; radius: number; zero: number } | null;
  /** All points as far as they can be placed; the links of the two ends by name. */
  points: Record<string, Vec>;
  chains: [string[], string[]];
  /** Between which coordinates of the driver the machine can be assembled, in its unit (deg or mm). */
  possible: [number, number][];
  unit: "deg" | "mm";
  lengths: { name: string; length: number; wanted: number | null }[];
  remedies: Remedy[];
}

/** Structure of the mechanism for the tab of that name. */
export interface Structure {
  mobility: number;
  /** One line: what the drawing is now. */
  headline: string;
  formula: string;
  class: string;
  groups: { name: string; signature: string; class: string; links: string[]; joints: string[] }[];
}

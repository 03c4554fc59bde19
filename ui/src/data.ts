// What a page carries, as the Python side writes it.
import type { Program } from "./engine";

export type Language = "en" | "zh";
export type Said = Record<Language, string>;

/** How a text holds a number: the first offset of what stands there, the one behind it, what is written before the number
 *  and after it. */
export type Written = [number, number, string, string];

/** `written`: how the text holds it, null: it does not, or, `drawn`, by its drawing; `moves`: it may move what is drawn. */
export interface Dimension {
  address: string;
  value: number;
  unit: string;
  factor: number;
  written: Written | null;
  positive: boolean;
  geometry: boolean;
  moves: boolean;
  drawn: boolean;
}

/** The text's drawing: the input of a steady driver in it, or the nearest position; of its coordinates the rows, how it
 *  holds them, and the SI value of a unit. */
export interface Drawing {
  input: number | null;
  at: number;
  places: [string, Written, number][];
}

export interface Signal {
  id: string;
  form: "row" | "angle" | "size";
  rows: string[];
  kind: string;
  name: Said;
}

export interface Figure {
  id: string;
  kind: "range" | "ratio" | "least" | "largest" | "rms";
  signal: string;
  quantity: string;
  name: Said;
}

export interface Group {
  name: string;
  signature: string;
  links: string[];
  facts: string[];
  wheels: string[];
  dyad: boolean;
}

export interface Point {
  key: string;
  fixed: boolean;
  moved: string[];
}

/** A number of the drawing: factor times and over dimensions where the page has all of them, else its value. */
export interface Amount {
  value: number;
  factor: number;
  times: string[];
  over: string[];
}

export interface Glyph {
  kind: "stamp" | "bar" | "plate" | "rail" | "rod" | "stub" | "cylinder" | "passing" | "spring" | "damper" | "load" | "wheel" | "strands" | "cam" | "rack";
  layer: string;
  at?: string;
  along?: string | number;
  svg?: string;
  shift?: number;
  /** From the point to where it is, along and across the frame, downwards, m. */
  off?: [number, number];
  role?: string;
  points?: string[];
  joint?: string;
  through?: string;
  tie?: string;
  reach?: string[];
  side?: number;
  length?: number;
  barrel?: number;
  piston?: number;
  load?: string;
  link?: string;
  follower?: string;
  carrier?: string;
  trace?: string;
  touch?: "roller" | "knife" | "flat";
  groove?: boolean;
  radius?: Amount | null;
  radii?: Amount[];
  base?: Amount;
  ratio?: Amount | null;
  turn?: Amount;
  second?: boolean;
  teeth?: number | null;
  mesh?: number;
  toothed?: boolean;
  inside?: boolean;
  crossed?: boolean;
  /** Of the link: #rrggbb. */
  colour?: string;
}

/** `rate`: the row of the joint's rate, zero at rest; `on`: links whose reactions add up to the size of that on b; `arm`: friction over the pressing force. */
export interface FrictionTerm {
  field: string;
  rate: string;
  joint: string;
  a: string;
  b: string;
  arm: number;
  slides: boolean;
  on: string[];
}

/** When a load acts; `ramp`: its size goes by the share of that which is passed. */
export type Phase = Interval | PhaseOfOutput;

/** While the first driver's coordinate is between two dimensions. */
export interface Interval {
  load: string;
  kind: "input";
  ramp: boolean;
  between: string[];
}

/** While an output moves, or goes from one of its limits to the other, or in a part of that way. */
export interface PhaseOfOutput {
  load: string;
  kind: "moving" | "stroke";
  ramp: boolean;
  /** The output: its row, or the two of a direction; its rate, that one's rate, and the first one, zero at rest. */
  rows: string[];
  rate: string;
  second: string;
  moving: string;
  ends: ("max" | "min")[];
  part: { word: "first" | "last" | "free"; amounts: [number, boolean][] } | null;
}

/** The angle of link b against a, which begins within half a turn of a dimension's value, or of a number. */
export interface AngleField {
  field: string;
  a: string;
  b: string;
  near: [string, number] | null;
}

/** Angles of a link against its carrier, beyond a dimension's value or a number, at which a cam goes over to another formula. */
export interface Bends {
  link: string;
  carrier: string;
  phase: [string, number];
  angles: number[];
}

export interface Steady {
  driver: string;
  turns: boolean;
  start: number;
  step: number;
  speed: number;
  begin: number;
}

export interface ModelData {
  name: Record<Language, string>;
  purpose: Record<Language, string>;
  source: Record<Language, string>;
  text: string;
  /** The module in base64, its length while a page is unpacked, or its bytes. */
  module: string | number | Uint8Array<ArrayBuffer>;
  program: Program;
  values: Record<string, number>;
  tables: Record<string, number[]>;
  sizes: string;
  dimensions: Dimension[];
  drawing: Drawing;
  positions: {
    count: number;
    closed: boolean;
    period: number | null;
    /** Whether the time goes on evenly from one position to the next, as in a run under forces. */
    run?: boolean;
    /** What the first driver's coordinate gains in a closed cycle. */
    drift: number;
    steady: Steady | null;
    modes: Record<string, number>;
    /** Places among the positions where laws that are not steady go over; null: nothing is known between the positions. */
    breaks: number[] | null;
    time: string | null;
    arrays: Record<string, string>;
    inputs: { name: string; turns: boolean; values: string | null }[];
  };
  fields: Record<string, string>;
  starts: Record<string, number>;
  /** Loads whose course is that of the original. */
  held: string[];
  phases: Phase[];
  angles: AngleField[];
  friction: FrictionTerm[];
  bends: Bends[];
  groups: Group[];
  signals: Signal[];
  numbers: Figure[];
  curves: string[];
  points: Point[];
  glyphs: Glyph[];
  masses: string[];
  undrawn: string[];
}

export interface PageData {
  /** Symbols of the studio's drawing paper, as SVG. */
  symbols?: Record<string, string>;
  language: Language;
  words: Record<Language, Record<string, string>>;
  models: ModelData[];
}

export function bytes(packed: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(packed), (c) => c.charCodeAt(0));
}

export function floats(packed: string): Float64Array {
  return new Float64Array(bytes(packed).buffer);
}

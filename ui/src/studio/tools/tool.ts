// What every tool of the rail is: how it takes the pointer, typed values and keys, and what it draws over the sheet.
import type { Action } from "../picture";
import type { Vec } from "../../shapes";
import type { Bench, Item, ToolName } from "../bench";
import type { Camera } from "../sheet/camera";
import type { Stand } from "../sheet/loads";
import type { Scene } from "../sheet/scene";

/** The key that takes each tool; its name is "tool.…" among the words. */
export const KEYS: Record<ToolName, string> = {
  move: "V", pivot: "P", link: "L", plate: "B", slider: "S", slot: "O", weld: "W", gears: "G", rack: "R", cam: "C", drive: "D", force: "F", torque: "T",
  spring: "K", mass: "M", dimension: "N", target: "U", photo: "I", erase: "E",
};

/** What the pointer (or the cross of the keyboard) is on. `place`: in metres, snapped unless Alt is held; `free`: as it is. */
export interface Spot {
  screen: Vec;
  place: Vec;
  free: Vec;
  /** What it has snapped to, with a sentence such as "Pivot O₂"; null: nothing. */
  snap: Snap | null;
  /** What is under the pointer, in the order of selection; a click takes the first. */
  under: Item[];
  shift: boolean;
  alt: boolean;
  touch: boolean;
}

export interface Snap {
  kind: "point" | "length" | "link" | "line" | "angle" | "grid" | "guide";
  sentence: string;
  at: Vec;
  /** The point or link of the drawing, by name. */
  name: string;
}

/** A value in hand: typed at the cursor, fixed while the pointer moves on. `text`: as typed; null: it follows the pointer. */
export interface Field {
  key: string;
  label: string;
  quantity: "length" | "angle" | "force" | "torque" | "stiffness" | "twist" | "damping" | "mass" | "rate" | "velocity" | "teeth" | "number";
  /** As it is now (SI; angles rad), or a text such as 20 : 40. */
  value: number | string;
  text: string | null;
  /** Shown only once something is typed. */
  quiet?: boolean;
}

/** Strokes over the sheet, in pixels of the screen; cleared before every drawing. A `style` is one or more words: `ghost`
 *  (dashed, what would be made), `hand` (in hand, accent), `soft` (thin, grey), `bad`, `good`, `load`, `force`, `input`,
 *  `velocity`; `thick` (as a bar), `dashed`, `halo` (13 px wide, pale), `fill` (pale inside), `head` (solid, no stroke); of
 *  circles `pin` (as a joint), `ring`; of texts `name` (serif italic), `strong`, `start`, `end` (else in the middle). */
export interface Overlay {
  path(d: string, style: string): void;
  circle(at: Vec, r: number, style: string): void;
  text(at: Vec, text: string, style: string): void;
  /** A dimension line between two places with its text, at a distance from them (px). */
  dimension(a: Vec, b: Vec, text: string, style: string, off?: number): void;
}

/** What a tool may use of the sheet. */
export interface Sheet {
  readonly bench: Bench;
  readonly camera: Camera;
  readonly scene: Scene;
  /** The machine or the drawing as it stands, with directions and loads. */
  readonly stand: Stand;
  /** What else is drawn over the machine, below what the tool draws: called at every drawing, in pixels of the screen. */
  readonly layers: Set<(over: Overlay) => void>;
  /** Where the pointer is now, or was last; null before it has been on the sheet. */
  readonly spot: Spot | null;
  /** Carries out actions on the text as one step that can be undone; gives the names that were made, null where the text
   *  does not admit them (the sentence is shown at the cursor). */
  act(actions: Action[]): Promise<string[] | null>;
  /** Says why a click was refused, at the cursor. */
  refuse(key: string, values?: Record<string, string>): void;
  /** Draws what is over the sheet again. */
  redraw(): void;
  /** Ends the tool and takes another one. */
  take(tool: ToolName): void;
  /** Shows the machine as it is drawn, at rest. */
  toDrawn(): void;
  // the camera: at the middle of the sheet, or at a place of it (px)
  zoom(factor: number, at?: Vec): void;
  /** 100 %. */
  full(): void;
  fit(): void;
  fitSelection(): void;
}

export interface Tool {
  readonly name: ToolName;
  /** The next step, as a key of words with its values; keys stand in brackets in the sentence: [Esc]. */
  hint(): [key: string, values?: Record<string, string>];
  down?(spot: Spot): void;
  move?(spot: Spot): void;
  up?(spot: Spot): void;
  enter?(): void;
  /** Goes back one step and leaves nothing behind; false where there was none to go back. */
  escape(): boolean;
  /** The values in hand, the first one takes digits at once; none: no panel. */
  fields?(): Field[];
  /** From where lengths and directions run: the pointer snaps to horizontal, vertical, steps of 15° and equal lengths. */
  anchor?(): Vec | null;
  /** Where the element in hand begins, m, where nothing snaps from there: the panel keeps clear of it, as of the anchor. */
  begins?(): Vec | null;
  /** Points in hand, to which the pointer does not snap. */
  avoid?(): string[];
  /** What it has snapped to by itself, at the head of the panel ("Along the guide"); "": nothing. */
  note?(): string;
  /** A typed value as a file has it ("140 mm", "30 deg"), "" to let it follow the pointer again; a sentence where it is refused. */
  type?(key: string, text: string): string | null;
  /** Whether it can do something with an element: only those light up. */
  takes?(item: Item): boolean;
  draw?(over: Overlay): void;
  /** Another tool is chosen. */
  leave(): void;
}

export type MakeTool = (sheet: Sheet) => Tool;

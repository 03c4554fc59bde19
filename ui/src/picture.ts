// What of a text can be drawn before it is a machine, and what is done to it.
import type { Load } from "./drawn_loads";

export interface Picture {
  points: Record<string, [number, number]>;
  fixed: string[];
  links: Record<string, string[]>;
  driver: string | null;
  guided: string[];
  loads: Record<string, Load>;
  /** Points that are where the solved machine has them, by its dimensions. */
  placed?: string[];
}

export type Tool = "select" | "fixed" | "link" | "driver" | "guide" | "slot" | "gear" | "rack" | "cam" | "mass" | "load" | "curve" | "photo" | "remove";
export type Action = Record<string, unknown> & { do: string };

// What of a text can be drawn before it is a machine, and what is done to it.
import type { Load } from "./drawn_loads";

export interface Picture {
  points: Record<string, [number, number]>;
  fixed: string[];
  links: Record<string, string[]>;
  driver: string | null;
  guided: string[];
  loads: Record<string, Load>;
  /** m/s²; null: none. */
  gravity?: [number, number] | null;
  masses?: Record<string, Mass>;
  guides?: Record<string, Guide>;
  drives?: Record<string, Drive>;
  /** Points that are where the solved machine has them, by its dimensions. */
  placed?: string[];
  /** Where points could stand that only lengths place, of a text that makes no machine. */
  sketched?: Record<string, [number, number]>;
  /** Links that no places of their points make as long as they are written. */
  unmet?: string[];
  /** Links whose motion nothing determines yet: the machine has not got them. */
  loose?: string[];
}

/** A link's mass, kg (null: no plain number) and as it is written; its centre: a point, coordinates in the link's axes (m)
 *  or null: midway. */
export interface Mass {
  mass: number | null;
  size: string;
  centre: string | [number, number] | null;
}

/** A joint along which a block slides; `direction`: rad in the axes of the guide's link, else along a ray of two points. */
export interface Guide {
  guide: string;
  through: string;
  block: string;
  at: string;
  direction: number | null;
  ray: string[];
}

/** What is driven: a link about its pin, or the joint along which a block slides; `rate`: SI. */
export interface Drive {
  turn: string;
  about: string;
  slide: string;
  speed: string;
  rate: number | null;
}

export type Tool = "select" | "fixed" | "link" | "driver" | "guide" | "slot" | "gear" | "rack" | "cam" | "mass" | "load" | "curve" | "photo" | "remove";
export type Action = Record<string, unknown> & { do: string };

// What of a text can be drawn before it is a machine, and what is done to it.
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

/** A load as the text has it; `angle`: direction in space, rad, null where it turns with the machine or has none. */
export interface Load {
  kind: string;
  on: string;
  at: string;
  angle: number | null;
  ends: string[];
  size: string;
  /** In what its direction stays: space, link, ray (two points of its link) or velocity. */
  held?: string;
  /** Direction in the axes of its link, rad. */
  turn?: number | null;
  ray?: string[];
  /** Along the left normal of the ray. */
  normal?: boolean;
  /** Ends with their links: link and point. */
  between?: [string, string][];
  links?: string[];
  joint?: string;
  /** Size (SI), the largest of a ramp; null: no plain number. */
  magnitude?: number | null;
  stiffness?: number | null;
  preload?: number | null;
  /** Whether it acts all the time. */
  always?: boolean;
}

/** A link's mass, kg (null: no plain number) and as it is written; its centre: a point, coordinates in the link's axes (m)
 *  or null: midway. */
export interface Mass {
  mass: number | null;
  /** kg·m², of one that its shape gives. */
  inertia?: number;
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

export type Action = Record<string, unknown> & { do: string };

// Every tool of the rail by its name.
import type { ToolName } from "../bench";
import { makeErase } from "./erase";
import { makeMove } from "./move";
import type { MakeTool } from "./tool";

/** Stands in for a tool that is not there: it is chosen, and does nothing. */
const missing = (name: ToolName): MakeTool => () => ({ name, hint: () => [`tool.${name}`], escape: () => false, leave: () => undefined });

export const MAKE: Record<ToolName, MakeTool> = {
  move: makeMove,

  pivot: missing("pivot"),

  link: missing("link"),

  plate: missing("plate"),

  slider: missing("slider"),

  slot: missing("slot"),

  weld: missing("weld"),

  gears: missing("gears"),

  rack: missing("rack"),

  cam: missing("cam"),

  drive: missing("drive"),

  force: missing("force"),

  torque: missing("torque"),

  spring: missing("spring"),

  mass: missing("mass"),

  dimension: missing("dimension"),

  target: missing("target"),

  photo: missing("photo"),

  erase: makeErase,
};

// Every tool of the rail by its name.
import type { ToolName } from "../bench";
import { makeErase } from "./erase";
import { makeMove } from "./move";
import { SHAPES } from "./shapes";
import type { MakeTool } from "./tool";

/** Stands in for a tool that is not there: it is chosen, and does nothing. */
const missing = (name: ToolName): MakeTool => () => ({ name, hint: () => [`tool.${name}`], escape: () => false, leave: () => undefined });

export const MAKE: Record<ToolName, MakeTool> = {
  move: makeMove,
  ...SHAPES,
  drive: missing("drive"),
  force: missing("force"),
  torque: missing("torque"),
  spring: missing("spring"),
  mass: missing("mass"),
  target: missing("target"),
  photo: missing("photo"),
  erase: makeErase,
};

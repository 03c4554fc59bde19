// Every tool of the rail by its name.
import type { ToolName } from "../bench";
import { makeDrive } from "./drive";
import { makeErase } from "./erase";
import { makeForce } from "./force";
import { makeMass } from "./mass";
import { makeMove } from "./move";
import { makePhoto } from "./photo";
import { SHAPES } from "./shapes";
import { makeSpring } from "./spring";
import { makeTarget } from "./target";
import type { MakeTool } from "./tool";
import { makeTorque } from "./torque";

export const MAKE: Record<ToolName, MakeTool> = {
  move: makeMove, ...SHAPES, drive: makeDrive, force: makeForce, torque: makeTorque, spring: makeSpring, mass: makeMass, target: makeTarget, photo: makePhoto,
  erase: makeErase,
};

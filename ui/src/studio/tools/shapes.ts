// The tools that draw points, links and pairs, by their names.
import type { ToolName } from "../bench";
import { makeCam } from "./cam";
import { makeDimension } from "./dimension";
import { makeGears } from "./gears";
import { makeLink } from "./link";
import { makePivot } from "./pivot";
import { makePlate } from "./plate";
import { makeRack } from "./rack";
import { makeSlider } from "./slider";
import { makeSlot } from "./slot";
import type { MakeTool } from "./tool";
import { makeWeld } from "./weld";

export const SHAPES = {
  pivot: makePivot, link: makeLink, plate: makePlate, slider: makeSlider, slot: makeSlot, weld: makeWeld, gears: makeGears, rack: makeRack, cam: makeCam,
  dimension: makeDimension,
} satisfies Partial<Record<ToolName, MakeTool>>;

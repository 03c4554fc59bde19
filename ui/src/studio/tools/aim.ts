// The direction of a force in hand: along the guide, along the link, across or up, in steps of 15°; else as it is.
import type { Vec } from "../../shapes";
import type { Stand } from "../sheet/loads";
import { turned } from "./hand";

export interface Aim {
  /** In space, rad. */
  angle: number;
  snapped: "guide" | "link" | "horizontal" | "vertical" | "steps" | "";
}

const NEAR = 10, STEP = Math.PI / 12;

/** Where a force points that is pulled from its point by `pull` (px, y upwards): it pushes back towards the point. */
export function aimed(pull: Vec, link: string, stand: Stand, free: boolean): Aim {
  const angle = Math.atan2(-pull[1], -pull[0]), long = Math.hypot(...pull);
  if (free) return { angle, snapped: "" };
  const off = (other: number) => {
    const turn = Math.abs(turned(angle - other));
    return turn < Math.PI / 4 ? long * Math.sin(turn) : Infinity;
  };
  const guide = stand.guideOf(link)?.angle ?? null, axis = guide === null ? stand.axis(link) : null;
  const round = STEP * Math.round(angle / STEP), square = Math.abs(Math.sin(2 * round)) < 1e-9;
  const found: [number | null, Aim["snapped"]][] = [
    ...both(guide).map((each): [number | null, Aim["snapped"]] => [each, "guide"]),
    ...(square ? [[round, Math.abs(Math.sin(round)) < 0.5 ? "horizontal" : "vertical"] as [number, Aim["snapped"]]] : []),
    ...both(axis).map((each): [number | null, Aim["snapped"]] => [each, "link"]),
    [round, "steps"],
  ];
  const best = found.find(([other]) => other !== null && off(other) <= NEAR);
  return best ? { angle: turned(best[0]!), snapped: best[1] } : { angle, snapped: "" };
}

const both = (angle: number | null) => (angle === null ? [] : [angle, angle + Math.PI]);

/** The direction as the file has it: along a guide or a link it turns with it, else it stays in space. */
export function direction({ angle, snapped }: Aim, link: string, stand: Stand): { key: "direction" | "in_link"; angle: number } {
  const axis = snapped === "guide" || snapped === "link" ? stand.axis(link) : null;
  return axis === null ? { key: "direction", angle: turned(angle) } : { key: "in_link", angle: turned(angle - axis) };
}

// Where a load takes hold: a point of a link, or a new one on a link where none is.
import type { Action } from "../picture";
import type { Vec } from "../../shapes";
import type { Stand } from "../sheet/loads";
import type { Scene } from "../sheet/scene";
import { freshPoint, linkAt, pointAt } from "./hand";
import type { Spot } from "./tool";

export interface Grip {
  link: string;
  point: string;
  at: Vec;
  /** What makes the point, where it is a new one. */
  made: Action[];
}

/** What a press takes hold of: of the links of a pin the block that slides there, else the one under the pointer beside it,
 *  else the last one. `frame`: the frame can be held, too, where nothing else is. */
export function grip(spot: Spot, scene: Scene, stand: Stand, { frame = false, taken = [] as string[] } = {}): Grip | null {
  const point = pointAt(spot, scene);
  if (point) {
    const { at, links, fixed } = scene.points.get(point)!, block = links.find((link) => stand.guideOf(link));
    const beside = links.find((link) => spot.under.some(({ kind, name }) => kind === "link" && name === link));
    const link = block ?? (frame && fixed ? "frame" : (beside ?? links.at(-1)));
    return link ? { link, point, at, made: [] } : null;
  }
  const link = linkAt(spot, scene);
  if (link) {
    const at = spot.snap?.kind === "link" && spot.snap.name === link ? spot.snap.at : spot.free, name = freshPoint(scene, false, taken);
    return { link, point: name, at, made: [{ do: "add_point", link, point: name, at }] };
  }
  if (!frame) return null;
  const name = freshPoint(scene, true, taken);
  return { link: "frame", point: name, at: spot.place, made: [{ do: "point", name, at: spot.place, fixed: true }] };
}

// Weld: click a joint, and the links that it joins are one; again, and they turn about it.
import type { Bench } from "../bench";
import { pointAt } from "./hand";
import { joint } from "./marks";
import { picking } from "./picking";
import type { Scene } from "../sheet/scene";

/** Entries of joints as the text has them, of one kind. */
export function pairs(bench: Bench, kind: string): Record<string, string>[] {
  const joints = bench.desk.solved.value.outline?.entries.joints;
  if (!joints || typeof joints === "string" || Array.isArray(joints)) return [];
  return Object.values(joints).filter((each) => typeof each === "object" && !Array.isArray(each) && each.kind === kind) as Record<string, string>[];
}

const welded = (bench: Bench, point: string) => pairs(bench, "weld").some(({ at }) => at === point);

/** Whether a point joins links, or a link and the frame. */
function joins(scene: Scene, name: string): boolean {
  const point = scene.points.get(name);
  return !!point && point.links.length + Number(point.fixed) > 1;
}

export const makeWeld = picking({
  name: "weld",
  makes: "pair",
  steps: [{
    hint: "hint.weld",
    takes: ({ sheet: { scene } }, { kind, name }) => kind === "point" && joins(scene, name),
    pick({ sheet }, spot) {
      const { scene } = sheet, point = pointAt(spot, scene);
      if (point && joins(scene, point)) return { name: point, at: scene.at(point)!, before: [] };
      sheet.refuse(point ? "refuse.weld_single" : "refuse.weld_joint", { point: point ?? "" });
      return null;
    },
  }],
  actions: ({ sheet: { bench }, picked: [{ name }] }) => [{ do: "weld", point: name, on: !welded(bench, name) }],
  draw(over, { sheet: { scene, camera } }, spot) {
    const point = spot && pointAt(spot, scene);
    if (point && joins(scene, point)) joint(over, camera.screen(scene.at(point)!));
  },
});

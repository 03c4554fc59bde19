// Rack: click the pinion, then the link that slides.
import type { Bench, Item } from "../bench";
import type { Scene } from "../sheet/scene";
import { linkAt, pointAt } from "./hand";
import { taken } from "./marks";
import { picking, pivoted, type Step } from "./picking";
import { pairs } from "./weld";
import type { Spot } from "./tool";

/** Links that slide on the frame, with the points where they are guided. */
export const blocks = (bench: Bench) => pairs(bench, "prismatic").filter(({ guide }) => guide === "frame").map(({ block, at }) => ({ block, at }));

function slidingAt(bench: Bench, scene: Scene, spot: Spot): string | null {
  const all = blocks(bench), point = pointAt(spot, scene);
  const named = spot.under.find(({ kind }) => kind === "pair")?.name;
  const joints = bench.desk.solved.value.outline?.entries.joints as Record<string, Record<string, string>> | undefined;
  return all.find(({ block, at }) => at === point || block === joints?.[named ?? ""]?.block)?.block ?? linkAt(spot, scene, (link) => all.some(({ block }) => block === link));
}

const rack: Step = {
  hint: "hint.rack.rack",
  takes: ({ sheet: { bench } }, { kind, name }: Item) => blocks(bench).some(({ block, at }) => (kind === "link" && block === name) || (kind === "point" && at === name)),
  pick({ sheet, picked: [pinion] }, spot) {
    const { bench, scene } = sheet, link = slidingAt(bench, scene, spot);
    if (link && link !== pinion.name && blocks(bench).some(({ block }) => block === link)) return { name: link, at: scene.corners(link)[0], before: [] };
    sheet.refuse(link ? "refuse.rack_slider" : "refuse.rack_none", { link: link ?? "" });
    return null;
  },
};

export const makeRack = picking({
  name: "rack",
  makes: "pair",
  steps: [pivoted("rack", "hint.rack.pinion"), rack],
  actions: ({ picked: [pinion, slider] }) => [{ do: "rack", pinion: pinion.name, rack: slider.name }],
  draw(over, { sheet, picked: [pinion] }) {
    if (pinion) taken(over, sheet, pinion.name);
  },
});

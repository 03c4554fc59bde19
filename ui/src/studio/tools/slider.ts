// Slider: click a point of a link, then where its guide leads; on another link the guide lies in that link.
import type { Vec } from "../../shapes";
import { dist, heading } from "../sheet/geometry";
import { linkAt, pointAt } from "./hand";
import { arc, guide, joint, taken } from "./marks";
import { picking, type Hand, type Step } from "./picking";
import { movingPoint } from "./slot";
import type { Spot } from "./tool";

// Directions are steps of this, rad; nearer to the point than this there is none, px.
const STEP = Math.PI / 12, NONE = 10;

const at: Step = {
  hint: "hint.slider.point",
  takes: ({ sheet: { scene } }, { kind, name }) => kind === "link" || (kind === "point" && movable(scene.points.get(name))),
  pick(hand, spot) {
    const { sheet } = hand, found = movingPoint(hand, spot, "refuse.slider_point");
    if (!found) return null;
    const there = sheet.scene.points.get(found.name), { name: point } = found;
    if (sheet.scene.guided.includes(point)) sheet.refuse("refuse.slider_there", { point });
    else if (!there || movable(there)) return found;
    else sheet.refuse(there.fixed ? "refuse.slider_pivot" : "refuse.slider_loose", { point });
    return null;
  },
};

const movable = (point?: { fixed: boolean; links: string[] }) => !!point && !point.fixed && point.links.length > 0;

/** The link under the pointer in which the guide would lie. */
function within({ sheet: { scene }, picked: [point], values }: Hand, spot: Spot): string | null {
  const free = (link: string) => scene.links[link].length > 1 && !scene.links[link].includes(point.name);
  const link = values.any || pointAt(spot, scene) ? null : linkAt(spot, scene, free);
  return link && free(link) ? link : null;
}

/** The direction of the guide, in steps of 15° unless Alt is held or it snaps to something else; null: the pointer says none. */
function direction({ sheet, picked: [{ at: from }], values }: Hand, spot: Spot): number | null {
  const given = values.value("angle"), far = dist(sheet.camera.screen(from), spot.screen);
  if (given !== null) return given;
  if (far < NONE) return null;
  const angle = heading(from, spot.alt ? spot.free : spot.place), exact = spot.alt || (spot.snap && ["point", "line", "guide"].includes(spot.snap.kind));
  return exact ? angle : STEP * Math.round(angle / STEP);
}

export const makeSlider = picking({
  name: "slider",
  makes: "pair",
  drags: true,
  steps: [at],
  last: {
    hint: "hint.slider.way",
    quantities: { angle: "angle" },
    fields: (hand, spot) => [hand.values.field("angle", direction(hand, spot) ?? 0)],
    takes: ({ sheet: { scene }, picked: [point] }, { kind, name }) => kind === "link" && scene.links[name]?.length > 1 && !scene.links[name].includes(point.name),
    anchor: ({ picked: [{ at: from }] }): Vec => from,
  },
  actions(hand, spot) {
    const [{ name }] = hand.picked, link = within(hand, spot);
    if (link) return [{ do: "slot", along: link, at: name }];
    const angle = direction(hand, spot);
    return angle === null ? null : [{ do: "guide", at: name, angle: Number(((angle * 180) / Math.PI).toFixed(3)) }];
  },
  draw(over, hand, spot) {
    const { sheet, picked: [point] } = hand;
    if (!point) return;
    const place = sheet.camera.screen(point.at), link = spot && within(hand, spot), angle = spot && direction(hand, spot);
    if (link) {
      const [a, b] = [sheet.scene.corners(link)[0], sheet.scene.corners(link)[sheet.scene.corners(link).length - 1]];
      taken(over, sheet, link);
      guide(over, sheet, point.at, heading(a, b));
    } else if (angle !== null) {
      guide(over, sheet, point.at, angle);
      arc(over, place, angle);
    } else joint(over, place);
  },
});

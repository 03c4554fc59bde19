// Cam: click the link that turns, then the point that follows, then its lift; law and touch are set in the inspector.
import type { Vec } from "../../shapes";
import { dist, heading } from "../sheet/geometry";
import { beyond, pivotOf, pointAt } from "./hand";
import { circle, joint, line, taken } from "./marks";
import { picking, pivoted, type Hand, type Step } from "./picking";
import { blocks } from "./rack";
import type { Spot } from "./tool";
import { reads } from "./typed";

// A lift is not smaller than this, m; it is set in steps of this share of the distance of the follower.
const LEAST = 1e-4, OFF = 26;

/** The link that a cam at a link would move by a point: it slides, or turns about a pivot, on the frame. */
function follower({ sheet: { bench, scene }, picked: [cam] }: Hand, point: string): string | null {
  const all = blocks(bench);
  const moved = (link: string) => all.some(({ block }) => block === link) || (pivotOf(scene, link) !== null && pivotOf(scene, link) !== point);
  return (scene.points.get(point)?.links ?? []).find((link) => link !== cam.name && moved(link)) ?? null;
}

const at: Step = {
  hint: "hint.cam.follower",
  takes: (hand, { kind, name }) => kind === "point" && follower(hand, name) !== null,
  pick(hand, spot) {
    const { sheet, picked: [cam] } = hand, point = pointAt(spot, sheet.scene);
    if (point && follower(hand, point)) return { name: point, at: sheet.scene.at(point)!, before: [] };
    const own = point && sheet.scene.links[cam.name]?.includes(point);
    sheet.refuse(!point ? "refuse.cam_point" : own ? "refuse.cam_own" : "refuse.cam_follower", { point: point ?? "", link: cam.name });
    return null;
  },
};

/** The lift that the pointer sets: how far it is from the follower, away from the cam. */
function lift({ picked: [cam, point], values }: Hand, spot: Spot): number {
  const far = dist(cam.at, spot.place) - dist(cam.at, point.at);
  return values.value("lift") ?? Math.max(0, Math.round(far / LEAST) * LEAST);
}

export const makeCam = picking({
  name: "cam",
  makes: "pair",
  steps: [pivoted("cam", "hint.cam.cam"), at],
  last: {
    hint: "hint.cam.lift",
    quantities: { lift: "length" },
    fields: (hand, spot) => [hand.values.field("lift", lift(hand, spot))],
    admits: (_key, value) => value >= LEAST,
  },
  actions(hand, spot) {
    const { sheet, picked: [cam, point], values } = hand, size = lift(hand, spot);
    if (size >= LEAST) return [{ do: "cam", cam: cam.name, at: point.name, lift: values.written("lift") ?? `${Number((1e3 * size).toFixed(1))} mm` }];
    sheet.refuse("refuse.cam_lift", { point: point.name });
    return null;
  },
  draw(over, hand, spot) {
    const { sheet, picked: [cam, point] } = hand, screen = (place: Vec) => sheet.camera.screen(place);
    if (cam) taken(over, sheet, cam.name);
    if (!point) return;
    joint(over, screen(point.at));
    const base = dist(screen(cam.at), screen(point.at)), size = spot ? lift(hand, spot) : 0, to = beyond(point.at, size, heading(cam.at, point.at));
    circle(over, screen(cam.at), base, "ghost");
    if (!size) return;
    circle(over, screen(cam.at), base + sheet.camera.scale * size, "soft dashed");
    over.path(line(screen(point.at), screen(to)), "ghost thick");
    over.dimension(screen(point.at), screen(to), reads(size, "length", sheet.bench.settings.value.unit), "hand strong", OFF);
  },
});

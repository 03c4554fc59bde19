// Slot: click the slotted link, then the point that slides in it.
import { dropped, endAt, linkAt, pointAt } from "./hand";
import { joint, line, taken } from "./marks";
import { picking, type Hand, type Picked, type Step } from "./picking";
import type { Spot } from "./tool";

const along: Step = {
  hint: "hint.slot.link",
  takes: ({ sheet: { scene } }, { kind, name }) => kind === "link" && scene.links[name]?.length > 1,
  pick({ sheet }, spot) {
    const { scene } = sheet, long = (link: string) => scene.links[link].length > 1, link = linkAt(spot, scene, long);
    if (link && long(link)) return { name: link, at: scene.corners(link)[0], before: [] };
    sheet.refuse(link ? "refuse.slot_short" : "refuse.slot_link", { link: link ?? "" });
    return null;
  },
};

/** The point of a link, or the place on it, that slides or turns; `refusal`: what is said where there is none. */
export function movingPoint({ sheet, picked }: Hand, spot: Spot, refusal: string): Picked | null {
  const { scene } = sheet, point = pointAt(spot, scene), end = endAt(spot, scene, picked.map(({ name }) => name));
  if (point) return { name: point, at: scene.at(point)!, before: [] };
  if (end.on && !picked.some(({ name }) => name === end.on)) return { name: end.name, at: end.at, before: dropped(end) };
  sheet.refuse(refusal, { link: picked[0]?.name ?? "" });
  return null;
}

const at: Step = {
  hint: "hint.slot.point",
  takes: ({ sheet: { scene }, picked: [{ name }] }, item) => item.kind === "point" && !scene.links[name]?.includes(item.name),
  pick(hand, spot) {
    const { sheet, picked: [{ name: link }] } = hand, found = movingPoint(hand, spot, "refuse.slot_point");
    if (!found || !sheet.scene.links[link]?.includes(found.name)) return found;
    sheet.refuse("refuse.slot_own", { point: found.name, link });
    return null;
  },
};

export const makeSlot = picking({
  name: "slot",
  makes: "pair",
  steps: [along, at],
  actions: ({ picked: [link, point] }) => [{ do: "slot", along: link.name, at: point.name }],
  draw(over, { sheet, picked: [link] }, spot) {
    if (!link) return;
    taken(over, sheet, link.name);
    const { camera, scene } = sheet, corners = scene.corners(link.name).map((each) => camera.screen(each)), point = spot && pointAt(spot, scene);
    if (!spot || corners.length < 2) return;
    const place = point ? camera.screen(scene.at(point)!) : camera.screen(spot.place), [a, b] = [corners[0], corners[corners.length - 1]];
    const share = ((place[0] - a[0]) * (b[0] - a[0]) + (place[1] - a[1]) * (b[1] - a[1])) / ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2 || 1);
    over.path(line([a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])], place), "ghost");
    joint(over, place, "ghost pin");
  },
});

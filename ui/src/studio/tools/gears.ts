// Gears: click two links that turn on one carrier; the pointer on the line of their centres sets the ratio, beyond one of them
// one wheel lies inside the other.
import type { Vec } from "../../shapes";
import type { Scene } from "../sheet/scene";
import { dist } from "../sheet/geometry";
import { linkAt, pivotOf } from "./hand";
import { circle, line, taken } from "./marks";
import { picking, type Hand, type Step } from "./picking";
import type { Spot } from "./tool";

// Teeth of the smaller wheel that the pointer sets, and the most of the larger; a ring has so many more at least. The pointer
// sets teeth by fives, so that ratios are round, unless Alt is held.
const SMALL = 20, LARGE = 400, MORE = 10, FIVES = 5;

export interface Wheels {
  /** Numbers of teeth, first and second. */
  teeth: [number, number];
  inside: boolean;
}

/** The wheels that a place sets, seen from the first centre towards the second. */
export function wheels(a: Vec, b: Vec, [x, y]: Vec, step = FIVES): Wheels {
  const far = dist(a, b), t = ((x - a[0]) * (b[0] - a[0]) + (y - a[1]) * (b[1] - a[1])) / far ** 2, inside = t < 0 || t > 1;
  const [first, second] = [Math.abs(t), Math.abs(1 - t)], ratio = Math.max(first, second) / Math.max(Math.min(first, second), 1e-9);
  const large = Math.min(LARGE, Math.max(inside ? SMALL + MORE : SMALL, step * Math.round((SMALL * ratio) / step)));
  return { teeth: first < second ? [SMALL, large] : [large, SMALL], inside };
}

/** Radii of the pitch circles at a distance of the centres. */
export function radii({ teeth: [a, b], inside }: Wheels, far: number): [number, number] {
  const unit = far / (inside ? Math.abs(a - b) : a + b);
  return [a * unit, b * unit];
}

/** The points about which two links turn on one carrier: the frame, else a link that is pinned to both. */
export function centres(scene: Scene, a: string, b: string): [string, string] | null {
  const common = (one: string, other: string) => scene.links[one].find((point) => scene.links[other].includes(point));
  const fixed = [pivotOf(scene, a), pivotOf(scene, b)], carriers = Object.keys(scene.links).filter((link) => link !== a && link !== b);
  const found = [fixed, ...carriers.map((carrier) => [common(a, carrier), common(b, carrier)])].filter(([first, second]) => first && second);
  return (found.find(([first, second]) => first !== second) ?? found[0] ?? null) as [string, string] | null;
}

/** A link that can be a wheel: it turns on the frame or on another link. */
const turns = (scene: Scene, link: string) => scene.links[link].some((name) => scene.points.get(name)?.fixed || scene.points.get(name)!.links.length > 1);

const first: Step = {
  hint: "hint.gears.first",
  takes: ({ sheet: { scene } }, { kind, name }) => kind === "link" && name in scene.links && turns(scene, name),
  pick({ sheet }, spot) {
    const { scene } = sheet, link = linkAt(spot, scene, (name) => turns(scene, name));
    if (link && turns(scene, link)) return { name: link, at: scene.corners(link)[0], before: [] };
    sheet.refuse(link ? "refuse.gears_pivot" : "refuse.gears_link", { link: link ?? "" });
    return null;
  },
};

const second: Step = {
  hint: "hint.gears.second",
  takes: ({ sheet: { scene }, picked: [{ name: one }] }, { kind, name }) => kind === "link" && name !== one && name in scene.links && centres(scene, one, name) !== null,
  pick({ sheet, picked: [{ name: one }] }, spot) {
    const { scene } = sheet, link = linkAt(spot, scene, (name) => name !== one && centres(scene, one, name) !== null);
    const found = link && link !== one ? centres(scene, one, link) : null;
    if (link && found && found[0] !== found[1]) return { name: link, at: scene.corners(link)[0], before: [] };
    const why = !link ? "link" : link === one ? "twice" : found ? "same" : "apart";
    sheet.refuse(`refuse.gears_${why}`, { link: link ?? "", first: one });
    return null;
  },
};

/** The places of the two centres, m. */
const middles = ({ sheet: { scene }, picked: [a, b] }: Hand): [Vec, Vec] => centres(scene, a.name, b.name)!.map((name) => scene.at(name)!) as [Vec, Vec];

function asked(hand: Hand, spot: Spot): Wheels {
  const free = wheels(...middles(hand), spot.free, spot.alt ? 1 : FIVES), text = hand.values.written("teeth");
  if (!text) return free;
  const [a, b] = text.split(":").map(Number);
  return { teeth: [a, Math.abs(b)], inside: b < 0 || free.inside };
}

export const makeGears = picking({
  name: "gears",
  makes: "pair",
  steps: [first, second],
  last: {
    hint: "hint.gears.teeth",
    quantities: { teeth: "teeth" },
    fields: (hand, spot) => [hand.values.field("teeth", asked(hand, spot).teeth.join(" : "))],
  },
  actions(hand, spot) {
    const { picked, sheet } = hand, { teeth, inside } = asked(hand, spot);
    if (inside && teeth[0] === teeth[1]) {
      sheet.refuse("refuse.gears_inside");
      return null;
    }
    return [{ do: "gear", links: picked.map(({ name }) => name), teeth: teeth.join(":"), inside }];
  },
  draw(over, hand, spot) {
    const { sheet, picked } = hand;
    for (const { name } of picked) taken(over, sheet, name);
    if (!spot || picked.length < 2) return;
    const found = asked(hand, spot), [a, b] = middles(hand).map((at) => sheet.camera.screen(at)), sizes = radii(found, dist(a, b));
    over.path(line(a, b), "soft dashed");
    [a, b].forEach((centre, k) => {
      if (Number.isFinite(sizes[k])) circle(over, centre, sizes[k], "ghost");
      over.text([centre[0], centre[1] - 14], String(found.teeth[k]), "hand strong");
    });
  },
});

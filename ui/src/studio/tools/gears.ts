// Gears: click two links with pivots; the pointer on the line of their pivots sets the ratio, beyond a pivot one lies inside.
import type { Vec } from "../../shapes";
import { distance, linkAt, pivotOf } from "./hand";
import { circle, line, taken } from "./marks";
import { picking, type Hand, type Step } from "./picking";
import type { Spot } from "./tool";

// Teeth of the smaller wheel that the pointer sets, and the most of the larger; a ring has so many more at least.
const SMALL = 20, LARGE = 400, MORE = 8;

/** A click on a link with a pivot; `role` is part of the refusals. */
export function pivoted(role: string, hint: string): Step {
  const fits = ({ sheet: { scene }, picked }: Hand) => (link: string) => pivotOf(scene, link) !== null && picked.every(({ name }) => name !== link);
  return {
    hint,
    takes: (hand, { kind, name }) => kind === "link" && fits(hand)(name),
    pick(hand, spot) {
      const { sheet, picked } = hand, { scene } = sheet, link = linkAt(spot, scene, fits(hand));
      if (link && fits(hand)(link)) return { name: link, at: scene.at(pivotOf(scene, link)!)!, before: [] };
      const twice = picked.some(({ name }) => name === link);
      sheet.refuse(!link ? `refuse.${role}_link` : twice ? `refuse.${role}_twice` : `refuse.${role}_pivot`, { link: link ?? "" });
      return null;
    },
  };
}

export interface Wheels {
  /** Numbers of teeth, first and second. */
  teeth: [number, number];
  inside: boolean;
}

/** The wheels that a place sets, seen from the first centre towards the second. */
export function wheels(a: Vec, b: Vec, [x, y]: Vec): Wheels {
  const far = distance(a, b), t = ((x - a[0]) * (b[0] - a[0]) + (y - a[1]) * (b[1] - a[1])) / far ** 2, inside = t < 0 || t > 1;
  const [first, second] = [Math.abs(t), Math.abs(1 - t)], ratio = Math.max(first, second) / Math.max(Math.min(first, second), 1e-9);
  const large = Math.min(LARGE, Math.max(inside ? SMALL + MORE : SMALL, Math.round(SMALL * ratio)));
  return { teeth: first < second ? [SMALL, large] : [large, SMALL], inside };
}

/** Radii of the pitch circles at a distance of the centres. */
export function radii({ teeth: [a, b], inside }: Wheels, far: number): [number, number] {
  const unit = far / (inside ? Math.abs(a - b) : a + b);
  return [a * unit, b * unit];
}

function asked({ sheet, picked: [a, b], values }: Hand, spot: Spot): Wheels {
  const free = wheels(a.at, b.at, spot.free), text = values.written("teeth");
  if (!text) return free;
  const [first, second] = text.split(":").map(Number);
  return { teeth: [first, Math.abs(second)], inside: second < 0 || (free.inside && sheet.spot !== null) };
}

export const makeGears = picking({
  name: "gears",
  makes: "pair",
  steps: [pivoted("gears", "hint.gears.first"), apart(pivoted("gears", "hint.gears.second"))],
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
    const found = asked(hand, spot), [a, b] = picked.map(({ at }) => sheet.camera.screen(at)), sizes = radii(found, distance(a, b));
    over.path(line(a, b), "soft dashed");
    [a, b].forEach((centre, k) => {
      if (Number.isFinite(sizes[k])) circle(over, centre, sizes[k], "ghost");
      over.text([centre[0], centre[1] - 14], String(found.teeth[k]), "hand strong");
    });
  },
});

/** The same step for wheels whose pivots are apart. */
function apart(step: Step): Step {
  return {
    ...step,
    pick(hand, spot) {
      const found = step.pick(hand, spot);
      if (!found || distance(found.at, hand.picked[0].at) > 1e-6) return found;
      hand.sheet.refuse("refuse.gears_same");
      return null;
    },
  };
}

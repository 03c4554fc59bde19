// How what can be drawn of a text differs from what could be drawn of another one.
import type { Picture } from "../picture";
import type { Vec } from "../../shapes";

/** How a picture differs from another one: not at all, by what has been added, by its places alone, or otherwise. */
export type Change = "same" | "more" | "moved" | "other";

export function compare(old: Picture, now: Picture): Change {
  if (!grown(old, now)) return "other";
  const more = !grown(now, old), near = ([a, b]: Vec, [c, d]: Vec) => Math.hypot(a - c, b - d) < 1e-6;
  const stays = Object.entries(old.points).every(([name, at]) => near(at, now.points[name]));
  return stays ? (more ? "more" : "same") : more ? "other" : "moved";
}

/** Whether a picture has all that another one had, wherever that is. */
function grown(old: Picture, now: Picture): boolean {
  return (
    Object.keys(old.points).every((name) => name in now.points) &&
    old.fixed.every((name) => now.fixed.includes(name)) && old.guided.every((name) => now.guided.includes(name)) &&
    Object.entries(old.links).every(([name, points]) => now.links[name]?.join() === points.join()) &&
    Object.keys(old.loads).every((name) => name in now.loads)
  );
}

/** A picture without some of its links, and the points that only these have. */
export function without(picture: Picture, loose: string[], bare: string[]): Picture {
  const links = Object.fromEntries(Object.entries(picture.links).filter(([name]) => !loose.includes(name))), left = new Set([...Object.values(links).flat(), ...picture.fixed]);
  return { ...picture, links, points: Object.fromEntries(Object.entries(picture.points).filter(([name]) => left.has(name) && !bare.includes(name))) };
}

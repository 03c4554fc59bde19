// How the window is shared out: by its size, and by the dividers that a hand has moved.
import type { Bench } from "../bench";

const PHONE = "(max-width: 860px)", LARGE = "(min-width: 1920px)";
/** Pixels: what the regions have unasked, and what dividers leave. */
export const INSPECTOR = { usual: 340, large: 400, least: 280, share: 0.5 };
export const DOCK = { usual: 264, large: 340, least: 120, share: 0.6 };
/** Below this width the rail has icons alone, unless it is set otherwise. */
export const NARROW = 1120;
/** The dock shut: its time line alone. */
export const SHUT = 56;
/** Pixels by which an arrow key moves a divider. */
export const STEP = 16;

interface Limits {
  usual: number;
  large: number;
  least: number;
  share: number;
}

/** The size of a region: as set, else as usual, within its limits in a room of so many pixels. */
export function sized(set: number | null, room: number, large: boolean, { usual, large: most, least, share }: Limits): number {
  return Math.round(Math.max(least, Math.min(set ?? (large ? most : usual), share * room)));
}

/** Keeps the layout after the size of the window; gives what ends that. */
export function followWindow(bench: Bench): () => void {
  const queries = [PHONE, LARGE].map((each) => matchMedia(each));
  // Paper is not a window: what is printed is the room as it is.
  const follow = () => matchMedia("print").matches || (bench.layout.value = queries[0].matches ? "phone" : queries[1].matches ? "large" : "desk");
  for (const each of queries) each.addEventListener("change", follow);
  follow();
  return () => queries.forEach((each) => each.removeEventListener("change", follow));
}

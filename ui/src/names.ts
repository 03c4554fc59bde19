// Names of points: where they cover least of the drawing and no other name, and where they were while that is as good.
import type { Vec } from "./shapes";
import { element, put, tenth } from "./strokes";

// Sizes of letters on wide paper, and the widths of a letter and of one of an index, as shares of it.
const SIZE = 14, LETTER = 0.56, LOW = 0.42;
// Where a name may stand: directions in degrees, clockwise, and gaps to its point, the ones liked best first.
const WAYS = [-45, 45, -135, 135, -90, 90, 0, 180, -20, 20, -160, 160].map((each): Vec => [Math.cos((each * Math.PI) / 180), Math.sin((each * Math.PI) / 180)]);
const GAPS = [11, 18, 28];
// What a unit of ink under a name costs beside a unit of gap and a place less liked; what a name gains by staying.
const INK = 1.6, FAR = 0.45, LIKED = 0.5, STAY = 12;
// A short name with a number behind it has that as an index.
const INDEXED = /^(\p{L}{1,2}'*)_?(\d+'*)$/u;

type Box = [left: number, top: number, right: number, bottom: number];

interface Name {
  text: SVGElement;
  letters: number;
  place: number;
}

export class Names {
  private readonly names = new Map<string, Name>();

  constructor(keys: string[], private readonly layer: SVGElement) {
    for (const key of keys) {
      const name = key.replace(/.*\./, ""), [, stem, index] = INDEXED.exec(name) ?? [name, name, ""];
      const text = element("text", { class: "lw-name" }, layer);
      text.append(stem);
      if (index) element("tspan", { dy: "0.36em", "font-size": "70%" }, text).append(index);
      this.names.set(key, { text, letters: LETTER * stem.length + LOW * index.length, place: -1 });
    }
  }

  get count(): number {
    return this.names.size;
  }

  /** Names at the places of their points; `ink`: ends of the strokes that are drawn. One without room is left out. */
  write(at: (key: string) => Vec, ink: number[], zoom: number, width: number, height: number): void {
    const size = SIZE / Math.sqrt(zoom), taken: Box[] = [];
    this.layer.setAttribute("font-size", String(Math.round(size)));
    for (const [key, name] of this.names) {
      const wide = size * name.letters + 2, high = 0.95 * size, [x, y] = at(key), reach = GAPS[GAPS.length - 1] + wide;
      const near = within([x - reach, y - reach, x + reach, y + reach], ink);
      const box = (k: number): Box | null => {
        const [dx, dy] = WAYS[k % WAYS.length], gap = GAPS[Math.floor(k / WAYS.length)];
        const u = x + dx * (gap + (wide / 2) * Math.abs(dx)), v = y + dy * (gap + (high / 2) * Math.abs(dy));
        const found: Box = [u - wide / 2, v - high / 2, u + wide / 2, v + high / 2];
        return found[0] < 0 || found[1] < 0 || found[2] > width || found[3] > height || taken.some((other) => meet(found, other)) ? null : found;
      };
      let best = name.place < 0 ? null : box(name.place), chosen = name.place;
      // A place where nothing is covered is kept: names do not jump while the machine moves.
      if (!best || under(best, near) > 0) {
        let least = Infinity;
        best = null;
        for (let k = 0; k < WAYS.length * GAPS.length; k++) {
          const found = box(k);
          if (!found) continue;
          const cost = INK * under(found, near) + FAR * GAPS[Math.floor(k / WAYS.length)] + LIKED * (k % WAYS.length) - (k === name.place ? STAY : 0);
          if (cost < least) [best, least, chosen] = [found, cost, k];
        }
      }
      put(name.text, "visibility", best ? "visible" : "hidden");
      if (!best) continue;
      name.place = chosen;
      taken.push(best);
      put(name.text, "transform", `translate(${tenth(best[0] + 1)} ${tenth(best[3] - 0.16 * size)})`);
    }
  }
}

function meet(a: Box, b: Box): boolean {
  return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
}

/** The strokes that come near a box. */
function within([left, top, right, bottom]: Box, ink: number[]): number[] {
  const found: number[] = [];
  for (let k = 0; k < ink.length; k += 4) {
    const ax = ink[k], ay = ink[k + 1], bx = ink[k + 2], by = ink[k + 3];
    if ((ax < left && bx < left) || (ax > right && bx > right) || (ay < top && by < top) || (ay > bottom && by > bottom)) continue;
    found.push(ax, ay, bx, by);
  }
  return found;
}

/** How much of the strokes lies in a box: their length in it, and a little for each of them. */
function under([left, top, right, bottom]: Box, ink: number[]): number {
  let found = 0;
  for (let k = 0; k < ink.length; k += 4) {
    const ax = ink[k], ay = ink[k + 1], dx = ink[k + 2] - ax, dy = ink[k + 3] - ay;
    let first = 0, last = 1;
    if (dx) {
      const a = (left - ax) / dx, b = (right - ax) / dx;
      first = Math.max(first, Math.min(a, b));
      last = Math.min(last, Math.max(a, b));
    } else if (ax < left || ax > right) continue;
    if (dy) {
      const a = (top - ay) / dy, b = (bottom - ay) / dy;
      first = Math.max(first, Math.min(a, b));
      last = Math.min(last, Math.max(a, b));
    } else if (ay < top || ay > bottom) continue;
    if (last > first) found += 4 + (last - first) * Math.hypot(dx, dy);
  }
  return found;
}

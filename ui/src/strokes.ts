// Strokes of the drawing, in pixels of the paper: path texts of symbols, and elements of SVG.
import type { Vec } from "./shapes";

const NS = "http://www.w3.org/2000/svg";
const TURN = 2 * Math.PI;
// Teeth on the paper: their pitch where their number is not known, heights over and under the pitch line; the finest.
export const PITCH = 11, TALL = 3.2, DEEP = 3.6, FINEST = 4;

/** How long the longest vector of a kind is drawn, px. */
export const VECTOR = 90;

export function element(tag: string, attributes: Record<string, string | number> = {}, parent?: Element): SVGElement {
  const made = document.createElementNS(NS, tag);
  for (const name in attributes) made.setAttribute(name, String(attributes[name]));
  parent?.append(made);
  return made;
}

/** Gives a bar or a plate a colour of its own; style sheets make it legible. */
export function tint(of: SVGElement, colour?: string): void {
  if (!colour) return;
  of.classList.add("own");
  of.style.setProperty("--own", colour);
}

export const tenth = (x: number) => Math.round(10 * x) / 10;
export const line = (points: Vec[], closed = false) =>
  points.map(([x, y], k) => `${k ? "L" : "M"}${tenth(x)} ${tenth(y)}`).join("") + (closed && points.length ? "Z" : "");
export const away = ([x, y]: Vec, [u, v]: Vec, far: number, side = 0): Vec => [x + far * u - side * v, y + far * v + side * u];

export function place(of: SVGElement, a: string, b: string, [x, y]: Vec): void {
  put(of, a, x.toFixed(2));
  put(of, b, y.toFixed(2));
}

export const far = (a: Vec, b: Vec) => Math.hypot(b[0] - a[0], b[1] - a[1]);

export function unit(a: Vec, b: Vec): Vec {
  const d = far(a, b) || 1;
  return [(b[0] - a[0]) / d, (b[1] - a[1]) / d];
}

export function arrow(shaft: SVGElement, head: SVGElement, from: Vec, to: Vec): void {
  const length = far(from, to), u = unit(from, to), size = Math.min(9, length);
  put(shaft, "d", line([from, away(to, u, -0.7 * size)]));
  put(head, "d", line([to, away(to, u, -size, -0.38 * size), away(to, u, -size, 0.38 * size)], true));
}

export function put(of: Element, name: string, value: string): void {
  if (of.getAttribute(name) !== value) of.setAttribute(name, value);
}

export function write(of: Element, text: string): void {
  if (of.textContent !== text) of.textContent = text;
}

/**
 * Numbers of the corners that a polyline needs so that no other place is farther off than the tolerance: from a corner
 * on, the directions in which all places since then are near enough become fewer, until there is none.
 */
export function thinned(x: ArrayLike<number>, y: ArrayLike<number>, tolerance: number): number[] {
  const last = x.length - 1, kept = last < 0 ? [] : [0], near = tolerance * tolerance;
  // The first and the last of those directions, counter-clockwise, as vectors; how far the places are, squared.
  let [ax, ay, bx, by, reached] = [0, 0, 0, 0, 0];
  for (let i = 1, corner = 0; i <= last; i++) {
    let dx = x[i] - x[corner], dy = y[i] - y[corner], d = dx * dx + dy * dy;
    if (d < reached || ax * dy < ay * dx || dx * by < dy * bx) {
      kept.push((corner = i - 1));
      [dx, dy] = [x[i] - x[corner], y[i] - y[corner]];
      [d, reached] = [dx * dx + dy * dy, 0];
      [ax, ay, bx, by] = [0, 0, 0, 0];
    }
    if (d <= near) continue;
    const along = Math.sqrt(d - near), [u, v] = [dx * along, dy * along], [s, t] = [dx * tolerance, dy * tolerance];
    if (!reached || ax * (v - s) > ay * (u + t)) [ax, ay] = [u + t, v - s];
    if (!reached || bx * (v + s) < by * (u - t)) [bx, by] = [u - t, v + s];
    reached = d;
  }
  if (last > 0) kept.push(last);
  return kept;
}

export function hull(cloud: Vec[]): Vec[] {
  const rows = [...cloud].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (ordered: Vec[]) => {
    const chain: Vec[] = [];
    for (const p of ordered) {
      while (chain.length > 1) {
        const [a, b] = chain.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(rows), ...half([...rows].reverse())];
}

// Corners of a tooth: place in pitches, 1 at its top.
export const TOOTH: Vec[] = [[-0.5, 0], [-0.32, 0], [-0.16, 1], [0.16, 1], [0.32, 0]];

/** Teeth about the middle; where their number is not known or too large to be seen, some that show that it is a gear. */
export function toothed(r: number, teeth: number | null, turned: number, sign: number): string {
  const known = teeth !== null && (TURN * r) / teeth > FINEST, count = known ? teeth : Math.max(12, Math.round((TURN * r) / PITCH));
  const height = Math.min(1, (TURN * r) / count / PITCH) * sign, outline: Vec[] = [];
  for (let k = 0; k < count; k++)
    for (const [share, top] of TOOTH) {
      const angle = turned + (TURN * (k + share)) / count, radius = r + height * (top ? TALL : -DEEP);
      outline.push([radius * Math.cos(angle), radius * Math.sin(angle)]);
    }
  return line(outline, true);
}

export const round = ([x, y]: Vec, r: number) =>
  `M${tenth(x - r)} ${tenth(y)}a${tenth(r)} ${tenth(r)} 0 1 0 ${tenth(2 * r)} 0a${tenth(r)} ${tenth(r)} 0 1 0 ${tenth(-2 * r)} 0Z`;

/** The common tangent of two circles on one side (signed radii: on different sides it crosses). */
export function strand(a: Vec, b: Vec, r: number, s: number): string {
  const d = far(a, b), u = unit(a, b), sine = (r - s) / d, cosine = Math.sqrt(Math.max(0, 1 - sine * sine));
  return line([away(a, u, r * sine, r * cosine), away(b, u, s * sine, s * cosine)]);
}

export function zigzag(a: Vec, b: Vec): Vec[] {
  const length = far(a, b), u = unit(a, b), lead = Math.min(0.18 * length, 16), points: Vec[] = [a];
  for (let k = 0; k <= 12; k++) {
    const side = k === 0 || k === 12 ? 0 : k % 2 ? -7 : 7;
    points.push(away(a, u, lead + ((length - 2 * lead) * k) / 12, side));
  }
  return [...points, b];
}

export function dashpot(from: Vec, to: Vec): string {
  const length = far(from, to), u = unit(from, to), body = Math.min(26, 0.5 * length), h = 8;
  const a = (length - body) / 2, b = (length + body) / 2, c = length / 2 + 0.15 * body;
  const strokes: Vec[][] = [
    [[0, 0], [a, 0]], [[b, -h], [a, -h], [a, h], [b, h]], [[c, -0.7 * h], [c, 0.7 * h]], [[c, 0], [length, 0]],
  ];
  return strokes.map((stroke) => line(stroke.map(([x, y]) => away(from, u, x, y)))).join("");
}

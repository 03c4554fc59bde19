// Strokes over the sheet: elements that are used again, so that a move of the pointer makes none.
import type { Vec } from "../../shapes";
import { element, far, put, tenth, unit, write } from "../../strokes";
import type { Overlay } from "../tools/tool";

// Of a dimension line: the gap between the part and its extension lines, how far these go on, its arrowheads, px.
const GAP = 9, ON = 5, HEAD = 8, HALF = 2.6, OFF = 28;

export class Pencil implements Overlay {
  private readonly groups: Record<"path" | "circle" | "text", { group: SVGElement; made: SVGElement[]; used: number }>;

  constructor(host: SVGElement) {
    const group = (kind: string) => ({ group: element("g", { class: `over-${kind}s` }, host), made: [], used: 0 });
    this.groups = { path: group("path"), circle: group("circle"), text: group("text") };
  }

  begin(): void {
    for (const each of Object.values(this.groups)) each.used = 0;
  }

  end(): void {
    for (const { made, used } of Object.values(this.groups)) for (let k = used; k < made.length; k++) put(made[k], "visibility", "hidden");
  }

  private next(kind: "path" | "circle" | "text", style: string): SVGElement {
    const pool = this.groups[kind], found = (pool.made[pool.used] ??= element(kind, {}, pool.group));
    pool.used++;
    put(found, "class", style);
    put(found, "visibility", "visible");
    return found;
  }

  path(d: string, style: string): void {
    put(this.next("path", style), "d", d);
  }

  circle([x, y]: Vec, r: number, style: string): void {
    const made = this.next("circle", style);
    put(made, "cx", String(tenth(x)));
    put(made, "cy", String(tenth(y)));
    put(made, "r", String(r));
  }

  text(at: Vec, text: string, style: string, turn = 0): void {
    const made = this.next("text", style);
    put(made, "transform", `translate(${tenth(at[0])} ${tenth(at[1])})${turn ? ` rotate(${tenth(turn)})` : ""}`);
    write(made, text);
  }

  dimension(a: Vec, b: Vec, text: string, style: string, off = OFF): void {
    if (far(a, b) < 1) return;
    const [u, v] = unit(a, b), side = Math.sign(off) || 1, n: Vec = [v * side, -u * side];
    const out = ([x, y]: Vec, by: number): Vec => [x + by * n[0], y + by * n[1]], size = Math.abs(off), [from, to] = [out(a, size), out(b, size)];
    const stroke = (p: Vec, q: Vec) => `M${tenth(p[0])} ${tenth(p[1])}L${tenth(q[0])} ${tenth(q[1])}`;
    this.path(stroke(out(a, GAP), out(a, size + ON)) + stroke(out(b, GAP), out(b, size + ON)) + stroke(from, to), `line ${style}`);
    const head = ([x, y]: Vec, way: number) =>
      `M${tenth(x)} ${tenth(y)}L${tenth(x + way * HEAD * u - HALF * v)} ${tenth(y + way * HEAD * v + HALF * u)}L${tenth(x + way * HEAD * u + HALF * v)} ${tenth(y + way * HEAD * v - HALF * u)}Z`;
    this.path(head(from, 1) + head(to, -1), `head ${style}`);
    // A text rises from its line: on the far side of it, its foot is farther away.
    const turn = upright(Math.atan2(v, u)), rad = (turn * Math.PI) / 180, away = n[0] * Math.sin(rad) - n[1] * Math.cos(rad) > 0 ? 4 : 13;
    this.text(out([(from[0] + to[0]) / 2, (from[1] + to[1]) / 2], away), text, `dim ${style}`, turn);
  }
}

/** The turn (deg) of a text along a line so that it is read from below or from the right. */
function upright(angle: number): number {
  const turn = (angle * 180) / Math.PI;
  return turn > 90 ? turn - 180 : turn <= -90 ? turn + 180 : turn;
}

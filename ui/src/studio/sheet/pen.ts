// Strokes that are drawn anew at every position: elements are used again in their order, so that a frame makes none.
import type { Vec } from "../../shapes";
import { element, put, write } from "../../strokes";

const f1 = (x: number) => String(Math.round(10 * x) / 10);

export class Pen {
  private readonly pools: Record<string, SVGElement[]> = {};
  private readonly used: Record<string, number> = {};

  constructor(readonly host: SVGElement) {}

  begin(): void {
    for (const tag in this.used) this.used[tag] = 0;
  }

  end(): void {
    for (const tag in this.pools)
      for (let k = this.used[tag] ?? 0; k < this.pools[tag].length; k++) put(this.pools[tag][k], "visibility", "hidden");
  }

  path(d: string, style: string): SVGElement {
    const made = this.next("path", style);
    put(made, "d", d);
    return made;
  }

  circle([x, y]: Vec, r: number, style: string): SVGElement {
    const made = this.next("circle", style);
    put(made, "cx", f1(x));
    put(made, "cy", f1(y));
    put(made, "r", f1(r));
    return made;
  }

  text([x, y]: Vec, text: string, style: string, anchor: "start" | "middle" | "end" = "start"): SVGElement {
    const made = this.next("text", style);
    put(made, "x", f1(x));
    put(made, "y", f1(y));
    put(made, "text-anchor", anchor);
    write(made, text);
    return made;
  }

  private next(tag: string, style: string): SVGElement {
    const pool = (this.pools[tag] ??= []), k = this.used[tag] ?? 0;
    this.used[tag] = k + 1;
    const made = (pool[k] ??= element(tag, {}, this.host));
    put(made, "class", style);
    put(made, "visibility", "visible");
    return made;
  }
}

// The grid of the sheet: 1-2-5 by the zoom or as set, every fifth line and the two axes stronger.
import { element, put, tenth } from "../../strokes";
import type { Camera } from "./camera";

// Lines are at least this far apart on the screen, px; a grid that was set is left out below the second.
const APART = 14, FINEST = 5;

/** The spacing of the lines, m; `wanted` > 0: as set, coarser by fives where that would be too fine. */
export function spacing(scale: number, wanted: number): number {
  if (wanted > 0) {
    let step = wanted;
    while (step * scale < FINEST) step *= 5;
    return step;
  }
  const least = APART / scale, power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find((each) => each * power >= least * (1 - 1e-9))!;
}

export class Grid {
  private readonly paths: SVGElement[];

  constructor(host: SVGElement) {
    this.paths = ["grid-fine", "grid-major", "grid-axis"].map((style) => element("path", { class: style }, host));
  }

  draw({ scale, origin: [x, y], size: [w, h] }: Camera, step: number): void {
    const lines = (apart: number) => {
      let d = "";
      for (let u = ((x % apart) + apart) % apart; u < w; u += apart) d += `M${tenth(u)} 0V${h}`;
      for (let v = ((y % apart) + apart) % apart; v < h; v += apart) d += `M0 ${tenth(v)}H${w}`;
      return d;
    };
    const axes = `${x >= 0 && x <= w ? `M${tenth(x)} 0V${h}` : ""}${y >= 0 && y <= h ? `M0 ${tenth(y)}H${w}` : ""}`;
    [step ? lines(step * scale) : "", step ? lines(5 * step * scale) : "", step ? axes : ""].forEach((d, k) => put(this.paths[k], "d", d));
  }
}

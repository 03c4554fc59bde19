// Where the sheet is looked at: pixels of the screen and metres of the machine.
import type { Vec } from "../../shapes";

// Pixels for a metre: the least, the most, and what 100 % is (a real size on a screen of 96 pixels an inch would be 3780).
const LEAST = 1, MOST = 2e6;
export const FULL = 2400;

export class Camera {
  scale = FULL;
  /** The origin on the screen, px. */
  origin: Vec = [0, 0];
  size: Vec = [600, 400];

  screen([x, y]: Vec): Vec {
    return [this.origin[0] + this.scale * x, this.origin[1] - this.scale * y];
  }

  world([x, y]: Vec): Vec {
    return [(x - this.origin[0]) / this.scale, (this.origin[1] - y) / this.scale];
  }

  /** Zooms so that what is at a place of the screen stays there. */
  zoom(factor: number, [x, y]: Vec): void {
    const scale = Math.min(MOST, Math.max(LEAST, this.scale * factor)), share = scale / this.scale;
    this.origin = [x + share * (this.origin[0] - x), y + share * (this.origin[1] - y)];
    this.scale = scale;
  }

  pan(dx: number, dy: number): void {
    this.origin = [this.origin[0] + dx, this.origin[1] + dy];
  }

  /** Puts a box (m) into the picture, with a margin in pixels and what each side (left, top, right, bottom) needs beyond it. */
  fit([left, low, right, high]: [number, number, number, number], margin = 56, more: readonly [number, number, number, number] = [0, 0, 0, 0]): void {
    const w = Math.max(this.size[0] - more[0] - more[2], 4 * margin), h = Math.max(this.size[1] - more[1] - more[3], 4 * margin), wide = Math.max(right - left, 1e-6), tall = Math.max(high - low, 1e-6);
    this.scale = Math.min(MOST, Math.max(LEAST, Math.min((w - 2 * margin) / wide, (h - 2 * margin) / tall)));
    this.origin = [more[0] + w / 2 - (this.scale * (left + right)) / 2, more[1] + h / 2 + (this.scale * (low + high)) / 2];
  }
}

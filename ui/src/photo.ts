// A picture behind the drawing, brought to scale by two clicks on it.
import type { Vec } from "./shapes";

/** Its upper left corner and its width, m; `shape`: height over width. */
interface Placed {
  href: string;
  corner: Vec;
  width: number;
  shape: number;
}

const UNITS: Record<string, number> = { mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254 };

/** A length as it is written in files, m. */
function metres(text: string): number {
  const [, number, unit] = /^\s*([\d.]+)\s*(mm|cm|m|in)\s*$/.exec(text) ?? [];
  return unit ? Number(number) * UNITS[unit] : NaN;
}

export class Photo {
  private placed: Placed | null = null;
  /** Places on it that have been clicked, m. */
  clicks: Vec[] = [];

  constructor(private readonly image: SVGElement) {}

  show(placed: Placed | null): void {
    this.placed = placed;
  }

  /** The second of two clicks makes it so large that they are as far apart as the text says; false: that is no length. */
  measure(at: Vec, text: string): boolean {
    const length = metres(text), { placed } = this;
    if (!(length > 0)) return false;
    if (!placed) return true;
    this.clicks.push(at);
    if (this.clicks.length < 2) return true;
    const [[ax, ay], [bx, by]] = this.clicks, factor = length / Math.hypot(bx - ax, by - ay);
    this.clicks = [];
    if (!Number.isFinite(factor)) return true;
    placed.corner = [ax + factor * (placed.corner[0] - ax), ay + factor * (placed.corner[1] - ay)];
    placed.width *= factor;
    return true;
  }

  draw(screen: (place: Vec) => Vec, scale: number): void {
    this.image.setAttribute("visibility", this.placed ? "visible" : "hidden");
    if (!this.placed) return;
    const { href, corner, width, shape } = this.placed, [x, y] = screen(corner);
    if (this.image.getAttribute("href") !== href) this.image.setAttribute("href", href);
    for (const [name, value] of Object.entries({ x, y, width: width * scale, height: width * shape * scale })) this.image.setAttribute(name, value.toFixed(1));
  }
}

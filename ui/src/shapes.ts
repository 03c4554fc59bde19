// Shapes that follow from the motion, in metres and in the axes of the link that carries them: cams by the contacts
// of their followers, teeth that mesh, racks by the way of their pinions.
import type { Amount, Glyph } from "./data";
import type { Outputs } from "./engine";
import type { Model } from "./model";
import type { Values } from "./solver";

export type Vec = [number, number];

const TURN = 2 * Math.PI;
// Largest gap between contacts in the cam's angle over which its profile is closed, rad; a face beyond its contacts.
const CLOSED = 0.2, BEYOND = 0.1;

/** `face`: ends of a flat face along its line, from the point that the follower is known by. */
export interface CamShape {
  profile: Vec[];
  pitch: Vec[];
  outer: Vec[];
  closed: boolean;
  face: Vec;
}

/** Where a rack begins and ends and one of its teeth is, along its pitch line from the point that it goes through. */
export interface RackShape {
  low: number;
  high: number;
  tooth: number;
  pitch: number | null;
}

export function amount({ value, factor, times, over }: Amount, values: Values): number {
  if (![...times, ...over].every((address) => address in values)) return value;
  const product = (names: string[]) => names.reduce((all, address) => all * values[address], 1);
  return (factor * product(times)) / product(over);
}

export class Shapes {
  private readonly turned: number[] = [];

  constructor(private readonly model: Model) {}

  private get glyphs(): Glyph[] {
    return this.model.data.glyphs;
  }

  private pair(name: string, i: number, missing: Vec, main: Outputs = this.model.main): Vec {
    return main.has(`${name}.x`) ? [main.row(`${name}.x`)[i], main.row(`${name}.y`)[i]] : missing;
  }

  private place = (key: string, i: number) => this.pair(`p:${key}`, i, [NaN, NaN]);
  private velocity = (key: string, i: number) => this.pair(`v:${key}`, i, [0, 0]);
  private axis = (link: string, i: number) => this.pair(`e:${link}`, i, [1, 0]);

  private spin(link: string, i: number): number {
    return this.model.main.has(`w:${link}`) ? this.model.main.row(`w:${link}`)[i] : 0;
  }

  // wheels -------------------------------------------------------------------------------

  /** Pitch radius, m. */
  radius(glyph: Glyph): number {
    if (glyph.radius) return amount(glyph.radius, this.model.values);
    const ratio = amount(glyph.ratio!, this.model.values);
    const [a, b] = glyph.points!.map((key) => this.place(key, 0));
    return Math.hypot(b[0] - a[0], b[1] - a[1]) * Math.abs((glyph.second ? 1 : ratio) / (ratio - 1));
  }

  /** The machine has changed. */
  forget(): void {
    this.turned.length = 0;
  }

  /** Where a tooth of a wheel is in its own axes, rad, so that it meshes with the wheel before it. */
  tooth(number: number): number {
    const glyph = this.glyphs[number], { mesh } = glyph;
    return (this.turned[number] ??= mesh === undefined ? 0 : this.meshing(glyph, this.glyphs[mesh], this.tooth(mesh)));
  }

  /** With the pitches u and v from a tooth of each wheel to the pitch point, u + v (inside a ring v - u) is a half. */
  private meshing(own: Glyph, other: Glyph, turned: number): number {
    const [a, b] = [other, own].map((glyph) => this.place(glyph.at!, 0));
    const ring = own.inside || other.inside, line = Math.atan2(b[1] - a[1], b[0] - a[0]);
    const from = own.inside ? line + Math.PI : line, to = ring ? from : line + Math.PI;
    const u = ((from - this.angle(other, 0) - turned) * (other.teeth ?? 1)) / TURN;
    return to - this.angle(own, 0) - ((0.5 + (ring ? u : -u)) * TURN) / (own.teeth ?? 1);
  }

  private angle(glyph: Glyph, i: number): number {
    const [x, y] = this.axis(glyph.link!, i);
    return Math.atan2(y, x);
  }

  // racks --------------------------------------------------------------------------------

  /** Direction of a rack's pitch line. */
  private way(glyph: Glyph, i: number): Vec {
    const [x, y] = this.axis(glyph.link!, i), turn = amount(glyph.turn!, this.model.values);
    const c = Math.cos(turn), s = Math.sin(turn);
    return [x * c - y * s, y * c + x * s];
  }

  rack(glyph: Glyph): RackShape {
    const wheel = this.glyphs[glyph.mesh!], side = glyph.inside ? -1 : 1;
    const along = (i: number) => {
      const d = this.way(glyph, i), [x, y] = this.place(wheel.at!, i), [u, v] = this.place(glyph.at!, i);
      return (x - u) * d[0] + (y - v) * d[1];
    };
    let [low, high] = [Infinity, -Infinity];
    for (let i = 0; i < this.model.n; i++) [low, high] = [Math.min(low, along(i)), Math.max(high, along(i))];
    if (!wheel.teeth) return { low, high, tooth: 0, pitch: null };
    const pitch = (TURN * this.radius(wheel)) / wheel.teeth, [dx, dy] = this.way(glyph, 0);
    const point = Math.atan2(dy, dx) - (side * Math.PI) / 2;
    const u = ((point - this.angle(wheel, 0) - this.tooth(glyph.mesh!)) * wheel.teeth) / TURN;
    return { low, high, tooth: along(0) + (0.5 - side * u) * pitch, pitch };
  }

  /** Places of a rack's ends over all positions, m. */
  reach(glyph: Glyph): [number[], number[]] {
    const { low, high } = this.rack(glyph), xs: number[] = [], ys: number[] = [];
    for (let i = 0; i < this.model.n; i++)
      for (const far of [low, high]) {
        const [x, y] = this.place(glyph.at!, i), [u, v] = this.way(glyph, i);
        xs.push(x + far * u);
        ys.push(y + far * v);
      }
    return [xs, ys];
  }

  // cams ---------------------------------------------------------------------------------

  /** Profile and pitch curve by where the follower touches at every position, in the order of the cam's angle. */
  cam(glyph: Glyph): CamShape {
    const roller = amount(glyph.radius!, this.model.values), flat = glyph.touch === "flat";
    const found: { angle: number; pitch: Vec; inner: Vec; outer: Vec }[] = [];
    let face: Vec = [0, 0];
    for (let i = 0; i < this.model.n; i++) {
      const e = this.axis(glyph.link!, i), p = this.place(glyph.trace!, i), c = this.place(glyph.at!, i);
      const w = this.spin(glyph.link!, i), [vx, vy] = this.velocity(glyph.trace!, i), [cx, cy] = this.velocity(glyph.at!, i);
      // Velocity of the trace point against the cam.
      const u: Vec = [vx - cx + w * (p[1] - c[1]), vy - cy - w * (p[0] - c[0])];
      let inner = p, outer = p;
      if (flat) {
        const t = this.line(glyph, i), s = -(u[1] * t[0] - u[0] * t[1]) / (this.spin(glyph.follower!, i) - w);
        inner = [p[0] + s * t[0], p[1] + s * t[1]];
        if (Number.isFinite(s)) face = [Math.min(face[0], s), Math.max(face[1], s)];
      } else {
        const r = (roller * Math.sign(this.spin(glyph.carrier!, i) - w)) / Math.hypot(u[0], u[1]);
        [inner, outer] = [-1, 1].map((side): Vec => [p[0] + side * r * u[1], p[1] - side * r * u[0]]);
      }
      const local = ([x, y]: Vec): Vec => [(x - c[0]) * e[0] + (y - c[1]) * e[1], (y - c[1]) * e[0] - (x - c[0]) * e[1]];
      const k = this.axis(glyph.carrier!, i), angle = Math.atan2(e[1] * k[0] - e[0] * k[1], e[0] * k[0] + e[1] * k[1]);
      if (Number.isFinite(inner[0] + inner[1])) found.push({ angle, pitch: local(p), inner: local(inner), outer: local(outer) });
    }
    const { rows, closed } = ordered(found);
    const more = BEYOND * Math.max(face[1] - face[0], amount(glyph.base!, this.model.values));
    return {
      profile: rows.map((row) => row.inner),
      pitch: glyph.touch === "roller" ? rows.map((row) => row.pitch) : [],
      outer: glyph.groove ? rows.map((row) => row.outer) : [],
      closed,
      face: [face[0] - more, face[1] + more],
    };
  }

  /** Direction of a flat face: across its guide, or along its arm. */
  line(glyph: Glyph, i: number, call: Outputs = this.model.main): Vec {
    if (glyph.joint) {
      const [x, y] = this.pair(`d:${glyph.joint}`, i, [1, 0], call);
      return [-y, x];
    }
    const [a, b] = [glyph.tie!, glyph.trace!].map((key) => this.pair(`p:${key}`, i, [NaN, NaN], call)), d = Math.hypot(b[0] - a[0], b[1] - a[1]);
    return [(b[0] - a[0]) / d, (b[1] - a[1]) / d];
  }
}

/** Rows by their angle, beginning behind the largest gap; `closed` where there is none. */
function ordered<Row extends { angle: number }>(found: Row[]): { rows: Row[]; closed: boolean } {
  const rows = [...found].sort((a, b) => a.angle - b.angle), n = rows.length;
  let most = 0, first = 0;
  rows.forEach((row, k) => {
    const gap = k ? row.angle - rows[k - 1].angle : n ? row.angle + TURN - rows[n - 1].angle : 0;
    if (gap > most) [most, first] = [gap, k];
  });
  return { rows: [...rows.slice(first), ...rows.slice(0, first)], closed: most < CLOSED };
}

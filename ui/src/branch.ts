// Whether a machine's assembly is proved to be that of its original, after changes too.
import { cubic, walk } from "./certificate";
import type { LoopData, ModelData } from "./data";
import { Loops } from "./loops";
import type { Solver, Values } from "./solver";

const TURN = 2 * Math.PI;
// How far rows may be from the tube in which the root lies, rad or share of the size: the rounding of angles of rows.
const NEAR = 1e-9;

/** Follows a machine from design to design: the last one that was certified at its first position. */
export class Branch {
  private readonly data: LoopData;
  private begin: number[];

  constructor(private readonly solver: Solver) {
    this.data = solver.data.loops!;
    this.begin = this.data.begin;
  }

  /** How many of the positions that the solver's rows hold are not certified; null where it cannot be tried. */
  uncertain(values: Values): number | null {
    const { solver, data } = this, { n } = solver;
    const changes = Object.fromEntries(Object.entries(solver.data.values).map(([address, value]) => [address, values[address] - value]));
    if (data.fixed.some((address) => changes[address] !== 0)) return null;
    const loops = Loops.of(data, (link, key) => place(solver, link, key), values, changes), q = this.drivers(0);
    const start = this.arrived(loops, this.begin, q) ?? this.arrived(loops, data.begin, q);
    if (!start || !this.alike(start, 0, (k) => NEAR * loops.scale[k])) return n;
    this.begin = start;
    let z = start, sure = 1;
    for (const { to, shares } of this.ways()) {
      const first = sure, last = walk(loops, z, { from: this.drivers(first - 1), to: this.drivers(to), unit: this.unit }, (a, b, tube) => {
        for (; sure <= to && shares[sure - first] <= b.x * (1 + 1e-12); sure++) {
          const near = cubic(a, b, shares[sure - first]);
          if (!this.alike(near, sure, (k) => tube[k] + NEAR * loops.scale[k])) return false;
        }
        return true;
      });
      if (!last) break;
      z = last.y;
    }
    return n - sure;
  }

  /** Unknowns of a design on the branch that begins at those of another one: the gap that these leave is closed. */
  private arrived(loops: Loops, z: number[], q: number[]): number[] | null {
    const gap = loops.gap(loops.turned([...z, ...q])), open = Math.max(...gap.map(Math.abs)) / this.data.size;
    const unit = [...q.map(() => 1), 1 / Math.max(open, 1e-9)];
    const last = walk(loops.opened(gap), z, { from: [...q, 1], to: [...q, 0], unit });
    return last && last.y.slice(0, loops.n);
  }

  private get unit(): number[] {
    return this.solver.data.positions.inputs.map((each) => (each.turns ? 1 : this.data.size));
  }

  /** Straight ways of the drivers through the positions, each to a position, with the shares of the way to all that it
   *  passes: as far as a single driver goes on in its direction, else from each position to the next. */
  private ways(): { to: number; shares: number[] }[] {
    const { n } = this.solver, found: { to: number; shares: number[] }[] = [], single = this.data.drivers.length === 1;
    const q = Array.from({ length: n }, (_, i) => this.drivers(i)[0] ?? 0);
    for (let i = 0, to = 1; to < n; i = to++) {
      const sense = Math.sign(q[to] - q[i]);
      while (single && sense && to + 1 < n && Math.sign(q[to + 1] - q[to]) === sense) to++;
      const whole = q[to] - q[i];
      found.push({ to, shares: Array.from({ length: to - i }, (_, k) => (to - i === 1 ? 1 : (q[i + 1 + k] - q[i]) / whole)) });
    }
    return found;
  }

  private drivers(i: number): number[] {
    const { inputs } = this.solver.data.positions;
    return this.data.drivers.map((name) => this.solver.driver(inputs.findIndex((each) => each.name === name), i));
  }

  /** Whether the rows of position i have these unknowns, to whole turns. */
  private alike(z: number[], i: number, room: (k: number) => number): boolean {
    const { main } = this.solver;
    return this.data.unknowns.every(([kind, name], k) => {
      let off = z[k] - (kind === "turn" ? Math.atan2(main.row(`e:${name}.y`)[i], main.row(`e:${name}.x`)[i]) : main.row(`s:${name}`)[i]);
      if (kind === "turn") off -= TURN * Math.round(off / TURN);
      return Math.abs(off) <= room(k);
    });
  }
}

/** Where a point of a link is at the first position, in the link's axes but for a shift. */
function place({ main, data }: Solver, link: string, key: string): [number, number] {
  const [x, y] = [main.row(`p:${key}.x`)[0], main.row(`p:${key}.y`)[0]];
  if (link === "frame") return [x, y];
  const other = reference(data, link), [u, v] = [x - main.row(`p:${other}.x`)[0], y - main.row(`p:${other}.y`)[0]];
  const [c, s] = [main.row(`e:${link}.x`)[0], main.row(`e:${link}.y`)[0]];
  return [u * c + v * s, v * c - u * s];
}

/** The first point of a link that its arms name. */
function reference({ loops }: ModelData, link: string): string {
  return loops!.arms.find((arm) => arm[2] === link)![3];
}

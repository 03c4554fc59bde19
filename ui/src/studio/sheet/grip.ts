// A link of the machine held by the hand: the machine goes through its positions so that the held place follows.
import type { Session } from "../../session";
import type { Vec } from "../../shapes";
import { dist, minus } from "./geometry";
import type { Board } from "./sheet";

/** Share of a cycle within which the next place is sought, so that a path that crosses itself is followed. */
const NEAR = 1 / 12;

export class Grip {
  private readonly begun: number;
  /** The points by whose places the held one is known, and its place in their axes. */
  private readonly keys: string[];
  private readonly local: Vec;

  constructor(private readonly board: Board, private readonly session: Session, link: string, at: Vec) {
    const { scene, bench } = board, points = (scene.links[link] ?? []).map((name) => scene.points.get(name)).filter((each) => each?.key);
    this.begun = bench.page.phase.value;
    this.keys = points.slice(0, 2).map((each) => each!.key);
    const [a, b] = points.slice(0, 2).map((each) => each!.at), u = axis(a, b ?? a), d = a ? minus(at, a) : ([0, 0] as Vec);
    this.local = [d[0] * u[0] + d[1] * u[1], d[1] * u[0] - d[0] * u[1]];
  }

  /** Where the held place is at a position. */
  private held(i: number): Vec {
    const { main } = this.session.model, [a, b] = this.keys.map((key) => ["x", "y"].map((name) => main.row(`p:${key}.${name}`)[i]) as Vec);
    const [u, v] = axis(a, b ?? a), [x, y] = this.local;
    return [a[0] + x * u - y * v, a[1] + x * v + y * u];
  }

  to(pointer: Vec): void {
    if (!this.keys.length) return;
    const { count, closed } = this.session.data.positions, { page } = this.board.bench, whole = closed ? count : count - 1;
    const here = Math.round(page.place(this.session)), reach = Math.max(2, Math.round(NEAR * whole));
    let best = Infinity, found = here;
    for (let k = here - reach; k <= here + reach; k++) {
      const i = closed ? (k + count) % count : k;
      if (i < 0 || i >= count) continue;
      const far = dist(this.held(i), pointer);
      if (far < best) [best, found] = [far, k];
    }
    const fine = found + this.between(found, pointer, closed, count);
    page.phase.value = closed ? ((fine / whole) % 1 + 1) % 1 : Math.min(1, Math.max(0, fine / whole));
  }

  /** How far beyond a position the nearest place of the path is, in positions: along the chord between its neighbours. */
  private between(k: number, pointer: Vec, closed: boolean, count: number): number {
    if (!closed && (k < 1 || k >= count - 1)) return 0;
    const at = (i: number) => this.held(closed ? ((i % count) + count) % count : i), before = at(k - 1), after = at(k + 1), way = minus(after, before), square = way[0] ** 2 + way[1] ** 2;
    if (!square) return 0;
    const off = minus(pointer, at(k));
    return Math.max(-0.5, Math.min(0.5, (2 * (off[0] * way[0] + off[1] * way[1])) / square));
  }

  back(): void {
    this.board.bench.page.phase.value = this.begun;
  }
}

function axis(a: Vec | undefined, b: Vec | undefined): Vec {
  const d = a && b ? dist(a, b) : 0;
  return d ? [(b![0] - a![0]) / d, (b![1] - a![1]) / d] : [1, 0];
}

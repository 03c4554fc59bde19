// Outlines of the parts under the machine, carried along with their links; what collides is red, the smallest gap marked.
import type { Session } from "../../session";
import type { Vec } from "../../shapes";
import { element, put, tint } from "../../strokes";
import { type PartOutline, type Room, within } from "../room";
import type { Overlay } from "../tools/tool";
import { Stand } from "./loads";
import type { Board } from "./sheet";

/** Radius of the mark at the smallest gap, px. */
const MARK = 7;

export class Outlines {
  private readonly group: SVGElement;
  private made: { of: PartOutline; path: SVGElement }[] = [];
  private known: PartOutline[] | null = null;

  /** `below`: what lies under the machine, marks of the selection at last. */
  constructor(private readonly board: Board, below: Element) {
    this.group = element("g", { class: "outlines" });
    below.insertBefore(this.group, below.lastChild);
    board.outer = () => this.box();
  }

  /** The room of what is drawn, m. */
  private box(): [number, number, number, number] | null {
    const { x, y, width, height } = (this.group as SVGGraphicsElement).getBBox(), { camera } = this.board;
    if (!width || !height) return null;
    const [left, high] = camera.world([x, y]), [right, low] = camera.world([x + width, y + height]);
    return [left, low, right, high];
  }

  draw(over: Overlay): void {
    const { board } = this, { bench } = board, room = bench.room.value, session = board.standsFor, shown = room !== null && session !== null && bench.shows("outlines");
    this.group.classList.toggle("hidden", !shown);
    if (!room && this.made.length) this.make([]);
    if (!shown) return;
    const first = !this.made.length;
    if (this.known !== room.outlines) this.make(room.outlines);
    const stand = board.solved === session ? board.stand : new Stand(board.scene, undefined, session, board.place), near = this.near(room, session);
    for (const { of, path } of this.made) {
      const at = stand.pair(`p:${of.at}`), along: Vec | null = of.along ? stand.pair(of.along) : [1, 0];
      put(path, "visibility", at && along ? "visible" : "hidden");
      if (!at || !along) continue;
      carry(path, along, board.camera.screen(at), board.camera.scale / 1e3);
      path.classList.toggle("collides", near.has(of.name));
    }
    this.mark(room, session, over);
    if (first) board.refit();
  }

  private make(outlines: PartOutline[]): void {
    this.known = outlines;
    this.group.replaceChildren();
    this.made = outlines.map((of) => {
      const path = element("path", { class: `outline ${of.sort}`, d: of.path, "fill-rule": "evenodd" }, this.group);
      path.dataset.name = of.name;
      tint(path, of.colour);
      return { of, path };
    });
  }

  /** What comes too near to something else at the shown place. */
  private near({ collisions }: Room, { data }: Session): Set<string> {
    const { desk, page } = this.board.bench, share = page.phase.value;
    // A run under forces is no cycle.
    if (desk.running.value) return new Set();
    return new Set(collisions.flatMap(({ pair, spans }) => (spans.some((span) => within(share, span, data.positions.closed)) ? pair : [])));
  }

  private mark({ gap }: Room, { data }: Session, over: Overlay): void {
    const { bench, camera } = this.board, { count, closed } = data.positions, step = 1 / Math.max(1, closed ? count : count - 1), share = bench.page.phase.value;
    if (!gap || bench.desk.running.value || !within(share, [gap.share - step, gap.share + step], closed)) return;
    const [x, y] = camera.screen(gap.place);
    over.circle([x, y], MARK, "nearest");
    over.text([x + MARK + 5, y + 4], gap.text, "nearest start");
  }
}

/** Moves a path in millimetres to a place of the screen, with its x axis along a direction. */
function carry(path: SVGElement, [x, y]: Vec, [left, top]: Vec, scale: number): void {
  const [u, v] = [scale * x, scale * y];
  put(path, "transform", `matrix(${[u, -v, v, u].map((each) => each.toFixed(7)).join(" ")} ${left.toFixed(2)} ${top.toFixed(2)})`);
}

// Pointers on the sheet: a mouse, a pen, fingers; what they mean to the camera and to the tool in hand.
import type { Vec } from "../../shapes";
import { dist, minus } from "./geometry";
import { showElementMenu } from "./menu";
import type { Board } from "./sheet";

// A finger has gone so far from where it came down, px, or has been there so long, ms, before it counts as one that draws.
const SLIP = 8;
// A wheel's step of this many pixels zooms by this factor.
const NOTCH = 100, FACTOR = 1.2;

type Doing = { what: "tool" } | { what: "pan"; from: Vec } | { what: "wait"; from: Vec; event: PointerEvent } | { what: "pinch"; between: number; middle: Vec } | null;

export class Pointers {
  private doing: Doing = null;
  private readonly fingers = new Map<number, Vec>();
  /** Whether Space is held, so that the mouse moves the paper. */
  space = false;
  /** Whether the paper has been moved since Space was pressed. */
  panned = false;

  constructor(private readonly board: Board) {
    const { host } = board, on = <K extends keyof HTMLElementEventMap>(name: K, work: (event: HTMLElementEventMap[K]) => void) =>
      host.addEventListener(name, work as (event: Event) => void, { passive: false });
    on("pointerdown", (event) => this.down(event));
    on("pointermove", (event) => this.move(event));
    on("pointerup", (event) => this.up(event));
    on("pointercancel", (event) => this.cancel(event));
    on("pointerleave", (event) => !this.doing && event.pointerType !== "touch" && board.point(null));
    on("wheel", (event) => this.wheel(event));
    on("contextmenu", (event) => {
      event.preventDefault();
      if (this.doing?.what === "wait") this.doing = null;
      if (!this.doing) showElementMenu(board, event, this.at(event));
    });
    on("auxclick", (event) => event.preventDefault());
  }

  private at(event: MouseEvent): Vec {
    const box = this.board.host.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 33 : 1;
    if (event.ctrlKey) this.board.zoom(FACTOR ** ((-event.deltaY * lines * 4) / NOTCH), this.at(event));
    else if (event.shiftKey || (event.deltaX && !event.deltaY)) this.board.pan(-(event.deltaX || event.deltaY) * lines, 0);
    else this.board.zoom(FACTOR ** ((-event.deltaY * lines) / NOTCH), this.at(event));
  }

  private down(event: PointerEvent): void {
    const { board } = this, at = this.at(event), touch = event.pointerType === "touch";
    if (event.target instanceof Element && event.target.closest("button, input, label")) return;
    board.host.classList.remove("by-keys");
    board.host.focus({ preventScroll: true });
    board.bench.refusal.value = null;
    board.cross = null;
    board.host.setPointerCapture(event.pointerId);
    if (event.button === 1 || (event.button === 0 && this.space)) {
      event.preventDefault();
      this.doing = { what: "pan", from: at };
      this.panned = true;
      board.host.classList.add("panning");
      return;
    }
    if (event.button !== 0) return;
    if (!touch) {
      this.doing = { what: "tool" };
      this.press(at, event);
      return;
    }
    this.fingers.set(event.pointerId, at);
    if (this.fingers.size === 1) this.doing = { what: "wait", from: at, event };
    else if (this.fingers.size === 2) {
      if (this.doing?.what === "tool") board.tool.escape();
      this.doing = { what: "pinch", ...this.spread() };
    }
  }

  private press(at: Vec, event: PointerEvent): void {
    const { board } = this, spot = board.spotAt(at, event, event.pointerType === "touch");
    board.point(spot);
    board.tool.down?.(spot);
    board.redraw();
  }

  /** How far two fingers are apart, and the place between them. */
  private spread(): { between: number; middle: Vec } {
    const [a, b] = [...this.fingers.values()];
    return { between: Math.max(1, dist(a, b)), middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] };
  }

  private move(event: PointerEvent): void {
    const { board, doing } = this, at = this.at(event);
    if (this.fingers.has(event.pointerId)) this.fingers.set(event.pointerId, at);
    if (doing?.what === "pan") {
      board.pan(...minus(at, doing.from));
      this.doing = { what: "pan", from: at };
    } else if (doing?.what === "pinch" && this.fingers.size === 2) {
      const now = this.spread();
      board.pan(...minus(now.middle, doing.middle));
      board.zoom(now.between / doing.between, now.middle);
      this.doing = { what: "pinch", ...now };
    } else if (doing?.what === "wait") {
      if (dist(at, doing.from) <= SLIP) return;
      this.doing = { what: "tool" };
      this.press(doing.from, doing.event);
      board.point(board.spotAt(at, event, true));
    } else if (doing?.what !== "pinch") {
      if (board.cross && !doing && event.pointerType !== "touch") board.cross = null;
      board.point(board.spotAt(at, event, event.pointerType === "touch"));
    }
  }

  private up(event: PointerEvent): void {
    const { board, doing } = this, at = this.at(event), touch = this.fingers.delete(event.pointerId);
    board.host.classList.remove("panning");
    if (doing?.what === "wait") this.press(doing.from, doing.event);
    if (doing?.what === "tool" || doing?.what === "wait") {
      const spot = board.spotAt(at, event, touch);
      board.spot = spot;
      board.tool.up?.(spot);
      board.redraw();
    }
    if (!this.fingers.size) this.doing = null;
  }

  private cancel(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    if (this.doing?.what === "tool") this.board.tool.escape();
    if (!this.fingers.size) this.doing = null;
    this.board.redraw();
  }
}

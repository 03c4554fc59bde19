// Keys on the sheet: camera, selection, the cross of the keyboard, digits for the values in hand.
import type { Vec } from "../../shapes";
import { type Item, same } from "../bench";
import { writes } from "../frame/keys";
import type { Hand } from "./hand";
import type { Pointers } from "./pointer";
import { copy, cut, duplicate, erase, everything, mirror, nudge, paste } from "./selection";
import type { Board } from "./sheet";

/** Space pressed shorter than this plays, ms; steps of panning, px; of zooming. */
const TAP = 200, PAN = 80, ZOOM = 1.25;
const WAYS: Record<string, Vec> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const TYPED = /^[\d.,\-−]$/;

export class Keys {
  private pressed = 0;
  private readonly ends: (() => void)[] = [];

  constructor(private readonly board: Board, private readonly hand: Hand, private readonly pointers: Pointers) {
    const on = (name: "keydown" | "keyup", work: (event: KeyboardEvent) => void) => {
      document.addEventListener(name, work);
      this.ends.push(() => document.removeEventListener(name, work));
    };
    on("keydown", (event) => !event.defaultPrevented && !elsewhere(event) && this.down(event) && event.preventDefault());
    on("keyup", (event) => this.up(event));
    // The sheet shows that it has the keys where these brought it there.
    on("keydown", ({ key }) => key === "Tab" && board.host.classList.add("by-keys"));
  }

  end(): void {
    for (const each of this.ends) each();
  }

  /** True where the key meant something. */
  private down(event: KeyboardEvent): boolean {
    const { board } = this, { key } = event, onSheet = document.activeElement === board.host || document.activeElement === document.body;
    if (event.ctrlKey || event.metaKey) return this.command(key.toLowerCase());
    if (key === "Escape") return this.escape();
    // Held over the sheet it holds snaps off; it opens no menu of the browser.
    if (key === "Alt") return board.bench.cursor.value !== null;
    if (key === "Tab" && onSheet && !event.shiftKey) return this.hand.begin();
    if (key === " ") return onSheet && this.space(event.repeat);
    if (key in WAYS) return onSheet && this.arrow(WAYS[key], event);
    if (key === "Enter") return onSheet && this.enter(event);
    if (key === "Delete" || key === "Backspace") return onSheet && erase(board);
    if (TYPED.test(key) && this.hand.begin()) return false;
    if (event.shiftKey && event.code === "Digit1") return (board.fit(), true);
    if (event.shiftKey && event.code === "Digit2") return (board.fitSelection(), true);
    if (event.shiftKey && key.toLowerCase() === "m") return mirror(board);
    switch (key) {
      case "+": case "=": return (board.zoom(ZOOM), true);
      case "-": case "−": return (board.zoom(1 / ZOOM), true);
      case "0": return (board.full(), true);
      case "[": case "]": return onSheet && this.walk(key === "]" ? 1 : -1);
    }
    return false;
  }

  private command(key: string): boolean {
    const { board } = this;
    switch (key) {
      case "a": return everything(board);
      case "c": return copy(board);
      case "x": return cut(board);
      case "v": return paste(board);
      case "d": return duplicate(board);
      default: return false;
    }
  }

  /** Value, then chain, then tool, then selection. */
  private escape(): boolean {
    const { board } = this, { bench, tool } = board;
    bench.refusal.value = null;
    if (tool.escape()) board.redraw();
    else if (board.cross) {
      board.cross = null;
      board.redraw();
    } else if (bench.tool.value !== "move") board.take("move");
    else bench.select();
    return true;
  }

  private space(repeat: boolean): boolean {
    if (repeat) return true;
    this.pressed = performance.now();
    [this.pointers.space, this.pointers.panned] = [true, false];
    this.board.host.classList.add("grabbing");
    return true;
  }

  private up(event: KeyboardEvent): void {
    const { pointers, board } = this, { page } = board.bench;
    if (event.key !== " " || !pointers.space) return;
    pointers.space = false;
    board.host.classList.remove("grabbing");
    if (!pointers.panned && performance.now() - this.pressed < TAP && board.bench.session.value) page.play(!page.playing.value);
  }

  private arrow([u, v]: Vec, event: KeyboardEvent): boolean {
    const { board } = this, { step, cross } = board;
    if (event.shiftKey) return (board.pan(-PAN * u, PAN * v), true);
    const size = event.altKey ? step / 10 : step;
    if (!cross) return nudge(board, [size * u, size * v]);
    this.go([cross[0] + size * u, cross[1] + size * v], event);
    return true;
  }

  /** Moves the cross, which stays in sight. */
  private go(to: Vec, event: { shiftKey: boolean; altKey: boolean }): void {
    const { board } = this, { camera } = board, [w, h] = camera.size, [x, y] = camera.screen(to), edge = 40;
    const inside = (value: number, most: number) => Math.min(most - edge, Math.max(edge, value)) - value;
    board.cross = to;
    if (inside(x, w) || inside(y, h)) board.pan(inside(x, w), inside(y, h));
    board.point(board.spotAt(camera.screen(to), { shiftKey: false, altKey: event.altKey }, false));
    if (board.spot?.snap?.kind === "point") board.said.value = board.spot.snap.sentence;
  }

  private enter(event: KeyboardEvent): boolean {
    const { board } = this, { tool, camera, step } = board, [w, h] = camera.size;
    if (board.cross) {
      const spot = board.spotAt(camera.screen(board.cross), { shiftKey: false, altKey: event.altKey }, false);
      board.point(spot);
      tool.down?.(spot);
      tool.up?.(spot);
      board.redraw();
    } else if (board.bench.cursor.value && (tool.fields?.().length || tool.anchor?.())) {
      tool.enter?.();
      board.redraw();
    } else {
      const [x, y] = camera.world([w / 2, h / 2]);
      this.go([Math.round(x / step) * step, Math.round(y / step) * step], event);
      board.host.classList.add("by-keys");
      board.said.value = board.bench.say("sheet.cross");
    }
    return true;
  }

  /** To the next joint or link, which is spoken; the cross goes with it. */
  private walk(way: 1 | -1): boolean {
    const { board } = this, { scene, bench } = board, one = bench.one;
    const all: Item[] = [...[...scene.points.keys()].map((name): Item => ({ kind: "point", name })), ...Object.keys(scene.links).map((name): Item => ({ kind: "link", name }))];
    if (!all.length) return true;
    const before = all.findIndex((each) => same(each, one)), item = all[before < 0 ? (way > 0 ? 0 : all.length - 1) : (before + way + all.length) % all.length];
    bench.select(item);
    board.speak(item);
    const corners = item.kind === "link" ? scene.corners(item.name) : [scene.at(item.name)!];
    if (board.cross && corners.length) this.go([0, 1].map((k) => corners.reduce((sum, each) => sum + each[k], 0) / corners.length) as Vec, { shiftKey: false, altKey: true });
    return true;
  }
}

/** Whether a key is for what is written or chosen elsewhere. */
function elsewhere({ target }: KeyboardEvent): boolean {
  return writes(target) || (target instanceof Element && target.closest("dialog, [role=menu], [role=dialog], [role=listbox]") !== null);
}

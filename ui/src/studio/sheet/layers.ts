// What is laid under and over the machine at every drawing: outlines, limits, paths of selected points, loads, transmission angles, vectors,
// the target curve and curves that are looked at.
import { effect, signal } from "@preact/signals";
import type { Vec } from "../../shapes";
import { line } from "../../strokes";
import type { Overlay } from "../tools/tool";
import { drawLimits, drawTransmission, drawVectorSizes } from "./analysis";
import { Backdrop, keepPhotos } from "./backdrop";
import { keepRoom } from "../room";
import { showPhoto } from "../tools/photo";
import { drawLoadMarks } from "./load_marks";
import { Outlines } from "./outlines";
import { type Scale, scalesOf } from "./scales";
import type { Board } from "./sheet";

/** Draws all that belongs to loads and results from now on. */
export class Layers {
  /** Of what is drawn as arrows. */
  readonly scales = signal<Scale[]>([]);
  private readonly backdrop: Backdrop;
  private readonly outlines: Outlines;
  private readonly ends: (() => void)[];

  constructor(private readonly board: Board) {
    const { bench } = board;
    const below = board.host.querySelector("svg.below")!;
    this.backdrop = new Backdrop(below);
    this.outlines = new Outlines(board, below);
    board.layers.add(this.draw);
    const redrawn = effect(() => {
      void [bench.photo.value, bench.target.value, bench.foreseen.value, bench.tool.value, bench.room.value];
      board.redraw();
    });
    board.host.addEventListener("dragover", (event) => event.preventDefault());
    board.host.addEventListener("drop", (event) => this.drop(event));
    this.ends = [() => board.layers.delete(this.draw), redrawn, keepPhotos(bench), keepRoom(bench)];
  }

  private readonly draw = (over: Overlay) => {
    const { board } = this;
    this.backdrop.draw(board.bench.photo.value, board.camera);
    this.outlines.draw(over);
    drawLimits(board, over);
    drawPaths(board, over);
    drawLoadMarks(board, over);
    drawTransmission(board, over);
    if (board.view && board.solved) drawVectorSizes(board, over, board.view);
    drawCurves(board, over);
    const scales = scalesOf(board);
    if (JSON.stringify(scales) !== JSON.stringify(this.scales.peek())) this.scales.value = scales;
  };

  /** A picture that is dropped on the sheet goes behind the drawing. */
  private drop(event: DragEvent): void {
    const file = [...(event.dataTransfer?.files ?? [])].find(({ type }) => type.startsWith("image/"));
    event.preventDefault();
    if (file) void showPhoto(this.board, file);
  }

  end(): void {
    for (const each of this.ends) each();
  }
}

/** Paths of selected points, while they are selected. */
function drawPaths({ bench, camera, scene, solved }: Board, over: Overlay): void {
  if (!solved || !bench.shows("paths")) return;
  const { model, data } = solved;
  for (const { kind, name } of bench.selection.value) {
    const point = kind === "point" ? scene.points.get(name) : undefined;
    if (!point?.key || point.fixed || solved.shown.paths.has(point.key)) continue;
    const xs = model.main.row(`p:${point.key}.x`), ys = model.main.row(`p:${point.key}.y`), way: Vec[] = [];
    for (let i = 0; i < model.n; i++) way.push(camera.screen([xs[i], ys[i]]));
    over.path(line(way, data.positions.closed), "path hand");
  }
}

function drawCurves({ bench, camera }: Board, over: Overlay): void {
  const { target, foreseen } = bench, screen = (places: Vec[]) => places.map((each) => camera.screen(each));
  foreseen.value.forEach((curve, k) => over.path(line(screen(curve)), k ? "path soft" : "path hand"));
  if (!target.value) return;
  const on = bench.has({ kind: "target", name: "target" });
  over.path(line(screen(target.value.points), target.value.closed), `target${on ? " hand" : ""}`);
}

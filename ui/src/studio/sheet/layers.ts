// What is laid over the machine at every drawing: limits, paths of selected points, loads, transmission angles, vectors,
// the target curve and curves that are looked at.
import { effect } from "@preact/signals";
import type { Vec } from "../../shapes";
import { line } from "../../strokes";
import type { Overlay } from "../tools/tool";
import { drawLimits, drawTransmission, drawVectorSizes } from "./analysis";
import { Backdrop, keepPhotos } from "./backdrop";
import { drawLoadMarks } from "./load_marks";
import type { Board } from "./sheet";

/** Draws all that belongs to loads and results from now on; ends with the function that it gives. */
export function layLayers(board: Board): () => void {
  const { bench } = board, backdrop = new Backdrop(board.host.querySelector("svg.below")!);
  const layer = (over: Overlay) => {
    backdrop.draw(bench.photo.value, board.camera);
    drawLimits(board, over);
    drawPaths(board, over);
    drawLoadMarks(board, over);
    drawTransmission(board, over);
    if (board.view && board.solved) drawVectorSizes(board, over, board.view);
    drawCurves(board, over);
  };
  board.layers.add(layer);
  const redrawn = effect(() => {
    void [bench.photo.value, bench.target.value, bench.foreseen.value];
    board.redraw();
  });
  const kept = keepPhotos(bench);
  return () => {
    board.layers.delete(layer);
    redrawn();
    kept();
  };
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

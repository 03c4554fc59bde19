// The line at the foot: what the drawing is now, where the pointer is, snap, grid, unit, zoom.
import type { Bench } from "../bench";

export function Status({ bench }: { bench: Bench }) {
  return <footer class="status"><span role="status">{bench.page.note.value || bench.desk.solved.value.structure?.headline}</span></footer>;
}

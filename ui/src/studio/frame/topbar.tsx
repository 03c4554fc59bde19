// The bar at the top: file, name and draft, undo, commands, language, theme, export, share.
import type { Bench } from "../bench";

export function TopBar({ bench }: { bench: Bench }) {
  return <header class="top"><b>{bench.desk.name.value}</b></header>;
}

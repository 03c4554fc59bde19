// What is done to the selected elements: removed, copied, moved by steps, mirrored.
import type { Vec } from "../../shapes";
import type { Item } from "../bench";
import { plus } from "./geometry";
import type { Board } from "./sheet";

/** What has been copied of which text, and how often it has been pasted since. */
let copied: { items: Item[]; of: string; pasted: number } | null = null;

export const hasCopy = () => copied !== null;

export function everything(board: Board): boolean {
  const { scene, bench } = board;
  bench.select(
    ...[...scene.points.keys()].map((name): Item => ({ kind: "point", name })), ...Object.keys(scene.links).map((name): Item => ({ kind: "link", name })),
    ...Object.keys(scene.loads).map((name): Item => ({ kind: "load", name })),
  );
  return true;
}

export function erase(board: Board): boolean {
  const items = board.bench.selection.value;
  if (items.length) {
    board.bench.select();
    void board.act([{ do: "remove", items }]);
  }
  return true;
}

export function copy(board: Board): boolean {
  const items = board.bench.selection.value.filter(({ kind }) => kind === "point" || kind === "link" || kind === "pair" || kind === "load");
  if (!items.length) return false;
  copied = { items, of: board.bench.desk.text.value, pasted: 0 };
  return true;
}

export function cut(board: Board): boolean {
  if (!copy(board)) return false;
  // It is put back where it was.
  copied!.pasted = -1;
  return erase(board);
}

export function paste(board: Board): boolean {
  if (!copied) return false;
  copied.pasted++;
  const far = 2 * copied.pasted * board.step;
  void put(board, copied.items, [far, -far], undefined, copied.of);
  return true;
}

export function duplicate(board: Board): boolean {
  const items = board.bench.selection.value;
  if (items.length) void put(board, items, [2 * board.step, -2 * board.step]);
  return true;
}

export function mirror(board: Board): boolean {
  const items = board.bench.selection.value;
  if (items.length) void put(board, items, [0, 0], "x");
  return true;
}

async function put(board: Board, items: Item[], shift: Vec, about?: "x" | "y", of = ""): Promise<void> {
  const other = of && of !== board.bench.desk.text.value;
  const made = await board.act([{ do: "paste", items, shift, ...(about ? { mirror: about } : {}), ...(other ? { of } : {}) }]);
  if (!made) return;
  board.bench.select(...made.map((name) => board.item(name)).filter((each) => each !== null));
}

/** The points of elements. */
export function pointsOf({ scene }: Board, items: Item[]): string[] {
  return [...new Set(items.flatMap(({ kind, name }) => (kind === "link" ? scene.links[name] ?? [] : kind === "point" ? [name] : [])))].filter((name) => scene.points.has(name));
}

/** Steps that are on their way into the text. */
let steps = 0;

/** Moves the selected elements by a way from where they are drawn; numbers that are locked stay. */
export function nudge(board: Board, way: Vec): boolean {
  const names = pointsOf(board, board.bench.selection.value);
  if (!names.length) return false;
  if (!steps) board.toDrawn();
  board.touch();
  // The next step goes on from here, though this one is not in the text yet.
  const points = Object.fromEntries(names.map((name) => [name, plus(board.scene.at(name)!, way)]));
  board.lift({ ...board.lifted, ...points });
  steps++;
  void board.act([{ do: "move", points, locked: [...board.bench.locked.value] }]).finally(() => --steps || board.lift(null));
  return true;
}

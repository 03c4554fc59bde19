// What is selected: the sheet where nothing is, one element, or several.
import type { ComponentType } from "preact";
import type { Bench, Item } from "../bench";
import type { Outline } from "../outline";
import { CurvePanel, PhotoPanel } from "./backgrounds";
import { DimensionPanel } from "./dimension";
import { DriverPanel } from "./driver";
import { at, type Table, word } from "./entries";
import { LinkPanel } from "./link";
import { LoadPanel } from "./load";
import { PairPanel } from "./pair";
import { PointPanel } from "./point";
import { Several } from "./several";
import { SheetPanel } from "./sheet";

export interface PanelProps {
  bench: Bench;
  item: Item;
  outline: Outline;
  entries: Table;
}

const PANELS: Record<Item["kind"], ComponentType<PanelProps>> = {
  point: PointPanel, link: LinkPanel, pair: PairPanel, load: LoadPanel, driver: DriverPanel, dimension: DimensionPanel, target: CurvePanel, photo: PhotoPanel,
};

export function Selected({ bench }: { bench: Bench }) {
  const selection = bench.selection.value, { outline } = bench.desk.solved.value;
  if (!outline || !selection.length) return <SheetPanel bench={bench} />;
  const { entries } = outline, known = selection.filter((item) => exists(bench, entries, item));
  if (!known.length) return <SheetPanel bench={bench} />;
  if (known.length > 1) return <Several bench={bench} items={known} outline={outline} entries={entries} />;
  const [item] = known, Panel = PANELS[item.kind];
  return <Panel key={`${item.kind} ${item.name}`} bench={bench} item={item} outline={outline} entries={entries} />;
}

/** Whether the text has it; it may be gone by undoing while it is selected. */
function exists(bench: Bench, entries: Table, { kind, name }: Item): boolean {
  switch (kind) {
    case "point": return name in (bench.desk.solved.value.picture?.points ?? {}) || word(at(entries, "joints", name, "kind")) !== "" || at(entries, "frame", "points", name) !== undefined;
    case "link": return at(entries, "links", name) !== undefined;
    case "pair": return at(entries, "joints", name) !== undefined;
    case "load": return at(entries, "loads", name) !== undefined;
    case "driver": return entries.driver !== undefined || entries.drivers !== undefined;
    default: return true;
  }
}

// Several elements at once: their count, what they have in common, align, mirror, weld.
import type { Action } from "../picture";
import type { Vec } from "../../shapes";
import type { Bench, Item } from "../bench";
import type { Outline } from "../outline";
import { Icon } from "../frame/icons";
import { make, perform, tell } from "./change";
import { at, linksAt, type Path, type Table, word } from "./entries";
import { Act, Quantity, Row } from "./fields";

interface Common {
  label: string;
  key: string;
  unit: string;
  items: [Item, Path][];
  address?: (name: string) => string;
}

export function Several({ bench, items, entries }: { bench: Bench; items: Item[]; outline: Outline; entries: Table }) {
  const { say } = bench, points = items.filter(({ kind }) => kind === "point").map(({ name }) => name), places = bench.desk.solved.value.picture?.points ?? {};
  const drawn = points.filter((name) => places[name]), counts = new Map<string, number>();
  for (const { kind } of items) counts.set(kind, (counts.get(kind) ?? 0) + 1);
  const act = (...actions: Action[]) => tell(bench, perform(bench, actions));
  const level = (axis: 0 | 1) => {
    const to = places[drawn[0]][axis], moved = Object.fromEntries(drawn.slice(1).map((name): [string, Vec] => [name, axis ? [places[name][0], to] : [to, places[name][1]]]));
    return act({ do: "move", points: moved, locked: [...bench.locked.value] });
  };
  const weldable = points.filter((name) => linksAt(entries, name).length > 1);
  const copied = items.filter(({ kind }) => ["point", "link", "pair", "load"].includes(kind));
  return (
    <>
      <div class="who">
        <span class="glyph"><Icon name="move" size={22} /></span>
        <div><h2>{say("insp.several", { count: String(items.length) })}</h2><p>{[...counts].map(([kind, count]) => say(`insp.count_${kind}`, { count: String(count) })).join(say("insp.comma"))}</p></div>
        <span class="acts"><button type="button" class="square" aria-label={say("insp.delete_all")} title={say("insp.delete_all")} onClick={() => void act({ do: "remove", items }).then((done) => done && bench.select())}><Icon name="trash" size={17} /></button></span>
      </div>
      <CommonFields bench={bench} items={items} entries={entries} />
      {drawn.length > 1 && (
        <div class="form">
          <Row label={say("insp.align")}>
            <Act act={() => void level(1)}>{say("insp.level")}</Act>
            <Act act={() => void level(0)}>{say("insp.upright")}</Act>
          </Row>
        </div>
      )}
      <div class="row-acts">
        {weldable.length > 0 && <Act icon="weld" act={() => void act(...weldable.map((point) => ({ do: "weld", point, on: linksAt(entries, point)[1] })))}>{say("insp.weld")}</Act>}
        {copied.length > 0 && <Act icon="mirror" act={() => void make(bench, [{ do: "paste", items: copied, shift: [0, 0], mirror: "x" }])}>{say("insp.mirror")}</Act>}
        {copied.length > 0 && <Act icon="copy" act={() => void make(bench, [{ do: "paste", items: copied, shift: [0.02, -0.02] }])}>{say("insp.copy")}</Act>}
      </div>
      <ul class="list names">
        {items.map((item) => <li key={`${item.kind} ${item.name}`}><button type="button" onClick={() => bench.select(item)} onPointerEnter={() => (bench.hovered.value = item)} onPointerLeave={() => (bench.hovered.value = null)}><b>{item.name}</b><span>{say(`insp.kind_${item.kind}`)}</span></button></li>)}
      </ul>
    </>
  );
}

/** Fields that all of them have; one that differs shows nothing, and what is typed is set in all. */
function CommonFields({ bench, items, entries }: { bench: Bench; items: Item[]; entries: Table }) {
  const { say } = bench, all = (kind: Item["kind"]) => items.every((each) => each.kind === kind);
  const found: Common[] = [];
  const add = (label: string, key: string, unit: string, section: string) => {
    const paths = items.map((item): [Item, Path] => [item, [section, item.name, key]]);
    if (paths.every(([, path]) => typeof at(entries, ...path) === "string")) found.push({ label, key, unit, items: paths });
  };
  if (all("link")) {
    add("insp.length", "length", "mm", "links");
    add("insp.mass", "mass", "kg", "links");
    add("insp.inertia", "inertia", "kg·m²", "links");
  }
  if (all("load")) {
    add("insp.size_of", "magnitude", "N", "loads");
    add("insp.direction", "direction", "deg", "loads");
    add("insp.key_stiffness", "stiffness", "N/mm", "loads");
  }
  if (!found.length) return null;
  return (
    <div class="form">
      {found.map(({ label, key, unit, items: paths }) => {
        const values = paths.map(([, path]) => word(at(entries, ...path))), same = values.every((each) => each === values[0]);
        return <Quantity key={key} label={say(label)} value={same ? values[0] : ""} preset={say("insp.differ")} unit={unit} set={(value) => perform(bench, paths.map(([, path]) => ({ do: "set", path, value })))} />;
      })}
    </div>
  );
}

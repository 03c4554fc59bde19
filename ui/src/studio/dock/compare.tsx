// Comparison: the machine as it is, as it was, kept variants and other machines side by side, what differs first.
import { signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import { rows as metricRows } from "../../compare";
import type { Folder, Solved } from "../desk";
import { foreseen } from "../foreseen";
import { Session } from "../../session";
import { code, type Values } from "../../solver";
import { digits, quantity } from "../../words";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { foresee } from "./foresee";
import { Select } from "./select";

/** Another machine, with what can be drawn of it. */
interface Other {
  name: string;
  session: Session;
  solved: Solved;
}

/** A column of the table: a design of this machine, or another machine. */
interface Column {
  key: string;
  title: string;
  /** The design's dimensions, to look at and to take; null: another machine. */
  values: Values | null;
  session: Session;
  numbers: Values;
  take?: () => void;
  remove?: () => void;
  other?: Other;
}

const others = signal<Other[]>([]);
/** Share of a size below which two values are the same. */
const SAME = 1e-6;

async function add(bench: Bench, asked: { name?: string; gallery?: string }, title: string): Promise<void> {
  const { desk, page } = bench, found = await desk.ask<{ text: string }>("read", asked), solved = found && (await desk.ask<Solved>("solve", { text: found.text, name: asked.name ?? "" }));
  if (!solved?.model) {
    if (solved) page.note.value = bench.say("dock.cannot_compare", { name: title, reason: solved.findings.find(({ severity }) => severity === "error")?.sentence ?? solved.sentence });
    return;
  }
  const session = new Session(solved.model, await code(solved.model), others.value.length + 1);
  others.value = [...others.value.filter((each) => each.name !== title), { name: title, session, solved }];
}

function columnsOf(bench: Bench, session: Session): Column[] {
  const { say } = bench, { model } = session, found: Column[] = [{ key: "now", title: bench.page.say("now"), values: null, session, numbers: model.numbers() }];
  if (model.differs) found.push({ key: "before", title: say("dock.before"), values: model.original.values, session, numbers: model.original.numbers, take: () => session.take({ ...model.values, ...model.original.values }) });
  for (const { number, design } of session.variants.value)
    found.push({ key: `variant ${number}`, title: bench.page.say("kept", { number: String(number) }), values: design.values, session, numbers: design.numbers, take: () => session.take({ ...model.values, ...design.values }), remove: () => session.forget(number) });
  for (const other of others.value)
    found.push({ key: `other ${other.name}`, title: other.name, values: null, session: other.session, numbers: other.session.model.numbers(), other, remove: () => (others.value = others.value.filter((each) => each !== other)) });
  return found;
}

interface Row {
  key: string;
  name: string;
  texts: string[];
  /** The largest difference to the machine as it is, as a share. */
  off: number;
}

const offOf = (list: (number | undefined)[]) => Math.max(0, ...list.slice(1).map((x) => (x === undefined || list[0] === undefined || Number.isNaN(x) ? 0 : Math.abs(x - list[0]) / Math.max(Math.abs(x), Math.abs(list[0]), 1e-12))));

/** The dimensions and metrics of all columns. */
function rowsOf(bench: Bench, columns: Column[]): { dimensions: Row[]; metrics: Row[] } {
  const language = bench.page.language.value, [{ session }] = columns, sessions = [...new Set(columns.map((each) => each.session))];
  const valueOf = (column: Column, address: string) => (column.values ?? column.session.model.values)[address];
  const dimensions = session.data.dimensions.map(({ address, unit, factor }): Row => {
    const list = columns.map((each) => valueOf(each, address));
    return { key: address, name: address, texts: list.map((x) => (x === undefined ? "–" : `${digits(x / factor, 5)}${unit === "deg" ? "°" : ` ${unit}`}`.trim())), off: offOf(list) };
  });
  const metrics = metricRows(sessions).map((row): Row => {
    const figures = columns.map((each) => row[sessions.indexOf(each.session)]), list = columns.map((each, k) => (figures[k] ? each.numbers[figures[k].id] : undefined)), first = figures.find(Boolean)!;
    const size = Math.max(...list.map((x) => Math.abs(x ?? 0)).filter(Number.isFinite), 0);
    return { key: first.id, name: [...new Set(figures.flatMap((each) => (each ? [each.name[language]] : [])))].join(" / "), texts: list.map((x) => (x === undefined ? "–" : quantity(x, first.quantity, size))), off: offOf(list) };
  });
  return { dimensions, metrics };
}

export function Compare({ bench, session }: { bench: Bench; session: Session }) {
  void [session.calm.value, session.variants.value, others.value];
  const { say } = bench, [all, setAll] = useState(false), columns = columnsOf(bench, session), { dimensions, metrics } = rowsOf(bench, columns);
  useEffect(() => () => foresee(bench, null), []);
  const look = (column: Column | null) => {
    const drawing = column?.other?.solved.picture;
    foreseen(session, column?.values ?? null);
    foresee(bench, drawing ? { drawing: { points: drawing.points, fixed: drawing.fixed, links: drawing.links, guides: [], driver: drawing.driver ?? "" }, curve: [] } : null);
  };
  const differ = (list: Row[]) => list.filter(({ off }) => off > SAME).sort((a, b) => b.off - a.off), alike = [...dimensions, ...metrics].filter(({ off }) => off <= SAME);
  const part = (title: string, list: Row[]) => list.length > 0 && (
    <tbody>
      <tr class="part"><th scope="rowgroup" colSpan={columns.length + 1}>{title}</th></tr>
      {list.map((row) => <tr key={row.key}><th scope="row">{row.name}</th>{row.texts.map((text, k) => <td key={columns[k].key} class={k && text !== row.texts[0] ? "differs" : ""}>{text}</td>)}</tr>)}
    </tbody>
  );
  return (
    <div class="compare">
      <Sources bench={bench} session={session} />
      <div class="compare-table" tabIndex={0} role="region" aria-label={say("dock.compare")}>
        {columns.length < 2 ? <p class="no-curves">{say("dock.compare_help")}</p> : (
          <table>
            <thead>
              <tr>
                <td />
                {columns.map((each) => (
                  <th scope="col" key={each.key} onPointerEnter={() => look(each)} onPointerLeave={() => look(null)}>
                    {each.title}
                    {each.take && <button class="text" onClick={each.take}>{say("dock.take")}</button>}
                    {each.remove && <button class="square" aria-label={bench.page.say("forget", { name: each.title })} onClick={() => { look(null); each.remove!(); }}><Icon name="close" size={14} /></button>}
                  </th>
                ))}
              </tr>
            </thead>
            {part(bench.page.say("dimensions"), differ(dimensions))}
            {part(say("dock.metrics"), differ(metrics))}
            {all && part(say("dock.alike"), alike)}
          </table>
        )}
        {columns.length > 1 && alike.length > 0 && <button class="text" aria-expanded={all} onClick={() => setAll(!all)}>{all ? say("dock.hide_alike") : say("dock.show_alike", { count: String(alike.length) })}</button>}
      </div>
    </div>
  );
}

/** What can be put beside the machine. */
function Sources({ bench, session }: { bench: Bench; session: Session }) {
  const { desk, say } = bench, [folder, setFolder] = useState<Folder | null>(null);
  useEffect(() => void desk.folder().then((found) => found && setFolder(found)), [desk.name.value, bench.page.language.value]);
  return (
    <div class="compare-add">
      <button class="quietly" onClick={() => session.keep()}><Icon name="plus" size={16} />{say("dock.keep_variant")}</button>
      {session.model.differs && (
        <button class="quietly" onClick={() => { session.model.original = session.model.design(); session.touched(); }}>{say("dock.keep_as_before")}</button>
      )}
      <Select
        value="" aria-label={say("dock.add_machine")}
        onChange={(event) => {
          const [kind, name] = event.currentTarget.value.split(/:(.*)/s), title = event.currentTarget.selectedOptions[0].textContent ?? name;
          event.currentTarget.value = "";
          if (name) void add(bench, { [kind]: name }, title);
        }}
      >
        <option value="">{say("dock.add_machine")}</option>
        {folder && folder.files.length > 0 && <optgroup label={say("dock.files")}>{folder.files.map(({ name }) => <option key={name} value={`name:${name}`}>{name}</option>)}</optgroup>}
        {folder && <optgroup label={say("gallery")}>{folder.gallery.map(({ name, title }) => <option key={name} value={`gallery:${name}`}>{title}</option>)}</optgroup>}
      </Select>
    </div>
  );
}

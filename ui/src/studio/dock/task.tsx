// A task of synthesis as a form: a field for each demand, by its form; points and poses are typed, pasted or set on the sheet.
import { useEffect, useRef, useState } from "preact/hooks";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { collect, drawRows } from "./collect";
import { type Demand, filled, type Given, MOST, pasted, ROWS, SHOWN, type Task, type Typed, UNITS, written } from "./demands";
import { lay } from "./foresee";
import { Select } from "./select";

interface Props {
  bench: Bench;
  task: Task;
  given: Given;
  give: (given: Given) => void;
}

export function TaskForm({ bench, task, given, give }: Props) {
  const { say } = bench, latest = useRef(given), [onSheet, setOnSheet] = useState("");
  latest.current = given;
  const set = (key: string, typed: Typed) => give((latest.current = { ...latest.current, [key]: typed }));
  const field = (demand: Demand) => <Field key={demand.key} bench={bench} demand={demand} typed={given[demand.key]} set={(typed) => set(demand.key, typed)} onSheet={onSheet === demand.key} toSheet={(on) => setOnSheet(on ? demand.key : "")} />;
  const needed = task.demands.filter((each) => each.needed), further = task.demands.filter((each) => !each.needed), ready = needed.every((each) => filled(given[each.key]));
  const running = bench.desk.sought.value?.running && bench.desk.sought.value.kind === "synthesis";
  return (
    <form
      class="task" onSubmit={(event) => {
        event.preventDefault();
        setOnSheet("");
        if (ready) void bench.desk.search("synthesis", { task: task.name, demands: written(task, given), unit: bench.settings.value.unit });
      }}
    >
      <p class="help">{say(`dock.task_help.${task.name}`)}</p>
      {needed.map(field)}
      {further.length > 0 && <h3>{say("dock.more_demands")}</h3>}
      {further.map(field)}
      <button class="solid sticking" disabled={!ready || running}>{say("dock.find_linkages")}</button>
    </form>
  );
}

interface FieldProps {
  bench: Bench;
  demand: Demand;
  typed: Typed | undefined;
  set: (typed: Typed) => void;
  onSheet: boolean;
  toSheet: (on: boolean) => void;
}

function Field(props: FieldProps) {
  const { bench, demand, typed, set } = props, { key, form, words, usual } = demand, label = bench.say(`dock.demand.${key}`);
  if (ROWS[form]) return <Rows {...props} label={label} />;
  if (form === "flag") {
    const on = typed === undefined ? usual === true : typed === true;
    return <label class="task-flag"><input type="checkbox" checked={on} onChange={(event) => set(event.currentTarget.checked)} />{label}</label>;
  }
  if (form === "word") {
    return (
      <label class="task-field">
        <span>{label}</span>
        <Select value={typeof typed === "string" ? typed : (usual ?? "").toString()} onChange={(event) => set(event.currentTarget.value)}>
          {usual === null && <option value="">{bench.say("dock.free")}</option>}
          {words.map(([word, name]) => <option key={word} value={word}>{name}</option>)}
        </Select>
      </label>
    );
  }
  const unit = SHOWN[UNITS[form]] ?? "", list = form === "angles" || form === "lengths";
  return (
    <label class="task-field">
      <span>{label}</span>
      <span class="task-value"><input value={typeof typed === "string" ? typed : ""} placeholder={list ? bench.say("dock.list_hint") : ""} spellcheck={false} autocomplete="off" required={demand.needed} onInput={(event) => set(event.currentTarget.value)} /><i>{unit}</i></span>
    </label>
  );
}

/** Rows of numbers: typed, pasted from a table, or set on the sheet. */
function Rows({ bench, demand: { key, form }, typed, set, onSheet, toSheet, label }: FieldProps & { label: string }) {
  const columns = ROWS[form], rows = Array.isArray(typed) ? typed : [], most = MOST[form] ?? Infinity, poses = form === "poses", latest = useRef(rows);
  latest.current = rows;
  useEffect(() => {
    if (!onSheet) return;
    return collect(bench, () => ({ rows: latest.current, poses, most, set: (found) => { latest.current = found; set(found); } }));
  }, [onSheet]);
  useEffect(() => {
    drawRows(bench, key, rows, poses);
    return () => lay(bench, key, null);
  }, [typed]);
  const axis = (name: "x" | "y" | "angle") => (name === "angle" ? bench.say("dock.angle") : name);
  const cell = (k: number, j: number, text: string) => set(rows.map((row, n) => (n === k ? row.map((each, m) => (m === j ? (text.trim() === "" || !Number.isFinite(Number(text.replace(",", "."))) ? null : Number(text.replace(",", "."))) : each)) : row)));
  const shown = rows.length ? rows : [columns.map(() => null)];
  return (
    <fieldset class="task-rows">
      <legend>{label}</legend>
      <div class="task-row task-axes" aria-hidden="true">{columns.map((each) => <span key={each}>{axis(each)} {each === "angle" ? "°" : "mm"}</span>)}</div>
      {shown.map((row, k) => (
        <div class="task-row" key={k}>
          {row.map((value, j) => (
            <input
              key={j} value={value ?? ""} inputMode="decimal" aria-label={bench.say("dock.coordinate", { name: label, number: String(k + 1), axis: axis(columns[j]) })}
              onChange={(event) => (rows.length ? cell(k, j, event.currentTarget.value) : set([columns.map((_, m) => (m === j && event.currentTarget.value.trim() ? Number(event.currentTarget.value.replace(",", ".")) : null))]))}
              onPaste={(event) => {
                const found = pasted(event.clipboardData?.getData("text") ?? "", columns.length);
                if (found.length < 2 && (found[0]?.length ?? 0) < 2) return;
                event.preventDefault();
                set([...rows.filter((each) => each[0] !== null), ...found].slice(0, most));
              }}
            />
          ))}
          <button type="button" class="square" disabled={!rows.length} aria-label={bench.say("dock.row_remove", { number: String(k + 1) })} onClick={() => set(rows.filter((_, n) => n !== k))}><Icon name="close" size={14} /></button>
        </div>
      ))}
      <div class="task-under">
        <button type="button" class="text" disabled={rows.length >= most} onClick={() => set([...rows, columns.map(() => null)])}><Icon name="plus" size={14} />{bench.say("dock.row_add")}</button>
        <button type="button" class="text" aria-pressed={onSheet} data-key={key} onClick={() => toSheet(!onSheet)}><Icon name={onSheet ? "check" : "target"} size={16} />{bench.say(onSheet ? "dock.on_sheet_end" : "dock.on_sheet")}</button>
      </div>
    </fieldset>
  );
}

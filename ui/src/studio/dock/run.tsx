// Motion under forces: what drives, brakes and stops the machine, how a run begins and ends, and what happened in it.
import { useEffect, useState } from "preact/hooks";
import type { Ran } from "../desk";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { set as change, tell, unset } from "../inspector/change";
import { at, type Path, table, word, words } from "../inspector/entries";
import type { Entry } from "../outline";
import { Select } from "./select";

/** A key of the file: whether it must be given, the words that it may be, a value as an example. */
interface Field {
  key: string;
  about: string;
  needed: boolean;
  words: string[];
  example: string;
}

interface Forms {
  kinds: { kind: string; about: string; fields: Field[] }[];
  stops: Field[];
  run: Field[];
}

/** Keys of a run that are asked here; the others stay as the text has them. */
const CONDITIONS = new Set(["speed", "for", "turns", "until", "at_most"]);

export function Running({ bench }: { bench: Bench }) {
  const { desk, say } = bench, [forms, setForms] = useState<Forms | null>(null), language = bench.page.language.value;
  useEffect(() => void desk.ask<Forms>("actuators").then((found) => found && setForms(found)), [language]);
  const running = desk.sought.value?.running && desk.sought.value.kind === "run", entries = table(desk.solved.value.outline?.entries);
  return (
    <div class="running">
      <form class="wish" onSubmit={(event) => { event.preventDefault(); void desk.run(); }}>
        <fieldset>
          <legend>{say("dock.actuators")}</legend>
          {forms && Object.entries(table(entries.actuators)).map(([name, entry]) => <Element key={name} bench={bench} path={["actuators", name]} entry={entry} title={`${name} (${word(at(entry, "kind"))})`} fields={forms.kinds.find(({ kind }) => kind === word(at(entry, "kind")))?.fields ?? []} />)}
          {forms && <Added bench={bench} forms={forms} />}
        </fieldset>
        <fieldset>
          <legend>{say("dock.stops")}</legend>
          {forms && Object.entries(table(entries.stops)).map(([name, entry]) => <Element key={name} bench={bench} path={["stops", name]} entry={entry} title={name} fields={forms.stops} />)}
          {forms && <New bench={bench} section="stops" stem="stop" fields={forms.stops} label={say("dock.add_stop")} />}
        </fieldset>
        <fieldset>
          <legend>{say("dock.conditions")}</legend>
          {forms?.run.filter(({ key }) => CONDITIONS.has(key)).map((field) => <Value key={field.key} bench={bench} path={["run", field.key]} entry={at(entries, "run", field.key)} field={field} />)}
        </fieldset>
        <button class="solid sticking" disabled={running}>{say("dock.begin_run")}</button>
      </form>
      <Course bench={bench} />
    </div>
  );
}

/** A motor, a brake, a stop of the text with its keys. */
function Element({ bench, path, entry, title, fields }: { bench: Bench; path: Path; entry: Entry; title: string; fields: Field[] }) {
  return (
    <details class="run-element">
      <summary><b>{title}</b><button type="button" class="square" aria-label={bench.say("forget", { name: title })} onClick={(event) => { event.preventDefault(); void tell(bench, unset(bench, path)); }}><Icon name="close" size={14} /></button></summary>
      {fields.map((field) => <Value key={field.key} bench={bench} path={[...path, field.key]} entry={at(entry, field.key)} field={field} />)}
    </details>
  );
}

const shown = (entry: Entry | undefined) => (Array.isArray(entry) ? words(entry).join(", ") : word(entry));
const read = (text: string, entry: Entry | undefined): Entry => (Array.isArray(entry) || text.includes(",") ? text.split(",").map((part) => part.trim()) : text.trim());

function Value({ bench, path, entry, field }: { bench: Bench; path: Path; entry: Entry | undefined; field: Field }) {
  const label = field.key.replaceAll("_", " "), set = (text: string) => void tell(bench, text.trim() ? change(bench, path, read(text, entry)) : unset(bench, path));
  return (
    <label class="task-field" title={field.about}>
      <span>{label}</span>
      {field.words.length ? (
        <Select value={word(entry)} onChange={(event) => set(event.currentTarget.value)}><option value="">–</option>{field.words.map((each) => <option key={each} value={each}>{each}</option>)}</Select>
      ) : <input value={shown(entry)} placeholder={field.example} spellcheck={false} autocomplete="off" onChange={(event) => set(event.currentTarget.value)} />}
    </label>
  );
}

/** A new actuator: its kind, what it must be given, then it stands in the text. */
function Added({ bench, forms }: { bench: Bench; forms: Forms }) {
  const [kind, setKind] = useState(""), chosen = forms.kinds.find((each) => each.kind === kind);
  return (
    <>
      <Select value={kind} aria-label={bench.say("dock.add_actuator")} onChange={(event) => setKind(event.currentTarget.value)}><option value="">{bench.say("dock.add_actuator")}</option>{forms.kinds.map((each) => <option key={each.kind} value={each.kind}>{each.kind}</option>)}</Select>
      {chosen && <New key={kind} bench={bench} section="actuators" stem={kind} kind={kind} fields={chosen.fields} label={bench.say("dock.add")} done={() => setKind("")} />}
    </>
  );
}

interface NewProps {
  bench: Bench;
  section: string;
  stem: string;
  kind?: string;
  fields: Field[];
  label: string;
  done?: () => void;
}

function New({ bench, section, stem, kind, fields, label, done }: NewProps) {
  const driven = word(at(table(bench.desk.solved.value.outline?.entries), "driver", "turn")), [open, setOpen] = useState(kind !== undefined);
  const [typed, setTyped] = useState<Record<string, string>>(driven && fields.some(({ key }) => key === "on") ? { on: driven } : {});
  const add = async () => {
    const given = Object.entries(typed).filter(([, text]) => text.trim()).map(([key, text]): [string, Entry] => [key, read(text, undefined)]);
    const made = await bench.desk.act([{ do: "add", section, stem, entry: { ...(kind ? { kind } : {}), ...Object.fromEntries(given) } }]);
    if (!made) return;
    setTyped({});
    setOpen(false);
    done?.();
  };
  if (!open) return <button type="button" class="text" onClick={() => setOpen(true)}><Icon name="plus" size={14} />{label}</button>;
  return (
    <>
      {fields.map((field) => {
        const value = typed[field.key] ?? "", set = (text: string) => setTyped({ ...typed, [field.key]: text });
        return (
          <label key={field.key} class="task-field" title={field.about}>
            <span>{field.key.replaceAll("_", " ")}{field.needed ? " *" : ""}</span>
            {field.words.length ? <Select value={value} onChange={(event) => set(event.currentTarget.value)}><option value="">–</option>{field.words.map((each) => <option key={each} value={each}>{each}</option>)}</Select>
              : <input value={value} placeholder={field.example} spellcheck={false} autocomplete="off" onInput={(event) => set(event.currentTarget.value)} />}
          </label>
        );
      })}
      <button type="button" class="quietly" onClick={() => void add()}>{label}</button>
    </>
  );
}

/** How the run ended and what happened; a click goes to that moment. */
function Course({ bench }: { bench: Bench }) {
  const { desk, say, page } = bench, sought = desk.sought.value;
  if (sought?.kind !== "run") return <p class="no-curves">{say("dock.run_help")}</p>;
  const ran: Ran = sought, end = ran.end ?? 0, go = (time: number) => {
    page.play(false);
    page.phase.value = end ? Math.min(time / end, 1) : 0;
  };
  return (
    <div class="run-course" role="region" aria-label={say("dock.run")} tabIndex={0}>
      {sought.sentence && <p class="not" role="alert">{sought.sentence}</p>}
      {ran.summary && <table><tbody>{ran.summary.map((row, k) => <tr key={k}>{row.map((cell, j) => (j ? <td key={j}>{cell}</td> : <th key={j} scope="row">{cell}</th>))}</tr>)}</tbody></table>}
      {desk.running.value ? <button type="button" class="text" onClick={() => void desk.solve()}>{say("dock.back_to_driver")}</button> : ran.summary && <p class="quiet">{say("dock.run_over")}</p>}
      {ran.events && ran.events.length > 0 && <ul>{ran.events.map(([time, event], k) => <li key={k}><button type="button" class="text" disabled={!desk.running.value} onClick={() => go(ran.times?.[k] ?? 0)}>{time}</button><span>{event}</span></li>)}</ul>}
    </div>
  );
}

// The keys of motors, brakes, stops and of a run as fields: in words, with what of the machine they may name.
import { useState } from "preact/hooks";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { set as change, tell, unset } from "../inspector/change";
import { at, type Path, pointsOf, table, type Table, word, words } from "../inspector/entries";
import type { Entry } from "../outline";
import { Select } from "./select";

/** A key of the file: its name in words, whether it must be given, what it may be, a value as an example. */
export interface Field {
  key: string;
  label: string;
  about: string;
  needed: boolean;
  /** What of the machine it names; empty: nothing. */
  form: "" | "link" | "moving" | "joint" | "output" | "points";
  words: [string, string][];
  example: string;
  /** Keys of which one is enough. */
  instead: string[];
  /** Whether few need it. */
  further: boolean;
}

/** The names that a field may have, from what stands in the text. */
function named(form: Field["form"], entries: Table): string[] {
  const links = Object.keys(table(entries.links)), guides = Object.entries(table(entries.joints)).filter(([, joint]) => word(at(joint, "kind")) === "prismatic").map(([name]) => name);
  const fixed = Object.keys(table(at(entries, "frame", "points"))), on = (link: string) => { const { own, also } = pointsOf(at(entries, "links", link)); return [...own, ...also]; };
  if (form === "moving") return links;
  if (form === "link") return ["frame", ...links];
  if (form === "joint") return guides;
  if (form === "points") return [...fixed.map((point) => `frame.${point}`), ...links.flatMap((link) => on(link).map((point) => `${link}.${point}`))];
  if (form === "output") return [...links, ...guides, ...[...new Set(links.flatMap(on))].flatMap((point) => (fixed.includes(point) ? [] : [`${point}.x`, `${point}.y`]))];
  return [];
}

const shown = (entry: Entry | undefined) => (Array.isArray(entry) ? words(entry).join(", ") : word(entry));
export const read = (text: string): Entry => (text.includes(",") ? text.split(",").map((part) => part.trim()) : text.trim());
const whole = (text: string) => text.trim() !== "" && !text.split(",").some((part) => part.trim() === "");

interface Entered {
  bench: Bench;
  field: Field;
  value: string;
  set: (text: string) => void;
  /** Whether every letter counts, not only what is typed in the end. */
  live?: boolean;
  entry?: Entry;
}

function Asked({ bench, field, value, set, live, entry }: Entered) {
  const names = named(field.form, table(bench.desk.solved.value.outline?.entries)), said = field.label + (live && field.needed ? " *" : "");
  if (field.form === "points") {
    const ends = value.split(",").map((part) => part.trim());
    return (
      <div class="task-field run-ends" role="group" aria-label={field.label} title={field.about}>
        <span>{said}</span>
        {[0, 1].map((k) => <Choice key={k} label={`${field.label} ${k + 1}`} value={ends[k] ?? ""} options={names.map((name) => [name, name])} set={(name) => set(k ? `${ends[0]}, ${name}` : `${name}, ${ends[1] ?? ""}`)} />)}
      </div>
    );
  }
  const options = field.words.length ? field.words : names.map((name): [string, string] => [name, name]), type = (event: { currentTarget: HTMLInputElement }) => set(event.currentTarget.value);
  const nested = entry !== undefined && !Array.isArray(entry) && typeof entry !== "string";
  return (
    <label class="task-field" title={field.about}>
      <span>{said}</span>
      {options.length ? <Choice value={value} options={options} set={set} />
        : <input value={value} placeholder={nested ? "…" : field.example} disabled={nested} spellcheck={false} autocomplete="off" onInput={live ? type : undefined} onChange={live ? undefined : type} />}
    </label>
  );
}

/** One of several, a value that is not among them too. */
function Choice({ label, value, options, set }: { label?: string; value: string; options: [string, string][]; set: (to: string) => void }) {
  return (
    <Select value={value} aria-label={label} onChange={(event) => set(event.currentTarget.value)}>
      <option value="">–</option>
      {value && !options.some(([each]) => each === value) && <option value={value}>{value}</option>}
      {options.map(([each, text]) => <option key={each} value={each}>{text}</option>)}
    </Select>
  );
}

/** The fields of an element: those of which another one is given stay away, those that few need stand apart. */
function Fields({ bench, fields, given, of }: { bench: Bench; fields: Field[]; given: (key: string) => string; of: (field: Field) => Omit<Entered, "bench" | "field"> }) {
  const open = fields.filter(({ key, instead }) => given(key) || !instead.some((each) => given(each))), asked = (field: Field) => <Asked key={field.key} bench={bench} field={field} {...of(field)} />;
  const first = open.filter(({ further, key }) => !further || given(key)), rest = open.filter((field) => !first.includes(field));
  return (
    <>
      {first.map(asked)}
      {rest.length > 0 && <details class="run-further"><summary>{bench.say("dock.further")}</summary>{rest.map(asked)}</details>}
    </>
  );
}

export function Value({ bench, path, entry, field }: { bench: Bench; path: Path; entry: Entry | undefined; field: Field }) {
  return <Asked bench={bench} field={field} {...kept(bench, path, entry, field)} />;
}

/** A value of the text, and what writes it there. */
function kept(bench: Bench, path: Path, entry: Entry | undefined, { form }: Field) {
  const set = (text: string) => {
    if (text.trim() && form === "points" && !whole(text)) return;
    void tell(bench, text.trim() ? change(bench, path, Array.isArray(entry) && !text.includes(",") ? [text.trim()] : read(text)) : unset(bench, path));
  };
  return { value: shown(entry), entry, set };
}

/** A motor, a brake, a stop of the text with its keys. */
export function Element({ bench, path, entry, title, fields }: { bench: Bench; path: Path; entry: Entry; title: string; fields: Field[] }) {
  return (
    <div class="run-element">
      <details>
        <summary><b>{title}</b></summary>
        <Fields bench={bench} fields={fields} given={(key) => shown(at(entry, key))} of={(field) => kept(bench, [...path, field.key], at(entry, field.key), field)} />
      </details>
      <button type="button" class="square" aria-label={bench.say("forget", { name: title })} onClick={() => void tell(bench, unset(bench, path))}><Icon name="close" size={14} /></button>
    </div>
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

/** A new element: what it must be given, then it stands in the text. */
export function New({ bench, section, stem, kind, fields, label, done }: NewProps) {
  const driven = word(at(table(bench.desk.solved.value.outline?.entries), "driver", "turn")), [open, setOpen] = useState(kind !== undefined);
  const [typed, setTyped] = useState<Record<string, string>>(driven && fields.some(({ key }) => key === "on") ? { on: driven } : {});
  const add = async () => {
    const given = Object.entries(typed).filter(([, text]) => whole(text)).map(([key, text]): [string, Entry] => [key, read(text)]);
    const made = await bench.desk.act([{ do: "add", section, stem, entry: { ...(kind ? { kind } : {}), ...Object.fromEntries(given) } }]);
    if (!made) return;
    setTyped({});
    setOpen(false);
    done?.();
  };
  if (!open) return <button type="button" class="text" onClick={() => setOpen(true)}><Icon name="plus" size={14} />{label}</button>;
  return (
    <>
      <Fields bench={bench} fields={fields} given={(key) => typed[key] ?? ""} of={({ key }) => ({ value: typed[key] ?? "", set: (text) => setTyped({ ...typed, [key]: text }), live: true })} />
      <button type="button" class="quietly" onClick={() => void add()}>{label}</button>
    </>
  );
}

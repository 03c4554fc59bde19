// Motion under forces: what drives, brakes and stops the machine, how a run begins and ends, and what happened in it.
import { useEffect, useState } from "preact/hooks";
import type { Ran } from "../desk";
import type { Bench } from "../bench";
import { at, table, word } from "../inspector/entries";
import { Element, type Field, New, Value } from "./run_form";
import { Select } from "./select";

interface Forms {
  kinds: { kind: string; label: string; about: string; fields: Field[] }[];
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
          {forms && Object.entries(table(entries.actuators)).map(([name, entry]) => {
            const kind = forms.kinds.find((each) => each.kind === word(at(entry, "kind")));
            return <Element key={name} bench={bench} path={["actuators", name]} entry={entry} title={`${name} (${kind?.label ?? word(at(entry, "kind"))})`} fields={kind?.fields ?? []} />;
          })}
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

/** A new actuator: its kind, what it must be given, then it stands in the text. */
function Added({ bench, forms }: { bench: Bench; forms: Forms }) {
  const [kind, setKind] = useState(""), chosen = forms.kinds.find((each) => each.kind === kind);
  return (
    <>
      <Select value={kind} aria-label={bench.say("dock.add_actuator")} onChange={(event) => setKind(event.currentTarget.value)}><option value="">{bench.say("dock.add_actuator")}</option>{forms.kinds.map((each) => <option key={each.kind} value={each.kind}>{each.label}</option>)}</Select>
      {chosen && <New key={kind} bench={bench} section="actuators" stem={kind} kind={kind} fields={chosen.fields} label={bench.say("dock.add")} done={() => setKind("")} />}
    </>
  );
}

/** How the run ended and what happened; a click goes to that moment. */
function Course({ bench }: { bench: Bench }) {
  const { desk, say, page } = bench, sought = desk.sought.value;
  if (sought?.kind !== "run") return <p class="no-curves">{say("dock.run_help")}</p>;
  const ran: Ran = sought, end = ran.end ?? 0, shows = desk.running.value, go = (time: number) => {
    page.play(false);
    page.phase.value = end ? Math.min(time / end, 1) : 0;
  };
  return (
    <div class="run-course" role="region" aria-label={say("dock.run")} tabIndex={0}>
      {[sought.sentence, ran.stalled].map((sentence, k) => sentence && <p key={k} class="not" role="alert">{sentence}</p>)}
      {ran.summary && <table><tbody>{ran.summary.map((row, k) => <tr key={k}>{row.map((cell, j) => (j ? <td key={j}>{cell}</td> : <th key={j} scope="row">{cell}</th>))}</tr>)}</tbody></table>}
      {shows ? <button type="button" class="text" onClick={() => void desk.solve()}>{say("dock.back_to_driver")}</button> : ran.model && !sought.running && <p class="quiet">{say("dock.run_over")}</p>}
      {ran.events && ran.events.length > 0 && <ul>{ran.events.map(([time, event], k) => <li key={k}><button type="button" class="text" disabled={!shows} onClick={() => go(ran.times?.[k] ?? 0)}>{time}</button><span>{event}</span></li>)}</ul>}
    </div>
  );
}

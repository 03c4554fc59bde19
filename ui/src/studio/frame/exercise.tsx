// The dialog that makes exercises of a drawing: what varies, what is asked, how many sheets.
import { useState } from "preact/hooks";
import type { Session } from "../../session";
import type { Bench } from "../bench";
import { DialogFrame } from "./dialog";

/** What results are called in exercises, by the beginnings of their names among the signals. */
const RESULTS: Partial<Record<string, (of: string, on: string) => string>> = {
  angle: (of) => `${of}.angle`, w: (of) => `${of}.angular_velocity`, g: (of) => `${of}.angular_acceleration`,
  s: (of) => `${of}.displacement`, sv: (of) => `${of}.velocity`, sa: (of) => `${of}.acceleration`,
  effort: (of) => `${of}.effort`, r: (of, on) => `${of} on ${on}.magnitude`,
};

/** Results that can be asked for: their names in the file, and in words. */
export function results(signals: Session["data"]["signals"], language: "en" | "zh"): [name: string, words: string][] {
  return signals.flatMap(({ id, name }): [string, string][] => {
    const [kind, rest = ""] = id.split(/:(.*)/s), [of, on = ""] = rest.split("|"), named = RESULTS[kind];
    return named && of ? [[named(of, on), name[language]]] : [];
  });
}

interface Chosen {
  count: string;
  seed: string;
  share: string;
  at: string;
  vary: string[];
  ask: string[];
}

/** The request: what is not chosen is left as it is usual. */
export function asked({ count, seed, share, at, vary, ask }: Chosen): Record<string, unknown> {
  const given = share.trim().replace(/^(\d+(?:[.,]\d+)?)$/, "$1 %").replace(",", ".");
  return {
    count: Number(count), seed: Number(seed),
    ...(vary.length ? { vary: Object.fromEntries(vary.map((address) => [address, given])) } : {}),
    ...(ask.length ? { ask } : {}), ...(at.trim() ? { at: at.trim() } : {}),
  };
}

export function ExerciseDialog({ bench }: { bench: Bench }) {
  const { desk, page, session } = bench, { data } = session.value ?? {};
  const [chosen, setChosen] = useState<Chosen>({ count: "10", seed: "1", share: "8 %", at: "", vary: [], ask: [] }), [problem, setProblem] = useState("");
  const set = (change: Partial<Chosen>) => setChosen({ ...chosen, ...change }), making = desk.making.value > 0;
  const turns = data?.positions.inputs[0]?.turns ?? true, wrong = !/^[1-9]\d{0,2}$/.test(chosen.count) || !/^\d{1,6}$/.test(chosen.seed);
  const take = async (ending: string) => {
    setProblem("");
    await desk.take(ending, asked(chosen));
    setProblem(page.note.value);
  };
  const field = (key: "count" | "seed" | "share" | "at", hint = "") => (
    <label>
      <span>{bench.say(`exercise.${key}`)}</span>
      <input autofocus={key === "count"} value={chosen[key]} inputMode={key === "count" || key === "seed" ? "numeric" : undefined} placeholder={hint} onInput={(event) => set({ [key]: event.currentTarget.value })} />
    </label>
  );
  const choice = (key: "vary" | "ask", all: [string, string][]) => (
    <fieldset>
      <legend>{bench.say(`exercise.${key}`)}</legend>
      <p class="quiet">{bench.say(`exercise.${key}_usual`)}</p>
      <div class="checks" tabIndex={0} role="group" aria-label={bench.say(`exercise.${key}`)}>
        {all.map(([name, words]) => (
          <label key={name}>
            <input type="checkbox" checked={chosen[key].includes(name)} onChange={(event) => set({ [key]: event.currentTarget.checked ? [...chosen[key], name] : chosen[key].filter((each) => each !== name) })} />
            {words}
          </label>
        ))}
      </div>
    </fieldset>
  );
  return (
    <DialogFrame bench={bench} title={bench.say("exercise.title")} class="exercise">
      <form class="dialog-form" onSubmit={(event) => { event.preventDefault(); if (!wrong && !making) void take(".exercise.pdf"); }}>
        <p class="quiet">{bench.say("exercise.help")}</p>
        <div class="exercise-fields">{field("count")}{field("seed")}{field("share")}{field("at", turns ? "60 deg" : "10 mm")}</div>
        {choice("vary", (data?.dimensions ?? []).filter(({ geometry, value }) => geometry && value !== 0).map(({ address }) => [address, address]))}
        {choice("ask", results(data?.signals ?? [], page.language.value))}
        <p role="alert" class="problem">{problem}</p>
        <div class="dialog-acts">
          <button type="button" class="outline" disabled={wrong || making} onClick={() => void take(".exercise.zip")}>{bench.say("exercise.zip")}</button>
          <button class="primary plain" disabled={wrong || making}>{bench.say(making ? "export.making" : "exercise.pdf")}</button>
        </div>
      </form>
    </DialogFrame>
  );
}

// Optimisation in the studio: what varies, what is made least, what is kept, and the designs as they are found.
import { useEffect, useState } from "preact/hooks";
import type { Dimension } from "./data";
import type { Better, Desk } from "./desk";
import type { Session } from "./session";

const SENSES = { minimize: "least", maximize: "most" } as const;
type Sense = keyof typeof SENSES;
type Pair = [string, string];

interface Wish {
  vary: Pair[];
  goals: [Sense, string][];
  keep: Pair[];
}

const shown = (value: unknown) => (typeof value === "string" ? value : JSON.stringify(value));

/** What a field says: a text, or a catalogue or list in brackets. */
function read(text: string): unknown {
  if (!/^[[{]/.test(text.trim())) return text.trim();
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}

function wished(asked: Record<string, unknown>): Wish {
  const pairs = (key: string): Pair[] => Object.entries((asked[key] ?? {}) as Record<string, unknown>).map(([name, value]) => [name, shown(value)]);
  const goals = (sense: Sense) => [asked[sense] ?? []].flat().map((name): [Sense, string] => [sense, shown(name)]);
  return { vary: pairs("vary"), goals: [...goals("minimize"), ...goals("maximize")], keep: pairs("keep") };
}

/** The section of the file, with what stood in it beside these; numbers that stand alone without a list. */
function section(wish: Wish, before: Record<string, unknown>): Record<string, unknown> {
  const table = (pairs: Pair[]) => Object.fromEntries(pairs.filter(([name]) => name.trim()).map(([name, value]) => [name.trim(), read(value)]));
  const goals = (sense: Sense) => {
    const names = wish.goals.filter(([each, name]) => each === sense && name.trim()).map(([, name]) => read(name));
    return names.length > 1 ? names : names[0];
  };
  const { vary: _, minimize: __, maximize: ___, keep: ____, ...rest } = before;
  const own = { vary: table(wish.vary), minimize: goals("minimize"), maximize: goals("maximize"), keep: table(wish.keep) };
  const said = Object.entries(own).filter(([, value]) => value !== undefined && (typeof value !== "object" || Object.keys(value ?? {}).length));
  return { ...Object.fromEntries(said), ...rest };
}

/** A range about the present value, in the unit of the file. */
function about(dimension: Dimension, value: number, size: number): string {
  const now = value / dimension.factor, reach = 0.2 * (Math.abs(now) || (dimension.geometry ? size / dimension.factor : 5));
  const [low, high] = [now - reach, now + reach].map((each) => Number(each.toPrecision(3)));
  return `${low}..${high} ${dimension.unit}`.trim();
}

export function Optimise({ desk, session }: { desk: Desk; session: Session }) {
  const asked = desk.solved.value.optimize ?? {}, key = JSON.stringify(asked), { folds } = desk.page;
  const [open, setOpen] = useState(folds.optimise ?? key !== "{}");
  return (
    <details class="card optimise" open={open} onToggle={(event) => setOpen((folds.optimise = event.currentTarget.open))}>
      <summary>{desk.say("optimize")}</summary>
      {open && <Form key={key} desk={desk} session={session} asked={asked} />}
      {open && <Designs desk={desk} session={session} />}
    </details>
  );
}

function Form({ desk, session, asked }: { desk: Desk; session: Session; asked: Record<string, unknown> }) {
  const [wish, setWish] = useState<Wish>(() => wished(asked)), [goals, setGoals] = useState<{ name: string; label: string }[]>([]);
  const language = desk.page.language.value, { dimensions } = session.data, { say } = desk;
  useEffect(() => void desk.ask<{ goals: typeof goals }>("goals", { text: desk.text.value }).then((found) => found && setGoals(found.goals)), [language]);
  const put = <Key extends keyof Wish>(part: Key, list: Wish[Key]) => setWish({ ...wish, [part]: list });
  const changed = <Row extends [string, string]>(list: Row[], k: number, place: 0 | 1, text: string) =>
    list.map((row, j) => (j === k ? (place ? [row[0], text] : [text, row[1]]) : row)) as Row[];
  const without = <Row,>(list: Row[], k: number) => list.filter((_, j) => j !== k);
  const away = (name: string, act: () => void) => <button class="remove" aria-label={say("forget", { name })} onClick={act}>×</button>;
  const begin = async () => {
    const wanted = section(wish, asked);
    if (JSON.stringify(wanted) !== JSON.stringify(asked)) await desk.act([{ do: "optimize", section: wanted }]);
    await desk.search("optimize", { text: desk.text.value });
  };
  const free = dimensions.filter(({ address }) => !wish.vary.some(([name]) => name === address));
  const ready = wish.vary.length > 0 && wish.goals.some(([, name]) => name.trim());
  return (
    <>
      <p class="hint">{say("help_optimize")}</p>
      <datalist id="goals">{goals.map(({ name, label }) => <option key={name} value={name}>{label}</option>)}</datalist>
      <fieldset class="wish">
        <legend>{say("vary")}</legend>
        {wish.vary.map(([name, range], k) => (
          <div class="row" key={name}>
            <span class="name">{name}</span>
            <input value={range} aria-label={say("range_of", { name })} onInput={(event) => put("vary", changed(wish.vary, k, 1, event.currentTarget.value))} />
            {away(name, () => put("vary", without(wish.vary, k)))}
          </div>
        ))}
        <select
          value="" aria-label={say("add_dimension")}
          onChange={(event) => {
            const found = dimensions.find(({ address }) => address === event.currentTarget.value);
            event.currentTarget.value = "";
            if (found) put("vary", [...wish.vary, [found.address, about(found, session.model.values[found.address], session.model.size)]]);
          }}
        >
          <option value="">{say("add_dimension")}</option>
          {free.map(({ address }) => <option key={address}>{address}</option>)}
        </select>
      </fieldset>
      <fieldset class="wish">
        <legend>{say("goals")}</legend>
        {wish.goals.map(([sense, name], k) => (
          <div class="row" key={k}>
            <select value={sense} aria-label={say("goals")} onChange={(event) => put("goals", changed(wish.goals, k, 0, event.currentTarget.value))}>
              {Object.entries(SENSES).map(([each, word]) => <option key={each} value={each}>{say(word)}</option>)}
            </select>
            <input value={name} list="goals" aria-label={say("number_name")} onInput={(event) => put("goals", changed(wish.goals, k, 1, event.currentTarget.value))} />
            {away(name, () => put("goals", without(wish.goals, k)))}
          </div>
        ))}
        <button onClick={() => put("goals", [...wish.goals, ["minimize", ""]])}>+ {say("add_goal")}</button>
      </fieldset>
      <fieldset class="wish">
        <legend>{say("demands")}</legend>
        {wish.keep.map(([name, demand], k) => (
          <div class="row" key={k}>
            <input value={name} list="goals" aria-label={say("number_name")} onInput={(event) => put("keep", changed(wish.keep, k, 0, event.currentTarget.value))} />
            <input value={demand} placeholder={say("demand_hint")} aria-label={say("demand_text")} onInput={(event) => put("keep", changed(wish.keep, k, 1, event.currentTarget.value))} />
            {away(name, () => put("keep", without(wish.keep, k)))}
          </div>
        ))}
        <button onClick={() => put("keep", [...wish.keep, ["", ""]])}>+ {say("add_demand")}</button>
      </fieldset>
      <button class="play" disabled={!ready} onClick={() => void begin()}>{say("begin")}</button>
    </>
  );
}

/** The designs so far; the one under the pointer shows its paths in the drawing. */
function Designs({ desk, session }: { desk: Desk; session: Session }) {
  const sought = desk.sought.value;
  if (sought?.kind !== "optimum") return null;
  const [done, most] = sought.done;
  return (
    <section class="candidates">
      {sought.running && (
        <p class="hint" role="status">
          {done ? desk.say("tried", { done: String(done), most: String(most) }) : desk.say("searching")} <button onClick={() => void desk.enough()}>{desk.say("enough")}</button>
        </p>
      )}
      {sought.sentence && <p class="wall">{sought.sentence}</p>}
      {sought.candidates.map((each, k) => <Design key={k} desk={desk} session={session} better={each} head={sought.head ?? []} number={k + 1} />)}
    </section>
  );
}

function Design({ desk, session, better, head, number }: { desk: Desk; session: Session; better: Better; head: string[]; number: number }) {
  const name = desk.say("design", { number: String(number) });
  const take = () => {
    session.foresee(null);
    void desk.enough();
    void desk.write(better.values);
  };
  return (
    <div class="scroll design" role="region" tabIndex={0} aria-label={name} onPointerEnter={() => session.foresee(better.values)} onPointerLeave={() => session.foresee(null)}>
      <table class="numbers">
        <caption>{name} <button onClick={take}>{desk.say("take_design")}</button></caption>
        <thead><tr>{head.map((each) => <th scope="col" key={each}>{each}</th>)}</tr></thead>
        <tbody>
          {better.rows.map(([first, ...rest]) => <tr key={first}><th scope="row">{first}</th>{rest.map((each, k) => <td key={k}>{each}</td>)}</tr>)}
        </tbody>
      </table>
    </div>
  );
}

// Optimisation: what varies within which range, what is made least or most, what must hold; the designs as they are found.
import { useEffect, useState } from "preact/hooks";
import type { Better } from "../desk";
import { foreseen } from "../foreseen";
import type { Session } from "../../session";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { about, type Goal, parted, ranged, type Sense, SENSES, type Wish, wished, writtenWish } from "./wish";
import { Select } from "./select";

/** Columns of a design: what it is of, before, now, change; the bounds stand in the form. */
const SHOWN = 4;

interface Props {
  bench: Bench;
  session: Session;
}

export function Optimise({ bench, session }: Props) {
  const { desk } = bench, asked = desk.solved.value.optimize ?? {}, key = JSON.stringify(asked);
  return (
    <div class={desk.sought.value?.kind === "optimum" ? "optimise has-designs" : "optimise"}>
      <Form key={key} bench={bench} session={session} asked={asked} />
      <Designs bench={bench} session={session} />
    </div>
  );
}

/** What a number is called, by its name in the file. */
interface Named {
  name: string;
  label: string;
}

function Form({ bench, session, asked }: Props & { asked: Record<string, unknown> }) {
  const { desk, say } = bench, [wish, setWish] = useState<Wish>(() => wished(asked)), [goals, setGoals] = useState<Named[]>([]), language = bench.page.language.value;
  useEffect(() => void desk.ask<{ goals: Named[] }>("goals", { text: desk.text.value }).then((found) => found && setGoals(found.goals)), [language, session]);
  const put = <Key extends keyof Wish>(part: Key, list: Wish[Key]) => setWish((now) => ({ ...now, [part]: list })), { dimensions } = session.data;
  const begin = async () => {
    const wanted = writtenWish(wish, asked);
    if (JSON.stringify(wanted) !== JSON.stringify(asked)) await desk.act([{ do: "optimize", section: wanted }]);
    await desk.search("optimize", { text: desk.text.value });
  };
  const free = dimensions.filter(({ address }) => !wish.vary.some(([name]) => name === address)), running = desk.sought.value?.running && desk.sought.value.kind === "optimum";
  const ready = wish.vary.length > 0 && wish.goals.some(([, name]) => name.trim());
  return (
    <form class="wish" onSubmit={(event) => { event.preventDefault(); if (ready) void begin(); }}>
      <fieldset>
        <legend>{say("dock.vary")}</legend>
        {wish.vary.map(([name, range], k) => <Vary key={name} bench={bench} name={name} range={range} set={(to) => put("vary", wish.vary.map((row, j) => (j === k ? [name, to] : row)))} remove={() => put("vary", wish.vary.filter((_, j) => j !== k))} />)}
        <Select
          value="" aria-label={say("add_dimension")}
          onChange={(event) => {
            const found = dimensions.find(({ address }) => address === event.currentTarget.value);
            event.currentTarget.value = "";
            if (found) put("vary", [...wish.vary, [found.address, about(found, session.model.values[found.address], session.model.size)]]);
          }}
        ><option value="">{say("add_dimension")}</option>{free.map(({ address }) => <option key={address}>{address}</option>)}</Select>
      </fieldset>
      <fieldset>
        <legend>{say("dock.goals")}</legend>
        {wish.goals.map(([sense, name], k) => (
          <div class="wish-row" key={k}>
            <Away bench={bench} name={name} act={() => put("goals", wish.goals.filter((_, j) => j !== k))} />
            <span class="wish-pair"><Select value={sense} aria-label={say("dock.goals")} onChange={(event) => put("goals", wish.goals.map((row, j): Goal => (j === k ? [event.currentTarget.value as Sense, name] : row)))}>{SENSES.map((each) => <option key={each} value={each}>{say(`dock.${each}`)}</option>)}</Select>
            <Metric bench={bench} goals={goals} name={name} set={(to) => put("goals", wish.goals.map((row, j): Goal => (j === k ? [sense, to] : row)))} /></span>
          </div>
        ))}
        <button type="button" class="text" disabled={!goals.length} onClick={() => put("goals", [...wish.goals, another(goals, wish)])}><Icon name="plus" size={14} />{say("dock.add_goal")}</button>
      </fieldset>
      <fieldset>
        <legend>{say("dock.demands")}</legend>
        {wish.keep.map(([name, demand], k) => (
          <div class="wish-row wish-keep" key={k}>
            <Metric bench={bench} goals={goals} name={name} set={(to) => put("keep", wish.keep.map((row, j) => (j === k ? [to, demand] : row)))} />
            <span class="wish-pair"><Demand bench={bench} demand={demand} set={(to) => put("keep", wish.keep.map((row, j) => (j === k ? [name, to] : row)))} /></span>
            <Away bench={bench} name={name} act={() => put("keep", wish.keep.filter((_, j) => j !== k))} />
          </div>
        ))}
        <button type="button" class="text" disabled={!goals.length} onClick={() => put("keep", [...wish.keep, [goals.find((each) => /transmission/.test(each.name))?.name ?? goals[0]?.name ?? "", "at least 40 deg"]])}><Icon name="plus" size={14} />{say("dock.add_demand")}</button>
      </fieldset>
      <button class="solid sticking" disabled={!ready || running}>{say("dock.begin")}</button>
    </form>
  );
}

/** The goals that are asked first, with their senses. */
const USUAL: [Sense, RegExp][] = [["minimize", /^peak_input_torque$/], ["maximize", /^transmission_angle$/], ["minimize", /^peak_reaction$/], ["minimize", /./]];

/** A goal that is not asked yet. */
function another(goals: Named[], { goals: asked }: Wish): Goal {
  const free = goals.filter(({ name }) => !asked.some(([, each]) => each === name));
  for (const [sense, sort] of USUAL) {
    const found = free.find(({ name }) => sort.test(name));
    if (found) return [sense, found.name];
  }
  return ["minimize", ""];
}

function Away({ bench, name, act }: { bench: Bench; name: string; act: () => void }) {
  return <button type="button" class="square" aria-label={bench.say("forget", { name })} onClick={act}><Icon name="close" size={14} /></button>;
}

/** A range by its ends; other texts of the file (lists, catalogues) as they are. */
function Vary({ bench, name, range, set, remove }: { bench: Bench; name: string; range: string; set: (range: string) => void; remove: () => void }) {
  const ends = ranged(range), label = bench.say("range_of", { name });
  return (
    <div class="wish-row wish-vary">
      <span class="wish-name" title={name}>{name}</span>
      {ends ? (
        <span class="wish-ends">
          <input value={ends.low} aria-label={`${label}, ${bench.say("dock.sweep_low")}`} inputMode="decimal" onInput={(event) => set(`${event.currentTarget.value}..${ends.high} ${ends.unit}`.trim())} />…
          <input value={ends.high} aria-label={`${label}, ${bench.say("dock.sweep_high")}`} inputMode="decimal" onInput={(event) => set(`${ends.low}..${event.currentTarget.value} ${ends.unit}`.trim())} />
          <i>{ends.unit === "deg" ? "°" : ends.unit}</i>
        </span>
      ) : <input value={range} aria-label={label} onInput={(event) => set(event.currentTarget.value)} />}
      <Away bench={bench} name={name} act={remove} />
    </div>
  );
}

/** A number in words; one that the list does not have stays as the file calls it. */
function Metric({ bench, goals, name, set }: { bench: Bench; goals: Named[]; name: string; set: (name: string) => void }) {
  return (
    <Select value={name} aria-label={bench.say("number_name")} onChange={(event) => set(event.currentTarget.value)}>
      {!goals.some((each) => each.name === name) && <option value={name}>{name}</option>}
      {goals.map((each) => <option key={each.name} value={each.name}>{each.label}</option>)}
    </Select>
  );
}

function Demand({ bench, demand, set }: { bench: Bench; demand: string; set: (demand: string) => void }) {
  const [bound, value] = parted(demand);
  return (
    <>
      {bound && <Select value={bound} aria-label={bench.say("dock.bound")} onChange={(event) => set(`${event.currentTarget.value} ${value}`)}><option value="at least">≥</option><option value="at most">≤</option></Select>}
      <input value={value} aria-label={bench.say("demand_text")} onInput={(event) => set(bound ? `${bound} ${event.currentTarget.value}` : event.currentTarget.value)} />
    </>
  );
}

/** The designs so far; the one under the pointer shows its paths on the sheet. */
function Designs({ bench, session }: Props) {
  const { desk, say } = bench, sought = desk.sought.value;
  if (sought?.kind !== "optimum") return <p class="no-curves">{say("dock.optimise_help")}</p>;
  return (
    <div class="candidates" role="region" aria-label={say("dock.designs")}>
      {sought.sentence && <p class="not" role="alert">{sought.sentence}</p>}
      <ol>{sought.candidates.map((each, k) => <Design key={k} bench={bench} session={session} better={each} head={sought.head ?? []} number={k + 1} />)}</ol>
    </div>
  );
}

function Design({ bench, session, better, head, number }: Props & { better: Better; head: string[]; number: number }) {
  const name = bench.say("design", { number: String(number) }), look = () => foreseen(session, better.values), leave = () => foreseen(session, null);
  const take = () => {
    leave();
    void bench.desk.enough();
    void bench.desk.write(better.values);
  };
  return (
    <li class="design" onPointerEnter={look} onPointerLeave={leave}>
      <div class="design-head"><b>{name}</b><button class="text" aria-label={`${name}: ${bench.say("take_design")}`} onFocus={look} onBlur={leave} onClick={take}>{bench.say("dock.take")}</button></div>
      <div class="design-table" tabIndex={0} role="region" aria-label={name}>
        <table>
          <thead><tr>{head.slice(0, SHOWN).map((each) => <th scope="col" key={each}>{each}</th>)}</tr></thead>
          <tbody>{better.rows.map(([first, ...rest]) => <tr key={first}><th scope="row">{first}</th>{rest.slice(0, SHOWN - 1).map((each, k) => <td key={k}>{each}</td>)}</tr>)}</tbody>
        </table>
      </div>
      {better.missed.length > 0 && <p class="not">{bench.say("missed", { names: better.missed.join(", ") })}</p>}
    </li>
  );
}

// Metrics before and now, with one dimension in hand.
import { useEffect, useState } from "preact/hooks";
import type { Session } from "../../session";
import { digits } from "../../words";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { Act, Segments, Sentence, Sym } from "./fields";
import { InHand } from "./hand";
import { Kept } from "./kept";
import { ask, choice, found, GROUPS, keep, type Row, rows } from "./metrics";
import { Notes } from "./notes";
import { Picker } from "./picker";

/** Share of a change, %, that is worth saying; of a limit, that is rounding. */
const WORTH = 0.005, ROUNDING = 1e-9;

export function Numbers({ bench }: { bench: Bench }) {
  const session = bench.session.value, { say } = bench;
  if (!session) return <p class="quiet">{say("insp.no_numbers")}</p>;
  return <Table bench={bench} session={session} />;
}

function Table({ bench, session }: { bench: Bench; session: Session }) {
  void session.calm.value;
  const { say } = bench, [both, setBoth] = useState(true), [picking, pick] = useState(false), language = bench.page.language.value;
  useEffect(() => void ask(bench, session), [session, language]);
  const all = rows(bench, session), shown = all.filter((row) => choice.value.shown[row.key] ?? row.usual);
  const asBefore = () => {
    session.model.original = session.model.design();
    keep(session, found.value.list);
    session.touched();
  };
  return (
    <>
      <div class="before">
        <Segments label={say("insp.numbers_shown")} value={both ? "both" : "now"} options={[["both", say("insp.before_and_now")], ["now", say("insp.now_only")]]} set={(to) => setBoth(to === "both")} />
        {session.model.differs && (
          <>
            <button type="button" class="text" onClick={asBefore}>{say("insp.keep_as_before")}</button>
            <button type="button" class="text" onClick={() => session.take({ ...session.model.values, ...session.model.original.values })}>{say("insp.back_to_before")}</button>
          </>
        )}
      </div>
      <InHand bench={bench} session={session} />
      {shown.length > 0 && (
        <div class="table">
          <table>
            <thead><tr><th scope="col">{say("insp.metric")}</th>{both && <th scope="col">{say("insp.before")}</th>}<th scope="col">{say("insp.now_column")}</th><th scope="col"><span class="unseen">{say("insp.change")}</span></th></tr></thead>
            {GROUPS.map((group) => {
              const own = shown.filter((row) => row.group === group);
              return own.length > 0 && (
                <tbody key={group}>
                  <tr class="group"><th colSpan={both ? 4 : 3} scope="rowgroup">{say(`insp.group_${group}`)}</th></tr>
                  {own.map((row) => <Metric key={row.key} bench={bench} row={row} both={both} />)}
                </tbody>
              );
            })}
          </table>
        </div>
      )}
      {!all.length && found.value.text === session.data.text && <p class="quiet">{say("insp.no_metrics")}</p>}
      <Notes bench={bench} session={session} />
      <Kept bench={bench} session={session} />
      {picking && <Picker bench={bench} session={session} all={all} close={() => pick(false)} />}
      <div class="row-acts last">
        <button type="button" class="quietly" aria-expanded={picking} onClick={() => pick(!picking)}><Icon name="plus" size={16} />{say("insp.number")}</button>
        <Act act={() => (bench.dock.value = "compare")}>{say("insp.compare")}</Act>
        <Act act={() => (bench.dock.value = "optimise")}>{say("insp.optimise")}</Act>
      </div>
    </>
  );
}

function Metric({ bench, row, both }: { bench: Bench; row: Row; both: boolean }) {
  const { key, label, of, now, before, unit, factor, limit, remark, stale } = row, size = Math.max(Math.abs(before) || 0, Math.abs(now) || 0), glued = unit === "°" || unit === "";
  const plain = (value: number) => digits(Math.abs(value) < ROUNDING * size ? 0 : value * factor, 4) + (unit === "°" && Number.isFinite(value) ? "°" : "");
  const share = ((now - before) / Math.abs(before)) * 100, changed = both && Math.abs(share) > WORTH ? percent(share) : "";
  const met = limit && (limit.least ? now >= limit.value * (1 - ROUNDING) : now <= limit.value * (1 + ROUNDING)), bound = limit ? plain(limit.value) : "";
  return (
    <tr data-metric={key} class={stale ? "stale" : ""}>
      <th scope="row" title={remark || undefined}><Label bench={bench} name={key} label={label} /><small><Owner of={of} /></small></th>
      {both && <td class="was">{plain(before)}</td>}
      <td class="is">{plain(now)}{!glued && <em>{unit}</em>}</td>
      <td class={limit ? (met ? "ok" : "bad") : "chg"} title={limit ? bench.say(met ? "insp.met" : "insp.missed", { limit: bound }) : ""}>
        {limit ? `${limit.least === met ? "≥" : limit.least ? "<" : met ? "≤" : ">"} ${bound}` : changed}
      </td>
    </tr>
  );
}

function Label({ bench, name, label }: { bench: Bench; name: string; label: string }) {
  return name.startsWith("transmission_angle ") ? <Sentence text={bench.say("metric.least_m", { mu: "{0}" })} names={["μ"]} /> : <>{label}</>;
}

/** What a metric is of: points in italics, links as they are called. */
function Owner({ of }: { of: string }) {
  const [first, link] = of.split("|");
  if (!of) return null;
  if (link) return <><Sym name={first} />, {link}</>;
  return <>{/^\p{L}{1,2}\d*$/u.test(first) ? <Sym name={first} /> : first.split("+").join(", ")}</>;
}

function percent(share: number): string {
  return Math.abs(share) >= 1000 ? `× ${digits(1 + share / 100, 3)}` : `${share > 0 ? "+" : ""}${digits(share, 2)} %`;
}

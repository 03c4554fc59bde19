// Metrics before and now, with one dimension in hand.
import { useState } from "preact/hooks";
import type { Figure } from "../../data";
import type { Session } from "../../session";
import { digits, unitFor } from "../../words";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { Act, Segments, Sentence, Sym } from "./fields";
import { InHand } from "./hand";
import { choice, figures, GROUPS, groupOf, kindOf, limitOf, named, ownerOf, valuesOf } from "./metrics";
import { Picker } from "./picker";

/** Share of a change, %, that is worth saying. */
const WORTH = 0.005;

export function Numbers({ bench }: { bench: Bench }) {
  const session = bench.session.value, { say } = bench;
  if (!session) return <p class="quiet">{say("insp.no_numbers")}</p>;
  return <Table bench={bench} session={session} />;
}

function Table({ bench, session }: { bench: Bench; session: Session }) {
  void session.calm.value;
  const { say } = bench, [both, setBoth] = useState(true), [picking, pick] = useState(false), values = valuesOf(session);
  const hidden = new Set(choice.value.hidden), all = figures(session), shown = all.filter(({ id }) => !hidden.has(id));
  const keep = () => {
    session.model.original = session.model.design();
    session.touched();
  };
  return (
    <>
      <div class="before">
        <Segments label={say("insp.numbers_shown")} value={both ? "both" : "now"} options={[["both", say("insp.before_and_now")], ["now", say("insp.now_only")]]} set={(to) => setBoth(to === "both")} />
        {session.model.differs && <button type="button" class="text" onClick={keep}>{say("insp.keep_as_before")}</button>}
      </div>
      <InHand bench={bench} session={session} />
      {shown.length > 0 && (
        <div class="table">
          <table>
            <thead><tr><th scope="col">{say("insp.metric")}</th>{both && <th scope="col">{say("insp.before")}</th>}<th scope="col">{say("insp.now_column")}</th><th scope="col"><span class="unseen">{say("insp.change")}</span></th></tr></thead>
            {GROUPS.map((group) => {
              const rows = shown.filter(({ signal }) => groupOf(signal) === group);
              return rows.length > 0 && (
                <tbody key={group}>
                  <tr class="group"><th colSpan={both ? 4 : 3} scope="rowgroup">{say(`insp.group_${group}`)}</th></tr>
                  {rows.map((each) => <Metric key={each.id} bench={bench} figure={each} both={both} {...values(each)} />)}
                </tbody>
              );
            })}
          </table>
        </div>
      )}
      {!all.length && <p class="quiet">{say("insp.no_metrics")}</p>}
      {picking && <Picker bench={bench} session={session} all={all} close={() => pick(false)} />}
      <div class="row-acts last">
        <button type="button" class="quietly" aria-expanded={picking} onClick={() => pick(!picking)}><Icon name="plus" size={16} />{say("insp.number")}</button>
        <Act act={() => (bench.dock.value = "compare")}>{say("insp.compare")}</Act>
        <Act act={() => (bench.dock.value = "optimise")}>{say("insp.optimise")}</Act>
      </div>
    </>
  );
}

function Metric({ bench, figure, both, now, before }: { bench: Bench; figure: Figure; both: boolean; now: number; before: number }) {
  const size = Math.abs(before) || Math.abs(now), unit = unitFor(figure.quantity, size), angle = unit.symbol === "°", share = ((now - before) / Math.abs(before)) * 100;
  const plain = (value: number) => digits(Math.abs(value) < 1e-9 * size ? 0 : value / unit.factor, 4) + (angle ? "°" : ""), limit = limitOf(bench, figure), met = limit && now >= limit.least - 1e-9;
  return (
    <tr data-figure={figure.id}>
      <th scope="row" title={figure.name[bench.page.language.value]}>{kindOf(figure.signal) === "m" && figure.kind === "least" ? <Sentence text={bench.say("metric.least_m", { mu: "{0}" })} names={["μ"]} /> : named(bench, figure)}<small><Owner of={ownerOf(figure.signal)} /></small></th>
      {both && <td class="was">{plain(before)}</td>}
      <td class="is">{plain(now)}{!angle && unit.symbol && <em>{unit.symbol}</em>}</td>
      <td class={limit ? (met ? "ok" : "bad") : "chg"} title={limit ? bench.say(met ? "insp.met" : "insp.missed", { limit: limit.text }) : ""}>
        {limit ? `${met ? "≥" : "<"} ${limit.text}` : both && Math.abs(share) > WORTH ? percent(share) : ""}
      </td>
    </tr>
  );
}

/** What a metric is of: points in italics, links as they are called. */
function Owner({ of }: { of: string }) {
  const [first, link] = of.split("|");
  if (!of || of === "driver") return null;
  if (link) return <><Sym name={first} />, {link}</>;
  return <>{first.split("+").join(", ")}</>;
}

function percent(share: number): string {
  return Math.abs(share) >= 1000 ? `× ${digits(1 + share / 100, 3)}` : `${share > 0 ? "+" : ""}${digits(share, 2)} %`;
}


// Which metrics are shown, and new ones chosen by words: what, of what, as which number.
import { useState } from "preact/hooks";
import type { Figure } from "../../data";
import type { Session } from "../../session";
import type { Bench } from "../bench";
import { Choice } from "./fields";
import { choice, choose, figure, kindIn, kindOf, named, ownerOf, ways } from "./metrics";

export function Picker({ bench, session, all, close }: { bench: Bench; session: Session; all: Figure[]; close: () => void }) {
  const { say } = bench, { signals } = session.data, kinds = [...new Set(signals.map(({ id }) => kindOf(id)))], { hidden, added } = choice.value;
  const [kind, setKind] = useState(kinds[0] ?? ""), [owner, setOwner] = useState(""), [as, setAs] = useState<Figure["kind"]>("largest");
  const of = signals.filter(({ id }) => kindOf(id) === kind), chosen = of.find(({ id }) => id === owner) ?? of[0], usual = chosen ? ways(chosen) : [];
  const way = usual.includes(as) ? as : usual[0], toggle = (id: string, on: boolean) => choose({ hidden: on ? hidden.filter((each) => each !== id) : [...hidden, id] });
  const add = () => {
    if (!chosen || !way) return;
    const { id } = figure(way, chosen);
    choose({ added: added.includes(id) ? added : [...added, id], hidden: hidden.filter((each) => each !== id) });
  };
  const inWords = (id: string) => ownerOf(id).replace("|", ` ${say("insp.on_link")} `).replaceAll("+", ", ") || "–";
  return (
    <section
      class="box picker" aria-label={say("insp.number")}
      onKeyDown={(event) => {
        if (event.key !== "Escape") return;
        event.stopPropagation();
        close();
      }}
    >
      <div class="form tight">
        <Choice label={say("insp.what")} value={kind} options={kinds.map((each) => [each, say(`metric.of_${kindIn(each, signals.find(({ id }) => kindOf(id) === each)!.kind)}`)])} set={setKind} />
        <Choice label={say("insp.of_what")} value={chosen?.id ?? ""} options={of.map(({ id }) => [id, inWords(id)])} set={setOwner} />
        <Choice label={say("insp.as")} value={way ?? ""} options={usual.map((each) => [each, say(`metric.way_${each}`)])} set={(to) => setAs(to as Figure["kind"])} />
      </div>
      <button type="button" class="quietly" onClick={add}>{say("insp.add_number")}</button>
      <fieldset>
        <legend>{say("insp.shown")}</legend>
        {all.map((each) => (
          <label key={each.id}><input type="checkbox" checked={!hidden.includes(each.id)} onChange={(event) => toggle(each.id, event.currentTarget.checked)} />{named(bench, each)}<small>{inWords(each.signal)}</small></label>
        ))}
      </fieldset>
    </section>
  );
}

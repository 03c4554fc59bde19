// Which metrics are shown, and new ones chosen by words: what, of what, as which number.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Figure } from "../../data";
import type { Session } from "../../session";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { Choice } from "./fields";
import { choice, choose, kindIn, kindOf, ownerOf, type Row, ways } from "./metrics";

export function Picker({ bench, session, all, close }: { bench: Bench; session: Session; all: Row[]; close: () => void }) {
  const { say } = bench, { signals } = session.data, kinds = [...new Set(signals.map(({ id }) => kindOf(id)))], { shown, added } = choice.value;
  const [kind, setKind] = useState(kinds[0] ?? ""), [owner, setOwner] = useState(""), [as, setAs] = useState<Figure["kind"]>("largest");
  const of = signals.filter(({ id }) => kindOf(id) === kind), chosen = of.find(({ id }) => id === owner) ?? of[0], usual = chosen ? ways(chosen) : [];
  const way = usual.includes(as) ? as : usual[0], inWords = (id: string) => id.replace("|", ` ${say("insp.on_link")} `).replaceAll("+", ", ") || "–";
  const box = useRef<HTMLElement>(null);
  useLayoutEffect(() => box.current!.scrollIntoView({ block: "nearest" }), []);
  const add = () => {
    const id = `${way}:${chosen.id}`;
    choose({ added: added.includes(id) ? added : [...added, id], shown: { ...shown, [id]: true } });
  };
  return (
    <section
      ref={box} class="box metric-picker" aria-label={say("insp.number")}
      onKeyDown={(event) => {
        if (event.key !== "Escape") return;
        event.stopPropagation();
        close();
      }}
    >
      <div class="form tight">
        <Choice label={say("insp.what")} value={kind} options={kinds.map((each) => [each, say(`metric.of_${kindIn(each, signals.find(({ id }) => kindOf(id) === each)!.kind)}`)])} set={setKind} />
        <Choice label={say("insp.of_what")} value={chosen?.id ?? ""} options={of.map(({ id }) => [id, inWords(ownerOf(id))])} set={setOwner} />
        <Choice label={say("insp.as")} value={way ?? ""} options={usual.map((each) => [each, say(`metric.way_${each}`)])} set={(to) => setAs(to as Figure["kind"])} />
      </div>
      <button type="button" class="quietly" disabled={!chosen || !way} onClick={add}>{say("insp.add_number")}</button>
      <fieldset>
        <legend>{say("insp.shown")}</legend>
        {all.map(({ key, label, of: subject, usual: own }) => (
          <div key={key}>
            <label><input type="checkbox" checked={shown[key] ?? own} onChange={(event) => choose({ shown: { ...shown, [key]: event.currentTarget.checked } })} />{label}<small>{inWords(subject)}</small></label>
            {added.includes(key) && <button type="button" class="small" aria-label={say("insp.delete", { name: label })} onClick={() => choose({ added: added.filter((each) => each !== key) })}><Icon name="close" size={13} /></button>}
          </div>
        ))}
      </fieldset>
    </section>
  );
}

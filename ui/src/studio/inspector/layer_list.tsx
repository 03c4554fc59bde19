// The layers of the machine from the frame up, seen from the side; what keeps it from having any.
import { useEffect, useState } from "preact/hooks";
import type { Bench } from "../bench";
import { useRoom } from "../room";
import { PlaceLink } from "../sheet/room-line";
import { Chips, Section } from "./fields";

export function Layers({ bench }: { bench: Bench }) {
  if (!bench.session.value) return null;
  return <Section bench={bench} id="insp.layers" title={bench.say("insp.layers")}>{() => <List bench={bench} />}</Section>;
}

function List({ bench }: { bench: Bench }) {
  const { say } = bench, room = useRoom(bench), links = bench.desk.solved.value.picture?.links ?? {};
  if (!room || !(room.layered || room.sentence)) return <p class="quiet" role="status">{say("insp.arranging")}</p>;
  const { layers, conflicts, remedies, sentence, gap } = room, shown = gap ? [gap] : conflicts;
  const pick = (name: string) => name in links && bench.select({ kind: "link", name });
  return (
    <div class="layers">
      {layers.length > 0 && <Side bench={bench} key={bench.page.language.value} />}
      {layers.length > 0 && (
        <div class="form">
          {layers.map(({ number, plates }) =>
            plates.length ? <Chips key={number} label={say("insp.layer_number", { number: String(number) })} names={plates} symbols={false} pick={pick} />
              : <div key={number} class="field"><span class="label">{say("insp.layer_number", { number: String(number) })}</span><div class="in"><span class="quiet">{say("insp.layer_bare")}</span></div></div>)}
        </div>
      )}
      {sentence && <p class="quiet">{sentence}</p>}
      {shown.length > 0 && <ul class={conflicts.length ? "said bad" : "said"}>{shown.map((each) => <li key={each.sentence}><PlaceLink bench={bench} of={each} /></li>)}</ul>}
      {remedies.map((each) => <p key={each}>{each}</p>)}
    </div>
  );
}

/** The section through the pins, on white paper in any theme. */
function Side({ bench }: { bench: Bench }) {
  const [svg, setSvg] = useState(""), room = bench.room.value, { text } = bench.desk.solved.value;
  useEffect(() => {
    let gone = false;
    const show = (found: { svg: string } | null) => !gone && found && setSvg(found.svg);
    void bench.desk.ask<{ svg: string }>("side_view", { text }).then(show);
    return () => void (gone = true);
  }, [room?.layers]);
  if (!svg) return null;
  return <img class="side" alt={bench.say("insp.side_view")} src={`data:image/svg+xml,${encodeURIComponent(svg)}`} />;
}

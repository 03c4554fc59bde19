// The smallest gap of the parts, or what keeps them from having layers, in a line at the foot of the sheet.
import type { Bench } from "../bench";
import type { Placed } from "../room";
import "./outlines.css";

export function RoomLine({ bench }: { bench: Bench }) {
  const room = bench.room.value;
  if (!room || !bench.session.value || !bench.shows("outlines")) return null;
  const { sentence, conflicts, gap, layered } = room;
  if (sentence || (layered && !conflicts.length && !gap)) return <p class="room-line">{sentence || bench.say("sheet.room_free")}</p>;
  const all: Placed[] = conflicts.length ? conflicts : gap ? [gap] : [];
  if (!all.length) return null;
  return (
    <p class={conflicts.length ? "room-line conflicts" : "room-line"} role="status">
      {all.map((each) => <PlaceLink key={each.sentence} bench={bench} of={each} />)}
    </p>
  );
}

/** A sentence that leads to the position that it is about. */
export function PlaceLink({ bench, of: { sentence, share } }: { bench: Bench; of: Placed }) {
  if (share === null) return <span>{sentence}</span>;
  return (
    <button type="button" class="text" data-tip={bench.say("sheet.room_go")} onClick={() => go(bench, share)}>
      {sentence}
    </button>
  );
}

/** Shows a share of the cycle, at rest. */
function go({ page, session }: Bench, share: number): void {
  page.play(false);
  page.phase.value = session.value?.data.positions.closed ? share - Math.floor(share) : Math.min(1, Math.max(0, share));
}

// The callout at a gap: what is missing, in numbers, and what would mend it. Pointing at a remedy shows it on the sheet.
import { signal, useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { Vec } from "../../shapes";
import { tenth } from "../../strokes";
import { Icon } from "../frame/icons";
import type { Gap, Remedy } from "../outline";
import type { Overlay } from "../tools/tool";
import "./gap.css";
import { drawGap, drawRemedy, namedEnd, placed, spotOf } from "./gap";
import type { Board } from "./sheet";

/** The gap that has been put aside, by its words. */
const aside = signal("");
const told = (gap: Gap) => `${gap.title} ${gap.sentence}`;

export function GapCallout({ board }: { board: Board }) {
  const { bench } = board, gap = bench.gap.value, playing = bench.page.playing.value;
  if (!gap || playing) return null;
  return <Shown key={told(gap)} board={board} gap={gap} />;
}

function Shown({ board, gap }: { board: Board; gap: Gap }) {
  const { bench } = board, box = useRef<HTMLElement>(null), foreseen = useSignal<Remedy | null>(null), shut = aside.value === told(gap);
  useLayoutEffect(() => {
    const draw = (over: Overlay) => {
      const { picture } = bench.desk.solved.value, reach = (link: string) => bench.say("sheet.gap_reach", { link });
      const words = { reach, unit: bench.settings.value.unit, reaches: bench.shows("reach"), named: picture ? namedEnd(gap, picture) : null };
      if (!moved(board, gap)) drawGap(over, gap, board.camera, words);
      if (foreseen.value && picture) drawRemedy(over, foreseen.value, picture.links, picture.fixed, board.camera);
      if (box.current) lead(over, board, gap, box.current);
    };
    board.layers.add(draw);
    board.redraw();
    return () => {
      board.layers.delete(draw);
      board.redraw();
    };
  }, [gap]);
  useLayoutEffect(() => board.redraw(), [foreseen.value, shut]);
  if (shut) return null;
  const act = async ({ actions }: Remedy) => {
    foreseen.value = null;
    await board.act(actions);
  };
  return (
    <section class="gap-callout" ref={box} aria-label={gap.title}>
      <h2><Icon name="alert" size={18} /><span>{named(gap.title, gap.point)}</span></h2>
      <button type="button" class="square aside" aria-label={bench.say("sheet.gap_aside")} title={bench.say("sheet.gap_aside")} onClick={() => (aside.value = told(gap))}><Icon name="close" size={16} /></button>
      <p>{gap.sentence}</p>
      {gap.remedies.length > 0 && (
        <ul>
          {gap.remedies.map((remedy) => (
            <li key={remedy.title}>
              <button
                type="button" onClick={() => void act(remedy)}
                onPointerEnter={() => (foreseen.value = remedy)} onPointerLeave={() => (foreseen.value = null)}
                onFocus={() => (foreseen.value = remedy)} onBlur={() => (foreseen.value = null)}
              >
                <b>{remedy.title}</b><span>{remedy.change}</span><small>{remedy.note}</small>
              </button>
            </li>
          ))}
        </ul>
      )}
    </section>
  );
}

/** A name in a sentence, in the hand of names. */
function named(text: string, name: string) {
  const [before, ...after] = name ? text.split(` ${name} `) : [text];
  return after.length ? <>{before} <i>{name}</i> {after.join(` ${name} `)}</> : text;
}

/** Places along a link, px, that a callout should not cover. */
const along = (corners: Vec[]): Vec[] =>
  corners.flatMap((a, k) => (k ? [0.25, 0.5, 0.75, 1].map((share): Vec => [0, 1].map((axis) => corners[k - 1][axis] + share * (a[axis] - corners[k - 1][axis])) as Vec) : [a]));

/** Whether the machine is shown elsewhere than where it comes apart. */
const moved = (board: Board, gap: Gap) => gap.drawn && !board.broken;

/** Puts the callout off the gap, and draws the line that leads there. */
function lead(over: Overlay, board: Board, gap: Gap, { style, offsetWidth, offsetHeight }: HTMLElement): void {
  const { camera, scene } = board, spot = moved(board, gap) ? null : spotOf(gap, camera);
  const bars = Object.keys(scene.links).map((link) => scene.corners(link).map((each) => camera.screen(each)));
  const later = gap.remedies.flatMap(({ places }) => Object.values(places).map((each) => camera.screen(each)));
  const drawing = [...bars.flatMap(along), ...later, ...(spot ? [spot] : [])];
  // On a phone the signs of the sheet are at its right edge.
  const [x, y] = board.bench.layout.value === "phone" ? [8, 8] : placed([offsetWidth, offsetHeight], spot, drawing, camera.size);
  style.left = `${Math.round(x)}px`;
  style.top = `${Math.round(y)}px`;
  if (!spot || !gap.ends || !gap.drawn || board.bench.layout.value === "phone") return;
  const right = x > spot[0], edge = right ? x : x + offsetWidth, side = Math.min(y + offsetHeight - 24, y + 88);
  if ((right ? edge - spot[0] : spot[0] - edge) > 16) over.path(`M${tenth(spot[0])} ${tenth(spot[1] + (side < spot[1] ? -48 : 48))}V${tenth(side)}H${tenth(edge)}`, "bad leader");
}

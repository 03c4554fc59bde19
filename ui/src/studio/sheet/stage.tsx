// The sheet in the middle of the window, and what floats over it: hint, refusals, values in hand.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Bench } from "../bench";
import { First } from "./first";
import { GapCallout } from "./gap-callout";
import { Hand } from "./hand";
import { Keys } from "./keys";
import { Layers } from "./layers";
import "./loads.css";
import { Pointers } from "./pointer";
import { RoomLine } from "./room-line";
import { Board } from "./sheet";
import { Scales, ShowBar } from "./show";

/** A refusal goes after this time, ms. */
const LONG = 6000;

export function Stage({ bench }: { bench: Bench }) {
  const stage = useRef<HTMLElement>(null), host = useRef<HTMLDivElement>(null), [board, setBoard] = useState<Board | null>(null);
  const [layers, setLayers] = useState<Layers | null>(null);
  useLayoutEffect(() => {
    const made = new Board(bench, host.current!), hand = new Hand(made, stage.current!), keys = new Keys(made, hand, new Pointers(made));
    made.drawn = () => hand.draw();
    const laid = new Layers(made);
    bench.sheet.value = bench.view = made;
    bench.reveal = (items) => made.reveal(items);
    setBoard(made);
    setLayers(laid);
    return () => {
      bench.sheet.value = bench.view = null;
      keys.end();
      hand.end();
      laid.end();
      made.end();
    };
  }, []);
  return (
    <main class="stage" ref={stage} data-tool={bench.tool.value}>
      <div class="paper" ref={host} tabIndex={0} role="application" aria-label={bench.say("sheet.label")} aria-describedby="sheet-keys" />
      <p class="unseen" id="sheet-keys">{bench.say("sheet.keys")}</p>
      <div class="sheet-foot">
        <RoomLine bench={bench} />
        {board && layers && <Scales board={board} layers={layers} />}
        <ShowBar bench={bench} />
      </div>
      {board && <First board={board} />}
      {board && <Hint board={board} />}
      {board && <GapCallout board={board} />}
      {board && <Refusal board={board} />}
      {board && <p class="unseen" aria-live="polite">{board.said.value}</p>}
    </main>
  );
}

/** The next step in a sentence; keys stand in brackets in it. */
function Hint({ board }: { board: Board }) {
  const { bench, hint } = board, parts = hint.value.split(/(?<=[.。；;])\s*/), plain = parts.filter((part) => !part.includes("["));
  if (!hint.value) return null;
  // On a phone there are no keys.
  const text = bench.layout.value === "phone" && plain.length ? plain.join(" ") : hint.value;
  return <p class="hint">{text.split(/(\[[^\]]+\])/).map((part, k) => (part.startsWith("[") ? <kbd key={k}>{part.slice(1, -1)}</kbd> : part))}</p>;
}

/** Why a click was refused, at the cursor. */
function Refusal({ board }: { board: Board }) {
  const { bench, camera } = board, refusal = bench.refusal.value, bubble = useRef<HTMLParagraphElement>(null);
  useLayoutEffect(() => {
    if (!refusal || !bubble.current) return;
    const [x, y] = camera.screen(refusal.at), [w, h] = camera.size, { offsetWidth: wide, offsetHeight: tall, style } = bubble.current;
    style.left = `${Math.max(8, Math.min(x - wide / 2, w - wide - 8))}px`;
    style.top = `${y + 24 + tall < h ? y + 24 : Math.max(8, y - 24 - tall)}px`;
    const timer = setTimeout(() => (bench.refusal.value = null), LONG);
    return () => clearTimeout(timer);
  }, [refusal]);
  return <div role="alert" class="refusals">{refusal && <p class="refusal" ref={bubble}>{refusal.sentence}</p>}</div>;
}

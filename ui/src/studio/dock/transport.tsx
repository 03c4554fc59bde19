// The time line: play from the drawn position, the input's value, a track to scrub, how the input goes, how fast.
import { effect } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Action } from "../picture";
import type { Session } from "../../session";
import { put } from "../../strokes";
import { digits, quantity } from "../../words";
import type { Bench } from "../bench";
import type { Gap } from "../outline";
import { Icon } from "../frame/icons";
import { axisOf, shown, tick } from "./axis";
import { limits, outside, pace, phaseOf, phases, type Stretch, ticks, typed } from "./timeline";

const SPEEDS = [0.01, 0.05, 0.1, 0.25, 0.5, 1, 2];
// Seconds of a cycle that the eye can follow: the speed that a machine begins with; rest before solving is shown, ms.
const LOOKED = 1.2, PATIENCE = 300, HALF = Math.PI, DEGREE = Math.PI / 180;
const KEYS: Record<string, number> = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 };

export function TimeLine({ bench }: { bench: Bench }) {
  const session = bench.session.value, gap = bench.gap.value, moves = session && session.data.positions.count > 1;
  return (
    <div class={moves || gap ? "timeline" : "timeline idle"}>
      {moves ? <Transport key={session} bench={bench} session={session} /> : gap ? <Stuck bench={bench} /> : <Idle bench={bench} session={session} />}
      <Busy bench={bench} />
    </div>
  );
}

/** Whether the present text is being solved. */
const waiting = ({ desk }: Bench) => desk.text.value !== "" && desk.solved.value.text !== desk.text.value && !desk.gone.value;

/** A thin bar while the text is being solved for longer than a moment. */
function Busy({ bench }: { bench: Bench }) {
  const [busy, setBusy] = useState(false), waits = waiting(bench);
  useEffect(() => {
    if (!waits) return setBusy(false);
    const timer = setTimeout(() => setBusy(true), PATIENCE);
    return () => clearTimeout(timer);
  }, [waits]);
  return busy ? <div class="busy-bar" role="progressbar" aria-label={bench.say("dock.solving")} /> : null;
}

/** What is missing until the machine moves. */
function Idle({ bench, session }: { bench: Bench; session: Session | null }) {
  const { desk } = bench, { picture, outline, sentence, findings } = desk.solved.value;
  const driven = picture?.driver || outline?.entries.driver || outline?.entries.drivers;
  const [before, after] = bench.say("dock.undriven", { tool: "\n" }).split("\n");
  const wrong = findings.find(({ severity }) => severity === "error")?.sentence ?? sentence;
  return (
    <>
      <button class="play" disabled aria-label={bench.page.say("play")}><Icon name="play" /></button>
      {session ? <span>{bench.page.say("static")}</span> : !outline && waiting(bench) ? <span>{bench.say("dock.solving")} …</span> : driven ? <span class="why">{wrong}</span> : (
        <span class="undriven">
          {before}
          <button class="word" onClick={() => (bench.tool.value = "drive")}><Icon name="drive" /><b>{bench.say("dock.drive")}</b><kbd>D</kbd></button>
          {after}
        </span>
      )}
    </>
  );
}

function rocks(bench: Bench): boolean {
  const { outline } = bench.desk.solved.value, cycle = outline?.entries.cycle;
  return cycle === undefined ? /^cycle: *["']?rock\b/m.test(bench.desk.text.value) : cycle === "rock";
}

/** Whether the input turns through or rocks between its limits. */
function Cycle({ bench }: { bench: Bench }) {
  const rock = rocks(bench);
  const choose = (wanted: boolean) => {
    if (wanted === rock) return;
    // A remedy also draws the machine where it can be, on the side where it is drawn.
    const rocking = bench.gap.value?.remedies.find(({ actions }) => (actions[0] as Action | undefined)?.path?.toString() === "cycle")?.actions;
    void bench.desk.act(wanted ? (rocking ?? [{ do: "set", path: ["cycle"], value: "rock" }]) : [{ do: "unset", path: ["cycle"] }]);
  };
  return (
    <div class="segment" role="group" aria-label={bench.say("dock.cycle")}>
      <button aria-pressed={!rock} data-tip={bench.say("dock.turn_help")} onClick={() => choose(false)}><Icon name="turn" size={16} />{bench.say("dock.turn")}</button>
      <button aria-pressed={rock} data-tip={bench.say("dock.rock_help")} onClick={() => choose(true)}><Icon name="rock" size={16} />{bench.say("dock.rock")}</button>
    </div>
  );
}

function Speed({ bench, session }: { bench: Bench; session: Session }) {
  const { page } = bench, { rpm, seconds } = pace(session.data);
  const own = bench.layout.value === "phone" ? "" : rpm !== null ? bench.say("dock.rpm", { value: digits(rpm, 4) }) : seconds !== null ? quantity(seconds, "time", 1, 2) : "";
  const said = (each: number) => (own ? bench.say("dock.speed_of", { speed: `${each}×`, own }) : `${each}×`);
  return (
    <>
      <button class="square" aria-pressed={page.loop.value} aria-label={bench.say("dock.loop")} data-tip={bench.say("dock.loop")} onClick={() => (page.loop.value = !page.loop.value)}><Icon name="loop" /></button>
      <label class="speed">
        <select aria-label={page.say("speed")} value={page.pace.value} onChange={(event) => (page.pace.value = Number(event.currentTarget.value))}>
          {SPEEDS.map((each) => <option key={each} value={each}>{said(each)}</option>)}
        </select>
        <Icon name="chevron" size={14} />
      </label>
    </>
  );
}

/** The speed at which a machine begins: its own one, or slower so that the eye can follow. */
export function beginning(session: Session): number {
  const { seconds } = pace(session.data);
  return seconds === null ? 1 : (SPEEDS.findLast((each) => each <= 1 && seconds / each >= LOOKED) ?? SPEEDS[0]);
}

const at = (share: number) => ({ left: `${(100 * share).toFixed(3)}%` });
const over = ({ from, to }: Stretch) => ({ left: `${(100 * from).toFixed(3)}%`, width: `${(100 * (to - from)).toFixed(3)}%` });

/** The track with what stands on it; `children`: what moves. */
function Track({ labels, pieces, marks, children, ...rest }: {
  labels: { share: number; text: string }[];
  pieces: (Stretch & { style: string; name?: string })[];
  marks: { share: number; text: string }[];
  children?: ComponentChildren;
  [name: string]: unknown;
}) {
  return (
    <div class="scrub" {...rest}>
      <div class="track">{pieces.map((each, k) => <div key={k} class={each.style} style={over(each)} />)}</div>
      {pieces.map((each, k) => each.name && each.to - each.from > 0.06 && <u key={k} class="zone" style={at((each.from + each.to) / 2)}>{each.name}</u>)}
      {marks.map(({ share, text }, k) => <i key={k} class={`limit${share < 0.06 ? " at-start" : share > 0.94 ? " at-end" : ""}`} style={at(share)}><u>{text}</u></i>)}
      <div class="ticks">{labels.map(({ share, text }, k) => <i key={k} style={at(share)}>{text}</i>)}</div>
      {children}
    </div>
  );
}

function Transport({ bench, session }: { bench: Bench; session: Session }) {
  const { page } = bench, { data } = session, run = data.positions.run === true;
  void [session.calm.value, page.language.value];
  const [axis] = useState(() => axisOf(session)), { values, turns } = axis, stuck = bench.gap.value?.possible.length ? bench.gap.value : null, range = stuck && rangeOf(stuck);
  const thumb = useRef<HTMLDivElement>(null), field = useRef<HTMLInputElement>(null), name = data.positions.inputs[0]?.name ?? "";
  useLayoutEffect(() => effect(() => {
    const i = page.index(session), share = page.phase.value, text = axis.shown(values[i]);
    // Moved by its way, which is as wide as the track: nothing is laid out anew.
    thumb.current!.style.transform = `translateX(${(100 * (range ? range.share(values[i]) : share)).toFixed(3)}%)`;
    const slider = thumb.current!.parentElement!;
    put(slider, "aria-valuenow", share.toFixed(4));
    put(slider, "aria-valuetext", text);
    if (field.current !== document.activeElement && field.current!.value !== text) field.current!.value = text;
  }), []);
  const go = (share: number) => {
    page.play(false);
    page.phase.value = Math.min(data.positions.closed ? 1 - 1e-6 : 1, Math.max(0, share));
  };
  const drag = (event: PointerEvent) => {
    if (event.buttons !== 1) return;
    const host = event.currentTarget as HTMLElement, box = host.getBoundingClientRect();
    if (event.type === "pointerdown") {
      host.setPointerCapture(event.pointerId);
      host.focus();
    }
    const share = (event.clientX - box.left) / box.width, phase = range ? phaseNear(values, range.low + share * (range.high - range.low), turns, page.phase.value) : share;
    go(phase);
  };
  const key = (event: KeyboardEvent) => {
    if (event.key === " ") {
      event.preventDefault();
      event.stopPropagation();
      return page.play(!page.playing.value);
    }
    const step = KEYS[event.key], count = data.positions.closed ? data.positions.count : data.positions.count - 1;
    const to = step ? (page.index(session) + step * (event.shiftKey ? 10 : 1)) / count : event.key === "Home" ? 0 : event.key === "End" ? 1 : null;
    if (to === null) return;
    event.preventDefault();
    event.stopPropagation();
    go(data.positions.closed && step ? to - Math.floor(to) : to);
  };
  const type = () => {
    const value = axis.typed(field.current!.value), phase = value === null ? null : phaseOf(values, value, turns, page.phase.value);
    if (phase === null) {
      page.note.value = bench.say(value === null ? axis.says.wrong : axis.says.never, { text: field.current!.value });
      field.current!.value = axis.shown(values[page.index(session)]);
    } else go(phase);
  };
  const acts = run ? [] : phases(session).flatMap(({ load, stretches }) => stretches.map(({ from, to }) => ({ from, to, style: "acts", name: bench.say("dock.acts", { name: load }) })));
  const ends = run ? [] : limits(session).map(({ share, name: output, max }) => ({ share, text: bench.say(max ? "dock.max" : "dock.min", { name: output }) }));
  const shownOn = stuck && range ? partsOf(bench, stuck, range) : { labels: axis.labels, pieces: acts, marks: ends };
  const playing = page.playing.value, label = bench.say(axis.says.label, { name });
  return (
    <>
      <button class="play" aria-label={page.say(playing ? "pause" : "play")} data-tip={page.say(playing ? "pause" : "play")} data-keys="Space" onClick={() => page.play(!playing)}><Icon name={playing ? "pause" : "play"} /></button>
      <span class="at-box"><input
        ref={field} class="at" spellcheck={false} autocomplete="off" aria-label={label} data-tip={label}
        onFocus={(event) => { page.play(false); event.currentTarget.select(); }} onChange={type}
        onKeyDown={(event) => {
          if (event.key === "Enter") event.currentTarget.blur();
          if (event.key === "Escape") {
            event.currentTarget.value = axis.shown(values[page.index(session)]);
            event.currentTarget.blur();
          }
          event.stopPropagation();
        }}
      /></span>
      <Track
        role="slider" tabIndex={0} aria-label={page.say("position")} aria-valuemin={0} aria-valuemax={1} aria-valuenow={0}
        onPointerDown={drag} onPointerMove={drag} onKeyDown={key}
        {...shownOn}
      >
        <div class="thumb-way" ref={thumb}><div class="thumb" /></div>
      </Track>
      {!run && <Cycle bench={bench} />}
      <Speed bench={bench} session={session} />
    </>
  );
}

/** What the track of a machine that cannot be everywhere runs over. */
interface Range {
  low: number;
  high: number;
  turns: boolean;
  possible: [number, number][];
  share: (x: number) => number;
}

function rangeOf(gap: Gap): Range {
  const turns = gap.unit === "deg", factor = turns ? DEGREE : 1e-3, possible = gap.possible.map(([a, b]): [number, number] => [a * factor, b * factor]), ends = possible.flat();
  const most = Math.max(...ends, -Infinity), least = Math.min(...ends, Infinity), wide = ends.length ? most - least : 0, middle = ends.length ? (most + least) / 2 : 0;
  const [low, high] = turns ? (ends.some((x) => Math.abs(x) > HALF) ? [0, 2 * HALF] : [-HALF, HALF]) : [middle - (wide || 0.1), middle + (wide || 0.1)];
  const lap = (x: number) => (turns ? x - 2 * HALF * Math.floor((x - low) / (2 * HALF)) : x);
  return { low, high, turns, possible, share: (x) => Math.min(1, Math.max(0, (lap(x) - low) / (high - low))) };
}

/** Where the machine can be, and where not. */
function partsOf(bench: Bench, gap: Gap, { low, high, turns, possible }: Range) {
  const size = Math.max(Math.abs(low), Math.abs(high)), share = (x: number) => (x - low) / (high - low), factor = turns ? DEGREE : 1e-3;
  const able = possible.map(([a, b]) => ({ from: Math.max(0, share(a)), to: Math.min(1, share(b)), style: "able", name: bench.say("dock.possible") }));
  const barred = outside(possible, low, high).map(({ from, to }) => ({ from, to, style: "barred" }));
  return {
    labels: ticks(low, high, turns).map((each) => ({ share: each.share, text: tick(each.value, turns, size) })), pieces: [...able, ...barred],
    marks: gap.possible.flat().map((x) => ({ share: share(x * factor), text: turns ? `${digits(x, 2)}°` : `${digits(x, 3)} mm` })).filter((each) => each.share > 0.001 && each.share < 0.999),
  };
}

/** The phase at which the input has a value, or the nearest one that it has. */
function phaseNear(values: Float64Array, value: number, turns: boolean, now: number): number {
  const found = phaseOf(values, value, turns, now);
  if (found !== null) return found;
  let best = 0;
  const off = (x: number) => (turns ? Math.abs(Math.atan2(Math.sin(x - value), Math.cos(x - value))) : Math.abs(x - value));
  values.forEach((x, i) => {
    if (off(x) < off(values[best])) best = i;
  });
  return best / (values.length - 1);
}

/** The time line of a machine that cannot be assembled where it is drawn: where it can be, and a way to move it there. */
function Stuck({ bench }: { bench: Bench }) {
  const { desk, page } = bench, gap = bench.gap.value!, range = rangeOf(gap), { turns, possible } = range, here = typed(gap.input, turns), size = Math.max(Math.abs(range.low), Math.abs(range.high));
  const rock = async () => {
    if (!rocks(bench)) await desk.act([{ do: "set", path: ["cycle"], value: "rock" }]);
    await desk.solve();
    if (bench.session.value) page.play(true);
  };
  return (
    <>
      <button class="play" disabled={!possible.length} aria-label={page.say("play")} data-tip={bench.say("dock.rock_help")} onClick={() => void rock()}><Icon name="play" /></button>
      <output class="at">{here === null ? "–" : shown(here, turns, size)}</output>
      <Track role="img" aria-label={bench.say("dock.possible_between", { ranges: gap.possible.map((each) => each.map((x) => `${digits(x, 3)}${turns ? "°" : " mm"}`).join(" … ")).join(", ") || "–" })} {...partsOf(bench, gap, range)}>
        {here !== null && <div class="thumb" style={at(range.share(here))} />}
      </Track>
      <Cycle bench={bench} />
    </>
  );
}

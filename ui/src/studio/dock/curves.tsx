// Curves over the input side by side: drawn by effects when the machine changes or moves, chosen by words, scrubbed by hand.
import { effect } from "@preact/signals";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { type Extreme, isForce, TURN } from "../../numbers";
import type { Session } from "../../session";
import { write } from "../../strokes";
import { digits, quantity as quantityText, unitFor } from "../../words";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { showMenu } from "../frame/menu";
import { chosenOf, remember } from "./chosen";
import { Picker } from "./picker";
import { Plot, valueAt } from "./plot";
import { Polar } from "./polar";
import { asWhat, colourOf, GOOD, largest, ofWhat, quantities, type Quantity, sentence, values, valuesBefore, whatOf, type Words, wordsOf } from "./quantities";
import { Name } from "./symbol";
import { CurveTable, download } from "./table";
import { ticksOf } from "./timeline";

/** Where the input is, as a number among the positions. */
export const placeOf = (phase: number, { data }: Session) => phase * (data.positions.closed ? data.positions.count : data.positions.count - 1);

/** A row between two positions. */
function between(row: ArrayLike<number>, place: number, turn: number): number {
  const i = Math.floor(place), share = place - i, a = valueAt(row, i, turn);
  return share < 1e-9 || i + 1 > row.length ? a : a + share * (valueAt(row, i + 1, turn) - a);
}

/** A value with as many decimals as its curve asks for, so that it does not jump about while it changes. */
function steady(value: number, kind: string, size: number): string {
  const { factor, symbol } = unitFor(kind, size), places = Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(size / factor || 1))));
  if (!Number.isFinite(value)) return "–";
  const text = (value / factor).toFixed(places), plain = Number(text) === 0 ? text.replace("-", "") : text;
  return plain.replace("-", "−") + (symbol === "°" || !symbol ? symbol : ` ${symbol}`);
}

/** About how wide values are at most. */
const roomFor = (all: number[], kind: string, size: number) => `${Math.max(...all.map((each) => steady(each, kind, size).length)) + 2}ch`;

/** Ticks of the axis that curves run over. */
function axisTicks({ model }: Session): { share: number; text: string }[] {
  const { x, kind } = model.axis;
  if (kind !== "time") return ticksOf(x, kind === "angle").map(({ share, value }) => ({ share, text: kind === "angle" ? `${digits((value * 180) / Math.PI, 4)}°` : quantityText(value, kind, model.size, 3) }));
  return [0, 0.5, 1].map((share) => ({ share, text: quantityText(x[0] + share * (x[x.length - 1] - x[0]), kind, 1, 3) }));
}

/** The row above the curves: another one, what the dashes are, table and file. */
export function CurvesHead({ bench, session }: { bench: Bench; session: Session }) {
  const button = useRef<HTMLButtonElement>(null), [picking, pick] = useState(false), chosen = chosenOf(bench, session), most = mostCurves(bench);
  void session.calm.value;
  const menu = (at: HTMLElement) => showMenu(bench.say("dock.curves"), at, [
    { label: bench.say("dock.as_curves"), icon: "curves", checked: !chosen.table, act: () => remember(bench, { table: false }) },
    { label: bench.say("dock.as_table"), icon: "table", checked: chosen.table, act: () => remember(bench, { table: true }) },
    null,
    { label: bench.say("dock.csv"), icon: "export", act: () => download(bench, session, shownOf(session, chosen.ids)) },
    { label: bench.say("dock.usual_curves"), icon: "undo", act: () => remember(bench, { ids: null }) },
  ]);
  return (
    <>
      <button
        ref={button} class="text add" aria-haspopup="dialog" aria-expanded={picking} disabled={chosen.ids.length >= most} data-tip={chosen.ids.length >= most ? bench.say("dock.most_curves", { most: String(most) }) : undefined}
        onClick={() => pick(!picking)}
      ><Icon name="plus" size={14} />{bench.say("dock.add_curve")}</button>
      {picking && <Picker bench={bench} session={session} words={wordsOf(bench)} anchor={button.current!} chosen={null} close={() => pick(false)} choose={(id) => remember(bench, { ids: [...chosen.ids.filter((each) => each !== id), id] })} />}
      <div class="legend">{session.model.differs && <><i />{bench.page.say("now")}<i class="was" />{bench.say("dock.before")}</>}</div>
      <button class="square" aria-label={bench.say("dock.curve_menu")} data-tip={bench.say("dock.curve_menu")} aria-haspopup="menu" onClick={(event) => menu(event.currentTarget)}><Icon name="more" /></button>
    </>
  );
}

export const mostCurves = (bench: Bench) => (bench.layout.value === "large" ? 6 : bench.layout.value === "phone" ? 6 : 4);

/** The quantities of chosen curves, as far as the machine has them. */
function shownOf(session: Session, ids: string[]): Quantity[] {
  const all = new Map(quantities(session).map((each) => [each.id, each]));
  return ids.flatMap((id) => all.get(id) ?? []);
}

export function Curves({ bench, session }: { bench: Bench; session: Session }) {
  const { ids, table } = chosenOf(bench, session), shown = shownOf(session, ids).slice(0, mostCurves(bench)), words = wordsOf(bench);
  if (!shown.length) return <p class="no-curves">{bench.say("dock.no_curves")}</p>;
  if (table) return <CurveTable bench={bench} session={session} shown={shown} />;
  return (
    <div class="plots">
      {shown.map((each) => <Figure key={each.id} bench={bench} session={session} quantity={each} words={words} ids={ids} />)}
    </div>
  );
}

function Figure({ bench, session, quantity, words, ids }: { bench: Bench; session: Session; quantity: Quantity; words: Words; ids: string[] }) {
  const button = useRef<HTMLButtonElement>(null), value = useRef<HTMLSpanElement>(null), [picking, pick] = useState(false), name = sentence(quantity, words), of = ofWhat(quantity, words);
  const part = quantity.as === "value" || quantity.as === "size" ? "" : asWhat(quantity, words);
  return (
    <figure class="plot" data-curve={quantity.id}>
      <figcaption>
        <button ref={button} class="pick" aria-label={bench.say("dock.change_curve", { name })} data-tip={name} aria-haspopup="dialog" aria-expanded={picking} onClick={() => pick(!picking)}>
          <b>{whatOf(quantity, words)}</b><Icon name="chevron" size={14} />
        </button>
        <span class="of">{of && <Name text={of} />}{part && ` ${part}`}</span>
        <output><span ref={value} /></output>
        <button class="away" aria-label={bench.page.say("forget", { name })} onClick={() => remember(bench, { ids: ids.filter((each) => each !== quantity.id) })}><Icon name="close" size={14} /></button>
      </figcaption>
      {picking && <Picker bench={bench} session={session} words={words} anchor={button.current!} chosen={quantity.id} close={() => pick(false)} choose={(id) => remember(bench, { ids: ids.flatMap((each) => (each === quantity.id ? id : each === id ? [] : each)) })} />}
      {quantity.as === "polar" ? <Vectors bench={bench} session={session} quantity={quantity} name={name} value={value} /> : <Curve bench={bench} session={session} quantity={quantity} name={name} value={value} />}
    </figure>
  );
}

/** Why forces are not shown of the machine as it is. */
function withoutForces({ page }: Bench, { model, data }: Session): string {
  return model.solver.locking ? page.say("locking") : model.solver.doubtful ? page.say("doubtful") : page.say("not_found_again", { names: data.held.join(", ") });
}

interface Drawn {
  bench: Bench;
  session: Session;
  quantity: Quantity;
  name: string;
  /** Where the value at the cursor is written. */
  value: { current: HTMLElement | null };
}

function Curve({ bench, session, quantity, name, value }: Drawn) {
  const host = useRef<HTMLDivElement>(null), hover = useRef<HTMLDivElement>(null), missing = useRef<HTMLParagraphElement>(null), plot = useRef<Plot | null>(null), { page } = bench, { model } = session;
  const turn = quantity.what === "angle" ? TURN : 0, colour = colourOf(quantity) as "accent", size = largest(session, quantity), { factor } = unitFor(quantity.kind, size);
  const row = useRef<Float64Array>(new Float64Array(1));
  useLayoutEffect(() => {
    const drawn = (plot.current = new Plot(host.current!)), ticks = axisTicks(session);
    let [seen, rested] = [-1, -1], peaks: Extreme[] = [], compared: unknown = null;
    const stop = effect(() => {
      const version = session.version.value, calm = session.calm.value, place = placeOf(page.phase.value, session), variants = session.variants.value;
      const changed = version !== seen || calm !== rested || variants !== compared;
      compared = variants;
      if (version !== seen) [seen, row.current, peaks] = [version, values(session, quantity), []];
      // Extremes between the positions are sought when a hand rests.
      if (calm !== rested) [rested, peaks] = [calm, quantity.signal && !row.current.some(Number.isNaN) ? ([1, -1] as const).map((sign) => model.extreme(quantity.signal, row.current, sign)) : []];
      if (changed) {
        const before = model.differs ? valuesBefore(session, quantity) : null;
        const kept = quantity.signal ? variants.map(({ design }) => design.rows[quantity.signal]) : [];
        drawn.set({ x: model.axis.x, now: row.current, before, kept, peaks, colour, factor, turn, limit: quantity.what === "transmission" ? GOOD : null, ticks });
        const [low, high] = [Math.min(...row.current), Math.max(...row.current)].map((x) => quantityText(x, quantity.kind, size));
        drawn.label(bench.say("dock.curve_label", { name, low, high }));
        // As wide as its longest value, so that another one changes no other place.
        value.current!.style.width = roomFor([Math.min(...row.current), Math.max(...row.current)], quantity.kind, size);
        write(missing.current!, isForce(quantity.id.split("~")[0]) && !model.forces ? withoutForces(bench, session) : "");
      }
      const now = between(row.current, place, turn);
      drawn.cursor(place, now);
      write(value.current!, steady(now, quantity.kind, size));
    });
    return () => {
      stop();
      drawn.end();
    };
  }, [name]);
  const scrub = (event: PointerEvent) => {
    if (event.type === "pointerdown" && event.button === 0) (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    const phase = plot.current!.phase(event.clientX), place = placeOf(phase, session);
    if (event.buttons === 1) {
      page.play(false);
      page.phase.value = session.data.positions.closed ? Math.min(phase, 1 - 1e-6) : phase;
    }
    const { x, kind } = model.axis, at = between(x, place, 0), lines = [
      `${kind === "angle" ? `${((at * 180) / Math.PI).toFixed(1)}°` : quantityText(at, kind, kind === "length" ? model.size : 1)}   ${quantityText(between(row.current, place, turn), quantity.kind, size)}`,
      ...(model.differs ? [`${bench.say("dock.before")} ${quantityText(between(valuesBefore(session, quantity), place, turn), quantity.kind, size)}`] : []),
    ];
    const box = host.current!.getBoundingClientRect(), said = hover.current!, left = event.clientX - box.left;
    said.hidden = false;
    write(said, lines.join("\n").replaceAll("-", "−"));
    said.style.transform = `translateX(${Math.max(2, Math.min(box.width - said.offsetWidth - 2, left > box.width / 2 ? left - said.offsetWidth - 10 : left + 10))}px)`;
  };
  return (
    <div class="chart-host" ref={host} onPointerDown={scrub} onPointerMove={scrub} onPointerLeave={() => (hover.current!.hidden = true)}>
      <p class="plot-missing" ref={missing} />
      <div class="plot-hover" hidden ref={hover} />
    </div>
  );
}

function Vectors({ bench, session, quantity, name, value }: Drawn) {
  const host = useRef<HTMLDivElement>(null), { page } = bench, size = largest(session, quantity);
  useLayoutEffect(() => {
    const drawn = new Polar(host.current!);
    let seen = -1, x: Float64Array = new Float64Array(), y: Float64Array = new Float64Array();
    const stop = effect(() => {
      const version = session.version.value, place = placeOf(page.phase.value, session);
      if (version !== seen) {
        [seen, x, y] = [version, values(session, quantity, 0), values(session, quantity, 1)];
        drawn.set(x, y, colourOf(quantity) as "accent", session.data.positions.closed);
        drawn.label(name);
        value.current!.style.width = roomFor([size], quantity.kind, size);
      }
      const [a, b] = [between(x, place, 0), between(y, place, 0)];
      drawn.cursor(a, b);
      write(value.current!, steady(Math.hypot(a, b), quantity.kind, size));
    });
    return () => {
      stop();
      drawn.end();
    };
  }, [name]);
  return <div class="chart-host" ref={host} />;
}

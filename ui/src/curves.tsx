// Curves over the input, and hodographs: drawn by effects when the machine changes or moves.
import { effect } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { Chart, type Curve, Hodograph } from "./chart";
import type { Page } from "./living";
import { type Extreme, TURN } from "./numbers";
import type { Session } from "./session";
import { write } from "./strokes";
import { quantity, unitFor } from "./words";

const MOST_CURVES = 8;

function Plot({ page, session, id, place }: { page: Page; session: Session; id: string; place: number }) {
  const host = useRef<HTMLDivElement>(null), value = useRef<HTMLOutputElement>(null), chart = useRef<Chart | null>(null);
  const { model } = session, language = page.language.value, signal = model.signals[id];
  useLayoutEffect(() => {
    const drawn = (chart.current = new Chart(host.current!));
    let [seen, rested, shown] = [-1, -1, ""], row: Float64Array = new Float64Array(1), peaks: Extreme[] = [], kept: unknown = null;
    const stop = effect(() => {
      const version = session.version.value, calm = session.calm.value, state = `${version} ${calm} ${page.language.value}`;
      const variants = session.variants.value, i = page.index(session);
      if (version !== seen) [seen, row, peaks] = [version, model.row(id), []];
      // Extremes between the positions are sought when a hand rests.
      if (calm !== rested) [rested, peaks] = [calm, row.some(Number.isNaN) ? [] : [model.extreme(id, row, 1), model.extreme(id, row, -1)]];
      if (state !== shown || variants !== kept) {
        plot(drawn, page, session, id, { style: "now", values: row, peaks });
        [shown, kept] = [state, variants];
      }
      drawn.cursor(i, row[i]);
    });
    const told = effect(() => {
      void [session.calm.value, page.language.value];
      write(value.current!, quantity(row[page.index(session)], signal.kind, largest(session, id)));
    });
    return () => {
      stop();
      told();
      drawn.end();
    };
  }, []);
  const scrub = (event: PointerEvent) => {
    if (event.buttons !== 1) return;
    page.play(false);
    page.phase.value = chart.current!.index(event.clientX) / model.n;
  };
  return (
    <figure class="plot">
      <figcaption>
        <select
          value={id} aria-label={page.say("curves")}
          onChange={(event) => (session.curves.value = session.curves.value.map((each, k) => (k === place ? event.currentTarget.value : each)))}
        >
          {session.data.signals.map((each) => <option value={each.id} key={each.id}>{each.name[language]}</option>)}
        </select>
        <output ref={value} />
        <button class="remove" aria-label={page.say("forget", { name: signal.name[language] })} onClick={() => (session.curves.value = session.curves.value.filter((_, k) => k !== place))}>×</button>
      </figcaption>
      <div ref={host} onPointerDown={scrub} onPointerMove={scrub} />
    </figure>
  );
}

/** Largest value of the original, by which the unit is chosen. */
function largest({ model }: Session, id: string): number {
  let most = 0;
  for (const x of model.original.rows[id]) if (Math.abs(x) > most) most = Math.abs(x);
  return most;
}

/** The present curve over those of the original and of the variants. */
function plot(chart: Chart, page: Page, session: Session, id: string, now: Curve): void {
  const { model } = session, { x, kind } = model.axis, signal = model.signals[id];
  const unit = unitFor(signal.kind, largest(session, id));
  const ends = [0, x.length - 1].map((k) => quantity(x[k], kind, kind === "length" ? model.size : 1, 3)) as [string, string];
  const kept = session.variants.value.map((each, k) => ({ style: k + 1, values: each.design.rows[id] }));
  const old: Curve[] = model.differs ? [{ style: "original", values: model.original.rows[id] }] : [];
  chart.set(x, [...old, ...kept, now], unit.factor, ends, signal.form === "angle" ? TURN : 0);
  chart.label(page.say("curve", { name: signal.name[page.language.value] }));
}

function HodographPlot({ page, session, point }: { page: Page; session: Session; point: string }) {
  const host = useRef<HTMLDivElement>(null), name = page.say("hodograph", { name: point });
  useLayoutEffect(() => {
    const drawn = new Hodograph(host.current!), { main } = session.model;
    const stop = effect(() => {
      void session.version.value;
      const [x, y] = ["x", "y"].map((axis) => main.row(`v:${point}.${axis}`)), i = page.index(session);
      drawn.set(page.say("hodograph", { name: point }), x, y, session.data.positions.closed);
      drawn.cursor(x[i], y[i]);
    });
    return () => {
      stop();
      drawn.svg.remove();
    };
  }, []);
  return <figure class="plot"><figcaption>{name}</figcaption><div ref={host} /></figure>;
}

export function Curves({ page, session }: { page: Page; session: Session }) {
  if (session.data.positions.count < 2) return null;
  const ids = session.curves.value;
  const spare = session.data.signals.find(({ id }) => !ids.includes(id));
  return (
    <section class="curves" aria-label={page.region(session, "curves")}>
      {ids.map((id, k) => <Plot key={`${k}:${id}`} page={page} session={session} id={id} place={k} />)}
      {session.hodograph.value && <HodographPlot key={session.hodograph.value} page={page} session={session} point={session.hodograph.value} />}
      {spare && ids.length < MOST_CURVES && (
        <button class="more" onClick={() => (session.curves.value = [...ids, spare.id])}>+ {page.say("curves")}</button>
      )}
    </section>
  );
}

// The sweep: one dimension over a range, its metrics as small charts, the paths as ghosts on the sheet.
import { signal } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Dimension, Figure } from "../../data";
import type { Session } from "../../session";
import { digits, quantity, unitFor } from "../../words";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { showMenu } from "../frame/menu";
import { rangeOf } from "../inspector/hand";
import { named, ownerOf } from "../inspector/metrics";
import { line } from "../../strokes";
import { lay } from "./foresee";
import { Plot } from "./plot";
import { GOOD } from "./quantities";
import { Select } from "./select";
import { Name } from "./symbol";
import { type Swept, sweep } from "./sweep";

/** How many of the machines are drawn. */
const DRAWN = 7;
/** Rest after a change before the sweep begins again, ms. */
const REST = 180, USUAL = 21, MOST = 201;
const steps = signal(USUAL), shown = signal<string[] | null>(null);
const COLOURS: [RegExp, "good" | "input" | "force" | "velocity" | "acceleration"][] = [[/^m:/, "good"], [/^effort:/, "input"], [/^(r:|shake)/, "force"], [/^(w|v|sv):/, "velocity"], [/^(g|a|sa):/, "acceleration"]];
/** The sorts of metrics that are shown first. */
const FIRST = [/^least:m:/, /^range:/, /^largest:effort:/, /^largest:r:/, /^ratio:/];

/** The metrics that are shown: chosen ones, else the most usual of each sort. */
function figuresOf({ data }: Session, most: number): Figure[] {
  const chosen = shown.value?.flatMap((id) => data.numbers.find((each) => each.id === id) ?? []);
  if (chosen?.length) return chosen.slice(0, most);
  const found = FIRST.flatMap((sort) => data.numbers.findLast(({ id }) => sort.test(id)) ?? []);
  return [...found, ...data.numbers.filter((each) => !found.includes(each))].slice(0, most);
}

export function Sweep({ bench, session }: { bench: Bench; session: Session }) {
  const { say } = bench, { dimensions } = session.data, hand = bench.inHand.value;
  void session.calm.value;
  const dimension = dimensions.find(({ address }) => address === hand?.address) ?? dimensions.find(({ geometry, positive }) => geometry && positive) ?? dimensions[0];
  const [found, setFound] = useState<Swept | null>(null), state = JSON.stringify(session.model.values), most = bench.layout.value === "large" ? 6 : 4;
  const range = dimension && (hand?.address === dimension.address ? hand : rangeOf(session, dimension));
  // The range stays while the value moves in it.
  useEffect(() => {
    if (dimension && range && hand?.address !== dimension.address) bench.inHand.value = { address: dimension.address, low: range.low, high: range.high };
  }, [dimension?.address]);
  useEffect(() => {
    if (!dimension || !range) return;
    let wanted = true;
    const timer = setTimeout(() => void sweep(session, dimension.address, range.low, range.high, steps.value, (now) => {
      setFound(now);
      session.view?.ghosts(now.ghosts);
      drawMachines(bench, session, now);
    }, () => wanted), REST);
    return () => {
      wanted = false;
      clearTimeout(timer);
    };
  }, [session, state, dimension?.address, range?.low, range?.high, steps.value]);
  useEffect(() => () => {
    session.view?.ghosts([]);
    lay(bench, "sweep", null);
  }, [session]);
  if (!dimension || !range) return <p class="no-curves">{say("dock.no_dimension")}</p>;
  const fits = found?.address === dimension.address && found.values.length > 1 ? found : null;
  return (
    <div class="sweep">
      <Form bench={bench} session={session} dimension={dimension} low={range.low} high={range.high} />
      {fits ? <div class="plots">{figuresOf(session, most).map((each) => <Chart key={each.id} bench={bench} session={session} figure={each} swept={fits} dimension={dimension} />)}</div> : <p class="no-curves">{say("dock.sweeping")}</p>}
    </div>
  );
}

/** Draws some of the swept machines over the sheet, in the position that is shown. */
function drawMachines(bench: Bench, session: Session, { machines, values }: Swept): void {
  const every = Math.max(1, Math.round((values.length - 1) / (DRAWN - 1))), bodies = session.data.glyphs.filter((each) => each.points && (each.kind === "bar" || each.kind === "plate"));
  lay(bench, "sweep", machines.size ? (over, place) => {
    const i = bench.page.index(session);
    for (const [k, points] of machines) {
      if (k % every) continue;
      for (const { points: keys, kind } of bodies) over.path(line(keys!.map((key) => place([points[key].x[i], points[key].y[i]])), kind === "plate"), "soft");
    }
  } : null);
}

function Form({ bench, session, dimension, low, high }: { bench: Bench; session: Session; dimension: Dimension; low: number; high: number }) {
  const { say } = bench, { address, factor, unit } = dimension, inUnit = (x: number) => String(Number((x / factor).toPrecision(6)));
  const set = (change: { low?: number; high?: number }) => {
    const next = { address, low, high, ...change };
    if (next.high > next.low) bench.inHand.value = next;
  };
  const read = (text: string) => Number(text.replace(",", ".").replace("−", "-").replace(/[^\d.eE+-]/g, "")) * factor;
  const end = (which: "low" | "high", value: number) => (
    <label class="task-field">
      <span>{say(`dock.sweep_${which}`)}</span>
      <span class="task-value"><input value={inUnit(value)} inputMode="decimal" onChange={(event) => Number.isFinite(read(event.currentTarget.value)) && set({ [which]: read(event.currentTarget.value) })} /><i>{unit === "deg" ? "°" : unit}</i></span>
    </label>
  );
  return (
    <div class="sweep-form">
      <Select
        aria-label={say("dock.swept")} value={address}
        onChange={(event) => {
          const chosen = session.data.dimensions.find((each) => each.address === event.currentTarget.value)!;
          bench.inHand.value = { address: chosen.address, ...rangeOf(session, chosen) };
        }}
      >{session.data.dimensions.map((each) => <option key={each.address}>{each.address}</option>)}</Select>
      {end("low", low)}
      {end("high", high)}
      <label class="task-field"><span>{say("dock.steps")}</span><input type="number" min={3} max={MOST} value={steps.value} onChange={(event) => (steps.value = Math.max(3, Math.min(MOST, Math.round(Number(event.currentTarget.value) || USUAL))))} /></label>
      <Tolerance bench={bench} session={session} />
    </div>
  );
}

/** Machines whose lengths are off by chance, as clouds of paths. */
function Tolerance({ bench, session }: { bench: Bench; session: Session }) {
  const cloud = session.cloud.value, { page } = bench;
  useEffect(() => () => session.scatter(0), [session]);
  return (
    <>
      <label class="task-field"><span>{bench.say("dock.tolerance")}</span><span class="task-value"><input inputMode="decimal" value={cloud ? String(Number((cloud.width * 1e3).toPrecision(6))) : ""} onChange={(event) => session.scatter(Math.max(0, Number(event.currentTarget.value.replace(",", ".")) * 1e-3 || 0))} /><i>mm</i></span></label>
      {cloud && <p class="help" role="status">{page.say("cloud", { count: String(cloud.count), built: String(cloud.built), off: quantity(cloud.off, "length", cloud.off, 3), paths: session.traced.join(", ") })}</p>}
    </>
  );
}

/** A menu of the metrics, each to be shown or not. */
export function SweepHead({ bench, session }: { bench: Bench; session: Session }) {
  const most = bench.layout.value === "large" ? 6 : 4, language = bench.page.language.value;
  const menu = (at: HTMLElement) => {
    const now = figuresOf(session, most).map(({ id }) => id);
    showMenu(bench.say("dock.metrics"), at, session.data.numbers.map((each) => ({
      label: each.name[language], checked: now.includes(each.id), not: !now.includes(each.id) && now.length >= most ? bench.say("dock.most_curves", { most: String(most) }) : undefined,
      act: () => (shown.value = now.includes(each.id) ? now.filter((id) => id !== each.id) : [...now, each.id]),
    })));
  };
  return <button class="text add" aria-haspopup="menu" onClick={(event) => menu(event.currentTarget)}><Icon name="settings" size={16} />{bench.say("dock.metrics")}</button>;
}

function Chart({ bench, session, figure, swept, dimension }: { bench: Bench; session: Session; figure: Figure; swept: Swept; dimension: Dimension }) {
  const host = useRef<HTMLDivElement>(null), plot = useRef<Plot | null>(null), { model } = session, row = swept.metrics[figure.id], name = figure.name[bench.page.language.value];
  useLayoutEffect(() => {
    const drawn = (plot.current = new Plot(host.current!));
    return () => drawn.end();
  }, []);
  const now = model.values[dimension.address], { values } = swept, last = values.length - 1, place = ((now - values[0]) / (values[last] - values[0])) * last, here = Math.max(0, Math.min(last - 1, Math.floor(place)));
  const current = row[here] + (place - here) * (row[here + 1] - row[here]), size = row.reduce((most, x) => (Math.abs(x) > most ? Math.abs(x) : most), 0), sort = figure.signal;
  useLayoutEffect(() => {
    const said = (x: number) => `${digits(x / dimension.factor, 3)}${dimension.unit === "deg" ? "°" : ""}`;
    plot.current!.set({
      x: values, now: row, before: null, kept: [], peaks: [], colour: COLOURS.find(([each]) => each.test(sort))?.[1] ?? "accent", factor: unitFor(figure.quantity, size).factor, turn: 0,
      limit: figure.kind === "least" && sort.startsWith("m:") ? GOOD : null, ticks: [0, 0.5, 1].map((share) => ({ share, text: said(values[0] + share * (values[last] - values[0])) })),
    });
    plot.current!.label(name);
    plot.current!.cursor(Math.max(0, Math.min(last, place)), place >= 0 && place <= last ? current : NaN);
  }, [swept, figure, now]);
  const to = (event: PointerEvent) => {
    if (event.buttons !== 1 || !plot.current) return;
    if (event.type === "pointerdown") {
      (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
      session.begin();
      session.held = true;
    }
    const value = values[0] + plot.current.phase(event.clientX) * (values[last] - values[0]);
    bench.page.soon(() => {
      model.change({ ...model.values, [dimension.address]: value });
      session.moved();
    });
  };
  const done = () => {
    if (!session.held) return;
    bench.page.flush();
    session.held = false;
    session.end(true);
  };
  return (
    <figure class="plot">
      <figcaption><span class="pick" title={name}><b>{named(bench, figure)}</b><span><Name text={ownerOf(figure.signal).replace(/^driver$/, "").replace("|", ", ").split("+").join(", ")} /></span></span><output>{quantity(current, figure.quantity, size, 3)}</output></figcaption>
      <div class="chart-host" ref={host} onPointerDown={to} onPointerMove={to} onPointerUp={done} onPointerCancel={done} />
    </figure>
  );
}


// The page: machines side by side, each with its drawing, design numbers, dimensions and curves.
import { signal, useComputed } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { Chart, Hodograph } from "./chart";
import { Comparison } from "./compare";
import type { Dimension, Group, PageData } from "./data";
import { isForce, type Values, type Wall } from "./model";
import { Session } from "./session";
import { View } from "./view";
import { digits, quantity, unitFor, Words } from "./words";
import "./page.css";

const CYCLE_SECONDS = [2, 6];
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
const MOST_CURVES = 8;
// Rest after a change before joints are given their new names for those who do not see them, ms.
const NAMING = 150;
const SHOWN = ["names", "velocities", "accelerations", "forces", "centres"] as const;

export interface History {
  undo(): void;
  redo(): void;
  undoable: boolean;
  redoable: boolean;
}

export class Page {
  readonly words: Words;
  readonly language = signal<"en" | "zh">("en");
  readonly phase = signal(0);
  readonly playing = signal(false);
  readonly pace = signal(1);
  readonly note = signal("");
  /** Steps back and forth beyond those of the machines, where texts are changed as well. */
  history: History | null = null;
  private last = 0;
  private waiting: (() => void) | null = null;

  constructor(readonly data: PageData, readonly sessions: Session[]) {
    this.words = new Words(data, data.language);
    this.language.value = data.language;
  }

  say = (key: string, values: Record<string, string> = {}) => {
    this.words.language = this.language.value;
    return this.words.say(`page.${key}`, values);
  };

  /** A word for a region of a machine, with the machine's name where there are several. */
  region(session: Session, key: string): string {
    return this.sessions.length > 1 ? `${this.say(key)}: ${session.data.name} (${session.number + 1})` : this.say(key);
  }

  index(session: Session): number {
    const { count, closed } = session.data.positions;
    return Math.min(count - 1, Math.floor(this.phase.value * (closed ? count : count - 1) + 0.5) % count);
  }

  play(on: boolean): void {
    this.playing.value = on;
    if (on) requestAnimationFrame((now) => {
      this.last = now;
      this.tick(now);
    });
  }

  private seconds(): number {
    const { period, count, steady } = this.sessions[0].data.positions;
    const own = period ?? (steady ? Math.abs((count * steady.step) / steady.speed) : CYCLE_SECONDS[1]);
    return Math.min(CYCLE_SECONDS[1], Math.max(CYCLE_SECONDS[0], own));
  }

  private tick(now: number): void {
    if (!this.playing.value) return;
    const phase = this.phase.value + ((now - this.last) / 1000 / this.seconds()) * this.pace.value;
    this.last = now;
    this.phase.value = phase % 1;
    requestAnimationFrame((next) => this.tick(next));
  }

  /** Runs work in the next frame; what comes before the frame replaces it. */
  soon(work: () => void): void {
    const idle = this.waiting === null;
    this.waiting = work;
    if (idle) requestAnimationFrame(() => this.flush());
  }

  flush(): void {
    const work = this.waiting;
    this.waiting = null;
    work?.();
  }

  wall(session: Session, wall: Wall | null): string {
    if (!wall) return "";
    if (wall.kind === "locked" || wall.kind === "still") return this.say(`wall_${wall.kind}`, { name: wall.name });
    if (wall.kind === "length") return this.say("wall_length", { name: wall.name });
    const input = session.data.positions.inputs[0], group = wall.group!;
    const where = input ? this.say("where", { name: input.name, value: quantity(wall.input, input.turns ? "angle" : "length") }) : "";
    const names = { signature: group.signature, links: group.links.join(", ") };
    if (wall.kind === "change") return this.say("wall_change", { where, ...names });
    const outcome = { apart: "apart", singular: "singular", lost: "lost" }[wall.kind];
    const sentence = this.words.say(`outcome.${outcome}`, { ...names, reason: this.reason(wall.facts) || this.misfit(group) });
    return this.say("wall", { where, sentence });
  }

  private misfit(group: Group): string {
    return group.wheels.length ? this.say("misfit", { names: group.wheels.join(", ") }) : "";
  }

  /** Why a dyad is apart: the same sentences as the solver's. */
  private reason(facts: Values): string {
    const length = (x: number) => quantity(x, "length");
    const root = (name: string) => Math.sqrt(Math.max(facts[name], 0));
    if ("first²" in facts) {
      const distance = root("distance²"), first = root("first²"), second = root("second²");
      const far = distance > first + second, reach = far ? first + second : Math.abs(first - second);
      return this.words.say(far ? "outcome.rrr_far" : "outcome.rrr_near", {
        distance: length(distance), first: length(first), second: length(second), reach: length(reach),
        missing: length(Math.abs(distance - reach)),
      });
    }
    if ("height" in facts) {
      const height = Math.abs(facts.height), own = root("length²");
      return this.words.say("outcome.rrp_far", { height: length(height), length: length(own), missing: length(height - own) });
    }
    if ("offset" in facts) {
      const distance = root("distance²"), offset = Math.abs(facts.offset);
      return this.words.say("outcome.rpr_near", { distance: length(distance), offset: length(offset), missing: length(offset - distance) });
    }
    return "sine" in facts ? this.words.say("outcome.rpp_parallel", { sine: digits(facts.sine, 3) }) : "";
  }

  /** The link that carries the changed dimensions of all machines. */
  link(): string {
    const parts = this.sessions.flatMap((session) =>
      session.data.dimensions
        .filter((d) => session.model.values[d.address] !== d.value)
        .map((d) => `${session.number}.${encodeURIComponent(d.address)}=${session.model.values[d.address]}`),
    );
    return `#${parts.join("&")}`;
  }

  /** Takes the dimensions of a link; what it does not know, or no machine can be, is left. */
  follow(hash: string): void {
    const wanted = this.sessions.map((session) => ({ ...session.model.values }));
    for (const part of hash.replace(/^#/, "").split("&")) {
      const [place, text] = part.split("="), dot = place.indexOf("."), value = Number(text);
      if (place === "lang" && (text === "en" || text === "zh")) this.language.value = text;
      const session = this.sessions[Number(place.slice(0, dot))];
      let address = "";
      try {
        address = decodeURIComponent(place.slice(dot + 1));
      } catch {
        continue;
      }
      if (session?.data.dimensions.some((d) => d.address === address) && text && Number.isFinite(value))
        wanted[session.number][address] = value;
    }
    this.sessions.forEach((session, k) => {
      if (Object.keys(wanted[k]).some((name) => wanted[k][name] !== session.model.values[name])) session.take(wanted[k]);
    });
  }
}

// the machine ----------------------------------------------------------------------------

function Machine({ page, session }: { page: Page; session: Session }) {
  const host = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const view = new View(session.model, host.current!, session.shown);
    session.view = view;
    const observer = new ResizeObserver(([{ contentRect: box }]) => view.resize(box.width, box.height));
    observer.observe(host.current!);
    attach(page, session, view);
    view.draw(page.index(session));
    return () => observer.disconnect();
  }, []);
  void session.version.value;
  const i = page.index(session), language = page.language.value;
  // Drawn before the frame is painted, not behind it.
  useLayoutEffect(() => session.view?.draw(i));
  const help = page.say("drawing", { name: session.data.name });
  useEffect(() => {
    const waiting = window.setTimeout(() => label(), NAMING);
    return () => window.clearTimeout(waiting);
  }, [language, page.playing.value, session.version.value]);
  const label = () => {
    session.view?.svg.setAttribute("aria-label", help);
    for (const handle of session.view?.svg.querySelectorAll<SVGElement>(".handle") ?? []) {
      const key = handle.dataset.key!, { main } = session.model;
      const [x, y] = ["x", "y"].map((axis) => quantity(main.row(`p:${key}.${axis}`)[i], "length"));
      handle.setAttribute("aria-label", page.say("joint", { name: key, x, y }));
    }
  };
  const wall = page.wall(session, session.model.wall);
  return (
    <div class="stage">
      <div class="paper" ref={host} />
      <p class={wall ? "status wall" : "status"} role="status">{wall || transmission(page, session, i)}</p>
    </div>
  );
}

function transmission(page: Page, session: Session, i: number): string {
  let worst = Infinity, name = "";
  for (const signal of session.data.signals) {
    if (!signal.id.startsWith("m:")) continue;
    const angle = session.model.main.row(signal.id)[i];
    if (angle < worst) [worst, name] = [angle, signal.id.slice(2)];
  }
  return name ? page.say("transmission_now", { value: quantity(worst, "angle", 1, 3), name }) : "";
}

/** Dragging by pointer and by arrow keys. */
function attach(page: Page, session: Session, view: View): void {
  let dragged: { key: string; base: Values; dx: number; dy: number } | null = null;
  const move = (key: string, base: Values, x: number, y: number) => {
    session.model.drag(base, key, view.index, ...view.world(x, y));
    session.touched();
  };
  view.svg.addEventListener("pointerdown", (event) => {
    const handle = (event.target as Element).closest<SVGElement>(".handle");
    if (!handle) return;
    event.preventDefault();
    page.play(false);
    handle.setPointerCapture(event.pointerId);
    const [dx, dy] = [Number(handle.getAttribute("cx")) - event.pageX, Number(handle.getAttribute("cy")) - event.pageY];
    dragged = { key: handle.dataset.key!, base: { ...session.model.values }, dx, dy };
    session.begin();
    handle.focus();
  });
  view.svg.addEventListener("pointermove", (event) => {
    if (!dragged) return;
    const { key, base, dx, dy } = dragged, { pageX, pageY } = event;
    page.soon(() => move(key, base, pageX + dx, pageY + dy));
  });
  const stop = () => {
    if (!dragged) return;
    page.flush();
    dragged = null;
    session.end();
  };
  view.svg.addEventListener("pointerup", stop);
  view.svg.addEventListener("pointercancel", stop);
  view.svg.addEventListener("keydown", (event) => {
    const key = (event.target as SVGElement).dataset?.key;
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!key || !way) return;
    event.preventDefault();
    page.play(false);
    const far = event.shiftKey ? 10 : 1, handle = event.target as SVGElement;
    session.begin();
    move(key, { ...session.model.values }, Number(handle.getAttribute("cx")) + far * way[0], Number(handle.getAttribute("cy")) + far * way[1]);
    session.end();
  });
}

// panels ---------------------------------------------------------------------------------

export function Transport({ page }: { page: Page }) {
  const session = page.sessions[0], { count } = session.data.positions;
  if (count < 2) return <p class="hint">{page.say("static")}</p>;
  const i = page.index(session), { x, kind } = session.model.axis;
  const value = quantity(x[i], kind, kind === "length" ? session.model.size : 1);
  return (
    <div class="transport">
      <button class="play" onClick={() => page.play(!page.playing.value)}>{page.say(page.playing.value ? "pause" : "play")}</button>
      <input
        type="range" min="0" max={count - 1} value={i} aria-label={page.say("position")} aria-valuetext={value}
        onInput={(event) => {
          page.play(false);
          page.phase.value = Number(event.currentTarget.value) / count;
        }}
      />
      <output>{value}</output>
      <select aria-label={page.say("speed")} value={page.pace.value} onChange={(event) => (page.pace.value = Number(event.currentTarget.value))}>
        {SPEEDS.map((each) => <option value={each} key={each}>{each}×</option>)}
      </select>
    </div>
  );
}

function Numbers({ page, session }: { page: Page; session: Session }) {
  void session.calm.value;
  const language = page.language.value, { model } = session, now = model.numbers(), before = model.original.numbers;
  const variants = session.variants.value;
  return (
    <table class="numbers">
      <thead>
        <tr>
          <th scope="col">{page.say("numbers")}</th><th scope="col">{page.say("original")}</th>
          {variants.map((each) => <th scope="col" key={each.number}>{page.say("kept", { number: String(each.number) })}</th>)}
          <th scope="col">{page.say("now")}</th><th scope="col">{page.say("change")}</th>
        </tr>
      </thead>
      <tbody>
        {session.data.numbers.map((figure) => {
          const old = before[figure.id], value = now[figure.id], share = ((value - old) / Math.abs(old)) * 100;
          const size = Math.abs(old);
          return (
            <tr key={figure.id} data-figure={figure.id}>
              <th scope="row">{figure.name[language]}</th>
              <td>{quantity(old, figure.quantity, size)}</td>
              {variants.map((each) => <td key={each.number}>{quantity(each.design.numbers[figure.id], figure.quantity, size)}</td>)}
              <td>{quantity(value, figure.quantity, size)}</td>
              <td class={Math.abs(share) > 0.005 ? "moved" : ""}>{Math.abs(share) > 0.005 ? percent(share) : ""}</td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

function percent(share: number): string {
  return Math.abs(share) >= 1000 ? `× ${digits(1 + share / 100, 3)}` : `${share > 0 ? "+" : ""}${digits(share, 3)} %`;
}

/** Renders a component again only where what it shows has changed. */
function useShown(session: Session, what: () => unknown): void {
  void useComputed(() => (void session.calm.value, what())).value;
}

function Slider({ page, session, dimension }: { page: Page; session: Session; dimension: Dimension }) {
  const { address, value, factor, unit } = dimension, { model } = session;
  useShown(session, () => `${model.values[address]} ${model.locked.has(address)}`);
  const now = model.values[address], locked = model.locked.has(address);
  const reach = Math.abs(value) || (dimension.geometry ? (unit === "deg" || unit === "rad" ? 1 : model.size) : 1);
  const shown = (x: number) => Number((x / factor).toPrecision(6));
  const to = (x: number) => {
    if (!Number.isFinite(x)) return;
    page.soon(() => {
      model.change({ ...model.values, [address]: x * factor });
      session.touched();
    });
  };
  const done = () => {
    page.flush();
    session.end();
  };
  const changed = now !== value;
  return (
    <div class={changed ? "dimension changed" : "dimension"} data-address={address}>
      <button
        class="lock" aria-pressed={locked} aria-label={page.say(locked ? "unlock" : "lock", { name: address })}
        onClick={() => {
          if (locked) model.locked.delete(address);
          else model.locked.add(address);
          session.touched();
        }}
      >{locked ? "●" : "○"}</button>
      <span class="name">{address}</span>
      <input
        type="range" min={shown(dimension.positive ? value * 0.3 : value - reach)} max={shown(dimension.positive ? value * 2 : value + reach)}
        step="any" value={now / factor} disabled={locked} aria-label={address} aria-valuetext={`${shown(now)} ${unit}`}
        onPointerDown={() => session.begin()} onKeyDown={() => session.begin()}
        onInput={(event) => to(Number(event.currentTarget.value))} onChange={done}
      />
      <input
        type="number" step="any" value={shown(now)} disabled={locked} aria-label={page.say("value_of", { name: address })}
        onChange={(event) => {
          session.begin();
          to(Number(event.currentTarget.value));
          done();
        }}
      />
      <span class="unit">{unit}</span>
      {dimension.geometry && session.data.positions.count > 1 && (
        <button
          class="sweep" aria-pressed={session.swept.value === address} aria-label={page.say("sweep", { name: address })}
          title={page.say("sweep", { name: address })}
          onClick={() => session.sweep(session.swept.value === address ? null : address)}
        >∿</button>
      )}
    </div>
  );
}

/** A section whose content is there only while it is open. */
function Fold({ title, open, children }: { title: string; open: boolean; children: () => ComponentChildren }) {
  const [shown, show] = useState(open);
  return (
    <details open={shown} onToggle={(event) => show(event.currentTarget.open)}>
      <summary>{title}</summary>
      {shown && children()}
    </details>
  );
}

function Dimensions({ page, session }: { page: Page; session: Session }) {
  const { dimensions } = session.data, drivers = new Set(session.data.positions.inputs.map((each) => each.name));
  const drive = dimensions.filter((d) => drivers.has(d.address.split(".")[0]));
  const parts: [string, Dimension[], boolean][] = [
    ["dimensions", dimensions.filter((d) => d.geometry), true],
    ["driver", drive, true],
    ["loads", dimensions.filter((d) => !d.geometry && !drive.includes(d)), false],
  ];
  return (
    <>
      {parts.filter(([, list]) => list.length).map(([title, list, open]) => (
        <Fold title={page.say(title)} open={open} key={title}>
          {() => list.map((each) => <Slider key={each.address} page={page} session={session} dimension={each} />)}
        </Fold>
      ))}
    </>
  );
}

function Shows({ page, session }: { page: Page; session: Session }) {
  const { shown, data } = session;
  useShown(session, () => JSON.stringify({ ...shown, paths: [...shown.paths] }));
  const usable = SHOWN.filter((name) => (name !== "forces" || data.signals.some(({ id }) => isForce(id))) && (name !== "centres" || data.masses.length));
  const moving = data.points.filter(({ fixed }) => !fixed);
  return (
    <details>
      <summary>{page.say("show")}</summary>
      <div class="checks">
        {usable.map((name) => (
          <label key={name}>
            <input type="checkbox" checked={shown[name]} onChange={(event) => { shown[name] = event.currentTarget.checked; session.touched(); }} />
            {page.say(name)}
          </label>
        ))}
      </div>
      <fieldset class="checks">
        <legend>{page.say("paths")}</legend>
        {moving.map(({ key }) => (
          <label key={key}>
            <input
              type="checkbox" checked={shown.paths.has(key)}
              onChange={(event) => {
                if (event.currentTarget.checked) shown.paths.add(key);
                else shown.paths.delete(key);
                session.sweep(session.swept.value);
                session.touched();
              }}
            />
            {key}
          </label>
        ))}
      </fieldset>
      {data.positions.count > 1 && <Tolerance page={page} session={session} />}
      {data.positions.count > 1 && (
        <label class="choice">
          {page.say("hodographs")}
          <select value={session.hodograph.value} onChange={(event) => (session.hodograph.value = event.currentTarget.value)}>
            <option value="">{page.say("none")}</option>
            {moving.map(({ key }) => <option value={key} key={key}>{key}</option>)}
          </select>
        </label>
      )}
    </details>
  );
}

function Tolerance({ page, session }: { page: Page; session: Session }) {
  const cloud = session.cloud.value, length = (x: number) => quantity(x, "length", x, 3);
  return (
    <>
      <label class="choice">
        {page.say("tolerance")}
        <input
          type="number" min="0" step="any" value={cloud ? Number((cloud.width * 1e3).toPrecision(6)) : ""}
          onChange={(event) => session.scatter(Number(event.currentTarget.value) * 1e-3)}
        />
        mm
      </label>
      {cloud && (
        <p class="hint" role="status">
          {page.say("cloud", { count: String(cloud.count), built: String(cloud.built), off: length(cloud.off), paths: [...session.shown.paths].join(", ") })}
        </p>
      )}
    </>
  );
}

// curves ---------------------------------------------------------------------------------

function Plot({ page, session, id, place }: { page: Page; session: Session; id: string; place: number }) {
  const host = useRef<HTMLDivElement>(null), chart = useRef<Chart | null>(null);
  const { model } = session, language = page.language.value, signal = model.signals[id];
  const version = session.version.value, variants = session.variants.value, i = page.index(session);
  useLayoutEffect(() => {
    chart.current = new Chart(host.current!);
    return () => chart.current!.svg.remove();
  }, []);
  const row = model.row(id);
  useLayoutEffect(() => {
    const before = model.original.rows[id], { x, kind } = model.axis;
    const size = before.reduce((most, x) => Math.max(most, Math.abs(x)), 0), unit = unitFor(signal.kind, size);
    const ends = [0, model.n - 1].map((k) => quantity(x[k], kind, kind === "length" ? model.size : 1, 3)) as [string, string];
    const kept = variants.map((each, k) => ({ style: `variant trace-${(k + 1) % 4}`, values: each.design.rows[id] }));
    const old = model.differs ? [{ style: "original", values: before }] : [];
    chart.current!.set(x, [...old, ...kept, { style: "now", values: row }], unit.factor, ends);
    chart.current!.label(page.say("curve", { name: signal.name[language] }));
  }, [version, id, language, variants]);
  useLayoutEffect(() => chart.current!.cursor(i, row[i]));
  const size = model.original.rows[id].reduce((most, x) => Math.max(most, Math.abs(x)), 0);
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
        <output>{quantity(row[i], signal.kind, size)}</output>
        <button class="remove" aria-label={page.say("forget", { name: signal.name[language] })} onClick={() => (session.curves.value = session.curves.value.filter((_, k) => k !== place))}>×</button>
      </figcaption>
      <div ref={host} onPointerDown={scrub} onPointerMove={scrub} />
    </figure>
  );
}

function HodographPlot({ page, session }: { page: Page; session: Session }) {
  const host = useRef<HTMLDivElement>(null), drawn = useRef<Hodograph | null>(null);
  const key = session.hodograph.value, version = session.version.value, i = page.index(session), { main } = session.model;
  useLayoutEffect(() => {
    drawn.current = new Hodograph(host.current!);
    return () => drawn.current!.svg.remove();
  }, []);
  const name = page.say("hodograph", { name: key });
  useLayoutEffect(() => {
    drawn.current!.set(name, main.row(`v:${key}.x`), main.row(`v:${key}.y`), session.data.positions.closed);
  }, [key, version, name]);
  useLayoutEffect(() => drawn.current!.cursor(main.row(`v:${key}.x`)[i], main.row(`v:${key}.y`)[i]));
  return <figure class="plot"><figcaption>{name}</figcaption><div ref={host} /></figure>;
}

function Curves({ page, session }: { page: Page; session: Session }) {
  if (session.data.positions.count < 2) return null;
  const ids = session.curves.value;
  const spare = session.data.signals.find(({ id }) => !ids.includes(id));
  return (
    <section class="curves" aria-label={page.region(session, "curves")}>
      {ids.map((id, k) => <Plot key={`${k}:${id}`} page={page} session={session} id={id} place={k} />)}
      {session.hodograph.value && <HodographPlot page={page} session={session} />}
      {spare && ids.length < MOST_CURVES && (
        <button class="more" onClick={() => (session.curves.value = [...ids, spare.id])}>+ {page.say("curves")}</button>
      )}
    </section>
  );
}

// the whole ------------------------------------------------------------------------------

function Tools({ page, session }: { page: Page; session: Session }) {
  const history: History = (session.number ? null : page.history) ?? session;
  useShown(session, () => [history.undoable, history.redoable, session.model.differs].join());
  const button = (word: string, act: () => void, able = true) => <button disabled={!able} onClick={act}>{page.say(word)}</button>;
  const download = () => {
    const { text, missing } = session.text();
    save(new Blob([text], { type: "text/yaml" }), `${session.data.name.replace(/[\\/:*?"<>|\s]+/g, "_")}.yaml`);
    page.note.value = missing.length ? page.say("not_written", { names: missing.join(", ") }) : "";
  };
  return (
    <div class="tools">
      {button("undo", () => history.undo(), history.undoable)}
      {button("redo", () => history.redo(), history.redoable)}
      {button("reset", () => session.take({ ...session.model.values, ...session.model.original.values }), session.model.differs)}
      {button("keep", () => session.keep())}
      {session.variants.value.map((each) => {
        const name = page.say("kept", { number: String(each.number) });
        return (
          <span class="variant" key={each.number}>
            <button onClick={() => session.take(each.design.values)}>{page.say("take", { name })}</button>
            <button aria-label={page.say("forget", { name })} onClick={() => session.forget(each.number)}>×</button>
          </span>
        );
      })}
      {button("download", download)}
    </div>
  );
}

/** Hands a file to the user. */
export function save(content: Blob, name: string): void {
  const url = URL.createObjectURL(content), link = document.createElement("a");
  [link.href, link.download] = [url, name];
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

function notes(page: Page, session: Session): string[] {
  const { model } = session, { held } = session.data;
  const found: string[] = [];
  if (model.changed && held.length) found.push(page.say("not_found_again", { names: held.join(", ") }));
  if (model.locking) found.push(page.say("locking"));
  if (model.doubtful) found.push(page.say("doubtful"));
  if (model.iterated && model.changed) found.push(page.say("followed", { value: digits(model.margin ?? 0, 2) }));
  if (session.data.undrawn.length) found.push(page.say("undrawn", { names: session.data.undrawn.join(", ") }));
  if (session.data.module === null) found.push(page.say("text_kernel"));
  return found;
}

function Notes({ page, session }: { page: Page; session: Session }) {
  void session.calm.value;
  return <>{notes(page, session).map((each) => <p class="note" key={each}>{each}</p>)}</>;
}

export function Card({ page, session }: { page: Page; session: Session }) {
  return (
    <article class="card">
      <h1>{session.data.name}</h1>
      {session.data.purpose && <p class="purpose">{session.data.purpose}</p>}
      <div class="bench">
        <Machine page={page} session={session} />
        <div class="panels">
          <Tools page={page} session={session} />
          <Notes page={page} session={session} />
          <Dimensions page={page} session={session} />
          <Shows page={page} session={session} />
        </div>
      </div>
      <div class="results">
        <Curves page={page} session={session} />
        {session.data.numbers.length > 0 && (
          <div class="scroll" role="region" tabIndex={0} aria-label={page.region(session, "numbers")}><Numbers page={page} session={session} /></div>
        )}
      </div>
      {session.data.source && <p class="source">{session.data.source}</p>}
    </article>
  );
}

export function App({ page }: { page: Page }) {
  const language = page.language.value;
  useEffect(() => {
    document.documentElement.lang = language === "zh" ? "zh-CN" : "en";
    document.title = page.say("title", { name: page.sessions.map((each) => each.data.name).join(", ") });
  }, [language]);
  const share = async () => {
    const hash = page.link();
    try {
      history.replaceState(null, "", hash === "#" ? location.pathname + location.search : hash);
      await navigator.clipboard.writeText(location.href);
      page.note.value = page.say("copied");
    } catch {
      page.note.value = page.say("link_shown");
    }
  };
  return (
    <>
      <header>
        <Transport page={page} />
        <div class="common">
          <button onClick={() => void share()}>{page.say("link")}</button>
          <button onClick={() => window.print()}>{page.say("print")}</button>
          <button class="language" lang={language === "en" ? "zh-CN" : "en"} onClick={() => (page.language.value = language === "en" ? "zh" : "en")}>{page.say("language")}</button>
        </div>
      </header>
      <main class={page.sessions.length > 1 ? "side" : ""}>
        {page.sessions.map((session) => <Card key={session.number} page={page} session={session} />)}
        {page.sessions.length > 1 && <Comparison page={page} sessions={page.sessions} />}
      </main>
      <footer>
        <p role="status" class="said">{page.note.value}</p>
        <p>{page.say("drag_help")}</p>
        <p>{page.say("made")}</p>
      </footer>
    </>
  );
}

export function keys(page: Page): void {
  document.addEventListener("keydown", (event) => {
    const at = event.target as HTMLElement;
    if (event.code === "Space" && !["BUTTON", "INPUT", "SELECT", "SUMMARY", "TEXTAREA"].includes(at.tagName)) {
      event.preventDefault();
      page.play(!page.playing.value);
    }
    const which = event.key.toLowerCase();
    if ((event.ctrlKey || event.metaKey) && (which === "z" || which === "y") && !(at instanceof HTMLTextAreaElement) && at.getAttribute("type") !== "number") {
      event.preventDefault();
      const history = page.history ?? page.sessions.find((each) => each.view?.svg.contains(at)) ?? page.sessions[0];
      if (which === "y" || event.shiftKey) history.redo();
      else history.undo();
    }
  });
}

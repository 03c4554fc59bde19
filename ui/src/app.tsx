// The page: machines side by side, each with its drawing, metrics, dimensions and curves.
import { useComputed } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { Comparison } from "./compare";
import { Curves } from "./curves";
import type { Dimension } from "./data";
import { type Page, save } from "./living";
import { Machine } from "./machine";
import { isForce, sampled } from "./numbers";
import type { Session } from "./session";
import { shareLink } from "./share";
import { digits, quantity } from "./words";
import "./page.css";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
const SHOWN = ["names", "velocities", "accelerations", "forces", "centres"] as const;

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
  const { address, value, factor, unit } = dimension, { model } = session, field = useRef<HTMLInputElement>(null), typing = useRef(false);
  useShown(session, () => `${model.values[address]} ${model.locked.has(address)}`);
  const now = model.values[address], locked = model.locked.has(address);
  const reach = Math.abs(value) || (dimension.geometry ? (unit === "deg" || unit === "rad" ? 1 : model.size) : 1);
  const shown = (x: number) => Number((x / factor).toPrecision(6));
  const to = (x: number) => {
    if (!Number.isFinite(x)) return;
    page.soon(() => {
      model.change({ ...model.values, [address]: x * factor });
      session.moved();
      field.current!.value = String(shown(model.values[address]));
    });
  };
  const done = (roughly: boolean) => {
    page.flush();
    session.end(roughly);
  };
  const changed = now !== value;
  const hold = (held: boolean) => void (session.held = held);
  const type = (begun: boolean) => hold((typing.current = begun));
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
      <span class="name">{address.split(/(?<=[._])/).map((part) => <>{part}<wbr /></>)}</span>
      <input
        type="range" min={shown(dimension.positive ? value * 0.3 : value - reach)} max={shown(dimension.positive ? value * 2 : value + reach)}
        step="any" value={now / factor} disabled={locked} aria-label={address} aria-valuetext={`${shown(now)} ${unit}`}
        onPointerDown={() => { session.begin(); hold(true); }} onKeyDown={() => session.begin()}
        onPointerUp={() => hold(false)} onPointerCancel={() => hold(false)}
        onInput={(event) => to(Number(event.currentTarget.value))} onChange={() => done(true)}
      />
      <input
        ref={field} type="number" step="any" value={typing.current ? field.current!.value : shown(now)} disabled={locked} aria-label={page.say("value_of", { name: address })}
        onInput={() => type(true)} onBlur={() => type(false)}
        onChange={(event) => {
          type(false);
          if (!event.currentTarget.value) return void (event.currentTarget.value = String(shown(now)));
          session.begin();
          to(Number(event.currentTarget.value));
          done(false);
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

/** A section whose content is there only while it is open, as the page remembers. */
function Fold({ page, name, open, children }: { page: Page; name: string; open: boolean; children: () => ComponentChildren }) {
  const [shown, show] = useState(page.folds[name] ?? open);
  return (
    <details open={shown} onToggle={(event) => show((page.folds[name] = event.currentTarget.open))}>
      <summary>{page.say(name)}</summary>
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
      {parts.filter(([, list]) => list.length).map(([name, list, open]) => (
        <Fold page={page} name={name} open={open} key={name}>
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
    <Fold page={page} name="show" open={false}>
      {() => (
        <>
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
        </>
      )}
    </Fold>
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
          {page.say("cloud", { count: String(cloud.count), built: String(cloud.built), off: length(cloud.off), paths: session.traced.join(", ") })}
        </p>
      )}
    </>
  );
}

// the whole ------------------------------------------------------------------------------

function Tools({ page, session }: { page: Page; session: Session }) {
  // Where texts are changed as well, the page has steps back and forth of its own.
  const shared = page.history && !session.number, { history } = session;
  useShown(session, () => [history.undoable, history.redoable, session.model.differs].join());
  const button = (word: string, act: () => void, able = true) => <button disabled={!able} onClick={act}>{page.say(word)}</button>;
  const studio = async () => {
    const link = await shareLink(session.text().text);
    try {
      await navigator.clipboard.writeText(link);
      page.note.value = page.say("studio_copied");
    } catch {
      window.history.replaceState(null, "", link.slice(link.indexOf("#")));
      page.note.value = page.say("studio_shown");
    }
  };
  const download = () => {
    const { text, missing } = session.text();
    save(new Blob([text], { type: "text/yaml" }), `${session.data.name[page.language.value].replace(/[\\/:*?"<>|\s]+/g, "_")}.yaml`);
    page.note.value = missing.length ? page.say("not_written", { names: missing.join(", ") }) : "";
  };
  return (
    <div class="tools">
      {!shared && button("undo", () => history.undo(), history.undoable)}
      {!shared && button("redo", () => history.redo(), history.redoable)}
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
      {!page.history && button("studio", () => void studio())}
    </div>
  );
}

function notes(page: Page, session: Session): string[] {
  const { model } = session, { held } = session.data;
  const found: string[] = [];
  if (model.changed && held.length) found.push(page.say("not_found_again", { names: held.join(", ") }));
  if (model.solver.locking) found.push(page.say("locking"));
  if (model.solver.doubtful) found.push(page.say("doubtful"));
  if (model.solver.iterated) found.push(page.say("followed", { value: digits(model.solver.margin ?? 0, 2) }));
  if (session.data.undrawn.length) found.push(page.say("undrawn", { names: session.data.undrawn.join(", ") }));
  return found;
}

function Notes({ page, session }: { page: Page; session: Session }) {
  void session.calm.value;
  return <>{notes(page, session).map((each) => <p class="note" key={each}>{each}</p>)}</>;
}

/** Says where largest values are those of the positions, not of what lies between them. */
function Sampled({ page, session }: { page: Page; session: Session }) {
  const what = sampled(session.model), ids = new Set(session.data.numbers.map(({ signal }) => signal)), { n } = session.model;
  if (!what || n < 2 || (what === "forces" && ![...ids].some(isForce))) return null;
  return <p class="hint">{page.say(`sampled_${what}`, { count: String(n) })}</p>;
}

export function Card({ page, session }: { page: Page; session: Session }) {
  const { name, purpose, source } = session.data, language = page.language.value;
  return (
    <article class="card">
      <h1>{name[language]}</h1>
      {purpose[language] && <p class="purpose">{purpose[language]}</p>}
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
          <div class="scroll" role="region" tabIndex={0} aria-label={page.region(session, "numbers")}><Numbers page={page} session={session} /><Sampled page={page} session={session} /></div>
        )}
      </div>
      {source[language] && <p class="source">{source[language]}</p>}
    </article>
  );
}

export function App({ page }: { page: Page }) {
  const language = page.language.value;
  useLayoutEffect(() => {
    document.documentElement.lang = language === "zh" ? "zh-CN" : "en";
    document.title = page.say("title", { name: page.sessions.map((each) => each.data.name[language]).join(", ") });
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
      const history = page.history ?? (page.sessions.find((each) => each.view?.svg.contains(at)) ?? page.sessions[0]).history;
      if (which === "y" || event.shiftKey) history.redo();
      else history.undo();
    }
  });
}

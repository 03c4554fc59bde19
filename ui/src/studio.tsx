// The studio: the living page with its model's text beside it, and tools that draw a mechanism from nothing.
import { signal } from "@preact/signals";
import { render } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { Card, keys, Page, save, Transport } from "./app";
import { bytes, type ModelData, type PageData } from "./data";
import { code } from "./model";
import { quantity } from "./words";
import { type Action, Paper, type Picture, type Tool } from "./paper";
import { Session } from "./session";
import "./studio.css";

interface Found {
  severity: string;
  line: number;
  key: string;
  message: string;
  remedy: string;
}

interface Solved {
  findings: Found[];
  model: ModelData | null;
  picture?: Picture;
  sentence: string;
  mobility?: number;
  /** The text that it is about. */
  text?: string;
}

const TOOLS: Tool[] = ["select", "fixed", "link", "guide", "slot", "gear", "driver", "mass", "load", "curve", "photo", "remove"];
const VALUES: Partial<Record<Tool, string>> = { gear: "20:40", mass: "1 kg", load: "100 N", photo: "100 mm" };
const TAKEN = [".report.pdf", ".report.html", ".html", ".xlsx", ".csv", ".json", ".svg", ".pdf", ".png", ".dxf"];
const WAIT = 250, WATCH = 1500, LOOK = 400;

/** A linkage for a curve: its file, how far off it is (m), its curve. */
interface Candidate {
  text: string;
  links: number;
  error: number;
  transmission_angle: number;
  curve: [number, number][];
}

interface Sought {
  number: number;
  running: boolean;
  candidates: Candidate[];
  sentence: string;
}

/** The open file: its text with all its steps, what is found in it, the machine that it makes. */
class Desk {
  readonly text = signal("");
  readonly name = signal("");
  readonly session = signal<Session | null>(null);
  readonly solved = signal<Solved>({ findings: [], model: null, sentence: "" });
  readonly drawing = signal(true);
  readonly elsewhere = signal<string | null>(null);
  readonly onDisk = signal("");
  readonly dirty = signal(false);
  readonly sought = signal<Sought | null>(null);
  private readonly window = crypto.randomUUID();
  private readonly token = new URLSearchParams(location.search).get("token") ?? "";
  private past: string[] = [];
  private future: string[] = [];
  private version = "";
  private serial = 0;
  private asked = 0;
  private timer = 0;
  private queue: Promise<void> = Promise.resolve();
  private ready: Promise<void> = Promise.resolve();
  /** Actions of drawing that are not in the text yet. */
  pending = 0;

  constructor(readonly page: Page) {
    page.history = this;
    window.setInterval(() => void this.watch(), WATCH);
  }

  say = (key: string, values: Record<string, string> = {}) => {
    this.page.words.language = this.page.language.value;
    return this.page.words.say(`studio.${key}`, values);
  };

  async ask<T>(name: string, body: Record<string, unknown> = {}): Promise<T | null> {
    try {
      const answer = await fetch(`/api/${name}`, {
        method: "POST",
        headers: { "Content-Type": "application/json", "X-Linkwright-Token": this.token },
        body: JSON.stringify({ ...body, language: this.page.language.value }),
      });
      const found = (await answer.json()) as T & { error?: string };
      if (answer.ok) return found;
      this.page.note.value = found.error ?? "";
    } catch {
      this.page.note.value = this.say("gone");
    }
    return null;
  }

  get undoable(): boolean {
    return this.past.length > 0;
  }

  get redoable(): boolean {
    return this.future.length > 0;
  }

  undo(): void {
    this.go(this.past, this.future);
  }

  redo(): void {
    this.go(this.future, this.past);
  }

  private go(from: string[], to: string[]): void {
    const text = from.pop();
    if (text === undefined) return;
    to.push(this.text.value);
    this.put(text, 0);
  }

  /** Takes a text as a step of its own. */
  change(text: string, wait = 0): void {
    if (text === this.text.value) return;
    this.past.push(this.text.value);
    this.future = [];
    this.put(text, wait);
  }

  private put(text: string, wait: number): void {
    this.text.value = text;
    this.dirty.value = true;
    void this.keep();
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.solve(), wait);
  }

  /** Every change goes to the server as a draft, in their order. */
  private keep(): Promise<void> {
    this.queue = this.queue.then(async () => {
      if (!this.name.value || this.elsewhere.value !== null) return;
      const kept = await this.ask<{ serial: number; other: string | null }>("keep", { name: this.name.value, text: this.text.value, window: this.window, serial: this.serial });
      if (!kept) return;
      this.serial = kept.serial;
      if (kept.other !== null) this.elsewhere.value = kept.other;
    });
    return this.queue;
  }

  private async watch(): Promise<void> {
    if (!this.name.value || this.elsewhere.value !== null) return;
    const state = await this.ask<{ serial: number; other: boolean; version: string }>("state", { name: this.name.value, window: this.window });
    if (!state) return;
    if (this.page.note.value === this.say("gone")) {
      this.page.note.value = "";
      this.serial = state.serial;
      await this.keep();
      return;
    }
    if (state.other && state.serial !== this.serial) {
      const opened = await this.ask<{ text: string; serial: number }>("open", { name: this.name.value });
      if (opened && opened.text !== this.text.value) this.elsewhere.value = opened.text;
      this.serial = state.serial;
    }
    this.onDisk.value = state.version !== this.version ? state.version : "";
  }

  takeTheirs(): void {
    const text = this.elsewhere.value;
    this.elsewhere.value = null;
    if (text !== null) this.change(text);
  }

  keepMine(): void {
    this.elsewhere.value = null;
    void this.keep();
  }

  open(asked: { name?: string; gallery?: string; fresh?: boolean }): Promise<void> {
    return (this.ready = this.opened(asked));
  }

  private async opened(asked: { name?: string; gallery?: string; fresh?: boolean }): Promise<void> {
    const opened = await this.ask<{ name: string; text: string; version: string; serial: number; recovered: boolean }>("open", asked);
    if (!opened) return;
    this.name.value = opened.name;
    [this.version, this.serial, this.past, this.future] = [opened.version, opened.serial, [], []];
    this.elsewhere.value = null;
    this.onDisk.value = "";
    this.text.value = opened.text;
    this.dirty.value = opened.recovered;
    if (opened.recovered) this.page.note.value = this.say("recovered");
    this.clear();
    await this.solve();
    this.drawing.value = this.session.value === null;
  }

  async save(name: string): Promise<void> {
    if (name !== this.name.value) {
      this.name.value = name;
      const there = await this.ask<{ version: string; serial: number }>("open", { name });
      if (!there) return;
      [this.version, this.serial] = [there.version, there.serial];
    }
    await this.keep();
    const saved = await this.ask<{ saved: boolean; version: string }>("save", { name, text: this.text.value, version: this.version });
    if (!saved) return;
    if (!saved.saved) {
      this.onDisk.value = saved.version;
      return;
    }
    this.version = saved.version;
    this.dirty.value = false;
    this.page.note.value = this.say("saved");
  }

  async overwrite(): Promise<void> {
    this.version = this.onDisk.value;
    this.onDisk.value = "";
    await this.save(this.name.value);
  }

  private clear(): void {
    this.session.value = null;
    this.page.sessions.length = 0;
  }

  /** Asks what the text makes; a newer question makes an older answer void. */
  async solve(): Promise<void> {
    const number = ++this.asked, text = this.text.value;
    const solved = await this.ask<Solved>("solve", { text });
    if (!solved || number !== this.asked || text !== this.text.value) return;
    this.solved.value = { ...solved, text };
    if (!solved.model?.module) return;
    const session = new Session(solved.model, await code(solved.model, 0), 0), old = this.session.value;
    if (old) session.inherit(old);
    session.ended = () => void this.adopt(session);
    this.page.sessions[0] = session;
    this.session.value = session;
  }

  /** Writes the dimensions of the machine into the text. */
  private async adopt(session: Session): Promise<void> {
    const { dimensions } = session.data;
    const values = Object.fromEntries(dimensions.filter((d) => session.model.values[d.address] !== d.value).map((d) => [d.address, session.model.values[d.address]]));
    if (!Object.keys(values).length || session.data.text !== this.text.value) return;
    const { text, missing } = session.text();
    if (!missing.length) return this.change(text);
    const set = await this.ask<{ text: string }>("set", { text: session.data.text, values });
    if (set && session.data.text === this.text.value) this.change(set.text);
  }

  /** Has linkages for a curve searched for, and looks what is found so far until the search has ended. */
  search = async (points: [number, number][], closed: boolean): Promise<void> => {
    const begun = await this.ask<{ number: number }>("curve", { points, closed });
    if (!begun) return;
    this.sought.value = { number: begun.number, running: true, candidates: [], sentence: "" };
    for (;;) {
      const found = await this.ask<Sought>("candidates");
      if (!found || found.number !== begun.number || this.sought.value?.number !== begun.number) return;
      this.sought.value = found;
      if (!found.running) return;
      await new Promise((go) => setTimeout(go, LOOK));
    }
  };

  async enough(): Promise<void> {
    if (this.sought.value) this.sought.value = { ...this.sought.value, running: false };
    await this.ask("enough");
  }

  /** A report or an export of the machine, as a download. */
  async take(ending: string): Promise<void> {
    this.page.note.value = this.say("making");
    const found = await this.ask<{ name: string; content: string }>("take", { text: this.text.value, ending });
    if (!found) return;
    this.page.note.value = "";
    const stem = this.name.value.replace(/\.\w+$/, "") || "machine";
    save(new Blob([bytes(found.content)]), found.name.replace(/^machine/, stem));
  }

  /** Carries out actions of drawing on the text, as one step, in the order in which they were asked. */
  act = (actions: Action[]): void => {
    this.pending++;
    this.queue = this.queue.then(async () => {
      await this.ready;
      let text = this.text.value;
      for (const action of actions) {
        const edited = await this.ask<{ text: string }>("edit", { text, action });
        if (!edited) return;
        text = edited.text;
      }
      this.change(text);
    }).finally(() => this.pending--);
  };
}

function Drafting({ desk }: { desk: Desk }) {
  const host = useRef<HTMLDivElement>(null), paper = useRef<Paper | null>(null);
  const [tool, choose] = useState<Tool>("fixed"), [value, setValue] = useState("");
  const { picture, mobility, text } = desk.solved.value;
  useEffect(() => {
    paper.current = new Paper(host.current!, desk.act);
    paper.current.drawn = (points, closed) => void desk.search(points, closed);
    const observer = new ResizeObserver(([{ contentRect: box }]) => paper.current!.resize(box.width, box.height));
    observer.observe(host.current!);
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    if (picture && !desk.pending && text === desk.text.value) paper.current!.set(structuredClone(picture));
    paper.current!.svg.setAttribute("aria-label", desk.say("paper"));
  }, [picture]);
  useLayoutEffect(() => {
    if (!paper.current) return;
    Object.assign(paper.current, { tool, value });
    paper.current.leave();
  }, [tool, value]);
  const sought = desk.sought.value, [shown, show] = useState(0);
  useLayoutEffect(() => {
    if (!paper.current) return;
    const curves = sought?.candidates.map((each) => each.curve) ?? [];
    paper.current.candidates = shown < curves.length ? [curves[shown], ...curves.filter((_, k) => k !== shown)] : curves;
    paper.current.draw();
  }, [sought, shown]);
  const choosePhoto = async (file: File | undefined) => {
    if (!file) return paper.current!.show(null);
    const href = URL.createObjectURL(file), image = new Image();
    image.src = href;
    try {
      await image.decode();
      paper.current!.show(href, image.naturalHeight / image.naturalWidth);
    } catch {
      URL.revokeObjectURL(href);
    }
  };
  return (
    <div>
      <h1>{desk.name.value || desk.say("new")}</h1>
      <div class="tools" role="toolbar" aria-label={desk.say("draw")}>
        {TOOLS.map((each) => (
          <button key={each} aria-pressed={each === tool} onClick={() => { choose(each); setValue(VALUES[each] ?? ""); }}>{desk.say(each)}</button>
        ))}
        {VALUES[tool] && <input class="value" value={value} aria-label={desk.say("value")} onChange={(event) => setValue(event.currentTarget.value)} />}
      </div>
      {tool === "photo" && (
        <div class="tools">
          <label class="choice">{desk.say("choose_photo")} <input type="file" accept="image/*" onChange={(event) => void choosePhoto(event.currentTarget.files?.[0])} /></label>
          <button onClick={() => void choosePhoto(undefined)}>{desk.say("without_photo")}</button>
        </div>
      )}
      <p class="hint">{desk.say(`help_${tool}`, { value })}</p>
      <div class="paper" ref={host} />
      {sought && (
        <section aria-label={desk.say("candidates")} class="candidates">
          <h2>{desk.say("candidates")}</h2>
          {sought.running && <p class="hint" role="status">{desk.say("searching")} <button onClick={() => void desk.enough()}>{desk.say("enough")}</button></p>}
          {sought.sentence && <p class="wall">{sought.sentence}</p>}
          <ol>
            {sought.candidates.map((each, k) => (
              <li key={each.text}>
                <button
                  onPointerEnter={() => show(k)} onFocus={() => show(k)}
                  onClick={() => {
                    void desk.enough();
                    desk.sought.value = null;
                    paper.current!.target = [];
                    desk.change(each.text);
                    desk.drawing.value = false;
                  }}
                >{desk.say("candidate", { links: String(each.links), error: quantity(each.error, "length", each.error, 3), angle: quantity(each.transmission_angle, "angle", 1, 3) })}</button>
              </li>
            ))}
          </ol>
        </section>
      )}
      <p class="status" role="status">{[mobility === undefined ? "" : desk.say("mobility", { value: String(mobility) }), desk.solved.value.sentence].filter(Boolean).join("; ")}</p>
    </div>
  );
}

function Text({ desk }: { desk: Desk }) {
  const area = useRef<HTMLTextAreaElement>(null), gutter = useRef<HTMLPreElement>(null);
  const { findings, sentence } = desk.solved.value, text = desk.text.value;
  const marked = new Map(findings.map((found) => [found.line, found.severity]));
  const lines = text.split("\n");
  const goTo = (line: number) => {
    const start = lines.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
    area.current!.focus();
    area.current!.setSelectionRange(start, start + (lines[line - 1]?.length ?? 0));
  };
  return (
    <section class="text" aria-label={desk.say("text")}>
      <div class="editor">
        <pre class="gutter" aria-hidden="true" ref={gutter}>
          {lines.map((_, k) => <span key={k} class={marked.get(k + 1) ?? ""}>{k + 1}{"\n"}</span>)}
        </pre>
        <textarea
          ref={area} spellcheck={false} wrap="off" value={text} aria-label={desk.say("text")}
          onInput={(event) => desk.change(event.currentTarget.value, WAIT)}
          onScroll={(event) => (gutter.current!.scrollTop = event.currentTarget.scrollTop)}
        />
      </div>
      <h2>{desk.say("findings")}</h2>
      <ul class="findings">
        {findings.map((found) => (
          <li key={`${found.line}${found.key}${found.message}`} class={found.severity}>
            {found.line > 0 && <button onClick={() => goTo(found.line)}>{desk.say("line", { line: String(found.line) })}</button>}
            <span>{found.key}: {found.message}{found.remedy && `; ${found.remedy}`}</span>
          </li>
        ))}
        {!findings.length && <li>{sentence || desk.say("fine")}</li>}
      </ul>
    </section>
  );
}

function Bar({ desk }: { desk: Desk }) {
  const [lists, setLists] = useState<{ files: string[]; gallery: string[] }>({ files: [], gallery: [] });
  const [name, setName] = useState(""), { page } = desk;
  useEffect(() => void desk.ask<{ files: string[]; gallery: string[] }>("files").then((found) => found && setLists(found)), [desk.dirty.value]);
  useEffect(() => setName(desk.name.value), [desk.name.value]);
  const pick = (title: string, names: string[], take: (name: string) => void) => (
    <select aria-label={title} value="" onChange={(event) => event.currentTarget.value && take(event.currentTarget.value)}>
      <option value="">{title}</option>
      {names.map((each) => <option key={each}>{each}</option>)}
    </select>
  );
  return (
    <div class="common">
      <button onClick={() => void desk.open({ fresh: true })}>{desk.say("new")}</button>
      {pick(desk.say("open"), lists.files, (file) => void desk.open({ name: file }))}
      {pick(desk.say("gallery"), lists.gallery, (gallery) => void desk.open({ gallery }))}
      <input value={name} placeholder="machine.yaml" aria-label={desk.say("name")} onInput={(event) => setName(event.currentTarget.value)} />
      <button disabled={!name} onClick={() => void desk.save(name)}>{desk.say("save")}</button>
      <select aria-label={desk.say("take")} value="" disabled={!desk.solved.value.model} onChange={(event) => { const ending = event.currentTarget.value; event.currentTarget.value = ""; if (ending) void desk.take(ending); }}>
        <option value="">{desk.say("take")}</option>
        {TAKEN.map((each) => <option key={each} value={each}>{each.startsWith(".report") ? `${desk.say("take_report")} ${each.slice(7)}` : each}</option>)}
      </select>
      <button aria-pressed={desk.drawing.value} onClick={() => (desk.drawing.value = !desk.drawing.value)}>{desk.say(desk.drawing.value ? "run" : "draw")}</button>
      <button disabled={!desk.undoable} onClick={() => desk.undo()}>{page.say("undo")}</button>
      <button disabled={!desk.redoable} onClick={() => desk.redo()}>{page.say("redo")}</button>
      <button class="language" lang={page.language.value === "en" ? "zh-CN" : "en"} onClick={() => { page.language.value = page.language.value === "en" ? "zh" : "en"; void desk.solve(); }}>{page.say("language")}</button>
    </div>
  );
}

function Room({ desk }: { desk: Desk }) {
  const { page } = desk, session = desk.solved.value.model && desk.session.value, language = page.language.value;
  void desk.text.value;
  useEffect(() => {
    document.documentElement.lang = language === "zh" ? "zh-CN" : "en";
    document.title = `${desk.name.value || desk.say("new")} – Linkwright`;
  }, [language, desk.name.value]);
  return (
    <>
      <header>
        <Bar desk={desk} />
        {session && !desk.drawing.value && <Transport page={page} />}
      </header>
      {desk.elsewhere.value !== null && (
        <p class="banner" role="alert">
          {desk.say("elsewhere")}
          <button onClick={() => desk.takeTheirs()}>{desk.say("take_theirs")}</button>
          <button onClick={() => desk.keepMine()}>{desk.say("keep_mine")}</button>
        </p>
      )}
      {desk.onDisk.value && (
        <p class="banner" role="alert">
          {desk.say("on_disk")}
          <button onClick={() => void desk.overwrite()}>{desk.say("overwrite")}</button>
        </p>
      )}
      <main class="room">
        <div class={session && !desk.drawing.value ? "side" : "card"}>
          {session && !desk.drawing.value ? <Card key={session} page={page} session={session} /> : <Drafting desk={desk} />}
        </div>
        <Text desk={desk} />
      </main>
      <footer>
        <p role="status" class="said">{page.note.value || (desk.dirty.value ? desk.say("unsaved") : "")}</p>
      </footer>
    </>
  );
}

async function open(): Promise<void> {
  const data = JSON.parse(document.getElementById("data")!.textContent!) as PageData & { file: string | null };
  const page = new Page(data, []), desk = new Desk(page);
  render(<Room desk={desk} />, document.getElementById("page")!);
  keys(page);
  Object.assign(globalThis, { linkwright: page, desk });
  await desk.open(data.file ? { name: data.file } : {});
}

void open();

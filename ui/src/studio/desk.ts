// The open file of the studio: its text with all its steps, what is found in it, the machine that it makes.
import { signal } from "@preact/signals";
import { bytes, type ModelData } from "../data";
import { History } from "../history";
import { save, type Page } from "../living";
import { code, type Values } from "../solver";
import { inherit } from "./inherit";
import type { Action, Picture } from "./picture";
import { Session } from "../session";
import { keepSteps, recallSteps } from "./steps";
import type { Gap, Outline, Structure } from "./outline";

export interface Found {
  severity: string;
  line: number;
  key: string;
  code?: string;
  /** What is the matter and what to do about it. */
  sentence: string;
}

export interface Solved {
  findings: Found[];
  model: ModelData | null;
  picture?: Picture;
  sentence: string;
  mobility?: number;
  outline?: Outline;
  structure?: Structure;
  /** Why the machine cannot be assembled; null: it can. */
  gap?: Gap | null;
  /** The text that it is about. */
  text?: string;
  /** What the text asks an optimisation. */
  optimize?: Record<string, unknown>;
}

/** Rest after typing before a text is solved, ms. */
export const WAIT = 250;
const WATCH = 1500, LOOK = 400, HELD = 50;
/** Letters typed within this time of each other are one step, ms. */
const PAUSE = 700;
/** Characters of a text that the server takes. */
const LARGEST = 1_000_000;

/** A text after actions of drawing: what to know about them, names of what is new, what can be drawn. */
interface Edited {
  text: string;
  notes: string[];
  made: string[];
  renamed: Renamed[];
  picture: Picture;
}

export interface Renamed {
  kind: string;
  from: string;
  to: string;
}

/** What can be opened; times in ms of the clock. */
export interface Folder {
  files: { name: string; time: number }[];
  /** Drawings that differ from their file; `saved`: whether there is one. */
  drafts: { name: string; time: number; saved: boolean; links: number }[];
  gallery: { name: string; title: string; purpose: string }[];
}

/** What is opened: a file or draft, a machine of the gallery, a new drawing; without any what was not saved last time. */
export interface Asked {
  name?: string;
  gallery?: string;
  fresh?: boolean;
  /** New drawings are numbered: "Drawing 3". */
  numbered?: boolean;
}

/** Where the points of a linkage are (m), which links join them, the guides of its blocks (rad). */
export interface Drawing {
  points: Record<string, [number, number]>;
  fixed: string[];
  links: Record<string, string[]>;
  guides: { on: string; at: string; angle: number }[];
  driver: string;
}

/** A linkage that meets the demands of a task, its numbers in words. */
export interface Design {
  text: string;
  type: string;
  error: string;
  defects: string;
  /** Null: not known. */
  transmission_angle: number | null;
  lengths: [string, string][];
  values: [string, string][];
  drawing: Drawing;
  curve: [number, number][];
}

/** A linkage for a curve: its file, how far off it is (m), its curve. */
export interface Candidate {
  text: string;
  drawing: Drawing;
  links: number;
  error: number;
  transmission_angle: number;
  curve: [number, number][];
}

/** A better machine: its dimensions (SI), its numbers beside those of the present one as texts. */
export interface Better {
  values: Values;
  rows: string[][];
  missed: string[];
}

interface Progress {
  number: number;
  running: boolean;
  sentence: string;
  /** Pieces of work done, and the most there will be. */
  done: number[];
}

/** How a run ended and what happened, with the times of that, s; the machine as it moved, once it has. */
export interface Ran {
  candidates: never[];
  model?: ModelData;
  summary?: string[][];
  /** That its drive could not start it or move it on. */
  stalled?: string;
  events?: string[][];
  times?: number[];
  end?: number;
}

export type Sought = Progress & (({ kind: "run" } & Ran) | { kind: "curve"; candidates: Candidate[] } | { kind: "synthesis"; candidates: Design[]; notes?: string[] } | { kind: "optimum"; head?: string[]; candidates: Better[] });

export class Desk {
  readonly text = signal("");
  readonly name = signal("");
  readonly session = signal<Session | null>(null);
  readonly solved = signal<Solved>({ findings: [], model: null, sentence: "" });
  readonly elsewhere = signal<string | null>(null);
  /** A file on the disk that is not the one that was opened, and so is not overwritten unasked. */
  readonly onDisk = signal<{ name: string; version: string } | null>(null);
  readonly dirty = signal(false);
  /** When the last draft was kept (ms of the clock), 0: none; whether the file has been saved at all. */
  readonly keptAt = signal(0);
  readonly onFile = signal(false);
  /** How many files have been opened. */
  readonly opens = signal(0);
  /** Whether the server has not answered since a question or a change that it does not have. */
  readonly gone = signal(false);
  private unkept = false;
  /** Elements that the last actions have named otherwise. */
  readonly renamed = signal<Renamed[]>([]);
  /** How many files are being made for downloads. */
  readonly making = signal(0);
  readonly sought = signal<Sought | null>(null);
  /** Whether the machine on the sheet moves as in a run under forces. */
  readonly running = signal(false);
  /** The pace before a run was shown. */
  private usualPace = 1;
  private readonly window = crypto.randomUUID();
  private readonly token = new URLSearchParams(location.search).get("token") ?? "";
  readonly history = new History<string>(() => this.text.value, (text) => this.put(text, 0));
  /** The open file as the server has it: version on the disk, serial of its draft. */
  private file = { name: "", version: "", serial: 0 };
  private typed = -PAUSE;
  /** The text before the last change of the machine by hand, and the text that wrote. */
  private moved: { before: string; text: string } | null = null;
  private stale = false;
  private solving: Promise<void> | null = null;
  private timer = 0;
  private queue: Promise<void> = Promise.resolve();
  private ready: Promise<void> = Promise.resolve();
  private saving: Promise<void> = Promise.resolve();
  /** Changes that are on their way into the text. */
  pending = 0;

  constructor(readonly page: Page) {
    page.history = this.history;
    window.setInterval(() => void this.watch(), WATCH);
    window.addEventListener("beforeunload", (event) => this.unkept && event.preventDefault());
    window.addEventListener("pagehide", () => this.remember());
  }

  say = (key: string, values: Record<string, string> = {}) => {
    this.page.words.language = this.page.language.value;
    return this.page.words.say(`studio.${key}`, values);
  };

  async ask<T>(name: string, body: Record<string, unknown> = {}): Promise<T | null> {
    if (typeof body.text === "string" && body.text.length > LARGEST) {
      this.page.note.value = this.say("large", { most: String(LARGEST) });
      return null;
    }
    try {
      const answer = await fetch(`/api/${name}`, {
        method: "POST",
        headers: { "Content-Type": "application/json", "X-Linkwright-Token": this.token },
        body: JSON.stringify({ ...body, language: this.page.language.value }),
      });
      const found = (await answer.json()) as T & { error?: string };
      this.gone.value &&= this.unkept;
      if (answer.ok) return found;
      this.page.note.value = found.error ?? "";
    } catch {
      this.page.note.value = "";
      this.gone.value = true;
    }
    return null;
  }

  /** Takes a text as a step of its own. */
  change(text: string, wait = 0): void {
    if (text === this.text.value) return;
    const now = wait ? performance.now() : -PAUSE;
    if (now - this.typed >= PAUSE || !wait) this.history.mark();
    this.put(text, wait);
    this.typed = now;
  }

  private put(text: string, wait: number): void {
    this.typed = -PAUSE;
    this.page.note.value = "";
    this.text.value = plain(text);
    this.dirty.value = true;
    void this.keep();
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.solve(), wait);
  }

  /** Every change goes to the server as a draft of the file that is open now, in their order. */
  private keep(): Promise<void> {
    const { file } = this, text = this.text.value;
    return (this.queue = this.queue.then(async () => {
      if (!file.name || this.elsewhere.value !== null) return;
      const kept = await this.ask<{ serial: number; other: string | null }>("keep", { name: file.name, text, window: this.window, serial: file.serial });
      this.unkept = !kept;
      if (!kept) return;
      this.gone.value = false;
      file.serial = kept.serial;
      if (file === this.file) this.keptAt.value = kept.serial / 1000;
      if (kept.other !== null && file === this.file) this.elsewhere.value = kept.other;
    }));
  }

  private async watch(): Promise<void> {
    const { file } = this;
    if (!file.name || this.elsewhere.value !== null) return;
    const behind = this.gone.value || this.unkept, { version } = file;
    const state = await this.ask<{ serial: number; other: boolean; version: string }>("state", { name: file.name, window: this.window });
    if (!state || file !== this.file) return;
    if (behind) {
      file.serial = state.serial;
      await this.keep();
      return;
    }
    if (state.other && state.serial !== file.serial) {
      const opened = await this.ask<{ text: string; serial: number }>("open", { name: file.name });
      if (opened && file === this.file && plain(opened.text) !== this.text.value) this.elsewhere.value = opened.text;
      file.serial = state.serial;
    }
    const known = this.onDisk.value;
    if (version !== file.version || (known && known.name !== file.name)) return;
    this.onDisk.value = state.version === version ? null : { name: file.name, version: state.version };
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

  open(asked: Asked): Promise<void> {
    return (this.ready = this.opened(asked));
  }

  /** Opens a text as a new drawing that has not been saved. */
  async begin(text: string): Promise<void> {
    const { file } = this;
    await this.open({ fresh: true, numbered: true });
    if (file !== this.file) this.put(text, 0);
  }

  /** Opens the machine of another program's file or link as a new drawing, with what it could not say. */
  async bring(name: string, text: string): Promise<void> {
    const found = await this.ask<{ text: string; notes: string[] }>("import", { name, text });
    if (!found) return; // why is in the note
    await this.begin(found.text);
    if (found.notes.length) this.page.note.value = found.notes.join("\n");
  }

  /** The steps back and forth outlive the page. */
  private remember(): void {
    keepSteps(this.file.name, { ...this.history.states, now: this.text.value });
  }

  folder(): Promise<Folder | null> {
    return this.ask<Folder>("folder");
  }

  /** Gives the open file another name; false where that is taken. */
  async rename(asked: string): Promise<boolean> {
    const name = named(asked), { file } = this;
    if (name === file.name) return true;
    await this.keep();
    const found = await this.ask<{ renamed: boolean; name: string; version: string; serial: number }>("rename", { name: file.name, to: name, version: file.version });
    if (!found || file !== this.file) return true; // why is in the note
    if (!found.renamed) return false;
    this.file = { name: (this.name.value = found.name), version: found.version, serial: found.serial };
    if (this.dirty.value) void this.keep();
    return true;
  }

  private async opened(asked: Asked): Promise<void> {
    this.remember();
    await this.queue;
    if (this.elsewhere.value !== null || this.unkept) return; // what is not stored yet would be lost
    const opened = await this.ask<{ name: string; text: string; version: string; serial: number; recovered: boolean }>("open", { ...asked, window: this.window });
    if (!opened) return;
    this.name.value = opened.name;
    this.file = { name: opened.name, version: opened.version, serial: opened.serial };
    this.history.clear();
    const steps = recallSteps(opened.name, plain(opened.text));
    if (steps) this.history.restore(steps);
    this.elsewhere.value = null;
    this.onDisk.value = null;
    this.text.value = plain(opened.text);
    this.dirty.value = opened.recovered;
    this.onFile.value = opened.version !== "";
    this.keptAt.value = opened.recovered ? opened.serial / 1000 : 0;
    this.page.note.value = opened.recovered ? this.say("recovered") : "";
    this.clear();
    this.opens.value++;
    await this.solve();
  }

  /** Writes the file, and says whether it is written; another one than the open one only where there is none, or in place of the given version. */
  async save(asked: string, version?: string): Promise<boolean> {
    let done = false;
    await (this.saving = this.saving.then(async () => void (done = await this.saved(asked, version))));
    return done;
  }

  private async saved(asked: string, version?: string): Promise<boolean> {
    const name = named(asked), { file } = this, own = name === file.name;
    await this.keep();
    const text = this.text.value;
    const saved = await this.ask<{ saved: boolean; version: string; name: string; aside: string }>("save", {
      name, text, version: version ?? (own ? file.version : ""), draft: file.name,
    });
    if (!saved || file !== this.file) return false;
    this.onDisk.value = saved.saved ? null : { name, version: saved.version };
    if (!saved.saved) return false;
    this.onFile.value = true;
    if (own) file.version = saved.version;
    else this.file = { name: (this.name.value = saved.name), version: saved.version, serial: 0 };
    this.dirty.value = text !== this.text.value;
    if (!own && this.dirty.value) void this.keep();
    this.page.note.value = saved.aside ? this.say("set_aside", { name: saved.name, aside: saved.aside }) : this.dirty.value ? "" : this.say("saved");
    return true;
  }

  /** Writes the file in place of the one on the disk that has been in the way. */
  async overwrite(): Promise<void> {
    const there = this.onDisk.value;
    if (there) await this.save(there.name, there.version);
  }

  /** Goes on with the text of the open file as it is on the disk now; what is typed while it comes stays. */
  async takeDisk(): Promise<void> {
    const { file } = this, text = this.text.value, there = await this.ask<{ text: string; version: string }>("disk", { name: file.name });
    if (!there || file !== this.file) return;
    if (text !== this.text.value) {
      this.page.note.value = this.say("typed_meanwhile");
      return;
    }
    file.version = there.version;
    this.onDisk.value = null;
    this.change(there.text);
    this.dirty.value = false;
  }

  private clear(): void {
    this.session.value = null;
    this.solved.value = { findings: [], model: null, sentence: "" };
    this.page.sessions.splice(0, Infinity, ...(this.session.value ? [this.session.value] : []));
  }

  /** Asks what the text makes, once at a time: texts that came meanwhile are one question more. */
  solve(): Promise<void> {
    this.stale = true;
    return (this.solving ??= this.settled().finally(() => (this.solving = null)));
  }

  private async settled(): Promise<void> {
    while (this.stale) {
      this.stale = false;
      await this.once();
    }
  }

  private async once(): Promise<void> {
    const text = this.text.value;
    const solved = await this.ask<Solved>("solve", { text, name: this.file.name });
    if (text !== this.text.value) return;
    if (!solved) {
      const sentence = this.page.note.value;
      if (!this.gone.value) this.solved.value = { findings: [], model: null, sentence, text };
      return;
    }
    if (!solved.model && this.moved?.text === text) return this.refuse(this.moved.before, solved);
    if (solved.picture) hold(solved.picture, this.solved.value.picture);
    this.solved.value = { ...solved, text };
    if (!solved.model) return;
    const session = new Session(solved.model, await code(solved.model), 0), old = this.session.value;
    while (old?.held) await new Promise((go) => setTimeout(go, HELD));
    if (text !== this.text.value) return;
    if (old) inherit(session, old);
    session.ended = () => void this.adopt(session);
    this.session.value = session;
    if (this.running.value) this.page.pace.value = this.usualPace;
    this.running.value = false;
    this.page.sessions.splice(0, Infinity, ...(this.session.value ? [this.session.value] : []));
  }

  /** Writes the dimensions of the machine into the text. */
  private async adopt(session: Session): Promise<void> {
    const { dimensions } = session.data;
    const values = Object.fromEntries(dimensions.filter((d) => session.model.values[d.address] !== d.value).map((d) => [d.address, session.model.values[d.address]]));
    if (!Object.keys(values).length) return;
    const { text, missing } = session.text();
    if (missing.length || session.data.text !== this.text.value) {
      if (!(await this.write(values))) back(session);
      return;
    }
    this.moved = { before: this.text.value, text };
    this.change(text);
  }

  /** Takes a change by hand back where the file does not admit it, and says why. */
  private refuse(before: string, solved: Solved): void {
    this.moved = null;
    this.history.unmark();
    if (this.session.value) back(this.session.value);
    this.put(before, 0);
    this.page.note.value = this.errors(solved) || solved.sentence;
  }

  /** Begins a search and looks what is found so far until it has ended. */
  async search(name: "curve" | "synthesis" | "optimize" | "run", body: Record<string, unknown>): Promise<void> {
    const begun = await this.ask<{ number: number }>(name, body);
    if (!begun) return;
    this.page.note.value = "";
    for (;;) {
      const found = await this.ask<Sought>("candidates");
      if (!found || found.number !== begun.number || (this.sought.value?.number ?? 0) > begun.number) return;
      this.sought.value = found;
      if (!found.running) return;
      await new Promise((go) => setTimeout(go, LOOK));
    }
  }

  /** Lets the machine of the text move under its actuators and loads, and shows how it moved until it is changed. */
  async run(): Promise<void> {
    const text = this.text.value;
    await this.search("run", { text });
    const ran = this.sought.value;
    if (ran?.kind !== "run" || !ran.model || text !== this.text.value) return;
    this.session.value = new Session(ran.model, await code(ran.model), 0);
    this.page.sessions.splice(0, Infinity, this.session.value);
    if (!this.running.value) this.usualPace = this.page.pace.value;
    this.running.value = true;
    this.page.phase.value = 0;
    [this.page.paced, this.page.pace.value] = [true, 1];
  }

  /** Writes dimensions (SI) into the text as it is then; false where it does not admit them. */
  async write(values: Values): Promise<boolean> {
    this.pending++;
    try {
      for (;;) {
        const text = this.text.value, set = await this.ask<{ text: string }>("set", { text, values });
        if (!set) return false;
        if (text !== this.text.value) continue;
        this.moved = { before: text, text: plain(set.text) };
        this.change(set.text);
        return true;
      }
    } finally {
      this.pending--;
    }
  }

  async enough(): Promise<void> {
    if (this.sought.value) this.sought.value = { ...this.sought.value, running: false };
    await this.ask("enough");
  }

  /** A report or an export of the machine, as a download; `asked`: what an exercise is about. */
  async take(ending: string, asked: Record<string, unknown> = {}): Promise<void> {
    this.making.value++;
    await this.taken(ending, asked).finally(() => this.making.value--);
  }

  private async taken(ending: string, asked: Record<string, unknown>): Promise<void> {
    this.page.note.value = this.say("making");
    const found = await this.ask<{ content: string }>("take", { ...asked, text: this.text.value, name: this.file.name, ending });
    if (!found) return;
    this.page.note.value = "";
    const stem = this.name.value.replace(/\.\w+$/, "") || "machine";
    save(new Blob([bytes(found.content)]), `${stem}${ending}`);
  }

  /** Carries out actions of drawing on the text, as one step, in the order in which they were asked; gives the names of
   *  what is new, null where the text does not admit them. */
  act = (actions: Action[]): Promise<string[] | null> => {
    const { ready } = this;
    this.pending++;
    const acted = this.queue.then(async () => {
      await ready;
      const edited = await this.carriedOut(actions).finally(() => this.pending--), { picture } = this.solved.value;
      if (edited) this.draw(edited);
      else if (picture) this.solved.value = { ...this.solved.value, picture: { ...picture } };
      return edited && edited.made;
    });
    this.queue = acted.then(() => undefined);
    return acted;
  };

  private async carriedOut(actions: Action[]): Promise<Edited | null> {
    for (;;) {
      const from = this.text.value, edited = await this.ask<Edited>("edit", { text: from, actions: withPlaces(actions, this.solved.value.picture) });
      if (!edited) return null;
      if (from !== this.text.value) continue;
      this.change(edited.text);
      this.renamed.value = edited.renamed;
      this.page.note.value = edited.notes.join(" ");
      return edited;
    }
  }

  /** Shows what is drawn now, before it is solved. */
  private draw({ picture }: Edited): void {
    hold(picture, this.solved.value.picture);
    this.solved.value = { ...this.solved.value, picture };
  }

  /** What is wrong with the text, in a line. */
  private errors(solved = this.solved.value): string {
    return solved.findings.filter(({ severity }) => severity === "error").map(({ sentence }) => sentence).join(this.say("semicolon"));
  }

  /** Shows everything in another language; sentences that were said in the one before go. */
  speak(language: "en" | "zh"): void {
    this.page.language.value = language;
    this.page.note.value = "";
    void this.solve();
  }
}

/** The name of a file that a person has typed. */
export const named = (asked: string) => (/\.(ya?ml|json)$/i.test(asked.trim()) ? asked.trim() : `${asked.trim()}.yaml`);

/** A text with the ends of lines that a text field has; the server writes those of the file. */
const plain = (text: string) => text.replaceAll("\r\n", "\n");

/** Actions with the places of points that the text has by its lengths alone. */
function withPlaces(actions: Action[], picture: Picture | undefined): Action[] {
  const { placed = [], points = {} } = picture ?? {}, places = Object.fromEntries(placed.map((name) => [name, points[name]]));
  return placed.length ? actions.map((each) => Object.assign({}, each, { places: Object.assign({}, places, each.places) })) : actions;
}

/** Points that lengths have placed stay where they were while a text is written that no machine comes of; others are
 *  where their lengths would have them. */
function hold(picture: Picture, old?: Picture): void {
  picture.loose ??= old?.loose?.filter((link) => link in picture.links);
  const used = new Set(Object.values(picture.links).flat()), before = Object.fromEntries((old?.placed ?? []).filter((point) => used.has(point)).map((point) => [point, old!.points[point]]));
  const held = Object.entries({ ...picture.sketched, ...before }).filter(([point]) => !(point in picture.points));
  Object.assign(picture.points, Object.fromEntries(held));
  picture.placed = [...(picture.placed ?? []), ...held.map(([point]) => point)];
}

/** Puts a machine back where its text has it. */
function back(session: Session): void {
  session.model.change({ ...session.data.values });
  session.touched();
}

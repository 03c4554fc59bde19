// What the whole page shares: its machines, the position that is shown, its language and sentences.
import { signal } from "@preact/signals";
import type { Group, PageData } from "./data";
import type { Values, Wall } from "./solver";
import type { History } from "./history";
import type { Session } from "./session";
import { holdsModel, modelOf } from "./share";
import { digits, quantity, Words } from "./words";
import { readBack } from "./written";

const CYCLE_SECONDS = [2, 6];
/** The end of a cycle that is played once. */
const LAST = 1 - 1e-6;

export class Page {
  readonly words: Words;
  readonly language = signal<"en" | "zh">("en");
  readonly phase = signal(0);
  readonly playing = signal(false);
  readonly pace = signal(1);
  readonly loop = signal(true);
  /** Whether a cycle is played in its own time, not in one that is pleasant to look at. */
  paced = false;
  readonly note = signal("");
  /** Sections that have been opened or closed by hand. */
  readonly folds: Record<string, boolean> = {};
  /** Steps back and forth beyond those of the machines, where texts are changed as well. */
  history: History<string> | null = null;
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
    return this.sessions.length > 1 ? `${this.say(key)}: ${session.data.name[this.language.value]} (${session.number + 1})` : this.say(key);
  }

  index(session: Session): number {
    const { count, closed } = session.data.positions;
    return Math.min(count - 1, Math.floor(this.phase.value * (closed ? count : count - 1) + 0.5) % count);
  }

  /** The place among the positions that is shown; the position is the nearest one. */
  place(session: Session): number {
    const { count, closed } = session.data.positions;
    return this.phase.value * (closed ? count : count - 1);
  }

  play(on: boolean): void {
    if (on && this.phase.value >= LAST) this.phase.value = 0;
    this.playing.value = on;
    if (on) requestAnimationFrame((now) => {
      this.last = now;
      this.tick(now);
    });
  }

  private seconds(): number {
    const { period, count, steady } = this.sessions[0].data.positions;
    const own = period ?? (steady ? Math.abs((count * steady.step) / steady.speed) : CYCLE_SECONDS[1]);
    return this.paced ? own : Math.min(CYCLE_SECONDS[1], Math.max(CYCLE_SECONDS[0], own));
  }

  private tick(now: number): void {
    if (!this.playing.value) return;
    const next = this.phase.value + (this.sessions.length ? ((now - this.last) / 1000 / this.seconds()) * this.pace.value : 0);
    this.phase.value = this.loop.value || next < 1 ? next % 1 : LAST;
    this.last = now;
    if (next >= 1 && !this.loop.value) return void (this.playing.value = false);
    requestAnimationFrame((later) => this.tick(later));
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

  /** Why a dyad is apart: the same sentences as the solver's; none where it is not, and something else does not fit. */
  private reason(facts: Values): string {
    const length = (x: number) => quantity(x, "length");
    const root = (name: string) => Math.sqrt(Math.max(facts[name], 0));
    if ("first²" in facts) {
      const distance = root("distance²"), first = root("first²"), second = root("second²");
      if (distance <= first + second && distance >= Math.abs(first - second)) return "";
      const far = distance > first + second, reach = far ? first + second : Math.abs(first - second);
      return this.words.say(far ? "outcome.rrr_far" : "outcome.rrr_near", {
        distance: length(distance), first: length(first), second: length(second), reach: length(reach),
        missing: length(Math.abs(distance - reach)),
      });
    }
    if ("height" in facts) {
      const height = Math.abs(facts.height), own = root("length²");
      if (height <= own) return "";
      return this.words.say("outcome.rrp_far", { height: length(height), length: length(own), missing: length(height - own) });
    }
    if ("offset" in facts) {
      const distance = root("distance²"), offset = Math.abs(facts.offset);
      if (offset <= distance) return "";
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
    if (holdsModel(hash)) return void this.take(hash);
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

  /** Takes the dimensions of the model in a link, where it is that of a machine on the page; says where it is not. */
  private async take(link: string): Promise<void> {
    const text = await modelOf(link);
    for (const session of text === null ? [] : this.sessions) {
      const values = readBack(text!, session.data);
      if (values) return session.take({ ...session.model.values, ...values });
    }
    this.note.value = this.say(text === null ? "link_broken" : "link_other");
  }
}

/** Hands a file to the user. */
export function save(content: Blob, name: string): void {
  const url = URL.createObjectURL(content), link = document.createElement("a");
  [link.href, link.download] = [url, name];
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

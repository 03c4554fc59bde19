// The workbench: what is selected, in hand and shown, beside the document (Desk) and the machine that it makes (Session).
import { computed, effect, signal } from "@preact/signals";
import type { Desk, Renamed } from "./desk";
import type { Session } from "../session";
import type { Vec } from "../shapes";
import type { Gap } from "./outline";
import type { Room } from "./room";
import type { Sheet } from "./tools/tool";

export const TOOLS = [
  "move", "pivot", "link", "plate", "slider", "slot", "weld", "gears", "rack", "cam", "drive", "force", "torque", "spring", "mass", "dimension", "target",
  "photo", "erase",
] as const;
export type ToolName = (typeof TOOLS)[number];
export const TABS = ["inspect", "numbers", "findings", "structure", "text"] as const;
export type Tab = (typeof TABS)[number];
export const DOCKS = ["curves", "run", "sweep", "synthesis", "optimise", "compare"] as const;
export type DockName = (typeof DOCKS)[number];
export const SHOWN = [
  "velocities", "accelerations", "forces", "loads", "transmission", "paths", "limits", "centres", "names", "dimensions", "reach", "outlines", "grid",
] as const;
export type ShownName = (typeof SHOWN)[number];
/** What the tool Spring sets between two points. */
export const SPRINGS = ["spring", "damper", "gas_spring", "cylinder", "torsion_spring"] as const;
export type SpringName = (typeof SPRINGS)[number];

/** What can be selected. A `point` may be a joint, a pivot or a point of one link; a `pair` is an entry of `joints`. */
export interface Item {
  kind: "point" | "link" | "pair" | "load" | "driver" | "dimension" | "target" | "photo";
  name: string;
}

export const same = (a: Item | null, b: Item | null) => a?.kind === b?.kind && a?.name === b?.name;

/** What stands over the room and waits for an answer. */
export type Dialog = { kind: "open"; part?: "drafts" | "files" | "gallery" } | { kind: "save" | "link" | "keys" | "palette" | "tools" | "exercise" };

/** How the sheet is looked at: what its bar and keys call. The sheet sets it. */
export interface SheetView {
  /** Zooms about the middle of the sheet. */
  zoom(factor: number): void;
  /** 100 %. */
  full(): void;
  fit(): void;
  fitSelection(): void;
}

/** A picture behind the drawing: its upper left corner and width, m; `shape`: height over width; `opacity`: 0…1. */
export interface Photo {
  href: string;
  corner: Vec;
  width: number;
  shape: number;
  opacity: number;
  locked: boolean;
}

/** Settings of the person at the screen, remembered in the browser, not in the file. */
export interface Settings {
  theme: "light" | "dark" | "";
  /** As it was chosen; "": the server's. */
  language: "en" | "zh" | "";
  slim: boolean | null;
  /** Width of the inspector and height of the open dock, px; null: as the window suggests. */
  inspector: number | null;
  dock: number | null;
  snap: boolean;
  /** Spacing of the grid, m; 0: by the zoom. */
  grid: number;
  unit: "mm" | "cm" | "m" | "in";
  /** How often each tool has been used: its hint goes after three times. */
  used: Partial<Record<ToolName, number>>;
  shown: Partial<Record<ShownName, boolean>>;
  /** Sections of the inspector that have been opened or shut by hand. */
  folds: Record<string, boolean>;
}

const SETTINGS: Settings = { theme: "", language: "", slim: null, inspector: null, dock: null, snap: true, grid: 0, unit: "mm", used: {}, shown: {}, folds: {} };
const STORED = "linkwright.settings";

export class Bench {
  readonly tool = signal<ToolName>("move");
  readonly spring = signal<SpringName>("spring");
  readonly selection = signal<Item[]>([]);
  readonly hovered = signal<Item | null>(null);
  readonly tab = signal<Tab>("inspect");
  readonly dock = signal<DockName | null>(null);
  /** How the window is used: by its size. */
  readonly layout = signal<"phone" | "desk" | "large">("desk");
  /** On a phone: how far the drawer with inspector and curves is pulled out. */
  readonly drawer = signal<"handle" | "half" | "full">("handle");
  readonly dialog = signal<Dialog | null>(null);
  /** Whether the name of the file is being edited in its place. */
  readonly renaming = signal(false);
  /** The link that was made last, while it is handed on: itself or the command with it as it is shown, and which is in the clipboard. */
  readonly shared = signal<{ link: string; shown: string; copied: "link" | "command" | "" } | null>(null);
  readonly settings = signal<Settings>(stored());
  /** Where the pointer or the cross is, m; null: not on the sheet. */
  readonly cursor = signal<Vec | null>(null);
  /** Pixels of the screen for a metre. */
  readonly scale = signal(2400);
  /** A sentence at the cursor, why a click was refused. */
  readonly refusal = signal<{ sentence: string; at: Vec } | null>(null);
  /** The sheet, once it is there: camera, scene, layers that are drawn over the machine. */
  readonly sheet = signal<Sheet | null>(null);
  /** Why the machine cannot be assembled, drawn on the sheet. */
  readonly gap = computed<Gap | null>(() => this.desk.solved.value.gap ?? null);
  /** The machine of the present text; null where the text makes none. */
  readonly session = computed<Session | null>(() => (this.desk.solved.value.model ? this.desk.session.value : null));

  /** Addresses of numbers that stay while joints are dragged ("crank.length"), whether there is a machine or not. */
  readonly locked = signal<ReadonlySet<string>>(new Set());
  /** The dimension in hand, with the range of its slider (SI). */
  readonly inHand = signal<{ address: string; low: number; high: number } | null>(null);
  /** A curve that a point of a linkage should follow, m; null: none is drawn. */
  readonly target = signal<{ points: Vec[]; closed: boolean } | null>(null);
  /** Curves of a candidate that is looked at, laid over the sheet, m. */
  readonly foreseen = signal<Vec[][]>([]);
  /** A picture behind the drawing, kept with it in this browser. */
  readonly photo = signal<Photo | null>(null);
  /** What the parts of the machine take up, while that is asked for. */
  readonly room = signal<Room | null>(null);
  /** How many panes show something of it. */
  readonly lookers = signal(0);
  /** Brings elements into the picture; the sheet sets it. */
  reveal: (items: Item[]) => void = () => {};

  view: SheetView | null = null;

  constructor(readonly desk: Desk) {
    effect(() => {
      for (const named of this.desk.renamed.value) this.follow(named);
    });
    effect(() => {
      const session = this.session.value, { value } = this.locked;
      if (session) session.model.locked = new Set([...value].filter((address) => address in session.model.values));
    });
  }

  /** What is selected or locked keeps to elements that are named otherwise. */
  private follow({ kind, from, to }: Renamed): void {
    this.selection.value = this.selection.peek().map((item) => (item.kind === kind && item.name === from ? { kind: item.kind, name: to } : item));
    const inside = `${from}.`, renamed = (address: string) => (address.startsWith(inside) ? to + address.slice(from.length) : address);
    if (kind !== "point") this.locked.value = new Set([...this.locked.peek()].map(renamed));
  }

  lock(addresses: string[], on: boolean): void {
    const locked = new Set(this.locked.value);
    for (const each of addresses) locked[on ? "add" : "delete"](each);
    this.locked.value = locked;
  }

  get page() {
    return this.desk.page;
  }

  say = (key: string, values: Record<string, string> = {}) => this.desk.say(key, values);

  select(...items: Item[]): void {
    this.selection.value = items;
  }

  /** Selects what a tool has made: nobody has asked for it yet. */
  selectMade(item: Item): void {
    this.selection.value = this.made = [item];
  }

  private made: Item[] = [];

  /** The only selected element, where a person has selected it. */
  get chosen(): Item | null {
    return this.selection.value === this.made ? null : this.one;
  }

  /** The only selected element. */
  get one(): Item | null {
    const { value } = this.selection;
    return value.length === 1 ? value[0] : null;
  }

  has(item: Item): boolean {
    return this.selection.value.some((each) => same(each, item));
  }

  shows(name: ShownName): boolean {
    return this.settings.value.shown[name] ?? ["loads", "names", "grid", "paths", "reach", "dimensions"].includes(name);
  }

  set(change: Partial<Settings>): void {
    this.settings.value = { ...this.settings.value, ...change };
    try {
      localStorage.setItem(STORED, JSON.stringify(this.settings.value));
    } catch {
      // A browser that stores nothing forgets the settings with the page.
    }
  }

  /** Shows everything in another language, the next time as well. */
  speak(language: "en" | "zh"): void {
    this.set({ language });
    this.desk.speak(language);
  }

  show(name: ShownName, on: boolean): void {
    this.set({ shown: { ...this.settings.value.shown, [name]: on } });
  }
}

function stored(): Settings {
  try {
    return { ...SETTINGS, ...(JSON.parse(localStorage.getItem(STORED) ?? "{}") as Partial<Settings>) };
  } catch {
    return SETTINGS;
  }
}

// The sheet: the machine or the sketch of a text under a camera, with what tools, selection and snaps draw over it.
import { effect, signal } from "@preact/signals";
import type { Action, Picture } from "../picture";
import type { Session } from "../../session";
import type { Vec } from "../../shapes";
import { element } from "../../strokes";
import { View } from "../../view";
import { type Bench, type Item, same, type ToolName } from "../bench";
import type { Gap } from "../outline";
import { MAKE } from "../tools";
import type { Overlay, Sheet, Spot, Tool } from "../tools/tool";
import { Camera, FULL } from "./camera";
import { type Change, compare, without } from "./changes";
import { drawnPhase, isDrawn } from "./drawn";
import { around, boxOf, comeApart } from "./gap";
import { heading } from "./geometry";
import { Grid, spacing } from "./grid";
import { FINGER, NEAR, under } from "./hits";
import { type DrawnLoad, drawnLoads, Stand } from "./loads";
import { loadsBox } from "./load_marks";
import { drawMarks, inkOf, lengths, type Placed } from "./marks";
import { pointWords, spoken } from "./names";
import { Pencil } from "./overlay";
import { Scene } from "./scene";
import { bareOf, Sketch } from "./sketch";
import { REACH, snap } from "./snap";

/** Tools that work on the machine as it stands or on what lies beside it: the others draw, at the drawn position. */
const STAYS = new Set<ToolName>(["move", "target", "photo", "erase"]);
/** Tools that put something where the pointer snaps to. */
const PLACING = new Set<ToolName>(["pivot", "link", "plate", "slider", "slot", "force", "spring", "cam"]);
/** Room between loads and the edges of the sheet that is seen whole, px; the share of what is missing that a step makes room for. */
const EDGE = 8, STEP = 0.75;
// Room over what stands at the foot of the sheet, px, and the most of the sheet that is kept free for it.
const FOOT = 20, FOOT_SHARE = 0.4;
/** How often a tool is used until its hint goes. */
const KNOWN = 3;

export class Board implements Sheet {
  readonly camera = new Camera();
  readonly layers = new Set<(over: Overlay) => void>();
  readonly hint = signal("");
  /** What is said aloud. */
  readonly said = signal("");
  tool: Tool;
  spot: Spot | null = null;
  /** Where the cross of the keyboard is, m. */
  cross: Vec | null = null;
  /** The room of what is laid under the machine, m; null: none. */
  outer: () => [number, number, number, number] | null = () => null;
  /** Called after each drawing, with the values in hand. */
  drawn: (() => void) | null = null;
  view: View | null = null;
  /** Links whose lengths are shown because they are being changed. */
  measured: string[] = [];
  /** Points that a hand has lifted from where the text has them. */
  lifted: Record<string, Vec> | null = null;
  /** On which sides of their bars lengths stand. */
  readonly sides = new Map<string, number>();
  /** Where lengths stand that are drawn beside their links, on the screen. */
  private placed: Placed = new Map();
  private readonly grid: Grid;
  private readonly marks: { below: Pencil; above: Pencil; over: Pencil };
  private readonly sketch: Sketch;
  private readonly machine: HTMLElement;
  private readonly ends: (() => void)[] = [];
  private known: Scene | null = null;
  private standing: Stand | null = null;
  /** What could be drawn of the text that the machine is of; how it differs from what can be drawn now. */
  private own: Picture | undefined;
  private shown: Session | null = null;
  private compared: { own: Picture; now: Picture; how: Change } | null = null;
  private fitting = true;
  /** Whether the sheet shows all as it did when the file was opened: it goes on to while regions about it take their places. */
  private whole = true;
  private stale = { waiting: false, all: true };
  private seen = "";

  constructor(readonly bench: Bench, readonly host: HTMLElement) {
    const { desk, page } = bench, layer = (style: string) => element("svg", { class: style, "aria-hidden": "true" }, host);
    const below = layer("below");
    this.grid = new Grid(element("g", {}, below));
    this.machine = host.appendChild(Object.assign(document.createElement("div"), { className: "machines" }));
    this.sketch = new Sketch(host, page.data.symbols!);
    const above = layer("above"), over = layer("over");
    this.marks = { below: new Pencil(element("g", {}, below)), above: new Pencil(above), over: new Pencil(over) };
    this.tool = MAKE.move(this);
    const observer = new ResizeObserver(([{ contentRect: box }]) => this.resize(box.width, box.height));
    observer.observe(host);
    this.ends.push(() => observer.disconnect());
    this.follow(() => this.show(bench.session.value));
    this.follow(() => {
      if (bench.tool.value !== this.tool.name) this.begin(bench.tool.value);
    });
    this.follow(() => {
      void [bench.session.value?.version.value, page.phase.value, page.playing.value, bench.settings.value, desk.text.value, page.language.value];
      void desk.solved.value;
      this.touch();
    });
    this.follow(() => {
      const { picture, model, text } = desk.solved.value;
      if (!picture && !model && text === undefined) this.fitting = true;
      if (picture && text === desk.text.value) this.prune(picture);
      if (Object.keys(picture?.links ?? {}).join() !== [...this.sides.keys()].join()) this.sides.clear();
    });
    this.follow(() => {
      void [bench.selection.value, bench.hovered.value];
      this.redraw();
    });
  }

  /** What is gone is not selected any more. */
  private prune({ points, links, loads }: Picture): void {
    const { selection } = this.bench, of: Partial<Record<Item["kind"], Set<string>>> = {
      point: new Set([...Object.keys(points), ...Object.values(links).flat()]), link: new Set(Object.keys(links)), load: new Set(Object.keys(loads)),
    };
    const left = selection.peek().filter(({ kind, name }) => of[kind]?.has(name) ?? true);
    if (left.length < selection.peek().length) selection.value = left;
  }

  private follow(work: () => void): void {
    this.ends.push(effect(work));
  }

  end(): void {
    for (const each of this.ends) each();
    this.view?.end();
    this.host.replaceChildren();
  }

  // what is shown ------------------------------------------------------------------------

  private show(session: Session | null): void {
    if (this.view?.model === session?.model) return;
    // What was shown as it is drawn stays so, wherever that is in the cycle of the new machine.
    const { page } = this.bench, phase = page.phase.peek(), drawn = !this.shown || !this.base || isDrawn(this.shown, phase);
    if (session && drawn && !page.playing.peek()) page.phase.value = drawnPhase(session);
    this.shown = session;
    this.view?.end();
    this.view?.svg.remove();
    this.view = session ? new View(session.model, this.machine, session.shown, this.camera) : null;
    if (session) session.view = this.view;
    this.own = this.picture;
    this.touch();
  }

  /** What can be drawn of the text as it is now, as far as that is known. */
  get picture(): Picture | undefined {
    return this.bench.desk.solved.value.picture;
  }

  /** What the machine that is shown was made of: the present text, or one to which there have only been additions. */
  private get base(): { session: Session; added: Picture | null } | null {
    const session = this.bench.session.value, { own, picture: now } = this;
    if (!session) return null;
    if (!now || now === own || !own) return { session, added: null };
    if (this.compared?.own !== own || this.compared.now !== now)
      this.compared = { own, now, how: compare(own, now) };
    const { how } = this.compared;
    // Where it is not shown as it is drawn, other places are seen once they are solved.
    const waits = how === "moved" && !isDrawn(session, this.bench.page.phase.peek());
    return how === "other" || (how === "moved" && !waits) ? null : { session, added: how === "more" ? own : null };
  }

  get scene(): Scene {
    return (this.known ??= this.looked());
  }

  private looked(): Scene {
    const { outline } = this.bench.desk.solved.value, { broken } = this;
    if (broken && this.picture) return comeApart(broken, this.picture, outline?.entries.joints, this.lifted);
    const session = this.base?.session ?? null;
    return new Scene(this.picture, session, session ? this.bench.page.place(session) : 0, outline?.entries.joints, this.lifted);
  }

  /** Why the drawn position cannot be assembled, while it is the one that is shown. */
  get broken(): Gap | null {
    const { bench } = this, { page, desk } = bench, { gap, text } = desk.solved.value, session = bench.session.value;
    if (!gap?.drawn || text !== desk.text.value || page.playing.value) return null;
    const phase = page.phase.value;
    return !session || phase === 0 || isDrawn(session, phase) ? gap : null;
  }

  /** The machine that the present text makes; null where it makes none, or none yet. */
  get solved(): Session | null {
    const { base, broken } = this;
    return base && !base.added && !broken ? base.session : null;
  }

  /** The machine that is drawn, of the present text or of one to which there have only been additions. */
  get standsFor(): Session | null {
    return this.broken ? null : (this.base?.session ?? null);
  }

  /** The place of the machine among its positions that is shown. */
  get place(): number {
    const session = this.bench.session.value;
    return session ? this.bench.page.place(session) : 0;
  }

  /** Draws points elsewhere than the text has them; null: where it has them. */
  lift(places: Record<string, Vec> | null): void {
    if (!places && !this.lifted) return;
    this.lifted = places;
    this.touch();
  }

  /** Whether a point is a free end of a bar. */
  loose(name: string): boolean {
    const point = this.scene.points.get(name);
    return point?.links.length === 1 && !point.fixed && !this.scene.guided.includes(name) && this.scene.links[point.links[0]].length === 2;
  }

  /** The machine or the drawing as it stands, with directions and loads. */
  get stand(): Stand {
    const session = this.solved, { scene, standing } = this;
    if (standing?.scene === scene && standing.session === session) return standing;
    return (this.standing = new Stand(scene, this.picture, session, session ? this.place : 0));
  }

  /** Loads as they are drawn now. */
  get loads(): DrawnLoad[] {
    return this.bench.shows("loads") ? drawnLoads(this.stand, this.camera) : [];
  }

  /** A place on the grid, unless it is held off. */
  snapped([x, y]: Vec, alt: boolean): Vec {
    const { step } = this, off = alt || !this.bench.settings.value.snap;
    return off ? [x, y] : [Math.round(x / step) * step, Math.round(y / step) * step];
  }

  /** Shows the machine as it is drawn, at rest. */
  toDrawn(): void {
    const session = this.bench.session.value, { page } = this.bench;
    page.play(false);
    if (session) page.phase.value = drawnPhase(session);
  }

  // drawing ------------------------------------------------------------------------------

  /** Draws all again. */
  touch(): void {
    this.known = null;
    this.stale.all = true;
    this.redraw();
  }

  redraw(): void {
    if (this.stale.waiting) return;
    this.stale.waiting = true;
    queueMicrotask(() => {
      this.stale.waiting = false;
      this.draw();
    });
  }

  private draw(): void {
    const { bench, camera } = this;
    if (camera.size[0] < 1) return;
    const { solved, text } = bench.desk;
    if (this.fitting && solved.value.text === text.value && (!solved.value.model || this.view)) {
      this.fitting = false;
      this.whole = true;
      this.fit();
    }
    if (this.stale.all) {
      this.drawAll();
      this.lookAgain();
    }
    const { below, above, over } = this.marks, tool = this.tool;
    for (const each of [below, above, over]) each.begin();
    this.placed = drawMarks(this, below, above);
    for (const each of this.layers) each(above);
    tool.draw?.(over);
    this.drawSpot(over);
    for (const each of [below, above, over]) each.end();
    const used = bench.settings.value.used[tool.name] ?? 0;
    this.hint.value = used < KNOWN ? bench.say(...tool.hint()) : "";
    this.drawn?.();
  }

  private drawAll(): void {
    const { bench, camera, sketch, machine } = this, [w, h] = camera.size, { base } = this;
    this.stale.all = false;
    const step = this.step, seen = [camera.scale, camera.origin, w, h, step, bench.shows("grid")].join();
    if (seen !== this.seen) {
      for (const each of this.host.querySelectorAll(":scope > svg")) each.setAttribute("viewBox", `0 0 ${w} ${h}`);
      this.grid.draw(camera, bench.shows("grid") ? step : 0);
      bench.scale.value = camera.scale;
    }
    const { broken } = this;
    machine.hidden = !base || broken !== null;
    const ink = inkOf(lengths(this));
    if (base && !broken && this.view) {
      const { session } = base, { page } = bench;
      Object.assign(session.shown, { names: bench.shows("names"), velocities: bench.shows("velocities"), accelerations: bench.shows("accelerations"), forces: bench.shows("forces"), centres: bench.shows("centres") });
      machine.classList.toggle("without-loads", !bench.shows("loads"));
      machine.classList.toggle("without-paths", !bench.shows("paths"));
      this.view.index = page.place(session);
      this.view.taken = ink;
      this.view.look();
    }
    const now = this.picture ?? null, bare = bareOf(this.scene), known = base && (base.added ?? (now?.loose?.length || bare.length ? now : null)), drawn = known && without(known, known.loose ?? [], bare);
    if (base && !drawn && !broken) sketch.clear();
    else sketch.draw(this.stand, bench.desk.solved.value.outline?.entries, camera, bench.shows("names"), broken ? null : drawn, ink);
    this.seen = seen;
  }

  private drawSpot(over: Pencil): void {
    const { spot, camera, cross } = this;
    if (cross) {
      const [x, y] = camera.screen(cross);
      over.path(`M${x - 12} ${y}H${x - 3}M${x + 3} ${y}H${x + 12}M${x} ${y - 12}V${y - 3}M${x} ${y + 3}V${y + 12}`, "hand cross");
    }
    const snapped = spot?.snap;
    if (!snapped || !PLACING.has(this.tool.name)) return;
    if (snapped.kind === "point" || snapped.kind === "link" || snapped.kind === "length") over.circle(camera.screen(snapped.at), 11, "snap");
    else over.circle(camera.screen(snapped.at), 3, "spot");
  }

  // camera -------------------------------------------------------------------------------

  private resize(w: number, h: number): void {
    if (w < 1 || h < 1) return;
    if (!this.seen) this.camera.origin = [Math.round(0.4 * w), Math.round(0.6 * h)];
    this.camera.size = [w, h];
    this.refit();
    this.touch();
  }

  zoom(factor: number, at?: Vec): void {
    const [w, h] = this.camera.size;
    this.whole = false;
    this.camera.zoom(factor, at ?? [w / 2, h / 2]);
    this.touch();
  }

  pan(dx: number, dy: number): void {
    this.whole = false;
    this.camera.pan(dx, dy);
    this.touch();
  }

  full(): void {
    this.zoom(FULL / this.camera.scale);
  }

  /** Puts all of the drawing into the sheet, clear of what stands at its foot. */
  fit(): void {
    const { camera, base, broken } = this, gap = this.bench.gap.value;
    const own = base && this.view && !broken ? around(this.view.box, this.scene.box, this.outer()) : this.scene.box, box = gap && (broken || !gap.drawn) ? boxOf(gap, own) : own;
    if (box) this.fitWithLoads(box, Math.min(96, 0.14 * Math.min(...camera.size)));
    else [camera.scale, camera.origin] = [FULL, [Math.round(0.4 * camera.size[0]), Math.round(0.6 * camera.size[1])]];
    this.touch();
  }

  /** There is more to see: where all was seen, it still is. */
  refit(): void {
    if (this.whole) this.fit();
  }

  /** Puts a box into the sheet so that loads with their labels, which are as large at any scale, are in it, too. */
  private fitWithLoads(box: [number, number, number, number], margin: number): void {
    const { camera } = this, [w, h] = camera.size, foot = this.host.parentElement?.querySelector<HTMLElement>(".sheet-foot")?.offsetHeight ?? 0;
    const more: [number, number, number, number] = [0, 0, 0, Math.max(0, Math.min(foot + FOOT, FOOT_SHARE * h) - margin)];
    camera.fit(box, margin, more);
    // Loads go along with their points as the scale changes: step by step, so that no more room is taken than is needed.
    for (let k = 0; k < 6; k++) {
      const loads = this.broken ? null : loadsBox(this), over = loads ? [EDGE - loads[0], EDGE - loads[1], loads[2] - w + EDGE, loads[3] - h + EDGE] : [];
      if (!over.some((each) => each > 0.5)) return;
      over.forEach((each, side) => (more[side] += STEP * Math.max(0, each)));
      camera.fit(box, margin, more);
    }
  }

  fitSelection(): void {
    this.reveal(this.bench.selection.value);
  }

  /** Puts elements into the middle of the sheet. */
  reveal(items: Item[]): void {
    const all = items.flatMap(({ kind, name }) => (kind === "link" ? this.scene.corners(name) : [this.scene.at(name)])).filter((each) => each !== null);
    if (!all.length) return this.fit();
    this.whole = false;
    const xs = all.map(([x]) => x), ys = all.map(([, y]) => y), room = all.length > 1 ? 0 : 0.05;
    this.camera.fit([Math.min(...xs) - room, Math.min(...ys) - room, Math.max(...xs) + room, Math.max(...ys) + room], 0.25 * Math.min(...this.camera.size));
    this.touch();
  }

  // the pointer --------------------------------------------------------------------------

  /** The spacing of the grid, m. */
  get step(): number {
    return spacing(this.camera.scale, this.bench.settings.value.grid);
  }

  spotAt(screen: Vec, keys: { shiftKey: boolean; altKey: boolean }, touch: boolean): Spot {
    const { bench, camera, scene, tool } = this, free = camera.world(screen), near = touch ? FINGER : NEAR, anchor = tool.anchor?.() ?? null;
    const settings = bench.settings.value, before = this.spot;
    const found = keys.altKey || !settings.snap ? null : snap(free, {
      scene, camera, anchor, avoid: tool.avoid?.() ?? [], grid: this.step, reach: touch ? FINGER : REACH,
      keep: keys.shiftKey && anchor && before ? (this.kept ??= heading(anchor, before.place)) : (this.kept = null),
      say: bench.say, named: (point) => pointWords(bench, scene, point),
    });
    return {
      screen, free, place: found?.at ?? free, snap: found, under: under(screen, scene, camera, near, this.loads, this.placed),
      shift: keys.shiftKey, alt: keys.altKey, touch,
    };
  }

  private kept: number | null = null;

  /** The pointer rests, but what is under it may be something else now. */
  private lookAgain(): void {
    const { spot, bench } = this;
    if (spot && !bench.page.playing.value) this.spot = this.spotAt(spot.screen, { shiftKey: spot.shift, altKey: spot.alt }, spot.touch);
  }

  /** The pointer is there: what it is on lights up. */
  point(spot: Spot | null): void {
    const { bench, tool } = this, first = spot?.under.find((each) => tool.takes?.(each) ?? true) ?? null;
    this.spot = spot ?? this.spot;
    if (!same(first, bench.hovered.value)) bench.hovered.value = first;
    bench.cursor.value = spot && spot.place;
    if (spot) tool.move?.(spot);
    this.redraw();
  }

  // tools --------------------------------------------------------------------------------

  private begin(name: ToolName): void {
    this.tool.leave();
    this.tool = MAKE[name](this);
    this.bench.refusal.value = null;
    if (!STAYS.has(name)) this.toDrawn();
    this.touch();
  }

  take(tool: ToolName): void {
    this.bench.tool.value = tool;
  }

  async act(actions: Action[]): Promise<string[] | null> {
    const { bench, tool } = this, { desk, page } = bench;
    this.whole = false;
    const made = await desk.act(actions);
    if (made) bench.set({ used: { ...bench.settings.value.used, [tool.name]: (bench.settings.value.used[tool.name] ?? 0) + 1 } });
    else if (page.note.value) this.say(page.note.value);
    this.touch();
    // Who draws by the cross hears what has been made.
    const last = this.cross && made?.map((name) => this.item(name)).findLast((each) => each !== null);
    if (last) this.speak(last);
    return made;
  }

  /** The element of a name. */
  item(name: string): Item | null {
    const { scene } = this;
    if (name in scene.links) return { kind: "link", name };
    if (scene.points.has(name)) return { kind: "point", name };
    return name in scene.loads ? { kind: "load", name } : null;
  }

  refuse(key: string, values: Record<string, string> = {}): void {
    this.say(this.bench.say(key, values));
  }

  private say(sentence: string): void {
    const [w, h] = this.camera.size;
    this.bench.refusal.value = { sentence, at: this.spot?.free ?? this.camera.world([w / 2, h / 2]) };
  }

  /** Says an element aloud. */
  speak(item: Item): void {
    this.said.value = spoken(this.bench, this.scene, item);
  }
}

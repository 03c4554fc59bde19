// Move: selects, drags joints and links, draws a box around what is to be selected.
import type { Values } from "../../solver";
import type { Session } from "../../session";
import type { Vec } from "../../shapes";
import { type Item, same } from "../bench";
import { dist, heading, minus, plus, polar } from "../sheet/geometry";
import { boxed } from "../sheet/hits";
import { pointsOf } from "../sheet/selection";
import { Grip } from "../sheet/grip";
import type { Board } from "../sheet/sheet";
import type { MakeTool, Overlay, Spot, Tool } from "./tool";

export const makeMove: MakeTool = (sheet) => new Move(sheet as Board);

/** How far the pointer goes before a click becomes a drag, px. */
const SLIP = 4;

type Doing =
  | { what: "press"; spot: Spot; item: Item | null }
  | { what: "box"; from: Vec; to: Vec }
  /** A joint of the solved machine: its dimensions follow. */
  | { what: "joint"; session: Session; key: string; name: string; base: Values; off: Vec }
  /** A link of the solved machine: the machine moves with it. */
  | { what: "turn"; grip: Grip }
  /** Points of a drawing that is no machine yet, from where they were. */
  | { what: "shift"; from: Vec; places: Record<string, Vec>; about: Vec | null; name: string };

class Move implements Tool {
  readonly name = "move";
  private doing: Doing | null = null;
  /** Where the last click was, on the screen. */
  private clicked: Vec | null = null;

  constructor(private readonly sheet: Board) {}

  hint(): [string] {
    return ["sheet.move_step"];
  }

  down(spot: Spot): void {
    const { bench } = this.sheet, several = bench.selection.value.length > 1, again = this.clicked && dist(this.clicked, spot.screen) < SLIP;
    // Several that are selected go together; what was clicked here last goes though something else lies over it.
    const chosen = several || again ? spot.under.find((each) => bench.has(each)) : undefined;
    this.doing = { what: "press", spot, item: chosen ?? spot.under[0] ?? null };
  }

  move(spot: Spot): void {
    const { doing } = this;
    if (doing?.what === "press" && dist(doing.spot.screen, spot.screen) > SLIP) this.begin(doing.spot, doing.item);
    switch (this.doing?.what) {
      case "box": this.doing.to = spot.screen; break;
      case "joint": this.drag(this.doing, spot); break;
      case "turn": this.doing.grip.to(spot.free); break;
      case "shift": this.shift(this.doing, spot); break;
    }
  }

  private begin(spot: Spot, item: Item | null): void {
    const { sheet } = this, { bench, scene } = sheet, session = sheet.solved;
    if (item && !bench.has(item) && !spot.shift) bench.select(item);
    const point = item?.kind === "point" ? scene.points.get(item.name) : undefined;
    if (!item || (item.kind !== "point" && item.kind !== "link")) {
      this.doing = { what: "box", from: spot.screen, to: spot.screen };
    } else if (session && point?.key) {
      bench.page.play(false);
      session.begin();
      session.held = true;
      this.doing = { what: "joint", session, key: point.key, name: point.name, base: { ...session.model.values }, off: minus(point.at, spot.free) };
      sheet.measured = point.links;
    } else if (session && item.kind === "link") {
      bench.page.play(false);
      this.doing = { what: "turn", grip: new Grip(sheet, session, item.name, spot.free) };
    } else {
      const names = bench.has(item) ? pointsOf(sheet, bench.selection.value) : pointsOf(sheet, [item]), alone = item.kind === "link" && bench.selection.value.length < 2;
      const fixed = alone ? names.filter((name) => scene.points.get(name)!.fixed) : [];
      const free = alone ? names.filter((name) => !fixed.includes(name)) : names;
      this.doing = {
        what: "shift", from: spot.free, name: item.name, about: fixed.length === 1 ? scene.at(fixed[0]) : null,
        places: Object.fromEntries(free.map((name) => [name, scene.at(name)!])),
      };
      sheet.measured = Object.keys(scene.links).filter((link) => scene.links[link].some((name) => free.includes(name)));
    }
  }

  avoid(): string[] {
    return this.doing?.what === "shift" ? Object.keys(this.doing.places) : this.doing?.what === "joint" ? [this.doing.name] : [];
  }

  private drag({ session, key, base, off }: Extract<Doing, { what: "joint" }>, spot: Spot): void {
    const { bench, place } = this.sheet, to = spot.snap?.kind === "grid" && !spot.alt ? spot.place : plus(spot.free, off);
    session.model.drag(base, key, place, ...to);
    session.moved();
    const wall = bench.page.wall(session, session.model.wall);
    bench.refusal.value = wall ? { sentence: wall, at: spot.free } : null;
  }

  /** Points go with the pointer, or turn about the pivot of their link. */
  private shift({ places, from, about }: Extract<Doing, { what: "shift" }>, spot: Spot): void {
    const names = Object.keys(places), lifted: Record<string, Vec> = {};
    if (about) {
      const turn = heading(about, spot.free) - heading(about, from);
      for (const name of names) lifted[name] = plus(about, polar(dist(about, places[name]), heading(about, places[name]) + turn));
    } else {
      // One point goes where the pointer snaps to; several keep their shape, by steps of the grid.
      const way = names.length === 1 ? minus(spot.place, places[names[0]]) : minus(spot.snap?.kind === "grid" ? spot.place : spot.free, this.sheet.snapped(from, spot.alt));
      for (const name of names) lifted[name] = plus(places[name], way);
    }
    this.sheet.lift(lifted);
  }

  up(spot: Spot): void {
    const { doing, sheet } = this;
    this.doing = null;
    sheet.measured = [];
    switch (doing?.what) {
      case "press": return this.click(spot);
      case "box": return this.box(doing.from, doing.to, spot.shift);
      case "joint": {
        doing.session.held = false;
        return doing.session.end(true);
      }
      case "shift": void this.put(doing, spot);
    }
  }

  /** The first element under the pointer, or the one below that which is selected. */
  private click({ under, shift, screen }: Spot): void {
    this.clicked = screen;
    const { bench } = this.sheet, before = under.findIndex((each) => same(each, bench.one)), item = under[before < 0 ? 0 : (before + 1) % under.length];
    if (!item) {
      if (!shift) bench.select();
    } else if (!shift) bench.select(item);
    else if (bench.has(under[0])) bench.select(...bench.selection.value.filter((each) => !same(each, under[0])));
    else bench.select(...bench.selection.value, under[0]);
    if (item) this.sheet.speak(item);
  }

  private box(from: Vec, to: Vec, shift: boolean): void {
    const { bench, scene, camera } = this.sheet, found = boxed(from, to, to[0] >= from[0], scene, camera);
    bench.select(...(shift ? bench.selection.value.filter((each) => !found.some((item) => same(item, each))) : []), ...found);
  }

  /** Writes where points have been put; a free end on a joint becomes that joint, on a link a point of it. */
  private async put({ places, about }: Extract<Doing, { what: "shift" }>, { snap }: Spot): Promise<void> {
    const { sheet } = this, names = Object.keys(places), { lifted } = sheet, [name] = names;
    if (!lifted) return;
    const end = names.length === 1 && !about && sheet.loose(name), points = { ...lifted }, locked = [...sheet.bench.locked.value];
    if (end && snap?.kind === "point") await sheet.act([{ do: "merge", from: name, into: snap.name }]);
    else if (end && snap?.kind === "link") await sheet.act([{ do: "move", points, locked }, { do: "add_point", link: snap.name, point: name, at: lifted[name] }]);
    else await sheet.act([{ do: "move", points, locked }]);
    sheet.lift(null);
  }

  escape(): boolean {
    const { doing, sheet } = this;
    this.doing = null;
    sheet.measured = [];
    if (doing?.what === "joint") {
      doing.session.model.change(doing.base);
      doing.session.held = false;
      doing.session.end();
      sheet.bench.refusal.value = null;
    }
    if (doing?.what === "turn") doing.grip.back();
    sheet.lift(null);
    return doing !== null;
  }

  leave(): void {
    this.escape();
  }

  draw(over: Overlay): void {
    const { doing } = this;
    if (doing?.what !== "box") return;
    const [[a, b], [c, d]] = [doing.from, doing.to];
    over.path(`M${a} ${b}H${c}V${d}H${a}Z`, c >= a ? "box" : "box dashed");
  }
}


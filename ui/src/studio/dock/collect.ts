// Points and poses set on the sheet by hand: a click sets one, a drag gives a pose its direction or moves one that is there.
import { line } from "../../strokes";
import type { Vec } from "../../shapes";
import type { Bench } from "../bench";
import { lay } from "./foresee";

type Row = (number | null)[];

export interface Collected {
  /** Columns x, y and for poses the angle; mm and degrees. */
  rows: Row[];
  poses: boolean;
  most: number;
  set: (rows: Row[]) => void;
}

// How near a press takes a point that is there, and how far a drag gives a direction, px; an arm of a pose, px; steps of
// angles that are drawn, deg.
const NEAR = 12, FAR = 16, ARM = 34, STEP = 5;

const near = (a: Vec, b: Vec) => Math.hypot(a[0] - b[0], a[1] - b[1]);
/** A length in mm with the digits that a zoom shows. */
const rounded = (metres: number, scale: number) => {
  const fine = 10 ** Math.max(0, Math.ceil(Math.log10(scale / 1e3)));
  return Math.round(metres * 1e3 * fine) / fine;
};

/** Takes presses on the sheet until it is ended; `now` gives what is there, and takes what changes. */
export function collect(bench: Bench, now: () => Collected): () => void {
  const sheet = bench.sheet.value, host = document.querySelector<HTMLElement>(".stage .paper");
  if (!sheet || !host) return () => {};
  const { camera } = sheet;
  let held: { row: number; moves: boolean; from: Vec } | null = null;
  const screen = (event: PointerEvent): Vec => {
    const box = host.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const at = (row: Row): Vec => camera.screen([row[0]! / 1e3, row[1]! / 1e3]);
  const placed = (event: PointerEvent): [number, number] => {
    const snapped = !event.altKey && sheet.spot && near(sheet.spot.screen, screen(event)) < 2 ? sheet.spot.place : camera.world(screen(event));
    return [rounded(snapped[0], camera.scale), rounded(snapped[1], camera.scale)];
  };
  const put = (row: number, values: Row) => now().set(now().rows.map((each, k) => (k === row ? values : each)));
  const take = (event: PointerEvent) => {
    event.preventDefault();
    event.stopImmediatePropagation();
  };
  const down = (event: PointerEvent) => {
    if (event.button) return;
    take(event);
    const { rows, poses, most } = now(), whole = rows.filter((row) => row[0] !== null && row[1] !== null), from = screen(event);
    const found = rows.findIndex((row) => row[0] !== null && row[1] !== null && near(at(row), from) < NEAR);
    host.setPointerCapture(event.pointerId);
    if (found >= 0) held = { row: found, moves: true, from };
    else {
      const kept = whole.length >= most ? whole.slice(0, most - 1) : whole;
      now().set([...kept, [...placed(event), ...(poses ? [0] : [])]]);
      held = { row: kept.length, moves: false, from };
    }
  };
  const move = (event: PointerEvent) => {
    if (!held) return;
    take(event);
    const row = now().rows[held.row], pointer = screen(event);
    if (!row) return;
    if (held.moves || !now().poses) return put(held.row, [...placed(event), ...row.slice(2)]);
    if (near(pointer, held.from) < FAR) return;
    const angle = (Math.atan2(held.from[1] - pointer[1], pointer[0] - held.from[0]) * 180) / Math.PI;
    put(held.row, [row[0], row[1], event.altKey ? Math.round(angle * 10) / 10 : STEP * Math.round(angle / STEP)]);
  };
  const up = (event: PointerEvent) => {
    if (!held) return;
    take(event);
    held = null;
  };
  const listeners = [["pointerdown", down], ["pointermove", move], ["pointerup", up], ["pointercancel", up]] as const;
  for (const [name, listener] of listeners) host.addEventListener(name, listener, true);
  return () => {
    for (const [name, listener] of listeners) host.removeEventListener(name, listener, true);
  };
}

/** Draws points and poses over the sheet, in their order. */
export function drawRows(bench: Bench, name: string, rows: Row[], poses: boolean): void {
  const whole = rows.filter((row) => row[0] !== null && row[1] !== null);
  lay(bench, name, whole.length ? (over, place) => {
    const at = whole.map((row) => place([row[0]! / 1e3, row[1]! / 1e3]));
    if (!poses) over.path(line(at), "ghost");
    whole.forEach((row, k) => {
      const [x, y] = at[k], angle = ((row[2] ?? NaN) * Math.PI) / 180;
      if (Number.isFinite(angle)) {
        const [c, s] = [Math.cos(angle), -Math.sin(angle)], corner = (along: number, across: number): Vec => [x + along * c - across * s, y + along * s + across * c];
        over.path(line([corner(0, -7), corner(ARM, -7), corner(ARM + 7, 0), corner(ARM, 7), corner(0, 7)], true), "input fill");
      }
      over.circle(at[k], 4.5, "input pin");
      over.text([x, y - 12], String(k + 1), "strong");
    });
  } : null);
}

// Which curves are shown: chosen by hand, else the usual ones of the machine.
import { type Signal, signal } from "@preact/signals";
import type { Session } from "../../session";
import type { Bench } from "../bench";

interface Chosen {
  /** Null: as the machine suggests. */
  ids: string[] | null;
  table: boolean;
}

const known = new WeakMap<Bench, Signal<Chosen>>();
/** The sorts of curves that a machine begins with, by the beginnings of their names, in their order. */
const FIRST = [/^m:/, /^effort:/, /^r:/, /^(sv|w):/];

function of(bench: Bench): Signal<Chosen> {
  const found = known.get(bench) ?? signal<Chosen>({ ids: null, table: false });
  known.set(bench, found);
  return found;
}

/** The curves of a machine that nobody has chosen: transmission angle, torque, joint force and rate of its output. */
function usual({ data }: Session): string[] {
  const rest = data.curves, found = FIRST.flatMap((sort) => rest.find((id) => sort.test(id)) ?? []);
  return [...found, ...rest.filter((id) => !found.includes(id))];
}

export function chosenOf(bench: Bench, session: Session): { ids: string[]; table: boolean } {
  const { ids, table } = of(bench).value, most = bench.layout.value === "large" ? 6 : 4;
  return { ids: ids ?? usual(session).slice(0, most), table };
}

export function remember(bench: Bench, change: Partial<Chosen>): void {
  const chosen = of(bench);
  chosen.value = { ...chosen.value, ...change };
}

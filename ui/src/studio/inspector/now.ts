// What the machine does at the position that is shown, for panes that are read and not followed by the eye.
import { untracked } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Vec } from "../../shapes";
import type { Bench } from "../bench";

/** Numbers change as often as this, ms; panes are rendered again when the machine has rested as long. */
const PACE = 120;

/** The position that is shown; renders again when the machine comes to rest, and never while it plays. */
export function useNow(bench: Bench): number {
  const [, again] = useState(0), session = bench.session.value, { page } = bench;
  void [session?.calm.value, page.playing.value];
  useEffect(() => {
    let timer = 0;
    const rested = () => void (page.playing.peek() || again((count) => count + 1));
    const look = () => {
      window.clearTimeout(timer);
      if (!page.playing.peek()) timer = window.setTimeout(rested, PACE);
    };
    const ends = [page.phase.subscribe(look), session?.version.subscribe(look)];
    return () => {
      for (const end of ends) end?.();
      window.clearTimeout(timer);
    };
  }, [session]);
  return indexNow(bench);
}

/** Writes what is shown into the page as it changes, as often as can be read, without a rendering. */
export function useLive(bench: Bench | undefined, write: ((index: number) => void) | undefined): void {
  const session = bench?.session.value, latest = useRef(write);
  useLayoutEffect(() => void (latest.current = write));
  useEffect(() => {
    let timer = 0;
    const look = () => (timer ||= window.setTimeout(() => {
      timer = 0;
      if (bench) latest.current?.(indexNow(bench));
    }, PACE));
    const ends = bench && write && session ? [bench.page.phase.subscribe(look), session.version.subscribe(look)] : [];
    return () => {
      for (const end of ends) end();
      window.clearTimeout(timer);
    };
  }, [session, !write]);
}

/** The position that is shown, for one who does not follow it. */
const indexNow = ({ session, page }: Bench) => untracked(() => (session.value ? page.index(session.value) : 0));

/** The key of a point among the rows of the machine, by its name in the text. */
export function keyOf(bench: Bench, name: string): string | null {
  const { value: session } = bench.session, links = bench.desk.solved.value.picture?.links ?? {};
  const keys = session?.data.points.map(({ key }) => key) ?? [];
  const own = Object.keys(links).filter((link) => links[link].includes(name)).map((link) => `${link}.${name}`);
  return [name, ...own, `frame.${name}`].find((key) => keys.includes(key)) ?? null;
}

/** Where a point is at a position, m. */
export function placeOf(bench: Bench, name: string, index: number): Vec | null {
  const { value: session } = bench.session, key = keyOf(bench, name);
  if (session && key) return ["x", "y"].map((axis) => session.model.main.row(`p:${key}.${axis}`)[index]) as Vec;
  return bench.desk.solved.value.picture?.points[name] ?? null;
}

/** A row of numbers of the machine at a position; NaN where it has none. */
export function rowAt(bench: Bench, id: string, index: number): number {
  const { value: session } = bench.session;
  return session && id in session.model.signals ? session.model.row(id)[index] : NaN;
}

// What the parts of the machine take up, as the server finds it: outlines at once, layers and what collides after them.
import { effect } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Vec } from "../shapes";
import type { Bench } from "./bench";

/** An outline about a point of its link and along this, mm, y downwards; `along`: rows of its direction, null: the frame. */
export interface PartOutline {
  name: string;
  sort: string;
  link: string;
  at: string;
  along: string | null;
  path: string;
  colour: string;
  layer?: number | null;
}

/** A sentence about a position; `share`: of the cycle, null: of none. */
export interface Placed {
  sentence: string;
  share: number | null;
}

export interface Room {
  outlines: PartOutline[];
  /** Width and thickness by link, m. */
  sizes: Record<string, { width: number; thickness: number }>;
  /** From the frame up. */
  layers: { number: number; plates: string[] }[];
  gap: (Placed & { pair: [string, string]; size: number; text: string; share: number; place: Vec }) | null;
  /** Pairs that no layers keep apart, with the shares of the cycle in which they are too near. */
  collisions: { pair: [string, string]; spans: [number, number][] }[];
  conflicts: Placed[];
  remedies: string[];
  notes: string[];
  /** Why there are none. */
  sentence: string;
  /** Whether layers have been looked for. */
  layered: boolean;
}

/** Rest after a change before it is asked, ms. */
const REST = 120;

/** Asks for the room of the machine while somebody looks at it; the answer for the latest text stays. */
export function keepRoom(bench: Bench): () => void {
  const { desk, page } = bench;
  let wanted: { text: string; language: string } | null = null, timer = 0, arranging = false, open = 0;
  const ask = async (asked: typeof wanted & object, layered: boolean) => {
    const found = await desk.ask<Omit<Room, "layered">>("room", { text: asked.text, layered });
    if (asked !== wanted) return;
    if (!found) wanted = null;
    else if (layered || !bench.room.peek()) bench.room.value = { ...found, layered };
    else bench.room.value = { ...bench.room.peek()!, outlines: found.outlines, sizes: found.sizes, sentence: found.sentence };
  };
  // Layers may take seconds: they are looked for once at a time.
  const arrange = async () => {
    if (arranging) return;
    arranging = true;
    for (let last = null as typeof wanted; wanted && last !== wanted; ) await ask((last = wanted), true);
    arranging = false;
  };
  return effect(() => {
    const text = desk.text.value, language = page.language.value;
    if (open !== desk.opens.value) {
      open = desk.opens.value;
      bench.room.value = wanted = null;
    }
    window.clearTimeout(timer);
    if (!bench.session.value || desk.solved.value.text !== text || !looksAt(bench) || (wanted?.text === text && wanted.language === language)) return;
    timer = window.setTimeout(() => {
      wanted = { text, language };
      void ask(wanted, false).then(arrange);
    }, REST);
  });
}

/** Whether anything that is shown is about room. */
const looksAt = (bench: Bench) => bench.shows("outlines") || bench.lookers.value > 0;

/** The room of the machine, which is asked for as long as this is shown. */
export function useRoom(bench: Bench): Room | null {
  useEffect(() => {
    bench.lookers.value++;
    return () => void bench.lookers.value--;
  }, []);
  return bench.room.value;
}

/** Whether a share of the cycle is in a span of shares. */
export const within = (share: number, [from, to]: [number, number], closed: boolean) => [0, ...(closed ? [-1, 1] : [])].some((turn) => share + turn >= from && share + turn <= to);

// Small drawings of machines in lists, asked one at a time and only for what is in sight.
import { useEffect, useRef, useState } from "preact/hooks";
import type { Bench } from "../bench";
import { type Stroke, Strokes } from "../sheet/first";

const known = new Map<string, Stroke[]>();
let queue: Promise<unknown> = Promise.resolve();

function asked(bench: Bench, id: string, machine: { name?: string; gallery?: string }, wanted: () => boolean): Promise<Stroke[] | null> {
  const found = queue.then(async () => {
    if (!known.has(id) && wanted()) known.set(id, (await bench.desk.ask<{ strokes: Stroke[] }>("thumbnail", machine))?.strokes ?? []);
    return known.get(id) ?? null;
  });
  queue = found;
  return found;
}

/** `id`: another one for each state of a drawing. */
export function Thumb({ bench, id, machine }: { bench: Bench; id: string; machine: { name?: string; gallery?: string } }) {
  const host = useRef<HTMLSpanElement>(null), [strokes, setStrokes] = useState<Stroke[]>(known.get(id) ?? []);
  useEffect(() => {
    if (known.has(id)) return setStrokes(known.get(id)!);
    let live = true;
    const observer = new IntersectionObserver((seen) => {
      if (!seen.some(({ isIntersecting }) => isIntersecting)) return;
      observer.disconnect();
      void asked(bench, id, machine, () => live).then((found) => live && found && setStrokes(found));
    });
    observer.observe(host.current!);
    return () => {
      live = false;
      observer.disconnect();
    };
  }, [id]);
  return <span class="thumb-box" ref={host}><Strokes size={[132, 74]} strokes={strokes} /></span>;
}

// The sheet in the middle of the window, and what floats over it: hint, values in hand, refusals, the callout of a gap, what is shown.
import { useLayoutEffect, useRef } from "preact/hooks";
import { View } from "../../view";
import type { Bench } from "../bench";

export function Stage({ bench }: { bench: Bench }) {
  const host = useRef<HTMLDivElement>(null), session = bench.session.value;
  useLayoutEffect(() => {
    if (!session) return;
    const view = (session.view = new View(session.model, host.current!, session.shown));
    const observer = new ResizeObserver(([{ contentRect: box }]) => view.resize(box.width, box.height));
    observer.observe(host.current!);
    view.draw(bench.page.index(session));
    return () => {
      observer.disconnect();
      view.end();
      view.svg.remove();
    };
  }, [session]);
  return <main class="stage"><div class="paper" ref={host} /></main>;
}

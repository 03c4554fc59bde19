// The hodograph of a point: the tip of its velocity over the cycle, with the velocity that it has now.
import { effect } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { Hodograph } from "../../chart";
import type { Session } from "../../session";
import type { Bench } from "../bench";

export function HodographPlot({ bench, session, point, name }: { bench: Bench; session: Session; point: string; name: string }) {
  const host = useRef<HTMLDivElement>(null), { page } = bench;
  useLayoutEffect(() => {
    const drawn = new Hodograph(host.current!), { main } = session.model;
    let seen = "";
    const stop = effect(() => {
      const version = `${session.version.value} ${page.language.value}`;
      const [x, y] = ["x", "y"].map((axis) => main.row(`v:${point}.${axis}`)), index = page.index(session);
      if (version !== seen) drawn.set(bench.say("insp.hodograph_of", { name }), x, y, session.data.positions.closed);
      seen = version;
      drawn.cursor(x[index], y[index]);
    });
    return () => {
      stop();
      drawn.svg.remove();
    };
  }, [session, point]);
  return <div class="hodograph-host" ref={host} />;
}

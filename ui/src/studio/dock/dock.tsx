// The dock below the sheet: the time line, and curves, sweep, synthesis, optimisation and comparison behind tabs.
import { useEffect } from "preact/hooks";
import type { Session } from "../../session";
import { drawnPhase } from "../sheet/drawn";
import { type Bench, type DockName, DOCKS } from "../bench";
import { Compare } from "./compare";
import { Curves, CurvesHead } from "./curves";
import { Optimise } from "./optimise";
import { Running } from "./run";
import { Sweep, SweepHead } from "./sweeping";
import { Progress, Synthesis } from "./synthesis";
import { beginning, TimeLine } from "./transport";

export function Dock({ bench }: { bench: Bench }) {
  const open = bench.dock.value, session = bench.session.value;
  useEffect(() => {
    if (!session || session.data.positions.count < 2 || opened === bench.desk.name.value) return;
    opened = bench.desk.name.value;
    begin(bench, session);
  }, [session, bench.desk.name.value]);
  return (
    <section class={open ? "dock open" : "dock"} aria-label={bench.say("dock")}>
      <TimeLine bench={bench} />
      <div class="dock-head">
        <Tabs bench={bench} />
        {open === "curves" && session && <CurvesHead bench={bench} session={session} />}
        {open === "sweep" && session && <SweepHead bench={bench} session={session} />}
        {open === "optimise" && <Progress bench={bench} kinds={["optimum"]} />}
        {open === "synthesis" && <Progress bench={bench} kinds={["curve", "synthesis"]} />}
        {open === "run" && <Progress bench={bench} kinds={["run"]} />}
      </div>
      {open && <div class="dock-panel" role="tabpanel" id="dock-panel" aria-label={bench.say(`dock.${open}`)}><Panel bench={bench} name={open} /></div>}
    </section>
  );
}

function Panel({ bench, name }: { bench: Bench; name: DockName }) {
  const session = bench.session.value;
  if (name === "synthesis") return <Synthesis bench={bench} />;
  if (name === "run" && bench.desk.solved.value.outline) return <Running bench={bench} />;
  if (!session || session.data.positions.count < 2) return <p class="no-curves">{bench.say("dock.no_machine")}</p>;
  if (name === "curves") return <Curves key={session} bench={bench} session={session} />;
  if (name === "sweep") return <Sweep bench={bench} session={session} />;
  if (name === "optimise") return <Optimise bench={bench} session={session} />;
  if (name === "compare") return <Compare bench={bench} session={session} />;
  return null;
}

/** The file for which it was set to its beginning. */
let opened = "";

/** The first machine of a file: shown where it is drawn, at a speed that can be looked at, with its curves. */
function begin({ page, dock }: Bench, session: Session): void {
  [page.paced, page.pace.value] = [true, beginning(session)];
  page.phase.value = drawnPhase(session);
  if (session.data.signals.length) dock.value ??= "curves";
}

function Tabs({ bench }: { bench: Bench }) {
  const open = bench.dock.value;
  const choose = (name: DockName) => (bench.dock.value = open === name ? null : name);
  const key = (event: KeyboardEvent) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const all = [...(event.currentTarget as HTMLElement).querySelectorAll("button")], here = all.indexOf(document.activeElement as HTMLButtonElement);
    all.at((here + step) % all.length)?.focus();
  };
  return (
    <div class="dock-tabs" role="tablist" aria-label={bench.say("dock")} onKeyDown={key}>
      {DOCKS.map((each, k) => (
          <button
            key={each} id={`dock-tab-${each}`} role="tab" aria-selected={each === open} aria-controls={each === open ? "dock-panel" : undefined}
            tabIndex={each === open || (!open && k === 0) ? 0 : -1} onClick={() => choose(each)}
          >{bench.say(`dock.${each}`)}</button>
        ))}
    </div>
  );
}

// The dock below the sheet: time line, curves, sweep, synthesis, optimisation, comparison.
import { type Bench, DOCKS } from "../bench";

export function Dock({ bench }: { bench: Bench }) {
  return (
    <section class="dock">
      <div role="tablist">{DOCKS.map((each) => <button key={each} role="tab" aria-selected={each === bench.dock.value} onClick={() => (bench.dock.value = bench.dock.value === each ? null : each)}>{each}</button>)}</div>
    </section>
  );
}

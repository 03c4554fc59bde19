// The inspector at the right: what is selected, and tabs for numbers, findings, structure and text.
import { type Bench, TABS } from "../bench";

export function Inspector({ bench }: { bench: Bench }) {
  return (
    <aside class="inspector">
      <div role="tablist">{TABS.map((tab) => <button key={tab} role="tab" aria-selected={tab === bench.tab.value} onClick={() => (bench.tab.value = tab)}>{tab}</button>)}</div>
    </aside>
  );
}

// The inspector at the right: what is selected, and tabs for numbers, findings, structure and text.
import { useEffect, useState } from "preact/hooks";
import { type Bench, type Tab, TABS } from "../bench";
import { unseen } from "./fields";
import { Findings, findingsOf } from "./findings";
import { Numbers } from "./numbers";
import { Selected } from "./selected";
import { Structure } from "./structure";
import { TextPane } from "./text";

/** From this size of the window on it is split: what is selected above, the other tabs below. */
const LARGE = "(min-width: 1920px) and (min-height: 1200px)";

const useMedia = (query: string) => {
  const [matches, set] = useState(() => matchMedia(query).matches);
  useEffect(() => {
    const media = matchMedia(query), look = () => set(media.matches);
    media.addEventListener("change", look);
    return () => media.removeEventListener("change", look);
  }, [query]);
  return matches;
};

export function Inspector({ bench }: { bench: Bench }) {
  unseen.tell = (sentence) => (bench.page.note.value = sentence);
  const large = useMedia(LARGE), [below, setBelow] = useState<Tab>("numbers"), tab = bench.tab.value;
  useEffect(() => {
    if (tab !== "inspect") setBelow(tab);
  }, [tab]);
  const label = bench.say("insp.region");
  if (!large) return <aside class="inspector insp" aria-label={label}><Half bench={bench} tabs={TABS} tab={tab} /></aside>;
  return (
    <aside class="inspector insp" aria-label={label}>
      <Half bench={bench} tabs={["inspect"]} tab="inspect" />
      <Half bench={bench} tabs={TABS.filter((each) => each !== "inspect")} tab={below} />
    </aside>
  );
}

function Half({ bench, tabs, tab }: { bench: Bench; tabs: readonly Tab[]; tab: Tab }) {
  return (
    <div class="half">
      <Tabs bench={bench} tabs={tabs} tab={tab} />
      <div class="pane" role="tabpanel" id={`pane-${tab}`} aria-labelledby={`tab-${tab}`} key={tab}><Pane bench={bench} tab={tab} /></div>
    </div>
  );
}

/** Tabs with their marks; the arrows walk through them. */
export function Tabs({ bench, tabs, tab }: { bench: Bench; tabs: readonly Tab[]; tab: Tab }) {
  const found = findingsOf(bench);
  const walk = (event: KeyboardEvent) => {
    const place = tabs.indexOf(tab), step = { ArrowRight: place + 1, ArrowLeft: place - 1, Home: 0, End: tabs.length - 1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const next = tabs[(step + tabs.length) % tabs.length], list = (event.currentTarget as HTMLElement).children;
    bench.tab.value = next;
    (list[tabs.indexOf(next)] as HTMLElement).focus();
  };
  return (
    <div class="tabs" role="tablist" aria-label={bench.say("insp.region")} onKeyDown={walk}>
      {tabs.map((each) => {
        const count = each === "findings" ? found.length : 0, bad = found.some(({ severity }) => severity === "error");
        return (
          <button key={each} type="button" role="tab" id={`tab-${each}`} aria-selected={each === tab} aria-controls={each === tab ? `pane-${each}` : undefined} tabIndex={each === tab ? 0 : -1} onClick={() => (bench.tab.value = each)}>
            {bench.say(`insp.tab_${each}`)}{count > 0 && <span class={bad ? "mark bad" : "mark"}>{count}</span>}
          </button>
        );
      })}
    </div>
  );
}

/** What a tab shows, under its name for those who hear it; the same at the right of the sheet and in the drawer of a phone. */
export function Pane({ bench, tab }: { bench: Bench; tab: Tab }) {
  return (
    <>
      {tab !== "inspect" && <h2 class="unseen">{bench.say(`insp.tab_${tab}`)}</h2>}
      <Shown bench={bench} tab={tab} />
    </>
  );
}

function Shown({ bench, tab }: { bench: Bench; tab: Tab }) {
  switch (tab) {
    case "inspect": return <Selected bench={bench} />;
    case "numbers": return <Numbers bench={bench} />;
    case "findings": return <Findings bench={bench} />;
    case "structure": return <Structure bench={bench} />;
    case "text": return <TextPane bench={bench} />;
  }
}

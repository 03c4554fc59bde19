// The room on a phone: bar, sheet, a drawer with inspector and curves, a strip of tools under the thumb.
import { useEffect, useRef, useState } from "preact/hooks";
import { type Bench, type DockName, type Tab, TABS, TOOLS } from "../bench";
import { Dock } from "../dock/dock";
import { Pane } from "../inspector/inspector";
import { Stage } from "../sheet/stage";
import { exportCommands } from "./commands";
import { DialogFrame } from "./dialog";
import { Icon } from "./icons";
import { type Choices, MenuButton, showMenu } from "./menu";
import { GROUPS, STRIP, ToolButton } from "./rail";
import { share } from "./sharing";
import { Said } from "./status";
import { Strips } from "./strips";
import { fileChoices, Name, State, Steps, themes } from "./topbar";
import { Square } from "./controls";

export function PhoneRoom({ bench }: { bench: Bench }) {
  return (
    <div class={`room phone drawer-${bench.drawer.value}`}>
      <PhoneBar bench={bench} />
      <Strips bench={bench} />
      <Stage bench={bench} />
      <div class="fab"><Square icon="fit" name={bench.say("zoom.fit")} act={() => bench.view?.fit()} /></div>
      <Said bench={bench} brief />
      <Drawer bench={bench} />
      <Strip bench={bench} />
    </div>
  );
}

function PhoneBar({ bench }: { bench: Bench }) {
  const bar = useRef<HTMLElement>(null), name = bench.say("menu"), other = bench.page.language.value === "en" ? "zh" : "en";
  const choices = (): Choices => [
    ...fileChoices(bench), null,
    { label: `${bench.say("export")}…`, icon: "export", act: () => below(bench.say("export"), exportCommands(bench)) },
    { label: bench.say("palette"), icon: "search", act: () => (bench.dialog.value = { kind: "palette" }) },
    { label: other === "zh" ? "中文" : "English", icon: "info", act: () => bench.speak(other) },
    { label: `${bench.say("theme")}…`, icon: "sun", act: () => below(bench.say("theme"), themes(bench)) },
    { label: bench.say("keys.title"), icon: "keyboard", act: () => (bench.dialog.value = { kind: "keys" }) },
  ];
  const below = (label: string, more: Choices) => showMenu(label, bar.current!.querySelector("button")!, more);
  return (
    <header class="top" ref={bar}>
      <MenuButton label={name} name={name} class="square" choices={choices}><Icon name="menu" /></MenuButton>
      <div class="phone-name"><Name bench={bench} /><State bench={bench} /></div>
      <Steps bench={bench} />
      <Square icon="share" name={bench.say("share")} act={() => void share(bench)} size={20} />
    </header>
  );
}

function Strip({ bench }: { bench: Bench }) {
  const { tool } = bench, tools = STRIP.includes(tool.value) ? STRIP : [...STRIP.slice(0, -1), tool.value], count = String(TOOLS.length);
  return (
    <nav class="tool-strip" aria-label={bench.say("tools")}>
      {tools.map((name) => <ToolButton key={name} bench={bench} name={name} tabIndex={0} size={22} />)}
      <button class="tool" onClick={() => (bench.dialog.value = { kind: "tools" })}><Icon name="plus" size={22} /><span class="tool-name">{bench.say("tools.all", { count })}</span></button>
    </nav>
  );
}

/** All tools, with their names. */
export function ToolSheet({ bench }: { bench: Bench }) {
  const first = useRef(bench.tool.value), { tool } = bench;
  useEffect(() => {
    if (tool.value !== first.current) bench.dialog.value = null;
  }, [tool.value]);
  return (
    <DialogFrame bench={bench} title={bench.say("tools")} class="tool-sheet">
      <div class="tool-groups" role="toolbar" aria-label={bench.say("tools")}>
        {GROUPS.map((group) => <div key={group[0]}>{group.map((name) => <ToolButton key={name} bench={bench} name={name} tabIndex={0} size={24} />)}</div>)}
      </div>
    </DialogFrame>
  );
}

type Part = Tab | DockName;
/** What the drawer holds: what is looked at most comes first. */
const PARTS: Part[] = ["inspect", "numbers", "findings", "curves", "run", "structure", "text", "sweep", "synthesis", "optimise", "compare"];
const HEIGHTS = ["handle", "half", "full"] as const;
const isTab = (part: Part): part is Tab => (TABS as readonly string[]).includes(part);
/** How far the handle is dragged until the drawer takes its next height, px. */
const FAR = 40;

function Drawer({ bench }: { bench: Bench }) {
  const { drawer, dock, tab } = bench, part: Part = dock.value ?? tab.value, moves = (bench.session.value?.data.positions.count ?? 0) > 1, [first, setFirst] = useState(true);
  const shut = drawer.value === "handle";
  // What another part of the room asks for comes to the front.
  useEffect(() => {
    if (!first) dock.value = null;
    setFirst(false);
  }, [tab.value]);
  const choose = (each: Part) => {
    if (isTab(each)) [dock.value, tab.value] = [null, each];
    else dock.value = each;
    if (shut) drawer.value = "half";
    else if (each === part) drawer.value = "handle";
  };
  return (
    <section class={moves ? "drawer moves" : "drawer"} aria-label={bench.say("drawer")}>
      <Grip bench={bench} />
      <Dock bench={bench} />
      <div class="drawer-tabs" role="tablist" aria-label={bench.say("drawer")} onKeyDown={walk}>
        {PARTS.map((each) => (
          <button
            key={each} id={`drawer-${each}`} role="tab" aria-selected={each === part && !shut} aria-controls={each === part && !shut ? (isTab(each) ? "drawer-pane" : "dock-panel") : undefined}
            tabIndex={each === part ? 0 : -1} onClick={() => choose(each)}
          >{bench.say(isTab(each) ? `insp.tab_${each}` : `dock.${each}`)}</button>
        ))}
      </div>
      {isTab(part) && !shut && <div class="pane insp" role="tabpanel" id="drawer-pane" aria-labelledby={`drawer-${part}`} key={part}><Pane bench={bench} tab={part} /></div>}
    </section>
  );
}

function walk(event: KeyboardEvent): void {
  const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (!step) return;
  event.preventDefault();
  const all = [...(event.currentTarget as HTMLElement).querySelectorAll("button")], here = all.indexOf(document.activeElement as HTMLButtonElement);
  all.at((here + step) % all.length)!.focus();
}

/** The handle: a touch takes the next height, a drag the one in its direction. */
function Grip({ bench }: { bench: Bench }) {
  const { drawer } = bench, at = HEIGHTS.indexOf(drawer.value), from = useRef<number | null>(null), dragged = useRef(false);
  const to = (k: number) => (drawer.value = HEIGHTS[Math.max(0, Math.min(HEIGHTS.length - 1, k))]);
  return (
    <button
      class="drawer-grip" aria-label={bench.say("drawer.height")} aria-expanded={drawer.value !== "handle"}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        [from.current, dragged.current] = [event.clientY, false];
      }}
      onPointerMove={(event) => {
        if (from.current === null || Math.abs(event.clientY - from.current) < FAR) return;
        to(at + (event.clientY < from.current ? 1 : -1));
        [from.current, dragged.current] = [event.clientY, true];
      }}
      onPointerUp={() => (from.current = null)} onPointerCancel={() => (from.current = null)}
      onClick={() => {
        if (!dragged.current) to(at === HEIGHTS.length - 1 ? 0 : at + 1);
        dragged.current = false;
      }}
      onKeyDown={(event) => {
        const step = { ArrowUp: 1, ArrowDown: -1 }[event.key];
        if (!step) return;
        event.preventDefault();
        event.stopPropagation();
        to(at + step);
      }}
    ><i aria-hidden="true" /></button>
  );
}


// The rail of tools at the left: names and keys, or icons alone.
import { useRef, useState } from "preact/hooks";
import { type Bench, SPRINGS, type ToolName } from "../bench";
import { KEYS } from "../tools/tool";
import { Icon } from "./icons";
import { showMenu } from "./menu";

export const GROUPS: ToolName[][] = [
  ["move"],
  ["pivot", "link", "plate", "slider", "slot", "weld"],
  ["gears", "rack", "cam"],
  ["drive", "force", "torque", "spring", "mass"],
  ["dimension", "target", "photo"],
  ["erase"],
];
const ORDER = GROUPS.flat();
/** How long a button is held until its variants are shown, ms. */
const HELD = 350;

/** The name of a tool, or of the variant that it has. */
export const nameOf = (bench: Bench, tool: ToolName) => bench.say(tool === "spring" ? `variant.${bench.spring.value}` : `tool.${tool}`);
export const iconOf = (bench: Bench, tool: ToolName) => (tool === "spring" ? bench.spring.value : tool);

/** Shows the variants of the spring at its button. */
export function showSprings(bench: Bench, at: HTMLElement, side: "right" | "below" = "right"): void {
  showMenu(bench.say("tool.spring"), at, SPRINGS.map((each) => ({
    label: bench.say(`variant.${each}`), icon: each, checked: bench.spring.value === each,
    act: () => {
      bench.spring.value = each;
      bench.tool.value = "spring";
    },
  })), side);
}

interface ToolProps {
  bench: Bench;
  name: ToolName;
  tabIndex: number;
  onFocus?: () => void;
  size?: number;
}

export function ToolButton({ bench, name, tabIndex, onFocus, size = 20 }: ToolProps) {
  const timer = useRef(0), held = useRef(false), label = nameOf(bench, name), variants = name === "spring", key = KEYS[name];
  const side = bench.layout.value === "phone" ? "below" : "right";
  const variant = (button: HTMLElement) => {
    window.clearTimeout(timer.current);
    if (variants) showSprings(bench, button, side);
  };
  return (
    <button
      class="tool" data-tool={name} aria-pressed={name === bench.tool.value} aria-keyshortcuts={key} aria-haspopup={variants ? "menu" : undefined}
      tabIndex={tabIndex} onFocus={onFocus} data-tip={label} data-keys={key} aria-label={label}
      onClick={() => {
        if (held.current) held.current = false;
        else bench.tool.value = name;
      }}
      onPointerDown={(event) => {
        const button = event.currentTarget;
        held.current = false;
        if (variants) timer.current = window.setTimeout(() => { held.current = true; variant(button); }, HELD);
      }}
      onPointerUp={() => window.clearTimeout(timer.current)} onPointerLeave={() => window.clearTimeout(timer.current)}
      onContextMenu={(event) => { event.preventDefault(); held.current = false; variant(event.currentTarget); }}
      onKeyDown={(event) => {
        if (!variants || event.key !== "ArrowRight") return;
        event.preventDefault();
        variant(event.currentTarget);
      }}
    >
      <Icon name={iconOf(bench, name)} size={size} />
      <span class="tool-name">{label}</span>
      {variants && <i class="corner" aria-hidden="true" />}
      <kbd aria-hidden="true">{key}</kbd>
    </button>
  );
}

export function Rail({ bench, slim }: { bench: Bench; slim: boolean }) {
  const host = useRef<HTMLDivElement>(null), [at, setAt] = useState<ToolName | null>(null), first = at ?? bench.tool.value;
  const fold = bench.say(slim ? "rail.names" : "rail.icons");
  const walk = (event: KeyboardEvent) => {
    const buttons = [...host.current!.querySelectorAll<HTMLElement>("button")], now = buttons.indexOf(document.activeElement as HTMLElement), last = buttons.length - 1;
    const next = { ArrowDown: now < last ? now + 1 : 0, ArrowUp: now > 0 ? now - 1 : last, Home: 0, End: last }[event.key];
    if (next === undefined || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    buttons[next].focus();
  };
  return (
    <div class={slim ? "rail slim" : "rail"} role="toolbar" aria-orientation="vertical" aria-label={bench.say("tools")} ref={host} onKeyDown={walk}>
      {GROUPS.map((group) => (
        <div class="tools-group" key={group[0]}>
          {group.map((name) => <ToolButton key={name} bench={bench} name={name} tabIndex={name === first ? 0 : -1} onFocus={() => setAt(name)} />)}
        </div>
      ))}
      <button class="tool fold" aria-pressed={slim} tabIndex={-1} data-tip={fold} aria-label={bench.say("rail.icons")} onClick={() => bench.set({ slim: !slim })}>
        <Icon name="rail" />
        <span class="tool-name">{fold}</span>
      </button>
    </div>
  );
}

/** The tools of the phone's strip; the others are one touch further. */
export const STRIP = ORDER.slice(0, 6);

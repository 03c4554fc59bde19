// Menus: one at a time, at a button or where the pointer is, over everything else.
import { signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";
import { Icon } from "./icons";
import { keyNames } from "./key_names";
import type { IconName } from "./signs";

export interface Choice {
  label: string;
  act: () => void;
  icon?: IconName;
  /** Keys or a word at its right. */
  keys?: string;
  /** One of several, or a switch. */
  checked?: boolean;
  /** Why it cannot be chosen now. */
  not?: string;
}

/** Choices; null is a line between groups. */
export type Choices = (Choice | null)[];

interface Open {
  label: string;
  anchor: DOMRect;
  side: "below" | "right";
  choices: Choices;
  opener: HTMLElement | null;
}

const GAP = 4, EDGE = 8;
const opened = signal<Open | null>(null);

/** Shows choices at a button, or at a place of the window. */
export function showMenu(label: string, at: HTMLElement | { x: number; y: number }, choices: Choices, side: "below" | "right" = "below"): void {
  const opener = at instanceof HTMLElement ? at : (document.activeElement as HTMLElement | null);
  const anchor = at instanceof HTMLElement ? at.getBoundingClientRect() : new DOMRect(at.x, at.y, 0, 0);
  opened.value = { label, anchor, side, choices, opener };
}

export function closeMenu(): void {
  const { value } = opened;
  opened.value = null;
  value?.opener?.focus();
}

/** Whether the menu of a button is open: its `aria-expanded`. */
export const isOpen = (opener: HTMLElement | null) => opener !== null && opened.value?.opener === opener;

interface ButtonProps {
  label: string;
  choices: () => Choices;
  class?: string;
  children: ComponentChildren;
  /** Its name, where its text is not that. */
  name?: string;
  tip?: string;
}

/** A button that shows choices. */
export function MenuButton({ label, choices, class: style = "ghost", children, name, tip }: ButtonProps) {
  const button = useRef<HTMLButtonElement>(null), shown = isOpen(button.current);
  return (
    <button
      ref={button} class={style} aria-haspopup="menu" aria-expanded={shown} aria-label={name} data-tip={tip}
      onClick={() => (shown ? closeMenu() : showMenu(label, button.current!, choices()))}
      onKeyDown={(event) => {
        if (event.key !== "ArrowDown") return;
        event.preventDefault();
        showMenu(label, button.current!, choices());
      }}
    >{children}</button>
  );
}

export function MenuHost() {
  const host = useRef<HTMLDivElement>(null), open = opened.value;
  useLayoutEffect(() => {
    if (!open) return;
    const box = host.current!, items = entries(box);
    if (typeof box.showPopover === "function") box.showPopover();
    put(box, open);
    // Where it is one of several, the one that holds; else the first.
    const of = open.choices[0]?.checked !== undefined ? items.findIndex((each) => each.getAttribute("aria-checked") === "true") : 0;
    items[Math.max(0, of)]?.focus();
    const outside = (event: Event) => {
      const at = event.target as Node;
      if (!box.contains(at) && !open.opener?.contains(at)) opened.value = null;
    };
    const shut = () => (opened.value = null);
    document.addEventListener("pointerdown", outside, true);
    window.addEventListener("blur", shut);
    window.addEventListener("resize", shut);
    return () => {
      document.removeEventListener("pointerdown", outside, true);
      window.removeEventListener("blur", shut);
      window.removeEventListener("resize", shut);
    };
  }, [open]);
  if (!open) return null;
  const choose = (choice: Choice) => {
    if (choice.not) return;
    closeMenu();
    choice.act();
  };
  return (
    <nav class="edges" aria-label={open.label}><div key={String(open.anchor.x + open.anchor.y)} class="menu" role="menu" popover="manual" ref={host} aria-label={open.label} onKeyDown={walk}>
      {open.choices.map((choice, k) => choice === null ? <hr key={k} /> : (
        <button
          key={k} role={choice.checked === undefined ? "menuitem" : "menuitemradio"} aria-checked={choice.checked} tabIndex={-1}
          aria-disabled={choice.not ? true : undefined} title={choice.not} onClick={() => choose(choice)} onPointerMove={(event) => event.currentTarget.focus()}
        >
          <span class="menu-sign">{choice.icon ? <Icon name={choice.icon} size={18} /> : choice.checked ? <Icon name="check" size={16} /> : null}</span>
          <span class="menu-text">{choice.label}</span>
          {choice.keys && <span class="menu-keys">{keyNames(choice.keys)}</span>}
        </button>
      ))}
    </div></nav>
  );
}

const entries = (box: HTMLElement) => [...box.querySelectorAll<HTMLElement>("[role^=menuitem]")];

function walk(event: KeyboardEvent): void {
  const items = entries(event.currentTarget as HTMLElement), at = items.indexOf(document.activeElement as HTMLElement), last = items.length - 1;
  const next = { ArrowDown: at < last ? at + 1 : 0, ArrowUp: at > 0 ? at - 1 : last, Home: 0, End: last }[event.key];
  if (next !== undefined) items[next]?.focus();
  else if (event.key === "Escape" || event.key === "Tab" || event.key === "ArrowLeft") closeMenu();
  else if (event.key.length === 1 && event.key !== " ") {
    const wanted = event.key.toLowerCase(), order = [...items.slice(at + 1), ...items.slice(0, at + 1)];
    order.find((each) => each.querySelector(".menu-text")!.textContent.trim().toLowerCase().startsWith(wanted))?.focus();
  } else return event.stopPropagation();
  event.preventDefault();
  event.stopPropagation();
}

/** Puts a menu at its button, where the window has room for it. */
function put(box: HTMLElement, { anchor, side }: Open): void {
  const { offsetWidth: wide, offsetHeight: tall } = box, { innerWidth, innerHeight } = window;
  let [x, y] = side === "right" ? [anchor.right + GAP, anchor.top] : [anchor.left, anchor.bottom + GAP];
  if (side === "below" && y + tall > innerHeight - EDGE && anchor.top - tall - GAP > EDGE) y = anchor.top - tall - GAP;
  x = Math.max(EDGE, Math.min(x, innerWidth - wide - EDGE));
  y = Math.max(EDGE, Math.min(y, innerHeight - tall - EDGE));
  [box.style.left, box.style.top] = [`${x}px`, `${y}px`];
}

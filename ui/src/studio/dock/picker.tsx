// Chooses what a curve shows, in three steps of words (what, of what, as), or by typing parts of them.
import { useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Session } from "../../session";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { asWhat, ofWhat, quantities, type Quantity, sentence, whatOf, CONTENTS, type Words } from "./quantities";
import { Name } from "./symbol";

interface Props {
  bench: Bench;
  session: Session;
  words: Words;
  /** Where it opens. */
  anchor: HTMLElement;
  chosen: string | null;
  choose: (id: string) => void;
  close: () => void;
}

const EDGE = 8, MOST = 60;

export function Picker({ bench, session, words, anchor, chosen, choose, close }: Props) {
  const host = useRef<HTMLDivElement>(null), field = useRef<HTMLInputElement>(null), all = useMemo(() => quantities(session), [session]);
  const first = all.find(({ id }) => id === chosen) ?? all[0];
  const [text, setText] = useState(""), [what, setWhat] = useState(first?.what), [of, setOf] = useState<string | null>(first ? `${first.of}|${first.on}` : null), [marked, mark] = useState(0);
  const { say } = bench;
  useLayoutEffect(() => {
    const box = host.current!, around = anchor.getBoundingClientRect();
    if (typeof box.showPopover === "function") box.showPopover();
    const left = Math.max(EDGE, Math.min(around.left, innerWidth - box.offsetWidth - EDGE)), over = around.top - box.offsetHeight - 4;
    [box.style.left, box.style.top] = [`${left}px`, `${over > EDGE ? over : Math.max(EDGE, Math.min(around.bottom + 4, innerHeight - box.offsetHeight - EDGE))}px`];
    field.current!.focus();
    const outside = (event: Event) => !box.contains(event.target as Node) && !anchor.contains(event.target as Node) && close();
    document.addEventListener("pointerdown", outside, true);
    return () => document.removeEventListener("pointerdown", outside, true);
  }, []);
  const take = (quantity: Quantity) => {
    close();
    choose(quantity.id);
    // The curve that is there now takes the focus of the one that was.
    setTimeout(() => (document.querySelector<HTMLElement>(`[data-curve="${CSS.escape(quantity.id)}"] .pick`) ?? anchor).focus());
  };
  const parts = text.toLowerCase().split(/[\s,，]+/).filter(Boolean);
  const matches = parts.length ? all.filter((each) => {
    const said = sentence(each, words).toLowerCase();
    return parts.every((part) => said.includes(part));
  }).slice(0, MOST) : [];
  const contents = CONTENTS.filter((each) => all.some((quantity) => quantity.what === each)), ofThese = all.filter((each) => each.what === what);
  const places = [...new Map(ofThese.map((each) => [`${each.of}|${each.on}`, each])).values()], ways = ofThese.filter((each) => `${each.of}|${each.on}` === of);
  const key = (event: KeyboardEvent) => {
    event.stopPropagation();
    if (event.key === "Escape") {
      close();
      anchor.focus();
    } else if (parts.length && (event.key === "ArrowDown" || event.key === "ArrowUp")) mark(Math.max(0, Math.min(matches.length - 1, marked + (event.key === "ArrowDown" ? 1 : -1))));
    else if (parts.length && event.key === "Enter" && matches[marked]) take(matches[marked]);
    else if (!parts.length && event.key.startsWith("Arrow")) walk(event, host.current!);
    else return;
    event.preventDefault();
  };
  return (
    <div class="picker" popover="manual" ref={host} role="dialog" aria-label={say("dock.choose_curve")} onKeyDown={key}>
      <label class="find">
        <Icon name="search" size={16} />
        <input
          ref={field} value={text} placeholder={say("dock.find_curve")} aria-label={say("dock.find_curve")} spellcheck={false} role="combobox" aria-expanded={parts.length > 0} aria-controls="dock-matches"
          aria-activedescendant={parts.length && matches[marked] ? `dock-match-${marked}` : undefined}
          onInput={(event) => { setText(event.currentTarget.value); mark(0); }}
        />
      </label>
      {parts.length > 0 ? (
        <>
          <ul role="listbox" id="dock-matches" aria-label={say("dock.choose_curve")}>
            {matches.map((each, k) => (
              <li key={each.id} role="option" id={`dock-match-${k}`} aria-selected={k === marked} onPointerEnter={() => mark(k)} onClick={() => take(each)}>{sentence(each, words)}</li>
            ))}
          </ul>
          {!matches.length && <p>{say("dock.no_match")}</p>}
          {!matches.length && !all.some((each) => each.what === "effort") && <p>{say("dock.no_forces")}</p>}
        </>
      ) : (
        <div class="picker-columns">
          <div role="group" aria-label={say("dock.what")}>
            <h3>{say("dock.what")}</h3>
            {contents.map((each) => {
              const one = all.find((quantity) => quantity.what === each)!;
              return (
                <button key={each} aria-pressed={each === what} onClick={() => { setWhat(each); setOf(`${one.of}|${one.on}`); }}>{whatOf(one, words)}<Icon name="chevron" size={14} /></button>
              );
            })}
          </div>
          <div role="group" aria-label={say("dock.of_what")}>
            <h3>{say("dock.of_what")}</h3>
            {places.map((each) => {
              const name = `${each.of}|${each.on}`, several = ofThese.filter((other) => `${other.of}|${other.on}` === name).length > 1;
              return (
                <button key={name} aria-pressed={name === of} onClick={() => (several ? setOf(name) : take(each))}>
                  <span>{ofWhat(each, words) ? <Name text={ofWhat(each, words)} /> : say("dock.whole")}</span>{several && <Icon name="chevron" size={14} />}
                </button>
              );
            })}
          </div>
          <div role="group" aria-label={say("dock.as_what")}>
            <h3>{say("dock.as_what")}</h3>
            {ways.map((each) => <button key={each.id} aria-pressed={each.id === chosen} onClick={() => take(each)}>{asWhat(each, words)}</button>)}
          </div>
        </div>
      )}
    </div>
  );
}

/** Arrow keys among the columns: up and down in one, left and right to the chosen word of the next. */
function walk(event: KeyboardEvent, host: HTMLElement): void {
  const lists = () => Array.from(host.querySelectorAll<HTMLElement>(".picker-columns > div"), (each) => Array.from(each.querySelectorAll("button")));
  const columns = lists();
  const at = columns.findIndex((each) => each.includes(document.activeElement as HTMLButtonElement)), here = columns[at];
  const chosen = (list: HTMLButtonElement[]) => list.find((each) => each.getAttribute("aria-pressed") === "true") ?? list[0];
  if (at < 0) {
    if (event.key === "ArrowDown") chosen(columns[0])?.focus();
    return;
  }
  const k = here.indexOf(document.activeElement as HTMLButtonElement);
  if (event.key === "ArrowDown") here[Math.min(here.length - 1, k + 1)].focus();
  else if (event.key === "ArrowUp" && k) here[k - 1].focus();
  else if (event.key === "ArrowUp") host.querySelector("input")!.focus();
  else if (event.key === "ArrowRight") {
    if (at < 2) here[k].click();
    // The next column is there once the word has been taken.
    setTimeout(() => host.isConnected && lists()[at + 1]?.length && chosen(lists()[at + 1]).focus());
  } else if (columns[at - 1]) chosen(columns[at - 1])?.focus();
}

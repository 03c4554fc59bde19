// The model file as text: numbered lines with the marks of findings, the selected element lit, the same steps back.
import { signal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { WAIT } from "../desk";
import type { Bench } from "../bench";
import { linesOf, pathOf } from "./entries";

/** The line to go to once the text is shown. */
const wanted = signal(0);

export function goTo(bench: Bench, line: number): void {
  wanted.value = line;
  bench.tab.value = "text";
}

export function TextPane({ bench }: { bench: Bench }) {
  const { desk } = bench, area = useRef<HTMLTextAreaElement>(null), gutter = useRef<HTMLDivElement>(null), lit = useRef<HTMLDivElement>(null);
  const { findings, outline } = desk.solved.value, text = desk.text.value, lines = text.split("\n"), marked = new Map(findings.map(({ line, severity, sentence }) => [line, { severity, sentence }]));
  const chosen = outline && desk.solved.value.text === text ? bench.selection.value.flatMap((item) => {
    const path = pathOf(outline.entries, item);
    return path ? [linesOf(text, outline, path)].filter((each) => each !== null) : [];
  }) : [];
  const scroll = () => {
    const { scrollTop, scrollLeft } = area.current!;
    gutter.current!.style.transform = `translateY(${-scrollTop}px)`;
    lit.current!.style.transform = `translate(${-scrollLeft}px, ${-scrollTop}px)`;
  };
  const target = wanted.value;
  useLayoutEffect(() => {
    if (!target) return;
    const start = lines.slice(0, target - 1).join("\n").length + (target > 1 ? 1 : 0), field = area.current!;
    field.focus();
    field.setSelectionRange(start, start + (lines[target - 1]?.length ?? 0));
    reach(field, target - 1);
    wanted.value = 0;
  }, [target]);
  const first = chosen[0]?.[0] ?? 0;
  useLayoutEffect(() => {
    if (first && document.activeElement !== area.current) reach(area.current!, first - 1);
  }, [first]);
  return (
    <div class="editor">
      <div class="gutter" aria-hidden="true">
        <div ref={gutter}>{lines.map((_, k) => <div key={k} class={marked.get(k + 1)?.severity ?? ""} title={marked.get(k + 1)?.sentence}>{k + 1}</div>)}</div>
      </div>
      <div class="letters">
        <div class="lit" aria-hidden="true"><div ref={lit}>{chosen.map(([from, to]) => <i key={from} style={{ top: `calc(${from - 1} * var(--row))`, height: `calc(${to - from + 1} * var(--row))` }} />)}{[...marked].map(([line, { severity }]) => line > 0 && <i key={`m${line}`} class={severity} style={{ top: `calc(${line - 1} * var(--row))`, height: "var(--row)" }} />)}</div></div>
        <textarea
          ref={area} spellcheck={false} wrap="off" autocomplete="off" autocapitalize="off" value={text} aria-label={desk.say("text")}
          onInput={(event) => desk.change(event.currentTarget.value, WAIT)} onKeyDown={(event) => step(bench, event)} onScroll={scroll}
        />
      </div>
    </div>
  );
}

/** Brings a line into the middle of the field. */
function reach(field: HTMLTextAreaElement, line: number): void {
  const row = Number.parseFloat(getComputedStyle(field).lineHeight);
  field.scrollTop = Math.max(0, line * row - field.clientHeight / 2);
}

/** A new line begins as far in as the one before, further behind a key that opens a section. */
function indent(event: KeyboardEvent, area: HTMLTextAreaElement): void {
  const { selectionStart: from, selectionEnd: to, value } = area, line = value.slice(value.lastIndexOf("\n", from - 1) + 1, from);
  const spaces = (/^ */.exec(line)?.[0] ?? "") + (/:\s*$/.test(line) ? "  " : "");
  event.preventDefault();
  area.setRangeText(`\n${spaces}`, from, to, "end");
  area.dispatchEvent(new Event("input", { bubbles: true }));
}

/** Steps of text and drawing by the keys that undo typing elsewhere; the cursor goes where the text changes. */
function step(bench: Bench, event: KeyboardEvent): void {
  const which = event.key.toLowerCase(), { desk } = bench, area = event.currentTarget as HTMLTextAreaElement;
  if (which === "enter" && !event.ctrlKey && !event.metaKey && !event.isComposing) return indent(event, area);
  if (!(event.ctrlKey || event.metaKey) || (which !== "z" && which !== "y")) return;
  event.preventDefault();
  event.stopPropagation();
  const before = desk.text.value;
  if (which === "y" || event.shiftKey) desk.history.redo();
  else desk.history.undo();
  const now = desk.text.value;
  if (now === before) return;
  let same = 0;
  while (same < Math.min(now.length, before.length) && now[now.length - 1 - same] === before[before.length - 1 - same]) same++;
  area.value = now;
  area.setSelectionRange(now.length - same, now.length - same);
}

// What the panes are made of: quantities, choices, switches, chips, sections that remember whether they are open.
import type { ComponentChildren } from "preact";
import { useEffect, useId, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Bench } from "../bench";
import { Icon, type IconName } from "../frame/icons";
import { useLive } from "./now";
import { read, shownUnit, stepped, typed } from "./quantities";

/** Rest after the last step by arrow keys before it is written, ms. */
const REST = 350;
const INDEXED = /^(\p{L}{1,2}'*)_?(\d+'*)$/u;

/** Where refusals are said whose field is gone. */
export const unseen: { tell: (sentence: string) => void } = { tell: () => undefined };

/** The name of a point, as drawings have it. */
export function Sym({ name }: { name: string }) {
  const short = name.replace(/.*\./, ""), [, stem, index] = INDEXED.exec(short) ?? [];
  return <i class="sym">{stem ?? short}{index && <sub>{index}</sub>}</i>;
}

/** A sentence whose {names} are points. */
export function Sentence({ text, names }: { text: string; names: string[] }) {
  return <>{text.split(/\{(\d)\}/).map((part, k) => (k % 2 ? <Sym key={k} name={names[Number(part)] ?? ""} /> : part))}</>;
}

export function Row({ label, id, aside, children }: { label: string; id?: string; aside?: ComponentChildren; children: ComponentChildren }) {
  return (
    <div class="field">
      {id ? <label for={id}>{label}</label> : <span class="label">{label}</span>}
      <div class="in">{children}</div>
      {aside}
    </div>
  );
}

export interface QuantityProps {
  label: string;
  /** As it is written; "": nothing is. */
  value: string;
  /** The unit of a number without one. */
  unit: string;
  /** Takes a text; gives the sentence of a refusal. */
  set?: (text: string) => Promise<string | null>;
  /** It follows from others. */
  follows?: boolean;
  /** Its value at a position, where it changes while the machine plays. */
  live?: { bench: Bench; at: (index: number) => string };
  /** What holds where nothing is written. */
  preset?: string;
  /** Nothing may be in it. */
  optional?: boolean;
  aside?: ComponentChildren;
  /** Another name than the visible one for screen readers. */
  name?: string;
}

/** A quantity with its unit beside its name: Enter or leaving it sets it, Escape puts the old one back. */
export function Quantity({ label, aside, ...rest }: QuantityProps) {
  const id = useId();
  return <Row label={label} id={id} aside={aside}><Typing id={id} label={label} {...rest} /></Row>;
}

/** The field of a quantity alone. */
export function Typing({ id, label, name, value, unit, set, follows = false, live, preset = "", optional = false }: Omit<QuantityProps, "aside"> & { id?: string }) {
  const [draft, setDraft] = useState<string | null>(null), [fault, setFault] = useState(""), timer = useRef(0), own = useId();
  const shown = read(value), number = shown.number || value, own_unit = shown.number ? shown.unit : value ? "" : unit, field = useRef<HTMLInputElement>(null);
  const pending = useRef<(() => void) | null>(null), asked = useRef<string | null>(null), gone = useRef(false);
  // A value that changes elsewhere shows at once, but never under the hand.
  useLayoutEffect(() => {
    if (document.activeElement !== field.current || draft === null) {
      setDraft(null);
      setFault("");
    }
  }, [value]);
  useLive(live?.bench, live && ((index) => {
    const input = field.current, text = read(live.at(index)).number;
    if (input && text && (!set || document.activeElement !== input)) input.value = text.replace(/^-/, "−");
  }));
  const commit = async (text: string) => {
    window.clearTimeout(timer.current);
    if (!set) return;
    const plain = typed(text, own_unit || unit);
    if (plain === value || (!plain && !optional) || (!value && plain === typed(preset, unit))) {
      setDraft(null);
      return setFault("");
    }
    if (asked.current === plain) return;
    asked.current = plain;
    const sentence = await set(plain);
    asked.current = null;
    if (gone.current) return void (sentence && unseen.tell(sentence));
    setFault(sentence ?? "");
    if (!sentence) setDraft(null);
  };
  pending.current = draft !== null && !fault ? () => void commit(draft) : null;
  // Another element is selected before the field is left: what is typed holds.
  useEffect(() => () => {
    gone.current = true;
    window.clearTimeout(timer.current);
    pending.current?.();
  }, []);
  const keys = (event: KeyboardEvent) => {
    const input = event.currentTarget as HTMLInputElement;
    if (event.key === "Enter") {
      event.preventDefault();
      void commit(input.value);
    } else if (event.key === "Escape" && (draft !== null || fault)) {
      event.stopPropagation();
      window.clearTimeout(timer.current);
      setDraft(null);
      setFault("");
    } else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
      const now = read(input.value), way = event.key === "ArrowUp" ? 1 : -1;
      if (!now.number || !set) return;
      event.preventDefault();
      const next = stepped(now.number, way, event.shiftKey ? 10 : event.altKey ? 0.1 : 1, !own_unit && /^-?\d+$/.test(now.number)) + (now.unit ? ` ${now.unit}` : "");
      setDraft(next);
      window.clearTimeout(timer.current);
      timer.current = window.setTimeout(() => void commit(next), REST);
    }
  };
  return (
    <span class="typing">
      <span class={`num${follows ? " follows" : ""}${fault ? " refused" : ""}`}>
        <input
          id={id} ref={field} value={draft ?? number.replace(/^-/, "−")} placeholder={preset} readOnly={!set} inputMode="text" autocomplete="off" spellcheck={false}
          aria-label={name ?? (id ? undefined : label)} aria-invalid={fault ? true : undefined} aria-describedby={fault ? own : undefined}
          onInput={(event) => setDraft(event.currentTarget.value)} onKeyDown={keys} onFocus={(event) => set && event.currentTarget.select()}
          onBlur={(event) => draft !== null && !fault && void commit(event.currentTarget.value)}
        />
        {own_unit && draft === null && <em>{shownUnit(own_unit)}</em>}
      </span>
      {fault && <small id={own} class="fault" role="alert">{fault}</small>}
    </span>
  );
}

/** A choice of words; `options`: values with their words. */
export function Choice({ label, value, options, set, aside }: {
  label: string; value: string; options: [string, string][]; set: (value: string) => void; aside?: ComponentChildren;
}) {
  const id = useId();
  return (
    <Row label={label} id={id} aside={aside}>
      <Select id={id} value={value} options={options} set={set} />
    </Row>
  );
}

export function Select({ id, label, value, options, set }: { id?: string; label?: string; value: string; options: [string, string][]; set: (value: string) => void }) {
  const known = options.some(([each]) => each === value);
  return (
    <span class="select">
      <select
        id={id} aria-label={label} value={value}
        onChange={(event) => {
          set(event.currentTarget.value);
          // Until the text has it, what it has is shown.
          event.currentTarget.value = value;
        }}
      >
        {!known && <option value={value}>{value}</option>}
        {options.map(([each, words]) => <option key={each} value={each}>{words}</option>)}
      </select>
      <Icon name="chevron" size={14} />
    </span>
  );
}

export function Switch({ label, on, set, children }: { label: string; on: boolean; set: (on: boolean) => void; children?: ComponentChildren }) {
  return (
    <Row label={label}>
      <button class="switch" role="switch" aria-checked={on} aria-label={label} onClick={() => set(!on)}><i /></button>
      {children && <span class="quiet">{children}</span>}
    </Row>
  );
}

/** Two or three words of which one holds. */
export function Segments({ label, value, options, set }: { label: string; value: string; options: [string, string][]; set: (value: string) => void }) {
  return (
    <span class="seg" role="group" aria-label={label}>
      {options.map(([each, words]) => <button key={each} type="button" aria-pressed={each === value} onClick={() => each !== value && set(each)}>{words}</button>)}
    </span>
  );
}

/** Names of points or links that are selected by a click. */
export function Chips({ label, names, pick, symbols = true, children }: {
  label: string; names: string[]; pick: (name: string) => void; symbols?: boolean; children?: ComponentChildren;
}) {
  return (
    <Row label={label}>
      <span class="chips">
        {names.map((name) => <button key={name} type="button" onClick={() => pick(name)}>{symbols ? <Sym name={name} /> : name}</button>)}
        {children}
      </span>
    </Row>
  );
}

export function Section({ bench, id, title, count, open = true, children }: {
  bench: Bench; id: string; title: string; count?: number; open?: boolean; children: () => ComponentChildren;
}) {
  const { folds } = bench.settings.value, shown = folds[id] ?? open, body = useId();
  return (
    <section class="sec">
      <h3>
        <button type="button" aria-expanded={shown} aria-controls={shown ? body : undefined} onClick={() => bench.set({ folds: { ...folds, [id]: !shown } })}>
          <Icon name="chevron" size={14} />{title}{count !== undefined && <span>{count}</span>}
        </button>
      </h3>
      {shown && <div class="body" id={body}>{children()}</div>}
    </section>
  );
}

/** A number that joints that are dragged leave as it is. */
export function Lock({ bench, address }: { bench: Bench; address: string }) {
  const locked = bench.locked.value.has(address), words = bench.say(locked ? "insp.locked" : "insp.free", { name: address });
  return (
    <button type="button" class="pinned" aria-pressed={locked} aria-label={bench.say("insp.lock", { name: address })} title={words} onClick={() => bench.lock([address], !locked)}>
      <Icon name={locked ? "lock" : "unlock"} size={15} />
    </button>
  );
}

export function Act({ icon, children, act, disabled = false, title }: { icon?: IconName; children: ComponentChildren; act: () => void; disabled?: boolean; title?: string }) {
  return <button type="button" class="quietly" disabled={disabled} title={title} onClick={act}>{icon && <Icon name={icon} size={17} />}{children}</button>;
}

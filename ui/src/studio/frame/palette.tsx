// The palette: whatever can be asked of the room, found by words of its language.
import { useEffect, useRef, useState } from "preact/hooks";
import type { Bench } from "../bench";
import { allCommands, type Command } from "./commands";
import { DialogFrame } from "./dialog";
import { Icon } from "./icons";
import { keyNames } from "./key_names";
import { useFolder } from "./open";
import { ranked } from "./search";

const MOST = 60;

export function Palette({ bench }: { bench: Bench }) {
  const folder = useFolder(bench), [text, setText] = useState(""), [at, setAt] = useState(0), list = useRef<HTMLUListElement>(null);
  const gallery = (folder?.gallery ?? []).map(({ name, title }): Command => ({ group: "gallery", label: title, icon: "gallery", act: () => void bench.desk.open({ gallery: name }) }));
  const words = (each: Command) => `${each.label} ${bench.say(`group.${each.group}`)}`;
  const found = ranked(text, [...allCommands(bench), ...gallery], words).slice(0, MOST), now = Math.min(at, found.length - 1);
  useEffect(() => list.current?.querySelector("[aria-selected=true]")?.scrollIntoView({ block: "nearest" }), [now, text]);
  const choose = (command: Command | undefined) => {
    if (!command || command.not) return;
    bench.dialog.value = null;
    // What it asks may open a dialog, after this one has shut.
    window.setTimeout(command.act);
  };
  const key = (event: KeyboardEvent) => {
    const next = { ArrowDown: now + 1, ArrowUp: now - 1, PageDown: now + 8, PageUp: now - 8 }[event.key];
    if (next !== undefined) setAt((next + found.length) % Math.max(1, found.length));
    else if (event.key === "Enter") choose(found[now]);
    else return;
    event.preventDefault();
  };
  return (
    <DialogFrame bench={bench} title={bench.say("palette")} class="palette" bare>
      <label class="field-line">
        <Icon name="search" size={18} />
        <input
          autofocus role="combobox" aria-expanded="true" aria-controls="palette-list" aria-activedescendant={now >= 0 ? `palette-${now}` : undefined} aria-label={bench.say("palette")}
          placeholder={bench.say("palette")} value={text} onInput={(event) => { setText(event.currentTarget.value); setAt(0); }} onKeyDown={key}
        />
      </label>
      <ul role="listbox" id="palette-list" aria-label={bench.say("palette")} ref={list}>
        {found.map((each, k) => (
          <li
            key={`${each.group}${each.label}`} id={`palette-${k}`} role="option" aria-selected={k === now} aria-disabled={each.not ? true : undefined} title={each.not}
            onPointerMove={() => setAt(k)} onClick={() => choose(each)}
          >
            <span class="menu-sign">{each.icon && <Icon name={each.icon} size={18} />}</span>
            <span class="menu-text">{each.label}</span>
            <small>{bench.say(`group.${each.group}`)}</small>
            {each.keys && <kbd>{keyNames(each.keys)}</kbd>}
          </li>
        ))}
      </ul>
      <p class="nothing" role="status">{found.length ? "" : bench.say("open.nothing")}</p>
    </DialogFrame>
  );
}

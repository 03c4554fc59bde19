// The head of a pane: icon, name edited in place, what it is, lock and delete; and its last line, what stands in the file.
import type { ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";
import type { Bench, Item } from "../bench";
import { Icon, type IconName } from "../frame/icons";
import { perform } from "./change";
import { type Path, written } from "./entries";

const NONE: string[] = [];
/** Lines of the file that are shown. */
const MOST = 9;

interface HeadProps {
  bench: Bench;
  icon: IconName;
  title: string;
  children: ComponentChildren;
  /** What is renamed and removed; without it the name stands. */
  item?: Item;
  /** Numbers that the lock of the whole holds. */
  locks?: string[];
  tone?: "load" | "input";
  fixedName?: boolean;
  /** Takes away what the text does not have as an element; null: it stays. */
  remove?: (() => void) | null;
}

export function Head({ bench, icon, title, children, item, locks = NONE, tone, fixedName = false, remove: away }: HeadProps) {
  const locked = locks.length > 0 && locks.every((each) => bench.locked.value.has(each));
  const remove = async () => {
    if (away) return away();
    if (!item || (await perform(bench, [{ do: "remove", items: [item] }]))) return;
    bench.select();
  };
  return (
    <div class={`who ${tone ?? ""}`}>
      <span class="glyph"><Icon name={icon} size={22} /></span>
      <div>
        <h2>{item && !fixedName ? <Name bench={bench} item={item} /> : title}</h2>
        <p>{children}</p>
      </div>
      {item && (
        <span class="acts">
          {locks.length > 0 && (
            <button type="button" class="square" aria-pressed={locked} aria-label={bench.say("insp.lock", { name: item.name })} title={bench.say(locked ? "insp.locked" : "insp.free", { name: item.name })} onClick={() => bench.lock(locks, !locked)}>
              <Icon name={locked ? "lock" : "unlock"} size={17} />
            </button>
          )}
          {away !== null && <button type="button" class="square" aria-label={bench.say("insp.delete", { name: item.name })} title={bench.say("insp.delete", { name: item.name })} onClick={() => void remove()}><Icon name="trash" size={17} /></button>}
        </span>
      )}
    </div>
  );
}

function Name({ bench, item }: { bench: Bench; item: Item }) {
  const [fault, setFault] = useState("");
  useEffect(() => setFault(""), [item.kind, item.name]);
  const rename = async (input: HTMLInputElement) => {
    const to = input.value.trim();
    if (!to || to === item.name) {
      input.value = item.name;
      return setFault("");
    }
    const sentence = await perform(bench, [{ do: "rename", what: item.kind, from: item.name, to }]);
    setFault(sentence ?? "");
    if (!sentence) bench.select({ kind: item.kind, name: to });
  };
  return (
    <>
      <input
        class="name" value={item.name} aria-label={bench.say("insp.name")} aria-invalid={fault ? true : undefined} autocomplete="off" spellcheck={false}
        onBlur={(event) => void rename(event.currentTarget)}
        onKeyDown={(event) => {
          if (event.key === "Enter") event.currentTarget.blur();
          if (event.key !== "Escape" || (event.currentTarget.value === item.name && !fault)) return;
          event.stopPropagation();
          event.currentTarget.value = item.name;
          setFault("");
        }}
      />
      {fault && <small class="fault" role="alert">{fault}</small>}
    </>
  );
}

/** What stands in the file for a path. */
export function Written({ bench, path }: { bench: Bench; path: Path | null }) {
  const { outline } = bench.desk.solved.value, text = path && outline ? written(bench.desk.text.value, outline, path) : "";
  const lines = text.split("\n"), shown = lines.length > MOST ? [...lines.slice(0, MOST), "…"] : lines;
  return text ? <div class="written"><span>{bench.say("insp.in_file")}</span><code>{shown.join("\n")}</code></div> : null;
}

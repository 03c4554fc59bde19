// The dialog that opens drawings: what was not saved with its times, files of the folder, machines of the gallery.
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Folder } from "../desk";
import type { Bench } from "../bench";
import { Square } from "./controls";
import { DialogFrame } from "./dialog";
import { Icon } from "./icons";
import { fits } from "./search";
import type { IconName } from "./signs";
import { Thumb } from "./thumbs";
import { when } from "./when";

export type Part = "drafts" | "files" | "gallery";
const PARTS: Part[] = ["drafts", "files", "gallery"];
const SIGNS: Record<Part, IconName> = { drafts: "clock", files: "folder", gallery: "gallery" };

/** The name of a draft as it is read. */
export const draftTitle = ({ name, saved }: Folder["drafts"][number]) => (saved ? name : name.replace(/\.\w+$/, ""));

/** What a draft is: "5 links, not saved". */
export function draftNote(bench: Bench, { links, saved }: Folder["drafts"][number]): string {
  return bench.say(saved ? "draft.changed" : links === 0 ? "draft.none" : links === 1 ? "draft.one" : "draft.links", { count: String(links) });
}

/** The folder as the server has it; asked anew for each `again`. */
export function useFolder(bench: Bench, again: unknown = 0): Folder | null {
  const [folder, setFolder] = useState<Folder | null>(null), language = bench.page.language.value;
  useEffect(() => {
    let live = true;
    void bench.desk.folder().then((found) => live && found && setFolder(found));
    return () => void (live = false);
  }, [again, language]);
  return folder;
}

interface Row {
  key: string;
  title: string;
  note: string;
  time: string;
  /** What its small drawing is of. */
  machine: { name?: string; gallery?: string };
  open: () => void;
  discard?: () => void;
}

function rows(bench: Bench, folder: Folder, part: Part, discard: (name: string) => void): Row[] {
  const { desk, page } = bench, time = (at: number) => when(at, page.language.value, bench.say);
  if (part === "drafts")
    return folder.drafts.map((each) => ({
      key: each.name, title: draftTitle(each), note: draftNote(bench, each), time: time(each.time), machine: { name: each.name }, open: () => void desk.open({ name: each.name }),
      discard: each.name === desk.name.value ? undefined : () => discard(each.name),
    }));
  if (part === "files") return folder.files.map((each) => ({ key: each.name, title: each.name, note: "", time: time(each.time), machine: { name: each.name }, open: () => void desk.open({ name: each.name }) }));
  return folder.gallery.map(({ name, title, purpose }) => ({ key: name, title, note: purpose, time: "", machine: { gallery: name }, open: () => void desk.open({ gallery: name }) }));
}

export function OpenDialog({ bench, part }: { bench: Bench; part?: Part }) {
  const [again, setAgain] = useState(0), folder = useFolder(bench, again), [text, setText] = useState(""), [chosen, setChosen] = useState<Part | null>(part ?? null);
  const [asked, setAsked] = useState(""), list = useRef<HTMLUListElement>(null);
  const shown: Part = chosen ?? (folder && !folder.drafts.length ? (folder.files.length ? "files" : "gallery") : "drafts");
  const discard = (name: string) => {
    if (asked !== name) return setAsked(name);
    setAsked("");
    void bench.desk.ask("discard", { name }).then(() => setAgain(again + 1));
  };
  const found = useMemo(() => (folder ? rows(bench, folder, shown, discard).filter((row) => fits(text, `${row.title} ${row.note} ${row.key}`)) : []), [folder, shown, text, asked]);
  const open = (row: Row | undefined) => {
    if (!row) return;
    bench.dialog.value = null;
    row.open();
  };
  const walk = (event: KeyboardEvent) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key], items = [...list.current!.querySelectorAll<HTMLElement>(".row-open")];
    if (!step || !items.length) return;
    event.preventDefault();
    const at = items.indexOf(document.activeElement as HTMLElement);
    items[Math.max(0, Math.min(items.length - 1, at + step))].focus();
  };
  return (
    <DialogFrame bench={bench} title={bench.say("open.title")} class="open-dialog">
      <div onKeyDown={walk} class="open-body">
        <label class="field-line">
          <Icon name="search" size={16} />
          <input
            type="search" autofocus placeholder={bench.say("open.search")} aria-label={bench.say("open.search")} value={text}
            onInput={(event) => setText(event.currentTarget.value)} onKeyDown={(event) => event.key === "Enter" && open(found[0])}
          />
        </label>
        <div class="parts" role="group" aria-label={bench.say("open.title")}>
          {PARTS.map((each) => (
            <button key={each} class="ghost" aria-pressed={each === shown} onClick={() => setChosen(each)}>
              <Icon name={SIGNS[each]} size={18} />{bench.say(`open.${each}`)}<span class="count">{folder?.[each].length ?? ""}</span>
            </button>
          ))}
        </div>
        <ul class={shown === "gallery" ? "rows cards" : "rows"} ref={list}>
          {found.map((row) => (
            <li key={row.key}>
              <button class="row-open" onClick={() => open(row)} aria-current={row.key === bench.desk.name.value ? "true" : undefined}>
                <Thumb bench={bench} id={`${shown} ${row.key} ${row.time}`} machine={row.machine} />
                <b>{row.title}</b><span>{row.time}</span>{row.note && <small>{row.note}</small>}
              </button>
              {row.discard && (asked === row.key
                ? <button class="outline discard" onClick={row.discard}>{bench.say("draft.discard_sure")}</button>
                : <Square icon="trash" name={bench.say("draft.discard", { name: row.title })} act={row.discard} />)}
            </li>
          ))}
          {folder && !found.length && <li class="nothing">{bench.say(text ? "open.nothing" : `open.no_${shown}`)}</li>}
        </ul>
      </div>
    </DialogFrame>
  );
}

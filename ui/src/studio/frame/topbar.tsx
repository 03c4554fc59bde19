// The bar at the top: file, name and draft, undo, commands, language, theme, export, share.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Bench } from "../bench";
import { exportCommands, fileCommands } from "./commands";
import { Square } from "./controls";
import { Icon } from "./icons";
import { keyNames } from "./key_names";
import { type Choices, MenuButton } from "./menu";
import { share } from "./sharing";
import type { IconName } from "./signs";
import { moment } from "./when";

export function TopBar({ bench }: { bench: Bench }) {
  return (
    <header class="top">
      <Brand />
      <File bench={bench} />
      <Rule />
      <Name bench={bench} />
      <State bench={bench} />
      <Rule />
      <Steps bench={bench} />
      <Find bench={bench} />
      <Language bench={bench} />
      <Theme bench={bench} />
      <Export bench={bench} />
      <button class="primary" onClick={() => void share(bench)}><Icon name="share" size={18} />{bench.say("share")}</button>
    </header>
  );
}

const Rule = () => <span class="rule" aria-hidden="true" />;

function Brand() {
  return (
    <svg class="brand" viewBox="0 0 24 24" width="22" height="22" role="img" aria-label="Linkwright">
      <path d="M4 18.5L8.5 8 19 5.5 20 18.5" fill="none" stroke="currentColor" stroke-width="2" stroke-linejoin="round" stroke-linecap="round" />
      {[[4, 18.5], [8.5, 8], [19, 5.5], [20, 18.5]].map(([x, y]) => <circle key={y + x} cx={x} cy={y} r="2.3" />)}
    </svg>
  );
}

export function fileChoices(bench: Bench): Choices {
  const { fresh, open, drafts, gallery, save, saveAs, rename, link } = fileCommands(bench);
  return [fresh, open, drafts, gallery, link, null, save, saveAs, rename];
}

function File({ bench }: { bench: Bench }) {
  const name = bench.say("file");
  return <MenuButton label={name} choices={() => fileChoices(bench)}>{name}<Icon name="chevron" size={14} /></MenuButton>;
}

function Find({ bench }: { bench: Bench }) {
  return (
    <button class="command" aria-keyshortcuts="Control+K" onClick={() => (bench.dialog.value = { kind: "palette" })}>
      <Icon name="search" size={16} /><span>{bench.say("palette")}</span><kbd aria-hidden="true">{keyNames("Ctrl K")}</kbd>
    </button>
  );
}

function Export({ bench }: { bench: Bench }) {
  const name = bench.say("export"), making = bench.desk.making.value;
  return <MenuButton label={name} choices={() => exportCommands(bench)}><Icon name="export" size={18} />{making ? bench.say("export.making") : name}<Icon name="chevron" size={14} /></MenuButton>;
}

/** The name of a file as it is read: that of a drawing that was never saved has no ending. */
export const titleOf = ({ desk }: Bench) => (desk.onFile.value ? desk.name.value : desk.name.value.replace(/\.\w+$/, "")) || desk.say("new");

/** The name, edited in its place. */
export function Name({ bench }: { bench: Bench }) {
  const title = titleOf(bench), { renaming, desk } = bench, field = useRef<HTMLInputElement>(null), [problem, setProblem] = useState("");
  useLayoutEffect(() => {
    if (!renaming.value) return;
    field.current?.focus();
    field.current?.select();
  }, [renaming.value]);
  const end = () => {
    renaming.value = false;
    setProblem("");
  };
  const rename = async () => {
    const wanted = field.current?.value.trim();
    if (!wanted || wanted === title || (await desk.rename(wanted))) return end();
    setProblem(bench.say("rename.taken", { name: wanted }));
    field.current?.focus();
  };
  if (!renaming.value) return <h1><button class="ghost file-name" data-tip={bench.say("file.rename")} onClick={() => (renaming.value = true)}><b>{title}</b></button></h1>;
  return (
    <span class="file-name">
      <input
        ref={field} defaultValue={title} spellcheck={false} aria-label={bench.say("save.name")} aria-invalid={problem !== ""} aria-describedby="rename-problem"
        onKeyDown={(event) => {
          if (event.key === "Enter") void rename();
          else if (event.key === "Escape") end();
          event.stopPropagation();
        }}
        onBlur={() => !problem && void rename()}
      />
      <span id="rename-problem" role="alert" class={problem ? "rename-problem" : ""}>{problem}</span>
    </span>
  );
}

/** Whether what is drawn is kept as a draft or saved. */
export function State({ bench }: { bench: Bench }) {
  const { desk, page } = bench, saved = desk.onFile.value && !desk.dirty.value, kept = desk.keptAt.value;
  void desk.text.value;
  const words = desk.gone.value ? bench.say("state.gone") : saved ? bench.say("state.saved")
    : desk.dirty.value && kept ? bench.say("state.kept", { time: moment(kept, page.language.value, bench.say) }) : bench.say("state.new");
  return <span class={saved ? "file-state saved" : desk.gone.value ? "file-state gone" : "file-state"}><i aria-hidden="true" />{words}</span>;
}

export function Steps({ bench }: { bench: Bench }) {
  const { history } = bench.desk;
  void bench.desk.text.value;
  return (
    <>
      <Square icon="undo" name={bench.page.say("undo")} keys="Ctrl Z" disabled={!history.undoable} act={() => history.undo()} />
      <Square icon="redo" name={bench.page.say("redo")} keys="Ctrl Shift Z" disabled={!history.redoable} act={() => history.redo()} />
    </>
  );
}

function Language({ bench }: { bench: Bench }) {
  const other = bench.page.language.value === "en" ? "zh" : "en";
  return <button class="ghost" lang={other === "zh" ? "zh-CN" : "en"} onClick={() => bench.speak(other)}>{other === "zh" ? "中文" : "English"}</button>;
}

const THEMES = ["light", "dark", ""] as const;
const THEME_ICONS: Record<(typeof THEMES)[number], IconName> = { light: "sun", dark: "moon", "": "contrast" };

export function themes(bench: Bench): Choices {
  return THEMES.map((theme) => ({
    label: bench.say(`theme.${theme || "system"}`), icon: THEME_ICONS[theme], checked: bench.settings.value.theme === theme, act: () => bench.set({ theme }),
  }));
}

function Theme({ bench }: { bench: Bench }) {
  const name = bench.say("theme"), { theme } = bench.settings.value;
  return <MenuButton label={name} name={name} class="square" tip={name} choices={() => themes(bench)}><Icon name={theme ? THEME_ICONS[theme] : "sun"} size={18} /></MenuButton>;
}


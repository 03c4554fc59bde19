// The bar at the top: file, name and draft, undo, commands, language, theme, export, share.
import type { Bench } from "../bench";
import { Square } from "./controls";
import { Icon } from "./icons";
import { type Choices, MenuButton } from "./menu";
import type { IconName } from "./signs";
import { moment } from "./when";

export function TopBar({ bench }: { bench: Bench }) {
  return (
    <header class="top">
      <Brand />
      <Rule />
      <Name bench={bench} />
      <State bench={bench} />
      <Rule />
      <Steps bench={bench} />
      <span class="between" />
      <Language bench={bench} />
      <Theme bench={bench} />
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

/** The name of a file as it is read: that of a drawing that was never saved has no ending. */
export const titleOf = ({ desk }: Bench) => (desk.onFile.value ? desk.name.value : desk.name.value.replace(/\.\w+$/, "")) || desk.say("new");

/** The name, edited in its place. */
export function Name({ bench }: { bench: Bench }) {
  const title = titleOf(bench);
  return <b class="file-name">{title}</b>;
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
  return <button class="ghost" lang={other === "zh" ? "zh-CN" : "en"} onClick={() => bench.desk.speak(other)}>{other === "zh" ? "中文" : "English"}</button>;
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


// Everything that can be asked of the room, for its menus, its keys and the palette.
import { type Bench, DOCKS, SHOWN, TABS, TOOLS } from "../bench";
import { KEYS } from "../tools/tool";
import type { Choice } from "./menu";
import { iconOf, nameOf } from "./rail";
import { share } from "./sharing";
import type { IconName } from "./signs";

export interface Command extends Choice {
  /** What it is under in the palette. */
  group: "file" | "edit" | "tool" | "view" | "export" | "gallery";
  /** Keys as they are pressed ("Ctrl+Shift+S"); `keys` is how they are written. */
  pressed?: string;
}

const written = (pressed: string) => pressed.replaceAll("+", " ");

export function fileCommands(bench: Bench): Record<"fresh" | "open" | "drafts" | "gallery" | "save" | "saveAs" | "rename" | "link" | "share", Command> {
  const { desk } = bench, dialog = (value: typeof bench.dialog.value) => () => void (bench.dialog.value = value);
  const command = (key: string, icon: IconName, act: () => void, pressed?: string): Command =>
    ({ group: "file", label: bench.say(key), icon, act, pressed, keys: pressed && written(pressed) });
  return {
    fresh: command("file.new", "file", () => void desk.open({ fresh: true, numbered: true }), "Ctrl+Alt+N"),
    open: command("file.open", "folder", dialog({ kind: "open" }), "Ctrl+O"),
    drafts: command("file.drafts", "clock", dialog({ kind: "open", part: "drafts" })),
    gallery: command("file.gallery", "gallery", dialog({ kind: "open", part: "gallery" })),
    save: command("file.save", "check", () => (desk.onFile.value ? void desk.save(desk.name.value) : dialog({ kind: "save" })()), "Ctrl+S"),
    saveAs: command("file.save_as", "copy", dialog({ kind: "save" }), "Ctrl+Shift+S"),
    rename: command("file.rename", "pencil", () => void (bench.renaming.value = true)),
    link: command("file.link", "share", dialog({ kind: "link" })),
    share: command("share", "share", () => void share(bench)),
  };
}

/** What is handed out, by the ending of the file; null is a line. */
export const ENDINGS = [
  ".report.pdf", ".report.html", ".html", null, ".sheet.pdf", ".sheet.dxf", ".parts.zip", ".exercise.pdf", null, ".xlsx", ".csv", ".json", null, ".svg", ".pdf", ".png", ".dxf",
] as const;
const SIGNS: Record<string, IconName> = { ".xlsx": "table", ".csv": "table", ".json": "file_text", ".html": "play", ".report.pdf": "file_text", ".report.html": "file_text", ".exercise.pdf": "pencil" };

export function exportCommands(bench: Bench): (Command | null)[] {
  const not = bench.session.value ? undefined : bench.say("export.not");
  const take = (ending: string) => (ending === ".exercise.pdf" ? () => void (bench.dialog.value = { kind: "exercise" }) : () => void bench.desk.take(ending));
  return ENDINGS.map((ending) => ending && {
    group: "export", label: bench.say(`export${ending}`), icon: SIGNS[ending] ?? "export", keys: ending.replace(/^.*(?=\.)/, ""), not, act: take(ending),
  });
}

function editCommands({ desk, say, page }: Bench): Command[] {
  const { history } = desk;
  return [
    { group: "edit", label: page.say("undo"), icon: "undo", keys: "Ctrl Z", not: history.undoable ? undefined : say("edit.nothing"), act: () => history.undo() },
    { group: "edit", label: page.say("redo"), icon: "redo", keys: "Ctrl Shift Z", not: history.redoable ? undefined : say("edit.nothing"), act: () => history.redo() },
  ];
}

const toolCommands = (bench: Bench): Command[] =>
  TOOLS.map((tool) => ({ group: "tool", label: nameOf(bench, tool), icon: iconOf(bench, tool), keys: KEYS[tool], act: () => void (bench.tool.value = tool) }));

function viewCommands(bench: Bench): Command[] {
  const { say, page } = bench, view = (label: string, act: () => void, icon?: IconName, keys?: string): Command => ({ group: "view", label, act, icon, keys });
  const shown = SHOWN.map((name) => view(say("layer.toggle", { name: say(`layer.${name}`) }), () => bench.show(name, !bench.shows(name)), bench.shows(name) ? "eye" : "eye_off"));
  return [
    view(page.say(page.playing.value ? "pause" : "play"), () => page.play(!page.playing.value), page.playing.value ? "pause" : "play", say("key.space")),
    ...shown,
    view(say("zoom.fit"), () => bench.view?.fit(), "fit", "Shift 1"),
    view(say("zoom.selection"), () => bench.view?.fitSelection(), "fit", "Shift 2"),
    view(say("zoom.full"), () => bench.view?.full(), "search", "0"),
    ...TABS.map((tab) => view(say(`go.${tab}`), () => void (bench.tab.value = tab), "rail")),
    ...DOCKS.map((dock) => view(say(`dock.${dock}`), () => void (bench.dock.value = dock), "curves")),
    ...(["light", "dark", ""] as const).map((theme) => view(`${say("theme")}: ${say(`theme.${theme || "system"}`)}`, () => bench.set({ theme }), theme === "dark" ? "moon" : theme ? "sun" : "contrast")),
    view(page.language.value === "en" ? "中文" : "English", () => bench.speak(page.language.value === "en" ? "zh" : "en"), "info"),
    view(say("keys.title"), () => void (bench.dialog.value = { kind: "keys" }), "keyboard", "?"),
  ];
}

/** All commands in the order of the palette. */
export function allCommands(bench: Bench): Command[] {
  return [...toolCommands(bench), ...Object.values(fileCommands(bench)), ...editCommands(bench), ...viewCommands(bench), ...exportCommands(bench).filter((each) => each !== null)];
}

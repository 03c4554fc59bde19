// The studio: one screen around the sheet on which a mechanism is drawn, moved, loaded, measured and improved.
import { render } from "preact";
import { useLayoutEffect, useState } from "preact/hooks";
import type { PageData } from "../data";
import { Desk } from "./desk";
import { Page } from "../living";
import "../machine.css";
import { Bench } from "./bench";
import { Dock } from "./dock/dock";
import "./dock/dock.css";
import "./frame/frame.css";
import { fileCommands } from "./frame/commands";
import { Divider } from "./frame/divider";
import { ExerciseDialog } from "./frame/exercise";
import { type Commands, listen } from "./frame/keys";
import { KeySheet } from "./frame/keysheet";
import { DOCK, followWindow, INSPECTOR, NARROW, SHUT, sized } from "./frame/layout";
import { MenuHost } from "./frame/menu";
import { OpenDialog } from "./frame/open";
import { Palette } from "./frame/palette";
import { PhoneRoom, ToolSheet } from "./frame/phone";
import { Rail } from "./frame/rail";
import { LinkDialog, SaveDialog } from "./frame/save";
import { Shared } from "./frame/shared";
import { linkInAddress, openLink, takeDropped } from "./frame/sharing";
import { Status } from "./frame/status";
import { Strips } from "./frame/strips";
import { followTheme } from "./frame/theme";
import { Tip } from "./frame/tip";
import { titleOf, TopBar } from "./frame/topbar";
import { Inspector } from "./inspector/inspector";
import "./inspector/inspector.css";
import "./sheet/sheet.css";
import { Stage } from "./sheet/stage";
import "./tokens.css";

function Room({ bench }: { bench: Bench }) {
  const { desk, page } = bench, language = page.language.value;
  useLayoutEffect(() => {
    document.documentElement.lang = language === "zh" ? "zh-CN" : "en";
    document.title = `${titleOf(bench)} – Linkwright`;
    if (desk.name.value) remember({ file: desk.name.value, lang: language });
  }, [language, desk.name.value, desk.onFile.value]);
  useLayoutEffect(() => {
    // Another file: nothing of the one before is selected or in hand; what is drawn already is moved first.
    bench.select();
    if (/^links:/m.test(desk.text.value)) bench.tool.value = "move";
    else bench.dock.value = null;
  }, [desk.opens.value]);
  const { settings, layout } = bench, [wide, tall] = useWindow(), large = layout.value === "large", slim = settings.value.slim ?? wide < NARROW;
  const inspector = sized(settings.value.inspector, wide, large, INSPECTOR), dock = sized(settings.value.dock, tall, large, DOCK);
  const style = { "--inspector": `${inspector}px`, "--dock": `${bench.dock.value ? dock : SHUT}px` };
  if (layout.value === "phone") return <><PhoneRoom bench={bench} /><Over bench={bench} /></>;
  return (
    <><div class={`room ${layout.value}${slim ? " slim" : ""}`} style={style}>
      <TopBar bench={bench} />
      <Strips bench={bench} />
      <nav class="edges" aria-label={bench.say("tools")}>
        <Rail bench={bench} slim={slim} />
        <Divider of="inspector" label={bench.say("divider.inspector")} value={inspector} least={INSPECTOR.least} most={Math.floor(INSPECTOR.share * wide)} set={(size) => bench.set({ inspector: size })} />
        {bench.dock.value && <Divider of="dock" label={bench.say("divider.dock")} value={dock} least={DOCK.least} most={Math.floor(DOCK.share * tall)} set={(size) => bench.set({ dock: size })} />}
      </nav>
      <Stage bench={bench} />
      <Inspector bench={bench} />
      <Dock bench={bench} />
      <Status bench={bench} />
    </div><Over bench={bench} /></>
  );
}

/** What stands over the room. */
function Over({ bench }: { bench: Bench }) {
  return (
    <>
      <Asked bench={bench} />
      <Shared bench={bench} />
      <MenuHost />
      <Tip />
    </>
  );
}

/** The dialog that is open. */
function Asked({ bench }: { bench: Bench }) {
  const dialog = bench.dialog.value;
  switch (dialog?.kind) {
    case "open": return <OpenDialog key={dialog.part} bench={bench} part={dialog.part} />;
    case "save": return <SaveDialog bench={bench} />;
    case "link": return <LinkDialog bench={bench} />;
    case "keys": return <KeySheet bench={bench} />;
    case "exercise": return <ExerciseDialog bench={bench} />;
    case "tools": return <ToolSheet bench={bench} />;
    case "palette": return <Palette bench={bench} />;
    default: return null;
  }
}

/** Files, palette and keys by their keys. */
function shortcuts(bench: Bench): Commands {
  const files = Object.values(fileCommands(bench)).filter(({ pressed }) => pressed).map(({ pressed, act }) => [pressed!, act] as const);
  const dialog = (kind: "palette" | "keys") => () => void (bench.dialog.value = { kind });
  return { ...Object.fromEntries(files), "Ctrl+K": dialog("palette"), "?": dialog("keys") };
}

/** The size of the window, as it is now. */
function useWindow(): [number, number] {
  const [size, setSize] = useState<[number, number]>([innerWidth, innerHeight]);
  useLayoutEffect(() => {
    const follow = () => setSize([innerWidth, innerHeight]);
    window.addEventListener("resize", follow);
    return () => window.removeEventListener("resize", follow);
  }, []);
  return size;
}

/** The address leads to what is open, so that a page that is loaded again shows it. */
function remember(values: Record<string, string>): void {
  const known = new URLSearchParams(location.search);
  for (const [name, value] of Object.entries(values)) known.set(name, value);
  history.replaceState(null, "", `?${known}${location.hash}`);
}

async function open(): Promise<void> {
  const data = JSON.parse(document.getElementById("data")!.textContent) as PageData & { file: string | null };
  const known = new URLSearchParams(location.search), file = known.get("file") ?? data.file, language = known.get("lang");
  const page = new Page(data, []), desk = new Desk(page), bench = new Bench(desk);
  page.language.value = language === "en" || language === "zh" ? language : bench.settings.value.language || data.language;
  followTheme(bench);
  followWindow(bench);
  listen(bench, shortcuts(bench));
  takeDropped(bench);
  render(<Room bench={bench} />, document.getElementById("page")!);
  Object.assign(globalThis, { linkwright: page, desk, bench });
  const link = linkInAddress();
  if (!link || !(await openLink(bench, link))) await desk.open(file ? { name: file } : { numbered: true });
}

void open();

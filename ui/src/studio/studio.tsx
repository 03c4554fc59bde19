// The studio: one screen around the sheet on which a mechanism is drawn, moved, loaded, measured and improved.
import { render } from "preact";
import { useLayoutEffect } from "preact/hooks";
import type { PageData } from "../data";
import { Desk } from "../desk";
import { Page } from "../living";
import "../machine.css";
import { Bench } from "./bench";
import { Dock } from "./dock/dock";
import "./dock/dock.css";
import "./frame/frame.css";
import { Rail } from "./frame/rail";
import { Status } from "./frame/status";
import { TopBar } from "./frame/topbar";
import { Inspector } from "./inspector/inspector";
import "./inspector/inspector.css";
import "./sheet/sheet.css";
import { Stage } from "./sheet/stage";
import "./tokens.css";

function Room({ bench }: { bench: Bench }) {
  const { desk, page } = bench, language = page.language.value;
  useLayoutEffect(() => {
    document.documentElement.lang = language === "zh" ? "zh-CN" : "en";
    document.title = `${desk.name.value || desk.say("new")} – Linkwright`;
  }, [language, desk.name.value]);
  return (
    <div class="room">
      <TopBar bench={bench} />
      <Rail bench={bench} />
      <Stage bench={bench} />
      <Inspector bench={bench} />
      <Dock bench={bench} />
      <Status bench={bench} />
    </div>
  );
}

async function open(): Promise<void> {
  const data = JSON.parse(document.getElementById("data")!.textContent) as PageData & { file: string | null };
  const known = new URLSearchParams(location.search), file = known.get("file") ?? data.file, language = known.get("lang");
  if (language === "en" || language === "zh") data.language = language;
  const page = new Page(data, []), desk = new Desk(page), bench = new Bench(desk);
  render(<Room bench={bench} />, document.getElementById("page")!);
  Object.assign(globalThis, { linkwright: page, desk, bench });
  await desk.open(file ? { name: file } : {});
}

void open();

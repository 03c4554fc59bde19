// The studio: the living page with its model's text beside it, and tools that draw a mechanism from nothing.
import { render } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { Card, keys, Transport } from "./app";
import type { PageData } from "./data";
import { Comparison } from "./compare";
import { Desk, WAIT } from "./desk";
import { Page } from "./living";
import { Optimise } from "./optimise";
import { Paper } from "./paper";
import type { Tool } from "./picture";
import { quantity } from "./words";
import "./studio.css";

const TOOLS: Tool[] = ["select", "fixed", "link", "guide", "slot", "gear", "rack", "cam", "driver", "mass", "load", "curve", "photo", "remove"];
const VALUES: Partial<Record<Tool, string>> = { gear: "20:40", cam: "20 mm", mass: "1 kg", load: "100 N", photo: "100 mm" };
const TAKEN = [".report.pdf", ".report.html", ".html", ".xlsx", ".csv", ".json", ".svg", ".pdf", ".png", ".dxf"];

function Drafting({ desk }: { desk: Desk }) {
  const host = useRef<HTMLDivElement>(null), paper = useRef<Paper | null>(null);
  const [tool, choose] = useState<Tool>("fixed"), [value, setValue] = useState("");
  const { picture, mobility, text } = desk.solved.value;
  useEffect(() => {
    paper.current = new Paper(host.current!, desk.act, desk.page.data.symbols!);
    paper.current.tell = (key, values) => (desk.page.note.value = desk.say(key, values));
    paper.current.drawn = (points, closed) => void desk.search("curve", { points, closed });
    const observer = new ResizeObserver(([{ contentRect: box }]) => paper.current!.resize(box.width, box.height));
    observer.observe(host.current!);
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    if (picture && !desk.pending && text === desk.text.value) paper.current!.set(structuredClone(picture));
    paper.current!.svg.setAttribute("aria-label", desk.say("paper"));
  }, [picture]);
  useLayoutEffect(() => {
    if (paper.current) Object.assign(paper.current, { tool, value });
  }, [tool, value]);
  useLayoutEffect(() => paper.current?.leave(), [tool]);
  const found = desk.sought.value, sought = found?.kind === "curve" ? found : null, [shown, show] = useState(0);
  useLayoutEffect(() => {
    if (!paper.current) return;
    const curves = sought?.candidates.map((each) => each.curve) ?? [];
    paper.current.candidates = shown < curves.length ? [curves[shown], ...curves.filter((_, k) => k !== shown)] : curves;
    paper.current.draw();
  }, [sought, shown]);
  const loads = Object.entries(picture?.loads ?? {});
  const point = (name: string | null) => {
    paper.current!.load = name;
    paper.current!.draw();
  };
  const choosePhoto = async (file: File | undefined) => {
    if (!file) return paper.current!.show(null);
    const href = URL.createObjectURL(file), image = new Image();
    image.src = href;
    try {
      await image.decode();
      paper.current!.show(href, image.naturalHeight / image.naturalWidth);
    } catch {
      URL.revokeObjectURL(href);
    }
  };
  return (
    <div>
      <h1>{desk.name.value || desk.say("new")}</h1>
      <div class="tools" role="toolbar" aria-label={desk.say("draw")}>
        {TOOLS.map((each) => (
          <button key={each} aria-pressed={each === tool} onClick={() => { choose(each); setValue(VALUES[each] ?? ""); paper.current!.leave(); }}>{desk.say(each)}</button>
        ))}
        {VALUES[tool] && <input class="value" value={value} aria-label={desk.say("value")} onInput={(event) => setValue(event.currentTarget.value)} />}
      </div>
      {tool === "photo" && (
        <div class="tools">
          <label class="choice">{desk.say("choose_photo")} <input type="file" accept="image/*" onChange={(event) => void choosePhoto(event.currentTarget.files?.[0])} /></label>
          <button onClick={() => void choosePhoto(undefined)}>{desk.say("without_photo")}</button>
        </div>
      )}
      <p class="hint">{desk.say(`help_${tool}`, { value })}</p>
      <div class="paper" ref={host} />
      {loads.length > 0 && (
        <ul class="loads" aria-label={desk.say("loads")}>
          {loads.map(([name, load]) => (
            <li key={name} onPointerEnter={() => point(name)} onPointerLeave={() => point(null)}>
              <span>{desk.say("load_is", { name, size: load.size, on: [load.on, load.at].filter(Boolean).join(".") || load.ends.join(" – ") })}</span>
              <button aria-label={desk.say("remove_load", { name })} onClick={() => void desk.act([{ do: "remove", what: "load", name }])}>×</button>
            </li>
          ))}
        </ul>
      )}
      {sought && (
        <section aria-label={desk.say("candidates")} class="candidates">
          <h2>{desk.say("candidates")}</h2>
          {sought.running && <p class="hint" role="status">{desk.say("searching")} <button onClick={() => void desk.enough()}>{desk.say("enough")}</button></p>}
          {sought.sentence && <p class="wall">{sought.sentence}</p>}
          <ol>
            {sought.candidates.map((each, k) => (
              <li key={each.text}>
                <button
                  onPointerEnter={() => show(k)} onFocus={() => show(k)}
                  onClick={() => {
                    void desk.enough();
                    desk.sought.value = null;
                    paper.current!.target = [];
                    desk.change(each.text);
                    desk.drawing.value = false;
                  }}
                >{desk.say("candidate", { links: String(each.links), error: quantity(each.error, "length", each.error, 3), angle: quantity(each.transmission_angle, "angle", 1, 3) })}</button>
              </li>
            ))}
          </ol>
        </section>
      )}
      <p class="status" role="status">{[mobility === undefined ? "" : desk.say("mobility", { value: String(mobility) }), desk.solved.value.sentence].filter(Boolean).join(desk.say("semicolon"))}</p>
    </div>
  );
}

function Text({ desk }: { desk: Desk }) {
  const area = useRef<HTMLTextAreaElement>(null), gutter = useRef<HTMLPreElement>(null);
  const { findings, sentence } = desk.solved.value, text = desk.text.value;
  const marked = new Map(findings.map((found) => [found.line, found.severity]));
  const lines = text.split("\n");
  const goTo = (line: number) => {
    const start = lines.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
    area.current!.focus();
    area.current!.setSelectionRange(start, start + (lines[line - 1]?.length ?? 0));
  };
  /** Steps of text and drawing by the keys that undo typing elsewhere; the cursor goes where the text changes. */
  const step = (event: KeyboardEvent) => {
    const which = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || (which !== "z" && which !== "y")) return;
    event.preventDefault();
    const before = desk.text.value;
    if (which === "y" || event.shiftKey) desk.history.redo();
    else desk.history.undo();
    const now = desk.text.value;
    if (now === before) return;
    let same = 0;
    while (same < Math.min(now.length, before.length) && now[now.length - 1 - same] === before[before.length - 1 - same]) same++;
    area.current!.value = now;
    area.current!.setSelectionRange(now.length - same, now.length - same);
  };
  return (
    <section class="text" aria-label={desk.say("text")}>
      <div class="editor">
        <pre class="gutter" aria-hidden="true" ref={gutter}>
          {lines.map((_, k) => <span key={k} class={marked.get(k + 1) ?? ""}>{k + 1}{"\n"}</span>)}
        </pre>
        <textarea
          ref={area} spellcheck={false} wrap="off" value={text} aria-label={desk.say("text")}
          onInput={(event) => desk.change(event.currentTarget.value, WAIT)} onKeyDown={step}
          onScroll={(event) => (gutter.current!.scrollTop = event.currentTarget.scrollTop)}
        />
      </div>
      <h2>{desk.say("findings")}</h2>
      <ul class="findings">
        {findings.map((found) => (
          <li key={`${found.line}${found.key}${found.sentence}`} class={found.severity}>
            {found.line > 0 && <button onClick={() => goTo(found.line)}>{desk.say("line", { line: String(found.line) })}</button>}
            <span>{found.key ? desk.say("finding", { name: found.key, sentence: found.sentence }) : found.sentence}</span>
          </li>
        ))}
        {!findings.length && <li>{sentence || desk.say("fine")}</li>}
      </ul>
    </section>
  );
}

/** Model files, drawings that were never saved, and models of the gallery, by name. */
interface Lists {
  files: string[];
  drafts: string[];
  gallery: string[];
}

function Bar({ desk }: { desk: Desk }) {
  const [lists, setLists] = useState<Lists>({ files: [], drafts: [], gallery: [] });
  const [name, setName] = useState(""), { page } = desk, machine = desk.session.value && !desk.drawing.value;
  useEffect(() => void desk.ask<Lists>("files").then((found) => found && setLists(found)), [desk.dirty.value, desk.name.value]);
  useEffect(() => setName(desk.name.value), [desk.name.value]);
  const drafts = lists.drafts.filter((each) => each !== desk.name.value);
  const pick = (title: string, names: string[], take: (name: string) => void, unsaved: string[] = []) => (
    <select aria-label={title} value="" onChange={(event) => event.currentTarget.value && take(event.currentTarget.value)}>
      <option value="">{title}</option>
      {names.map((each) => <option key={each}>{each}</option>)}
      {unsaved.map((each) => <option key={each} value={each}>{desk.say("never_saved", { name: each })}</option>)}
    </select>
  );
  return (
    <div class="common">
      <button onClick={() => void desk.open({ fresh: true })}>{desk.say("new")}</button>
      {pick(desk.say("open"), lists.files, (file) => void desk.open({ name: file }), drafts)}
      {pick(desk.say("gallery"), lists.gallery, (gallery) => void desk.open({ gallery }))}
      <input value={name} placeholder="machine.yaml" aria-label={desk.say("name")} onInput={(event) => setName(event.currentTarget.value)} />
      <button disabled={!name} onClick={() => void desk.save(name)}>{desk.say("save")}</button>
      <select aria-label={desk.say("take")} value="" disabled={!desk.solved.value.model} onChange={(event) => { const ending = event.currentTarget.value; event.currentTarget.value = ""; if (ending) void desk.take(ending); }}>
        <option value="">{desk.say("take")}</option>
        {TAKEN.map((each) => <option key={each} value={each}>{each.startsWith(".report") ? `${desk.say("take_report")} ${each.slice(7)}` : each}</option>)}
      </select>
      {machine && (
        <select
          aria-label={desk.say("beside")} value=""
          onChange={(event) => {
            const [kind, other] = event.currentTarget.value.split(/:(.*)/s);
            event.currentTarget.value = "";
            void desk.compare(other ? { [kind]: other } : null);
          }}
        >
          <option value="">{desk.say("beside")}</option>
          {desk.beside.value && <option value="none">{desk.say("without_beside")}</option>}
          {lists.files.map((each) => <option key={each} value={`name:${each}`}>{each}</option>)}
          <optgroup label={desk.say("gallery")}>{lists.gallery.map((each) => <option key={each} value={`gallery:${each}`}>{each}</option>)}</optgroup>
        </select>
      )}
      <button aria-pressed={desk.drawing.value} onClick={() => (desk.drawing.value ? void desk.run() : (desk.drawing.value = true))}>{desk.say(desk.drawing.value ? "run" : "draw")}</button>
      <button disabled={!desk.history.undoable} onClick={() => desk.history.undo()}>{page.say("undo")}</button>
      <button disabled={!desk.history.redoable} onClick={() => desk.history.redo()}>{page.say("redo")}</button>
      <button class="language" lang={page.language.value === "en" ? "zh-CN" : "en"} onClick={() => desk.speak(page.language.value === "en" ? "zh" : "en")}>{page.say("language")}</button>
    </div>
  );
}

/** Tells the style sheet how high the header is, which stays in sight. */
function useHeight() {
  const header = useRef<HTMLElement>(null);
  useLayoutEffect(() => {
    const observer = new ResizeObserver(() => document.documentElement.style.setProperty("--head", `${header.current!.offsetHeight}px`));
    observer.observe(header.current!);
    return () => observer.disconnect();
  }, []);
  return header;
}

function Room({ desk }: { desk: Desk }) {
  const header = useHeight();
  const { page } = desk, beside = desk.beside.value, session = desk.solved.value.model && desk.session.value, language = page.language.value;
  void desk.text.value;
  useLayoutEffect(() => {
    document.documentElement.lang = language === "zh" ? "zh-CN" : "en";
    document.title = `${desk.name.value || desk.say("new")} – Linkwright`;
    if (desk.name.value) remember({ file: desk.name.value, lang: language });
  }, [language, desk.name.value]);
  return (
    <>
      <header ref={header}>
        <Bar desk={desk} />
        {session && !desk.drawing.value && <Transport page={page} />}
      </header>
      {desk.elsewhere.value !== null && (
        <p class="banner" role="alert">
          {desk.say("elsewhere")}
          <button onClick={() => desk.takeTheirs()}>{desk.say("take_theirs")}</button>
          <button onClick={() => desk.keepMine()}>{desk.say("keep_mine")}</button>
        </p>
      )}
      {desk.onDisk.value && (
        <p class="banner" role="alert">
          {desk.onDisk.value.name === desk.name.value ? desk.say("on_disk") : desk.say("there_already", { name: desk.onDisk.value.name })}
          {desk.onDisk.value.name === desk.name.value && desk.onDisk.value.version && <button onClick={() => void desk.takeDisk()}>{desk.say("take_theirs")}</button>}
          <button onClick={() => void desk.overwrite()}>{desk.say("overwrite")}</button>
        </p>
      )}
      <main class="room">
        <div class={session && !desk.drawing.value ? "side" : "card"}>
          {session && !desk.drawing.value ? (
            <>
              <Card key={session} page={page} session={session} />
              {beside && <Card key={beside} page={page} session={beside} />}
              {beside && <Comparison page={page} sessions={[session, beside]} />}
            </>
          ) : <Drafting desk={desk} />}
        </div>
        <div class="margin">
          <Text desk={desk} />
          {session && !desk.drawing.value && <Optimise desk={desk} session={session} />}
        </div>
      </main>
      <footer>
        <p role="status" class="said">{desk.gone.value ? desk.say("gone") : page.note.value || (desk.dirty.value ? desk.say("unsaved") : "")}</p>
      </footer>
    </>
  );
}

/** The address leads to what is open, so that a page that is loaded again shows it. */
function remember(values: Record<string, string>): void {
  const known = new URLSearchParams(location.search);
  for (const [name, value] of Object.entries(values)) known.set(name, value);
  history.replaceState(null, "", `?${known}`);
}

async function open(): Promise<void> {
  const data = JSON.parse(document.getElementById("data")!.textContent) as PageData & { file: string | null };
  const known = new URLSearchParams(location.search), file = known.get("file") ?? data.file, language = known.get("lang");
  if (language === "en" || language === "zh") data.language = language;
  const page = new Page(data, []), desk = new Desk(page);
  render(<Room desk={desk} />, document.getElementById("page")!);
  keys(page);
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "s") return;
    event.preventDefault();
    if (desk.name.value) void desk.save(desk.name.value);
  });
  Object.assign(globalThis, { linkwright: page, desk });
  await desk.open(file ? { name: file } : {});
}

void open();

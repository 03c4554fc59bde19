// The dialogs that save under a name, and that open a shared link.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { named } from "../desk";
import { modelOf } from "../../share";
import type { Bench } from "../bench";
import { DialogFrame } from "./dialog";
import { isForeign } from "./sharing";
import { titleOf } from "./topbar";

export function SaveDialog({ bench }: { bench: Bench }) {
  const { desk } = bench, field = useRef<HTMLInputElement>(null), [name, setName] = useState(titleOf(bench).replace(/\.ya?ml$/, ""));
  const [problem, setProblem] = useState(""), there = desk.onDisk.value, taken = there !== null && there.name === named(name);
  // A name that was tried, and taken, is forgotten with the dialog.
  useLayoutEffect(() => () => {
    if (desk.onDisk.value?.name !== desk.name.value) desk.onDisk.value = null;
  }, []);
  const done = (saved: boolean) => {
    if (saved) bench.dialog.value = null;
    else {
      setProblem(desk.onDisk.value ? "" : bench.page.note.value);
      field.current!.focus();
    }
  };
  const save = async () => done(await (taken ? desk.save(there.name, there.version) : desk.save(name)));
  return (
    <DialogFrame bench={bench} title={bench.say("save.title")}>
      <form class="dialog-form" onSubmit={(event) => { event.preventDefault(); if (name.trim()) void save(); }}>
        <label class="field-line">
          <input
            ref={field} autofocus value={name} spellcheck={false} aria-label={bench.say("save.name")} aria-describedby="save-problem" onFocus={(event) => event.currentTarget.select()}
            onInput={(event) => { setName(event.currentTarget.value); setProblem(""); }}
          />
          {!/\.(ya?ml|json)$/i.test(name) && <span class="ending">.yaml</span>}
        </label>
        <p id="save-problem" role="alert" class="problem">{taken ? bench.say("save.taken", { name: there.name }) : problem}</p>
        <div class="dialog-acts">
          <button type="button" class="outline" onClick={() => (bench.dialog.value = null)}>{bench.say("dialog.cancel")}</button>
          <button class="primary plain" disabled={!name.trim()}>{bench.say(taken ? "save.replace" : "save")}</button>
        </div>
      </form>
    </DialogFrame>
  );
}

export function LinkDialog({ bench }: { bench: Bench }) {
  const [link, setLink] = useState(""), [problem, setProblem] = useState("");
  const open = async () => {
    if (isForeign(link)) {
      bench.dialog.value = null;
      return bench.desk.bring("link", link.trim());
    }
    const text = await modelOf(link);
    if (text === null) return setProblem(bench.say("link.none"));
    bench.dialog.value = null;
    await bench.desk.begin(text);
  };
  return (
    <DialogFrame bench={bench} title={bench.say("link.title")}>
      <form class="dialog-form" onSubmit={(event) => { event.preventDefault(); void open(); }}>
        <p class="quiet">{bench.say("link.help")}</p>
        <label class="field-line">
          <input autofocus value={link} spellcheck={false} placeholder="…#model=…" aria-label={bench.say("link.title")} onInput={(event) => { setLink(event.currentTarget.value); setProblem(""); }} />
        </label>
        <p role="alert" class="problem">{problem}</p>
        <div class="dialog-acts">
          <button type="button" class="outline" onClick={() => (bench.dialog.value = null)}>{bench.say("dialog.cancel")}</button>
          <button class="primary plain" disabled={!link.trim()}>{bench.say("open")}</button>
        </div>
      </form>
    </DialogFrame>
  );
}

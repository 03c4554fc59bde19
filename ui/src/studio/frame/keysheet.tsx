// The sheet of keys.
import { type Bench, TOOLS } from "../bench";
import { KEYS } from "../tools/tool";
import { DialogFrame } from "./dialog";
import { keyNames } from "./key_names";
import { nameOf } from "./rail";

/** Keys and the words that say what they do, by parts. */
const PARTS: [part: string, rows: [keys: string, words: string][]][] = [
  ["file", [["Ctrl Alt N", "file.new"], ["Ctrl O", "file.open"], ["Ctrl S", "file.save"], ["Ctrl Shift S", "file.save_as"], ["Ctrl K", "palette"], ["?", "keys.title"]]],
  ["edit", [
    ["Ctrl Z", "key.undo"], ["Ctrl Shift Z", "key.redo"], ["Ctrl C X V", "key.clip"], ["Ctrl D", "key.double"], ["Shift M", "key.mirror"], ["Delete", "key.remove"],
    ["← ↑ → ↓", "key.nudge"], ["Ctrl A", "key.all"], ["Esc", "key.back"],
  ]],
  ["view", [
    ["+ −", "key.zoom"], ["0", "zoom.full"], ["Shift 1", "zoom.fit"], ["Shift 2", "zoom.selection"], ["Shift ← ↑ → ↓", "key.pan"], ["Space", "key.play"], ["[ ]", "key.walk"], ["Enter", "key.cross"],
    ["Alt", "key.free"], ["Shift", "key.angle"], ["Tab", "key.next"], ["Shift K", "key.variant"],
  ]],
];

export function KeySheet({ bench }: { bench: Bench }) {
  const row = (keys: string, words: string) => <div key={keys + words}><dt>{keys.split(" ").map((each) => <kbd key={each}>{each === "Space" ? bench.say("key.space") : keyNames(each)}</kbd>)}</dt><dd>{words}</dd></div>;
  return (
    <DialogFrame bench={bench} title={bench.say("keys.title")} class="keys">
      <div class="key-parts">
        <section><h3>{bench.say("group.tool")}</h3><dl>{TOOLS.map((tool) => row(KEYS[tool], nameOf(bench, tool)))}</dl></section>
        {PARTS.map(([part, rows]) => <section key={part}><h3>{bench.say(`group.${part}`)}</h3><dl>{rows.map(([keys, words]) => row(keys, bench.say(words)))}</dl></section>)}
      </div>
    </DialogFrame>
  );
}

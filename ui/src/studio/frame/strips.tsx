// Strips under the bar: another window or another program has changed the file, the server does not answer.
import type { ComponentChildren } from "preact";
import type { Bench } from "../bench";
import { Icon } from "./icons";

function Strip({ children, bad }: { children: ComponentChildren; bad?: boolean }) {
  return <div class={bad ? "strip bad" : "strip"} role="alert"><Icon name="alert" size={16} />{children}</div>;
}

export function Strips({ bench }: { bench: Bench }) {
  const { desk } = bench, there = desk.onDisk.value, saving = bench.dialog.value?.kind === "save";
  const act = (key: string, done: () => void) => <button class="outline" onClick={done}>{bench.say(key)}</button>;
  return (
    <div class="strips">
      {desk.gone.value && <Strip bad><span>{bench.say("gone")}</span></Strip>}
      {desk.elsewhere.value !== null && (
        <Strip>
          <span>{bench.say("elsewhere")}</span>
          {act("take_theirs", () => desk.takeTheirs())}
          {act("keep_mine", () => desk.keepMine())}
        </Strip>
      )}
      {there && there.name === desk.name.value && (
        <Strip>
          <span>{bench.say(there.version ? "strip.changed" : "strip.removed", { name: there.name })}</span>
          {there.version && act("take_theirs", () => void desk.takeDisk())}
          {act("overwrite", () => void desk.overwrite())}
          {act("file.save_as", () => (bench.dialog.value = { kind: "save" }))}
        </Strip>
      )}
      {there && there.name !== desk.name.value && !saving && (
        <Strip>
          <span>{bench.say("there_already", { name: there.name })}</span>
          {act("overwrite", () => void desk.overwrite())}
          {act("dialog.cancel", () => (desk.onDisk.value = null))}
        </Strip>
      )}
    </div>
  );
}

// What is said of a link that was copied: what it holds, how it is opened, how long it is; other ways to hand a drawing on.
import { useEffect, useRef } from "preact/hooks";
import type { Bench } from "../bench";
import { Square } from "./controls";
import { Icon } from "./icons";
import { long, shareCommand } from "./sharing";

const SAID = { link: "copied", command: "command_copied", "": "copy" } as const;

export function Shared({ bench }: { bench: Bench }) {
  const host = useRef<HTMLDivElement>(null), shared = bench.shared.value;
  useEffect(() => {
    if (!shared) return;
    const shut = (event: Event) => {
      if (event instanceof KeyboardEvent ? event.key === "Escape" : !host.current!.contains(event.target as Node)) bench.shared.value = null;
    };
    if (!shared.copied) host.current!.querySelector("input")?.select();
    document.addEventListener("pointerdown", shut, true);
    document.addEventListener("keydown", shut);
    return () => {
      document.removeEventListener("pointerdown", shut, true);
      document.removeEventListener("keydown", shut);
    };
  }, [shared]);
  return (
    <div class="shared" ref={host} role="status" hidden={!shared}>
      {shared && (
        <>
          <h2><Icon name={shared.copied ? "check" : "share"} size={18} />{bench.say(`share.${SAID[shared.copied]}`)}<Square icon="close" name={bench.say("dialog.close")} act={() => (bench.shared.value = null)} /></h2>
          <p>{bench.say("share.help")}</p>
          <label class="field-line"><input readOnly value={shared.shown} aria-label={bench.say(shared.shown === shared.link ? "share.link" : "share.command_link")} onFocus={(event) => event.currentTarget.select()} /></label>
          {shared.shown === shared.link && long(shared.link) && <p class="warn"><Icon name="alert" size={16} />{bench.say("share.long", { count: String(shared.link.length) })}</p>}
          <Ways bench={bench} link={shared.link} />
        </>
      )}
    </div>
  );
}

/** For those who have no studio, and those who have none open. */
function Ways({ bench, link }: { bench: Bench; link: string }) {
  const { say, desk } = bench;
  return (
    <ul class="share-ways">
      <li>
        <button class="outline" disabled={!bench.session.value} onClick={() => void desk.take(".html")}><Icon name="play" size={16} />{say(desk.making.value ? "export.making" : "export.html")}</button>
        <span>{say("share.page_help")}</span>
      </li>
      <li>
        <button class="outline" onClick={() => void shareCommand(bench, link)}><Icon name="copy" size={16} />{say("share.command")}</button>
        <span>{say("share.command_help")}</span>
      </li>
    </ul>
  );
}

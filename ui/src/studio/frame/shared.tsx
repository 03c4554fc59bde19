// What is said of a link that was copied: what it holds, how it is opened, how long it is.
import { useEffect, useRef } from "preact/hooks";
import type { Bench } from "../bench";
import { Square } from "./controls";
import { Icon } from "./icons";
import { long } from "./sharing";

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
          <h2><Icon name={shared.copied ? "check" : "share"} size={18} />{bench.say(shared.copied ? "share.copied" : "share.copy")}<Square icon="close" name={bench.say("dialog.close")} act={() => (bench.shared.value = null)} /></h2>
          <p>{bench.say("share.help")}</p>
          <label class="field-line"><input readOnly value={shared.link} aria-label={bench.say("share.link")} onFocus={(event) => event.currentTarget.select()} /></label>
          {long(shared.link) && <p class="warn"><Icon name="alert" size={16} />{bench.say("share.long", { count: String(shared.link.length) })}</p>}
        </>
      )}
    </div>
  );
}

// The name of what the pointer or the keyboard is on: elements with `data-tip` and, where keys take them, `data-keys`.
import { useEffect, useRef } from "preact/hooks";
import { keyNames } from "./key_names";

/** How long the pointer rests first, ms; none while it goes on along a row. */
const REST = 450;
const GAP = 6, EDGE = 8;

export function Tip() {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const box = host.current!;
    let timer = 0, now: HTMLElement | null = null;
    const hide = () => {
      window.clearTimeout(timer);
      now = null;
      box.hidden = true;
    };
    const show = (at: HTMLElement) => {
      box.textContent = at.dataset.tip ?? "";
      if (at.dataset.keys) box.appendChild(document.createElement("kbd")).textContent = keyNames(at.dataset.keys);
      box.hidden = false;
      const around = at.getBoundingClientRect(), beside = at.closest("[aria-orientation=vertical]");
      const low = around.bottom + GAP + box.offsetHeight < innerHeight - EDGE;
      const x = beside ? around.right + GAP : around.left + (around.width - box.offsetWidth) / 2;
      const y = beside ? around.top + (around.height - box.offsetHeight) / 2 : low ? around.bottom + GAP : around.top - GAP - box.offsetHeight;
      box.style.left = `${Math.max(EDGE, Math.min(x, innerWidth - box.offsetWidth - EDGE))}px`;
      box.style.top = `${y}px`;
    };
    const enter = (event: Event) => {
      const at = (event.target as Element).closest<HTMLElement>("[data-tip]");
      if (at === now) return;
      const quick = !box.hidden;
      hide();
      if (!at || (event.type === "focusin" && !at.matches(":focus-visible")) || at.getAttribute("aria-expanded") === "true") return;
      now = at;
      if ((event as PointerEvent).pointerType === "touch") return;
      timer = window.setTimeout(() => at.isConnected && show(at), quick ? 0 : REST);
    };
    const listened: [string, (event: Event) => void][] = [["pointerover", enter], ["focusin", enter], ["pointerdown", hide], ["keydown", hide], ["focusout", hide]];
    for (const [name, heard] of listened) document.addEventListener(name, heard, true);
    return () => {
      hide();
      for (const [name, heard] of listened) document.removeEventListener(name, heard, true);
    };
  }, []);
  return <div class="tip" ref={host} aria-hidden="true" hidden />;
}

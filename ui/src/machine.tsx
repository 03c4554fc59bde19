// The machine on its paper: drawn when it changes or moves, dragged by its joints.
import { effect } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { Page } from "./living";
import type { Values } from "./solver";
import type { Session } from "./session";
import { put, write } from "./strokes";
import { View } from "./view";
import { quantity } from "./words";

// Rest after a change before joints are given their new names for those who do not see them, ms.
const NAMING = 150;

/** Drawn by effects, not by rendering again: a frame of a drag has no time for that. */
export function Machine({ page, session }: { page: Page; session: Session }) {
  const host = useRef<HTMLDivElement>(null), status = useRef<HTMLParagraphElement>(null);
  useLayoutEffect(() => {
    const view = new View(session.model, host.current!, session.shown), said = status.current!;
    session.view = view;
    const observer = new ResizeObserver(([{ contentRect: box }]) => view.resize(box.width, box.height));
    observer.observe(host.current!);
    attach(page, session, view);
    const say = (wall: string) => {
      put(said, "class", wall ? "status wall" : "status");
      write(said, wall || transmission(page, session, page.index(session)));
    };
    const drawn = effect(() => {
      void session.version.value;
      view.draw(page.index(session));
      const wall = page.wall(session, session.model.wall);
      if (wall || said.classList.contains("wall")) say(wall);
    });
    const told = effect(() => {
      void [session.calm.value, page.language.value];
      say(page.wall(session, session.model.wall));
    });
    let waiting = 0;
    const named = effect(() => {
      void [session.version.value, page.language.value, page.playing.value];
      window.clearTimeout(waiting);
      waiting = window.setTimeout(() => label(page, session, view), NAMING);
    });
    return () => {
      for (const stop of [drawn, told, named]) stop();
      window.clearTimeout(waiting);
      observer.disconnect();
      view.end();
    };
  }, []);
  return (
    <div class="stage">
      <div class="paper" ref={host} />
      <p class="status" role="status" ref={status} />
    </div>
  );
}

/** Names of the drawing and its joints for those who do not see them. */
function label(page: Page, session: Session, view: View): void {
  const { main } = session.model, i = page.index(session);
  view.svg.setAttribute("aria-label", page.say("drawing", { name: session.data.name[page.language.value] }));
  for (const handle of view.svg.querySelectorAll<SVGElement>(".handle")) {
    const key = handle.dataset.key!;
    const [x, y] = ["x", "y"].map((axis) => quantity(main.row(`p:${key}.${axis}`)[i], "length"));
    handle.setAttribute("aria-label", page.say("joint", { name: key, x, y }));
  }
}

function transmission(page: Page, session: Session, i: number): string {
  let worst = Infinity, name = "";
  for (const signal of session.data.signals) {
    if (!signal.id.startsWith("m:")) continue;
    const angle = session.model.main.row(signal.id)[i];
    if (angle < worst) [worst, name] = [angle, signal.id.slice(2)];
  }
  return name ? page.say("transmission_now", { value: quantity(worst, "angle", 1, 3), name }) : "";
}

/** Dragging by pointer and by arrow keys. */
function attach(page: Page, session: Session, view: View): void {
  let dragged: { key: string; base: Values; dx: number; dy: number } | null = null;
  const move = (key: string, base: Values, x: number, y: number) => {
    session.model.drag(base, key, view.index, ...view.world(x, y));
    session.moved();
  };
  view.svg.addEventListener("pointerdown", (event) => {
    const handle = (event.target as Element).closest<SVGElement>(".handle");
    if (!handle) return;
    event.preventDefault();
    page.play(false);
    handle.setPointerCapture(event.pointerId);
    const [dx, dy] = [Number(handle.getAttribute("cx")) - event.pageX / view.zoom, Number(handle.getAttribute("cy")) - event.pageY / view.zoom];
    dragged = { key: handle.dataset.key!, base: { ...session.model.values }, dx, dy };
    session.begin();
    session.held = true;
    handle.focus();
  });
  view.svg.addEventListener("pointermove", (event) => {
    if (!dragged) return;
    const { key, base, dx, dy } = dragged, { pageX, pageY } = event;
    page.soon(() => move(key, base, pageX / view.zoom + dx, pageY / view.zoom + dy));
  });
  const stop = () => {
    if (!dragged) return;
    page.flush();
    dragged = null;
    session.held = false;
    session.end(true);
  };
  view.svg.addEventListener("pointerup", stop);
  view.svg.addEventListener("pointercancel", stop);
  view.svg.addEventListener("keydown", (event) => {
    const key = (event.target as SVGElement).dataset?.key;
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!key || !way) return;
    event.preventDefault();
    page.play(false);
    const far = (event.shiftKey ? 10 : 1) / view.zoom, handle = event.target as SVGElement;
    session.begin();
    move(key, { ...session.model.values }, Number(handle.getAttribute("cx")) + far * way[0], Number(handle.getAttribute("cy")) + far * way[1]);
    session.end(true);
  });
}

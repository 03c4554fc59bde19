// The frame of a dialog: the browser's own, so that focus stays in it, Escape shuts it and the focus goes back.
import type { ComponentChildren } from "preact";
import { useId, useLayoutEffect, useRef } from "preact/hooks";
import type { Bench } from "../bench";
import { Square } from "./controls";

interface Props {
  bench: Bench;
  title: string;
  class?: string;
  /** Without a line of its own for title and cross. */
  bare?: boolean;
  children: ComponentChildren;
}

export function DialogFrame({ bench, title, class: style = "", bare, children }: Props) {
  const host = useRef<HTMLDialogElement>(null), id = useId();
  // Before it is painted: what is typed at once goes into it.
  useLayoutEffect(() => {
    host.current!.showModal();
    host.current!.querySelector<HTMLElement>("[autofocus]")?.focus();
  }, []);
  const shut = () => host.current!.close();
  return (
    <dialog
      ref={host} class={`dialog ${style}`} aria-labelledby={bare ? undefined : id} aria-label={bare ? title : undefined}
      onClose={() => (bench.dialog.value = null)} onPointerDown={(event) => event.target === host.current && shut()}
    >
      <div class="dialog-body">
        {!bare && <header class="dialog-head"><h2 id={id}>{title}</h2><Square icon="close" name={bench.say("dialog.close")} act={shut} /></header>}
        {children}
      </div>
    </dialog>
  );
}

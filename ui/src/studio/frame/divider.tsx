// A divider between two regions: dragged, moved by arrow keys, set back by a double click.
import { useRef } from "preact/hooks";
import { STEP } from "./layout";

interface Props {
  /** The region whose edge it is: the inspector's left one, the dock's upper one. */
  of: "inspector" | "dock";
  label: string;
  value: number;
  least: number;
  most: number;
  set: (value: number | null) => void;
}

export function Divider({ of, label, value, least, most, set }: Props) {
  const held = useRef<{ from: number; at: number } | null>(null), upright = of === "inspector";
  const to = (size: number) => set(Math.round(Math.max(least, Math.min(most, size))));
  const place = (event: PointerEvent) => (upright ? event.clientX : event.clientY);
  const key = (event: KeyboardEvent) => {
    const more = upright ? "ArrowLeft" : "ArrowUp", less = upright ? "ArrowRight" : "ArrowDown";
    const found = { [more]: value + STEP, [less]: value - STEP, Home: least, End: most }[event.key];
    if (found === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    to(found);
  };
  return (
    <div
      class={`divider at-${of}`} role="separator" tabIndex={0} aria-label={label} aria-orientation={upright ? "vertical" : "horizontal"}
      aria-valuenow={value} aria-valuemin={least} aria-valuemax={most}
      onPointerDown={(event) => {
        if (event.button) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        held.current = { from: place(event), at: value };
      }}
      onPointerMove={(event) => held.current && to(held.current.at + held.current.from - place(event))}
      onPointerUp={() => (held.current = null)} onPointerCancel={() => (held.current = null)}
      onDblClick={() => set(null)} onKeyDown={key}
    />
  );
}

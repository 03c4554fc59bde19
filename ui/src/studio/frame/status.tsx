// The line at the foot: what the drawing is now, where the pointer is, snap, grid, unit, zoom.
import { effect, type Signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Bench, Settings } from "../bench";
import { FULL } from "../sheet/camera";
import { spacing } from "../sheet/grid";
import { spoken } from "../sheet/names";
import { Square } from "./controls";
import { Icon } from "./icons";
import { type Choices, MenuButton } from "./menu";

type Unit = Settings["unit"];
/** SI value and decimal places of a coordinate. */
const UNITS: Record<Unit, [factor: number, places: number]> = { mm: [1e-3, 1], cm: [1e-2, 2], m: [1, 4], in: [0.0254, 3] };
const GRIDS: Record<Unit, number[]> = {
  mm: [1, 2, 5, 10, 20, 50, 100, 200, 500], cm: [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50], m: [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1],
  in: [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20],
};
const ZOOM = 1.25;

const plain = (x: number) => String(Number(x.toPrecision(6))).replace("-", "−");

export function Status({ bench }: { bench: Bench }) {
  return (
    <footer class="status">
      <Said bench={bench} />
      <Where bench={bench} />
      <Sheet bench={bench} />
    </footer>
  );
}

/** A note of the page, else what the drawing is now; said aloud when it changes. `brief`: only what must be said. */
export function Said({ bench, brief }: { bench: Bench; brief?: boolean }) {
  const { desk, page } = bench, { structure, findings, sentence, outline } = desk.solved.value, note = page.note.value;
  const gap = bench.gap.value, empty = outline !== undefined && !Object.keys(outline.entries.links ?? {}).length;
  const errors = !empty && findings.some(({ severity }) => severity === "error");
  const words = note || gap?.title || (structure?.headline ?? (empty ? bench.say("status.empty") : sentence));
  const item = bench.one, scene = bench.sheet.value?.scene, chosen = !brief && item && scene ? spoken(bench, scene, item) : "";
  const sign = note ? "info" : empty ? null : gap || errors ? "alert" : structure ? "check" : null;
  return (
    <p class={`said ${sign ?? ""}`} role="status" hidden={brief && !note && !gap}>
      {sign && <Icon name={sign} size={15} />}
      <span>{words}</span>
      {chosen && <span class="chosen" aria-hidden="true">{chosen}</span>}
    </p>
  );
}

/** Where the pointer is, without rendering at each of its moves. */
function Where({ bench }: { bench: Bench }) {
  const host = useRef<HTMLSpanElement>(null);
  useEffect(() => effect(() => {
    const at = bench.cursor.value, [factor, places] = UNITS[bench.settings.value.unit], shown = (x: number) => (x / factor).toFixed(places).replace("-", "−");
    if (!host.current) return; // the layout is being changed
    host.current.hidden = !at;
    if (at) host.current.querySelectorAll("b").forEach((each, k) => (each.textContent = shown(at[k])));
  }), []);
  return <span class="where" ref={host} hidden><i class="sym">x</i> <b /> <i class="sym">y</i> <b /></span>;
}

function Sheet({ bench }: { bench: Bench }) {
  const { snap, grid, unit } = bench.settings.value, [factor] = UNITS[unit], view = () => bench.view;
  const grids = (): Choices => [
    { label: bench.say("grid.by_zoom"), checked: grid === 0, act: () => bench.set({ grid: 0 }) },
    null,
    ...GRIDS[unit].map((each) => ({ label: `${plain(each)} ${unit}`, checked: Math.abs(grid - each * factor) < 1e-9, act: () => bench.set({ grid: each * factor }) })),
    null,
    { label: bench.say(bench.shows("grid") ? "grid.hide" : "grid.show"), act: () => bench.show("grid", !bench.shows("grid")) },
  ];
  const units = () => (Object.keys(UNITS) as Unit[]).map((each) => ({ label: bench.say(`unit.${each}`), keys: each, checked: each === unit, act: () => bench.set({ unit: each }) }));
  return (
    <>
      <button class="snap" aria-pressed={snap} data-tip={bench.say("snap.help")} onClick={() => bench.set({ snap: !snap })}><Icon name="magnet" size={16} />{bench.say("snap")}</button>
      <MenuButton label={bench.say("grid.spacing")} choices={grids}>{bench.say("grid.now", { value: "" })}<Spacing bench={bench} /><Icon name="chevron" size={12} /></MenuButton>
      <MenuButton label={bench.say("unit")} choices={units} name={bench.say("unit.now", { unit })}>{unit}<Icon name="chevron" size={12} /></MenuButton>
      <span class="zoom" role="group" aria-label={bench.say("zoom")}>
        <Square icon="minus" size={14} name={bench.say("zoom.out")} keys="−" act={() => view()?.zoom(1 / ZOOM)} />
        <button class="percent" data-tip={bench.say("zoom.full")} data-keys="0" onClick={() => view()?.full()}><Percent scale={bench.scale} /></button>
        <Square icon="plus" size={14} name={bench.say("zoom.in")} keys="+" act={() => view()?.zoom(ZOOM)} />
        <Square icon="fit" size={15} name={bench.say("zoom.fit")} keys="Shift 1" act={() => view()?.fit()} />
      </span>
    </>
  );
}

/** The spacing of the grid as it is drawn, written without rendering the line again. */
function Spacing({ bench }: { bench: Bench }) {
  const host = useRef<HTMLSpanElement>(null);
  useEffect(() => effect(() => {
    const { grid, unit } = bench.settings.value, [factor] = UNITS[unit];
    if (host.current) host.current.textContent = `${plain(spacing(bench.scale.value, grid) / factor)} ${unit}`;
  }), []);
  return <span ref={host} />;
}

/** The zoom, written without rendering the line again. */
function Percent({ scale }: { scale: Signal<number> }) {
  const host = useRef<HTMLSpanElement>(null);
  useEffect(() => effect(() => {
    const share = (100 * scale.value) / FULL;
    if (host.current) host.current.textContent = `${share < 10 ? Number(share.toPrecision(2)) : Math.round(share)} %`;
  }), []);
  return <span ref={host} />;
}

// One dimension in hand: its value, a slider with a mark where it was, the range that can be swept.
import { useRef } from "preact/hooks";
import type { Dimension } from "../../data";
import type { Session } from "../../session";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { set } from "./change";
import { addressPath, at, word } from "./entries";
import { Select, Typing } from "./fields";
import { inUnit, shownUnit, si } from "./quantities";

const shown = (value: number, { factor }: Dimension) => String(Number((value / factor).toPrecision(5))).replace("-", "−");

/** A range about the present value that a slider has unasked, with round ends (SI). */
export function rangeOf(session: Session, dimension: Dimension): { low: number; high: number } {
  const now = session.model.values[dimension.address] / dimension.factor, turns = dimension.unit === "deg" || dimension.unit === "rad";
  const reach = now && dimension.positive ? 0.3 * now : turns ? (dimension.unit === "deg" ? 45 : 0.8) : 0.3 * (Math.abs(now) || session.model.size / dimension.factor);
  const step = 10 ** Math.floor(Math.log10(reach || 1)) / 2, round = (x: number) => Number((Math.round(x / step) * step).toPrecision(6));
  const low = round(now - reach), high = round(now + reach);
  return { low: (dimension.positive && low <= 0 ? step : low) * dimension.factor, high: high * dimension.factor };
}

export function InHand({ bench, session }: { bench: Bench; session: Session }) {
  void session.calm.value;
  const { say } = bench, { dimensions } = session.data, hand = bench.inHand.value, field = useRef<HTMLInputElement>(null);
  const usual = dimensions.find(({ geometry, positive }) => geometry && positive) ?? dimensions.find(({ geometry }) => geometry) ?? dimensions[0];
  const chosen = dimensions.find(({ address }) => address === hand?.address) ?? selectedDimension(bench, dimensions) ?? usual;
  if (!chosen) return null;
  const { address, factor, unit } = chosen, { model } = session, now = model.values[address], was = model.original.values[address] ?? chosen.value;
  const { low, high } = hand?.address === address ? hand : rangeOf(session, chosen);
  const from = Math.min(low, now, was), to = Math.max(high, now, was), share = (value: number) => `${(100 * (value - from)) / (to - from || 1)}%`;
  const pick = (name: string) => {
    const dimension = dimensions.find((each) => each.address === name)!;
    bench.inHand.value = { address: name, ...rangeOf(session, dimension) };
  };
  const slide = (value: number) => bench.page.soon(() => {
    model.change({ ...model.values, [address]: value * factor });
    session.moved();
    field.current!.value = String(model.values[address] / factor);
  });
  const done = () => {
    bench.page.flush();
    session.end(true);
  };
  const type = async (text: string) => {
    const entries = bench.desk.solved.value.outline?.entries ?? {}, path = addressPath(entries, address);
    if (path && typeof at(entries, ...path) === "string") return set(bench, path, text);
    const value = si(text);
    if (!Number.isFinite(value)) return say("insp.no_quantity", { text });
    session.take({ ...model.values, [address]: value });
    return null;
  };
  const end = (which: "low" | "high") => async (text: string) => {
    const value = si(text), next = { address, low, high, [which]: value };
    if (!Number.isFinite(value) || next.high <= next.low) return say("insp.no_range");
    bench.inHand.value = next;
    return null;
  };
  const path = addressPath(bench.desk.solved.value.outline?.entries ?? {}, address), text = path ? word(at(bench.desk.solved.value.outline?.entries, ...path)) : "";
  const current = now === chosen.value && text ? text : `${inUnitOf(now, chosen)} ${unit}`.trim();
  return (
    <div class="knob">
      <div class="knob-h">
        <Select label={say("insp.in_hand")} value={address} options={dimensions.map((each) => [each.address, each.address])} set={pick} />
        <span class="was">{was === now ? "" : `${shown(was, chosen)} ${shownUnit(unit)}`}</span>
        <Typing label={say("insp.value_of", { name: address })} value={current} unit={unit} set={type} />
      </div>
      <div class="slide">
        <i class="fill" style={{ left: share(Math.min(was, now)), right: `calc(100% - ${share(Math.max(was, now))})` }} />
        <i class="was-mark" style={{ left: share(was) }} title={say("insp.was", { value: `${shown(was, chosen)} ${shownUnit(unit)}` })} />
        <input
          ref={field} type="range" min={from / factor} max={to / factor} step="any" value={now / factor} aria-label={address} aria-valuetext={`${shown(now, chosen)} ${unit}`}
          disabled={bench.locked.value.has(address)}
          onPointerDown={() => (session.begin(), (session.held = true))} onKeyDown={(event) => event.key.startsWith("Arrow") && session.begin()} onPointerUp={() => (session.held = false)} onPointerCancel={() => (session.held = false)}
          onInput={(event) => slide(Number(event.currentTarget.value))} onChange={done}
        />
      </div>
      {model.wall && <small class="fault" role="status">{bench.page.wall(session, model.wall)}</small>}
      <div class="knob-f">
        <Typing label={say("insp.range_low")} value={`${inUnitOf(low, chosen)} ${unit}`.trim()} unit={unit} set={end("low")} />
        <button type="button" class="text" onClick={() => ((bench.inHand.value = { address, low, high }), (bench.dock.value = "sweep"))}><Icon name="sweep" size={16} />{say("insp.sweep_range")}</button>
        <Typing label={say("insp.range_high")} value={`${inUnitOf(high, chosen)} ${unit}`.trim()} unit={unit} set={end("high")} />
      </div>
    </div>
  );
}

const inUnitOf = (value: number, { factor, unit }: Dimension) => (Number.isFinite(si(`1 ${unit}`)) ? inUnit(value, unit, 6) : String(Number((value / factor).toPrecision(6))));

/** The first dimension of what is selected. */
function selectedDimension(bench: Bench, dimensions: Dimension[]): Dimension | undefined {
  const item = bench.one;
  if (!item) return undefined;
  if (item.kind === "dimension") return dimensions.find(({ address }) => address === item.name);
  return dimensions.find(({ address }) => address.startsWith(item.kind === "point" ? `frame.${item.name}.` : `${item.name}.`) || address.startsWith(`loads.${item.name}.`));
}

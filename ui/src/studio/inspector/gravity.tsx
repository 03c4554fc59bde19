// Gravity: its size and where it pulls.
import type { Bench } from "../bench";
import { set } from "./change";
import { type Table } from "./entries";
import { Quantity, Section } from "./fields";
import { Head, Written } from "./head";
import { allLoads, gravityOf, LoadList } from "./loads_list";
import type { PanelProps } from "./selected";

export function GravityPanel({ bench, item, entries }: PanelProps) {
  const { say } = bench;
  return (
    <>
      <Head bench={bench} icon="gravity" title={say("insp.gravity")} item={item} tone="load" fixedName>{say("insp.gravity_about")}</Head>
      <div class="form"><GravityFields bench={bench} entries={entries} /></div>
      <Section bench={bench} id="insp.all_loads" title={say("insp.all_loads")} count={allLoads(entries).length + 1}>{() => <LoadList bench={bench} entries={entries} names={allLoads(entries)} gravity />}</Section>
      <Written bench={bench} path={["gravity"]} />
    </>
  );
}

export function GravityFields({ bench, entries }: { bench: Bench; entries: Table }) {
  const { say } = bench, field = gravityOf(entries);
  if (!field) return null;
  const [x, y] = field, size = Math.hypot(x, y), angle = Math.atan2(y, x);
  const write = (far: number, turn: number) => {
    const part = (each: number) => `${Number(each.toPrecision(7)) || 0} m/s²`;
    return set(bench, ["gravity"], [part(tidy(far * Math.cos(turn), far)), part(tidy(far * Math.sin(turn), far))]);
  };
  const take = (work: (value: number) => Promise<string | null>, unit: RegExp) => async (text: string) => {
    const value = Number.parseFloat(text);
    return Number.isFinite(value) && unit.test(text) ? work(value) : say("insp.no_quantity", { text });
  };
  return (
    <>
      <Quantity label={say("insp.size_of")} value={`${Number(size.toPrecision(7))} m/s²`} unit="m/s²" set={take((value) => write(value, angle), /^[-+.\d]+ ?m\/s²$/)} />
      <Quantity label={say("insp.direction")} value={`${Number(((angle * 180) / Math.PI).toPrecision(5))} deg`} unit="deg" set={take((value) => write(size, (value * Math.PI) / 180), /^[-+.\d]+ ?(deg|°)$/)} />
    </>
  );
}

const tidy = (part: number, size: number) => (Math.abs(part) < 1e-9 * size ? 0 : part);

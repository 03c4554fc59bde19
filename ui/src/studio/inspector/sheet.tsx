// The sheet itself, where nothing is selected: units, grid, gravity, what the machine is called, drafts.
import { useEffect, useId, useState } from "preact/hooks";
import type { Bench, Settings } from "../bench";
import { Icon } from "../frame/icons";
import { put, set, tell, unset } from "./change";
import { at, isTable, type Path, type Table, word } from "./entries";
import { Choice, Quantity, Section, Switch } from "./fields";
import { GravityFields } from "./gravity";
import { allLoads, GRAVITY, gravityOf, gravityText, LoadList } from "./loads_list";
import { inUnit, si } from "./quantities";

const UNITS: Settings["unit"][] = ["mm", "cm", "m", "in"];

export function SheetPanel({ bench }: { bench: Bench }) {
  const { say } = bench, { unit, grid } = bench.settings.value, entries = bench.desk.solved.value.outline?.entries ?? {}, field = gravityOf(entries), loads = allLoads(entries);
  const space = async (text: string) => {
    if (!text) return bench.set({ grid: 0 }), null;
    const value = si(text);
    if (!(value > 0)) return say("insp.no_length", { text });
    bench.set({ grid: value });
    return null;
  };
  return (
    <>
      <div class="who"><span class="glyph"><Icon name="sheet" size={22} /></span><div><h2>{say("insp.sheet")}</h2><p>{say("insp.nothing")}</p></div></div>
      <div class="form">
        <Choice label={say("insp.units")} value={unit} options={UNITS.map((each) => [each, `${each}, °, N, kg`])} set={(to) => bench.set({ unit: to as Settings["unit"] })} />
        <Quantity label={say("insp.grid")} value={grid ? `${inUnit(grid, unit)} ${unit}` : ""} unit={unit} preset={say("insp.by_zoom")} optional set={space} />
        <Switch label={say("insp.gravity")} on={field !== null} set={(on) => void tell(bench, on ? set(bench, ["gravity"], GRAVITY) : unset(bench, ["gravity"]))}>{field ? gravityText(field) : say("insp.off")}</Switch>
        {field && <GravityFields bench={bench} entries={entries} />}
      </div>
      {loads.length > 0 && <Section bench={bench} id="insp.sheet_loads" title={say("insp.loads")} count={loads.length}>{() => <LoadList bench={bench} entries={entries} names={loads} />}</Section>}
      {entries.links !== undefined && (
        <Section bench={bench} id="insp.machine" title={say("insp.machine")} open={false}>
          {() => (
            <div class="form">
              <Words bench={bench} label={say("insp.title")} path={["name"]} entries={entries} />
              <Words bench={bench} label={say("insp.purpose")} path={["purpose"]} entries={entries} />
              <Words bench={bench} label={say("insp.source")} path={["source"]} entries={entries} />
            </div>
          )}
        </Section>
      )}
      <Drafts bench={bench} />
    </>
  );
}

/** A text of the machine, in the language of the page where it has several. */
function Words({ bench, label, path, entries }: { bench: Bench; label: string; path: Path; entries: Table }) {
  const own = at(entries, ...path), place = isTable(own) ? [...path, bench.page.language.value] : path, value = word(at(entries, ...place)), id = useId();
  return (
    <div class="field tall">
      <label for={id}>{label}</label>
      <textarea id={id} rows={2} value={value} onChange={(event) => void tell(bench, put(bench, place, event.currentTarget.value.trim()))} />
    </div>
  );
}

/** A draft as the server lists it. */
interface Draft {
  name: string;
  /** ms since 1970. */
  time: number;
  saved: boolean;
}

function Drafts({ bench }: { bench: Bench }) {
  const { say, desk } = bench, [drafts, setDrafts] = useState<Draft[]>([]);
  useEffect(() => void desk.ask<{ drafts: (string | Partial<Draft> & { name: string })[] }>("files").then((found) => {
    const all = (found?.drafts ?? []).map((each) => typeof each === "string" ? { name: each, time: 0, saved: false } : { name: each.name, time: each.time ?? 0, saved: each.saved ?? false });
    setDrafts(all.filter(({ name }) => name !== desk.name.value).sort((a, b) => b.time - a.time));
  }), [desk.name.value, desk.dirty.value]);
  if (!drafts.length) return null;
  return (
    <Section bench={bench} id="insp.drafts" title={say("insp.drafts")} count={drafts.length}>
      {() => (
        <ul class="list">
          {drafts.slice(0, 12).map(({ name, time, saved }) => (
            <li key={name}><button type="button" onClick={() => void desk.open({ name })}><b>{name.replace(/\.ya?ml$/, "")}</b><span>{time ? when(bench, time) : ""}</span><small>{say(saved ? "insp.changed_since" : "insp.never_saved")}</small></button></li>
          ))}
        </ul>
      )}
    </Section>
  );
}

/** "today 14:02", "yesterday 18:15", a date. */
function when(bench: Bench, time: number): string {
  const date = new Date(time), language = bench.page.language.value === "zh" ? "zh-CN" : "en-GB", clock = date.toLocaleTimeString(language, { hour: "2-digit", minute: "2-digit" });
  const midnight = new Date().setHours(0, 0, 0, 0), day = 86_400_000;
  if (time >= midnight) return bench.say("insp.today", { time: clock });
  if (time >= midnight - day) return bench.say("insp.yesterday", { time: clock });
  return date.toLocaleDateString(language, { day: "numeric", month: "short" });
}

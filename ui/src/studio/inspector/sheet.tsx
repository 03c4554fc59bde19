// The sheet itself, where nothing is selected: units, grid, gravity, what the machine is called, drafts.
import { useId } from "preact/hooks";
import type { Bench, Settings } from "../bench";
import { Icon } from "../frame/icons";
import { draftNote, draftTitle, useFolder } from "../frame/open";
import { when } from "../frame/when";
import { put, set, tell, unset } from "./change";
import { Construction } from "./construction";
import { at, isTable, type Path, type Table, word } from "./entries";
import { Choice, Quantity, Section, Switch } from "./fields";
import { GravityFields } from "./gravity";
import { allLoads, GRAVITY, gravityOf, gravityText, LoadList } from "./loads_list";
import { inUnit, si } from "./quantities";

/** Drafts that are listed. */
const MOST = 12;
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
      {entries.links !== undefined && <Construction bench={bench} entries={entries} />}
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

function Drafts({ bench }: { bench: Bench }) {
  const { say, desk, page } = bench, drafts = (useFolder(bench, `${desk.name.value} ${desk.dirty.value}`)?.drafts ?? []).filter(({ name }) => name !== desk.name.value);
  if (!drafts.length) return null;
  return (
    <Section bench={bench} id="insp.drafts" title={say("insp.drafts")} count={drafts.length}>
      {() => (
        <ul class="list">
          {drafts.slice(0, MOST).map((each) => (
            <li key={each.name}><button type="button" onClick={() => void desk.open({ name: each.name })}><b>{draftTitle(each)}</b><span>{when(each.time, page.language.value, say)}</span><small>{draftNote(bench, each)}</small></button></li>
          ))}
        </ul>
      )}
    </Section>
  );
}

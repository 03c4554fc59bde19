// A load: how large it is and where it points, in which body that is held, when it acts.
import type { Bench } from "../bench";
import type { IconName } from "../frame/icons";
import type { Entry } from "../outline";
import { turned } from "../tools/hand";
import { written } from "../tools/written";
import { Acting } from "./acting";
import { put, set, tell } from "./change";
import { at, guideOf, type Path, pointsOf, type Table, table, word, words } from "./entries";
import { Chips, Choice, Quantity, Row, Section, Segments, Sym } from "./fields";
import { Head, Written } from "./head";
import { aboutLoad, allLoads, LoadList, sortOf } from "./loads_list";
import { Fields, type Spec } from "./pair";
import type { PanelProps } from "./selected";

const tension: Spec = { key: "preload", label: "preload", form: "quantity", unit: "N", preset: "0" };
const push: Spec = { key: "preload", label: "preload", form: "quantity", unit: "N" };
const KINDS: Record<string, { icon: IconName; fields: Spec[] }> = {
  force: { icon: "force", fields: [] },
  torque: { icon: "torque", fields: [] },
  spring: { icon: "spring", fields: [{ key: "stiffness", label: "stiffness", form: "quantity", unit: "N/mm" }, { key: "free_length", label: "free_length", form: "quantity", unit: "mm", preset: "0" }, tension] },
  gas_spring: { icon: "gas_spring", fields: [push, { key: "stiffness", label: "stiffness", form: "quantity", unit: "N/mm" }, { key: "free_length", label: "free_length", form: "quantity", unit: "mm", preset: "0" }] },
  cylinder: { icon: "cylinder", fields: [push] },
  damper: { icon: "damper", fields: [{ key: "damping", label: "damping", form: "quantity", unit: "N·s/m" }] },
  torsion_spring: {
    icon: "torsion_spring",
    fields: [{ key: "stiffness", label: "stiffness", form: "quantity", unit: "N·m/rad" }, { key: "free_angle", label: "free_angle", form: "quantity", unit: "deg", preset: "0" }, { ...tension, unit: "N·m" }],
  },
  torsion_damper: { icon: "torsion_spring", fields: [{ key: "damping", label: "damping", form: "quantity", unit: "N·m·s/rad" }] },
  pressure: { icon: "cylinder", fields: [{ key: "bore", label: "bore", form: "quantity", unit: "mm", preset: "–" }, { key: "area", label: "area", form: "quantity", unit: "mm²", preset: "–" }, { key: "pushes", label: "pushes", form: "words", words: ["forward", "backward"], preset: "forward" }] },
};

/** The units of sizes, by the kind of load. */
export const UNITS: Record<string, string> = { force: "N", torque: "N·m", pressure: "MPa" };

export function LoadPanel({ bench, item, entries }: PanelProps) {
  const { say } = bench, { name } = item, path: Path = ["loads", name], load = table(at(entries, ...path)), kind = sortOf(load);
  const { icon, fields } = KINDS[kind] ?? { icon: "force" as const, fields: extras(load) }, ends = words(load.between), links = words(load.links);
  return (
    <>
      <Head bench={bench} icon={icon} title={name} item={item} tone="load">{aboutLoad(bench, load)}</Head>
      <div class="form">
        {load.components !== undefined ? <Components bench={bench} path={path} load={load} /> : kind in UNITS && <Size bench={bench} path={path} load={load} unit={UNITS[kind]} />}
        {kind === "force" && load.components === undefined && <Direction bench={bench} name={name} load={load} entries={entries} />}
        {kind === "torque" && <Sense bench={bench} path={path} load={load} />}
        <Fields bench={bench} path={path} entry={load} specs={fields} />
        {word(load.at) && <Chips label={say("insp.point")} names={[word(load.at)]} pick={(point) => bench.select({ kind: "point", name: point })} />}
        {ends.length > 0 && <Row label={say("insp.ends")}><span class="chips">{ends.map((end) => <button key={end} type="button" onClick={() => bench.select({ kind: "point", name: end.split(".")[1] ?? end })}><Sym name={end} /></button>)}</span></Row>}
        {links.length > 0 && <Chips label={say("insp.links")} names={links.filter((link) => link !== "frame")} symbols={false} pick={(link) => bench.select({ kind: "link", name: link })} />}
      </div>
      {kind in UNITS && <Acting bench={bench} name={name} load={load} entries={entries} unit={UNITS[kind]} />}
      <Section bench={bench} id="insp.all_loads" title={say("insp.all_loads")} count={allLoads(entries).length + 1}>{() => <LoadList bench={bench} entries={entries} names={allLoads(entries)} gravity />}</Section>
      <Written bench={bench} path={path} />
    </>
  );
}

/** The quantities of a load of a kind without fields of its own here. */
const extras = (load: Table): Spec[] =>
  Object.entries(load).filter(([key, value]) => typeof value === "string" && !["kind", "on", "at", "against", "joint"].includes(key)).map(([key]) => ({ key, label: key, form: "quantity", unit: "" }));

/** Its size where it is one number; a ramp or table stands below, under when it acts. */
function Size({ bench, path, load, unit }: { bench: Bench; path: Path; load: Table; unit: string }) {
  if (load.magnitude === undefined) return null;
  return <Quantity label={bench.say("insp.size_of")} value={word(load.magnitude)} unit={unit} set={(text) => set(bench, [...path, "magnitude"], text)} />;
}

function Components({ bench, path, load }: { bench: Bench; path: Path; load: Table }) {
  const parts = words(load.components);
  return (
    <>
      {parts.map((value, k) => <Quantity key={k} label={bench.say(k ? "insp.y" : "insp.x")} value={value} unit="N" set={(text) => set(bench, [...path, "components"], parts.map((old, j) => (j === k ? text : old)))} />)}
    </>
  );
}

type Held = "space" | "link" | "guide" | "opposes";

/** Where a force points, and what holds its direction: space, its link, or the guide that its link slides in. */
function Direction({ bench, name, load, entries }: { bench: Bench; name: string; load: Table; entries: Table }) {
  const { say } = bench, path: Path = ["loads", name], guide = guideOf(entries, word(load.on))?.[1], along = words(load.along).length ? "along" : "normal_to";
  const ray = words(load[along]), own = word(load.direction), lead = word(guide?.direction);
  // Where it points now, and the axes that it may turn with, rad.
  const stand = bench.sheet.value?.stand, drawn = stand?.loads[name], way = (drawn && stand.direction(drawn)) ?? 0;
  const axis = stand?.axis(word(load.on)) ?? 0, slides = stand?.guideOf(word(load.on))?.angle ?? axis, along_guide = Math.abs(Math.sin(way - slides)) < 1e-6;
  const held: Held = load.opposes !== undefined ? "opposes" : load.in_link !== undefined ? (guide && along_guide ? "guide" : "link") : (ray.length && guide) || (lead && parallel(own, lead)) ? "guide" : "space";
  const hold = (to: Held) => void tell(bench, set(bench, path, withDirection(load, direction(to))));
  const direction = (to: Held): Record<string, Entry> => {
    if (to === "link") return { in_link: written(turned(way - axis), "angle") };
    if (to === "opposes") return { opposes: "velocity" };
    // A block has the axes of its guide: what is held in it stays along the guide wherever that leads.
    if (to === "guide") return { in_link: written(turned(slides - axis + (Math.cos(way - slides) < 0 ? Math.PI : 0)), "angle") };
    return { direction: written(turned(way), "angle") };
  };
  const options: [Held, string][] = [["space", say("insp.held_space")], ["link", say("insp.held_link")], ...(guide ? [["guide", say("insp.held_guide")] as [Held, string]] : [])];
  return (
    <>
      {ray.length > 0 && <Ray bench={bench} path={path} load={load} along={along} entries={entries} />}
      {(own || load.in_link !== undefined) && <Quantity label={say("insp.direction")} value={own || word(load.in_link)} unit="deg" set={(text) => set(bench, [...path, own ? "direction" : "in_link"], text)} />}
      {held === "opposes" ? <Row label={say("insp.direction")}><span class="quiet">{say("insp.opposes")}</span></Row> : null}
      <Row label={say("insp.held")}><Segments label={say("insp.held")} value={ray.length && !guide ? "link" : held} options={options} set={(to) => hold(to as Held)} /></Row>
    </>
  );
}

function withDirection(load: Table, direction: Record<string, Entry>): Table {
  const ways = new Set(["direction", "in_link", "along", "normal_to", "opposes"]), before = Object.entries(load).filter(([key]) => !ways.has(key));
  const place = Object.keys(load).findIndex((key) => ways.has(key));
  before.splice(place < 0 ? before.length : place, 0, ...Object.entries(direction));
  return Object.fromEntries(before);
}

const degrees = (text: string) => Number.parseFloat(text);
const parallel = (a: string, b: string) => a !== "" && Math.abs(Math.sin(((degrees(a) - degrees(b)) * Math.PI) / 180)) < 1e-9;

/** A direction by two points of its link: along their line or square to it. */
function Ray({ bench, path, load, along, entries }: { bench: Bench; path: Path; load: Table; along: string; entries: Table }) {
  const { say } = bench, [from, to] = words(load[along]), { own, also } = pointsOf(at(entries, "links", word(load.on)));
  const points = [...own, ...also], other = along === "along" ? "normal_to" : "along";
  const pick = (ends: string[]) => void tell(bench, set(bench, [...path, along], ends));
  const options = points.map((each): [string, string] => [each, each]);
  return (
    <>
      <Choice label={say("insp.direction")} value={along} options={[["along", say("insp.along_line", { a: from, b: to })], ["normal_to", say("insp.normal_line", { a: from, b: to })]]} set={(way) => way === other && void tell(bench, set(bench, path, withDirection(load, { [other]: [from, to] })))} />
      <Choice label={say("insp.from")} value={from} options={options} set={(point) => pick([point, to])} />
      <Choice label={say("insp.to")} value={to} options={options} set={(point) => pick([from, point])} />
    </>
  );
}

/** The sense of a torque: fixed, or against the turning. */
function Sense({ bench, path, load }: { bench: Bench; path: Path; load: Table }) {
  const { say } = bench;
  return (
    <Choice
      label={say("insp.sense")} value={load.opposes === undefined ? "" : "velocity"} options={[["", say("insp.sense_fixed")], ["velocity", say("insp.sense_opposes")]]}
      set={(to) => void tell(bench, put(bench, [...path, "opposes"], to))}
    />
  );
}

// The driver: what it moves, how fast or by which law, over which cycle, where it begins.
import type { Bench } from "../bench";
import type { Entry } from "../outline";
import { put, set, tell, unset } from "./change";
import { at, driverOf, list, type Path, type Table, table, word, words } from "./entries";
import { Chips, Choice, Lock, Quantity, Row, Section, Segments } from "./fields";
import { Head, Written } from "./head";
import type { PanelProps } from "./selected";

type Law = "speed" | "position" | "program" | "table";
const LAWS: Law[] = ["speed", "position", "program", "table"];

export function DriverPanel({ bench, item, entries }: PanelProps) {
  const { say } = bench, found = driverOf(entries, item.name);
  if (!found) return null;
  const { path, driver } = found, slides = driver.slide !== undefined, law = LAWS.find((each) => driver[each] !== undefined) ?? "speed", name = path.length > 1 ? String(path[1]) : "driver";
  const block = slides ? word(at(entries, "joints", word(driver.slide), "block")) : word(driver.turn), locks = ["speed", "start"].filter((key) => word(driver[key])).map((key) => `${name}.${key}`);
  return (
    <>
      <Head bench={bench} icon="drive" title={say("insp.driver")} item={{ kind: "driver", name }} tone="input" fixedName locks={locks}>
        {slides ? say("insp.driver_slides", { link: block }) : say("insp.driver_turns", { link: block, point: word(driver.about) })}
      </Head>
      <div class="form">
        <Chips label={say("insp.link")} names={[block].filter(Boolean)} symbols={false} pick={(link) => bench.select({ kind: "link", name: link })} />
        <Motion bench={bench} path={path} driver={driver} law={law} slides={slides} name={name} />
      </div>
      <Section bench={bench} id="insp.cycle" title={say("insp.cycle")}>{() => <Cycle bench={bench} entries={entries} slides={slides} />}</Section>
      <Written bench={bench} path={path} />
    </>
  );
}

/** How it moves: a constant speed, a law of the time, or segments. */
function Motion({ bench, path, driver, law, slides, name }: { bench: Bench; path: Path; driver: Table; law: Law; slides: boolean; name: string }) {
  const { say } = bench, place = slides ? "mm" : "deg", speed = slides ? "mm/s" : "rpm";
  const become = (to: string) => {
    if (to === law) return;
    const rest: Record<string, Entry> = Object.fromEntries(Object.entries(driver).filter(([key]) => !LAWS.includes(key as Law) && key !== "start"));
    if (to === "speed") rest.speed = slides ? "10 mm/s" : "60 rpm";
    else if (to === "position") rest.position = slides ? "20 mm*sin(360 deg/s*t)" : "30 deg*sin(360 deg/s*t)";
    else rest.program = [{ rise: slides ? "20 mm" : "60 deg", over: "1 s", law: "modified_sine" }, { fall: slides ? "20 mm" : "60 deg", over: "1 s", law: "modified_sine" }];
    void tell(bench, set(bench, path, rest));
  };
  const laws = law === "table" ? LAWS : LAWS.filter((each) => each !== "table");
  return (
    <>
      <Choice label={say("insp.motion")} value={law} options={laws.map((each) => [each, say(`insp.by_${each}`)])} set={become} />
      {law === "speed" && <Quantity label={say("insp.speed")} value={word(driver.speed)} unit={speed} set={(text) => set(bench, [...path, "speed"], text)} aside={<Lock bench={bench} address={`${name}.speed`} />} />}
      {law === "position" && <Quantity label={say("insp.position_of_t")} value={word(driver.position)} unit="" set={(text) => set(bench, [...path, "position"], text)} />}
      {law === "program" && <Row label={say("insp.program")}><span class="quiet">{list(driver.program).map((each) => segment(bench, table(each))).join(" → ")}</span></Row>}
      {law === "table" && <Row label={say("insp.table")}><span class="quiet">{say("insp.table_of", { count: String(words(at(driver.table, "time")).length) })}</span></Row>}
      {(law === "speed" || law === "program") && <Quantity label={say("insp.begins")} value={word(driver.start)} unit={place} preset="0" optional set={(text) => put(bench, [...path, "start"], text)} />}
    </>
  );
}

function segment(bench: Bench, each: Table): string {
  const move = ["rise", "fall", "dwell", "to"].find((key) => each[key] !== undefined) ?? "dwell";
  return `${bench.say(`insp.move_${move}`)} ${word(each[move])}`;
}

type Form = "turn" | "rock" | "from" | "turns" | "duration";

/** What one cycle is: a turn, rocking between the limits, from one coordinate to another, several turns, a time. */
export function Cycle({ bench, entries, slides }: { bench: Bench; entries: Table; slides: boolean }) {
  const { say } = bench, own = entries.cycle, cycle = table(own), path: Path = ["cycle"], unit = slides ? "mm" : "deg";
  const form: Form = word(own) === "rock" ? "rock" : cycle.from !== undefined ? "from" : cycle.turns !== undefined ? "turns" : cycle.duration !== undefined ? "duration" : "turn";
  const become = (to: string) => {
    if (to === "turn") return void tell(bench, unset(bench, path));
    const values: Record<string, Entry> = { rock: "rock", from: { from: `0 ${unit}`, to: slides ? "40 mm" : "180 deg" }, turns: { turns: "2" }, duration: { duration: "2 s" } };
    void tell(bench, set(bench, path, values[to]));
  };
  const other = form === "turn" || form === "rock" ? "" : form;
  return (
    <div class="form">
      <Row label={say("insp.cycle")}><Segments label={say("insp.cycle")} value={form} options={[["turn", say(slides ? "insp.cycle_usual" : "insp.cycle_turn")], ["rock", say("insp.cycle_rock")]]} set={become} /></Row>
      <Choice label={say("insp.or")} value={other} options={[["", "–"], ["from", say("insp.cycle_from")], ...(slides ? [] : [["turns", say("insp.cycle_turns")] as [string, string]]), ["duration", say("insp.cycle_duration")]]} set={(to) => become(to || "turn")} />
      {form === "from" && (
        <>
          <Quantity label={say("insp.from")} value={word(cycle.from)} unit={unit} set={(text) => set(bench, [...path, "from"], text)} />
          <Quantity label={say("insp.to")} value={word(cycle.to)} unit={unit} set={(text) => set(bench, [...path, "to"], text)} />
        </>
      )}
      {form === "turns" && <Quantity label={say("insp.turns_count")} value={word(cycle.turns)} unit="" set={(text) => set(bench, [...path, "turns"], text)} />}
      {form === "duration" && <Quantity label={say("insp.duration")} value={word(cycle.duration)} unit="s" set={(text) => set(bench, [...path, "duration"], text)} />}
    </div>
  );
}

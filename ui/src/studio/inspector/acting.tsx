// When a load acts, and how its size goes over that: constant, a ramp, or a table, with a small curve.
import type { Bench } from "../bench";
import type { Entry } from "../outline";
import { set, tell } from "./change";
import { at, list, type Path, type Table, table, word, words } from "./entries";
import { Choice, Row, Section, Typing } from "./fields";
import { inUnit, read, si } from "./quantities";
import { shownText } from "./loads_list";

type Form = "constant" | "ramp" | "table";

export function Acting({ bench, name, load, entries, unit }: { bench: Bench; name: string; load: Table; entries: Table; unit: string }) {
  const { say } = bench, path: Path = ["loads", name], phase = table(load.phase), ramp = words(load.ramp), rows = table(load.table);
  const form: Form = load.table !== undefined ? "table" : load.ramp !== undefined ? "ramp" : "constant", ways = outputs(bench, entries);
  const value = phaseKey(phase), size = ramp[1] ?? word(load.magnitude), [start, end] = words(phase.input);
  const input = bench.session.value?.data.positions.inputs[0]?.turns === false ? "mm" : "deg";
  const become = (to: string) => {
    const chosen = ways.find(([key]) => key === to)?.[2], next: Record<string, Entry> = { ...load };
    if (to === "") delete next.phase;
    else next.phase = chosen ?? { input: [`0 ${input}`, input === "deg" ? "180 deg" : "10 mm"] };
    // A ramp runs over the time in which the load acts; without one it is a constant.
    if (to === "" && form === "ramp") return void tell(bench, set(bench, path, sized(next, "magnitude", size)));
    void tell(bench, set(bench, path, next));
  };
  const shape = (to: string) => {
    if (to === form || to === "table") return;
    const next = to === "ramp" ? sized(load, "ramp", [`0 ${read(size).unit || unit}`, size || `100 ${unit}`]) : sized(load, "magnitude", size || `100 ${unit}`);
    if (to === "ramp" && load.phase === undefined) next.phase = ways[0]?.[2] ?? { input: [`0 ${input}`, input === "deg" ? "180 deg" : "10 mm"] };
    void tell(bench, set(bench, path, next));
  };
  return (
    <Section bench={bench} id="insp.acting" title={say("insp.acting")}>
      {() => (
        <>
          <div class="form">
            <Choice label={say("insp.while")} value={value} set={become} options={[["", say("insp.always")], ["input", say("insp.while_input")], ...ways.map(([key, title]): [string, string] => [key, title]), ...(value && value !== "input" && !ways.some(([key]) => key === value) ? [[value, shownText(describe(bench, phase))] as [string, string]] : [])]} />
            {phase.input !== undefined && (
              <Row label={say("insp.input")}>
                <span class="two">
                  {[start, end].map((each, k) => <Typing key={k} label={say(k ? "insp.to" : "insp.from")} value={each ?? ""} unit={input} set={(text) => set(bench, [...path, "phase", "input"], k ? [start, text] : [text, end])} />)}
                </span>
              </Row>
            )}
            <Choice label={say("insp.over_it")} value={form} set={shape} options={[["constant", say("insp.constant")], ["ramp", say("insp.ramp")], ...(form === "table" ? [["table", say("insp.table")] as [string, string]] : [])]} />
            {form === "ramp" && (
              <Row label={say("insp.size_of")}>
                <span class="two">
                  {ramp.map((each, k) => <Typing key={k} label={say(k ? "insp.to" : "insp.from")} value={each} unit={unit} set={(text) => set(bench, [...path, "ramp"], ramp.map((old, j) => (j === k ? text : old)))} />)}
                </span>
              </Row>
            )}
          </div>
          <Curve load={load} form={form} rows={rows} />
        </>
      )}
    </Section>
  );
}

/** A load with another form of its size, in the place of the old one. */
function sized(load: Table, key: "magnitude" | "ramp", value: Entry): Record<string, Entry> {
  const sizes = new Set(["magnitude", "ramp", "table"]), found: Record<string, Entry> = {};
  for (const [each, old] of Object.entries(load)) {
    if (sizes.has(each)) found[key] = value;
    else found[each] = old;
  }
  return key in found ? found : { ...found, [key]: value };
}

/** Outputs by whose motion a load can act: displacements of guides, then angles of links that swing; both ways. */
function outputs(bench: Bench, entries: Table): [key: string, words: string, phase: Table][] {
  const { say } = bench, guides = Object.entries(table(entries.joints)).filter(([, joint]) => word(table(joint).kind) === "prismatic").map(([name, joint]) => [name, word(table(joint).block)]);
  const blocks = new Set(guides.map(([, block]) => block)), session = bench.session.value;
  const swings = (link: string) => {
    const row = session && `angle:${link}` in session.model.signals ? session.model.row(`angle:${link}`) : null;
    return row === null || Math.max(...row) - Math.min(...row) < 6;
  };
  const driven = new Set([word(at(entries, "driver", "turn"))]);
  const links = Object.keys(table(entries.links)).filter((link) => !blocks.has(link) && !driven.has(link) && swings(link));
  const both = (of: string, name: string, kind: string): [string, string, Table][] =>
    [["min", "max"], ["max", "min"]].map(([from, to]) => [`${of} ${from}`, say(`insp.${kind}_${to}`, { name }), { of, from, to }]);
  return [...guides.flatMap(([guide, block]) => both(guide, block, "slides")), ...links.flatMap((link) => both(link, link, "turns"))];
}

const phaseKey = (phase: Table) => (phase.input !== undefined ? "input" : phase.of !== undefined ? `${word(phase.of).replace(/\.(angle|displacement)$/, "")} ${word(phase.from)}` : phase.moving !== undefined ? "moving" : "");

/** A phase that has no words of its own: as it is written. */
const describe = (bench: Bench, phase: Table) =>
  phase.moving === undefined ? `${word(phase.of)}: ${word(phase.from)} → ${word(phase.to)}` : bench.say(`insp.moving_${word(phase.direction) === "decreasing" ? "back" : "on"}`, { name: word(phase.moving) });

const WIDE = 300, HIGH = 56, BASE = 48, TOP = 10;

/** The size over the input: nothing, then what acts, then nothing again. */
function Curve({ load, form, rows }: { load: Table; form: Form; rows: Table }) {
  const sizes = form === "table" ? list(rows.y).map((each) => si(word(each))) : form === "ramp" ? words(load.ramp).map(si) : [si(word(load.magnitude)), si(word(load.magnitude))];
  if (sizes.length < 2 || !sizes.every(Number.isFinite)) return null;
  const most = Math.max(...sizes.map(Math.abs), 1e-30), always = load.phase === undefined, [from, to] = always ? [1, WIDE - 1] : [90, 205];
  const negative = sizes.some((each) => each < 0), base = negative ? (BASE + TOP) / 2 : BASE, scale = (base - TOP) / most;
  const points = sizes.map((each, k) => [from + ((to - from) * k) / (sizes.length - 1), base - scale * each]);
  const line = `M1 ${base}${always ? "" : `H${from}`}${points.map(([x, y]) => `L${x.toFixed(1)} ${y.toFixed(1)}`).join("")}${always ? "" : `V${base}H${WIDE - 1}`}`;
  const peak = sizes.findIndex((each) => Math.abs(each) === most), [x, y] = points[peak] ?? [0, 0], written = form === "table" ? "" : form === "ramp" ? words(load.ramp)[peak] : word(load.magnitude);
  const unit = read(written).unit;
  return (
    <div class="mini">
      <svg viewBox={`0 0 ${WIDE} ${HIGH}`} width="100%" height={HIGH} aria-hidden="true">
        <path class="mini-frame" d={`M1 4V${BASE}M1 ${base}H${WIDE - 1}`} />
        <path class="mini-line" d={line} />
        <text x={Math.min(x + 6, WIDE - 70)} y={Math.max(y + (sizes[peak] < 0 ? -4 : 10), 12)}>{unit ? `${inUnit(most * Math.sign(sizes[peak]), unit)} ${unit}` : ""}</text>
      </svg>
    </div>
  );
}

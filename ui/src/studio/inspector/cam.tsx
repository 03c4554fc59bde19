// The program of a cam: its segments over one turn, each with its lift, its angle and its law.
import type { Bench } from "../bench";
import type { Entry } from "../outline";
import { Icon } from "../frame/icons";
import { set, tell } from "./change";
import { list, type Path, type Table, table, word, words } from "./entries";
import { Row, Section, Select, Typing } from "./fields";

const LAWS = ["constant_velocity", "constant_acceleration", "simple_harmonic", "cycloidal", "double_harmonic", "modified_sine", "modified_trapezoidal", "polynomial_345", "polynomial_4567"];
type Move = "rise" | "fall" | "dwell" | "to";
const MOVES: Move[] = ["rise", "fall", "dwell"];

export function CamLaw({ bench, path, joint }: { bench: Bench; path: Path; joint: Table }) {
  const { say } = bench, program = list(joint.program).map(table);
  if (!program.length) {
    const count = words(joint.lifts).length;
    return count ? <Section bench={bench} id="insp.program" title={say("insp.program")}>{() => <p class="quiet">{say("insp.table_of", { count: String(count) })}</p>}</Section> : null;
  }
  const write = (segments: Table[]) => set(bench, [...path, "program"], segments);
  const at = (k: number, segment: Table | null) => program.flatMap((old, j) => (j === k ? (segment ? [segment] : []) : [old]));
  return (
    <Section bench={bench} id="insp.program" title={say("insp.program")} count={program.length}>
      {() => (
        <>
          {program.map((segment, k) => <Segment key={k} bench={bench} segment={segment} number={k + 1} set={(to) => write(at(k, to))} last={program.length === 1} />)}
          <button type="button" class="text" onClick={() => void tell(bench, write([...program, { dwell: "0 deg" }]))}><Icon name="plus" size={14} />{say("insp.add_segment")}</button>
        </>
      )}
    </Section>
  );
}

function Segment({ bench, segment, number, set: write, last }: { bench: Bench; segment: Table; number: number; set: (to: Table | null) => Promise<string | null>; last: boolean }) {
  const { say } = bench, move: Move = [...MOVES, "to" as const].find((each) => segment[each] !== undefined) ?? "dwell";
  const amount = word(segment[move]), over = word(segment.over), law = word(segment.law);
  const become = (to: Move): Table => {
    const angle: Entry = move === "dwell" ? amount : over;
    if (to === "dwell") return { dwell: angle };
    return { [to]: move === "dwell" ? "0 mm" : amount, over: angle, law: law || "modified_sine" };
  };
  return (
    <div class="box segment" role="group" aria-label={say("insp.segment", { number: String(number) })}>
      <Row label={String(number)}>
        <Select label={say("insp.segment", { number: String(number) })} value={move} options={MOVES.map((each) => [each, say(`insp.move_${each}`)])} set={(to) => void tell(bench, write(become(to as Move)))} />
        {move === "dwell"
          ? <Typing label={say("insp.over")} value={amount} unit="deg" set={(text) => write({ ...segment, dwell: text })} />
          : <><Typing label={say("insp.amount")} value={amount} unit="mm" set={(text) => write({ ...segment, [move]: text })} /><Typing label={say("insp.over")} value={over} unit="deg" set={(text) => write({ ...segment, over: text })} /></>}
        {!last && <button type="button" class="small" aria-label={say("insp.remove_segment", { number: String(number) })} onClick={() => void tell(bench, write(null))}><Icon name="close" size={13} /></button>}
      </Row>
      {move !== "dwell" && (
        <Row label={say("insp.law")}><Select label={say("insp.law")} value={law} options={LAWS.map((each) => [each, say(`insp.law_${each}`)])} set={(to) => void tell(bench, write({ ...segment, law: to }))} /></Row>
      )}
    </div>
  );
}

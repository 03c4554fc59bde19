// Synthesis by hand: a task with its demands at the left, the linkages that meet them as small pictures.
import { signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import type { Candidate, Design } from "../desk";
import type { Vec } from "../../shapes";
import { digits, quantity } from "../../words";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import type { Given, Task } from "./demands";
import { foresee } from "./foresee";
import { Select } from "./select";
import { Thumb } from "./thumb";
import { TaskForm } from "./task";

/** The task that is chosen and what is typed for each: kept while other tabs are looked at. */
const chosen = signal(""), typed = signal<Record<string, Given>>({});
const CURVE = "curve";

export function Synthesis({ bench }: { bench: Bench }) {
  const { desk, say } = bench, [tasks, setTasks] = useState<Task[]>([]), language = bench.page.language.value, target = bench.target.value;
  useEffect(() => void desk.ask<{ tasks: Task[] }>("tasks").then((found) => found && setTasks(found.tasks)), [language]);
  useEffect(() => {
    if (target) chosen.value = CURVE;
  }, [target]);
  const name = chosen.value || CURVE, task = tasks.find((each) => each.name === name);
  return (
    <div class={name === CURVE ? "synthesis of-curve" : "synthesis"}>
      <div class="synthesis-form">
        <label class="task-field task-choice">
          <span class="unseen">{say("dock.task")}</span>
          <Select value={name} onChange={(event) => (chosen.value = event.currentTarget.value)}>
            <option value={CURVE}>{say("dock.task.curve")}</option>
            {tasks.map((each) => <option key={each.name} value={each.name}>{say(`dock.task.${each.name}`)}</option>)}
          </Select>
        </label>
        {name === CURVE ? <OfTarget bench={bench} /> : task && <TaskForm key={name} bench={bench} task={task} given={typed.value[name] ?? {}} give={(given) => (typed.value = { ...typed.value, [name]: given })} />}
      </div>
      <Candidates bench={bench} />
    </div>
  );
}

/** The curve that was drawn on the sheet. */
function OfTarget({ bench }: { bench: Bench }) {
  const target = bench.target.value, running = bench.desk.sought.value?.running && bench.desk.sought.value.kind === "curve", [before, after] = bench.say("dock.task_help.curve").split("[U]");
  return (
    <div class="task">
      {!target && <p class="help">{before}<kbd>U</kbd>{after}</p>}
      <button class={target ? "quietly" : "solid"} onClick={() => (bench.tool.value = "target")}><Icon name="target" size={18} />{bench.say("dock.draw_target")}</button>
      {target && <button class="solid" disabled={running} onClick={() => void bench.desk.search("curve", { points: target.points, closed: target.closed, unit: bench.settings.value.unit })}>{bench.say("dock.search_again")}</button>}
    </div>
  );
}

/** How far a search is, at the right of the tabs. */
export function Progress({ bench, kinds }: { bench: Bench; kinds: string[] }) {
  const sought = bench.desk.sought.value;
  if (!sought?.running || !kinds.includes(sought.kind)) return null;
  const [done, most] = sought.done, share = most ? Math.min(1, done / most) : 0;
  const said = !most ? bench.say("dock.searching") : sought.kind === "optimum" ? bench.say("dock.tried", { done: String(done), most: String(most) }) : bench.say("dock.percent", { percent: digits(100 * share, 2) });
  return (
    <div class="progress" role="status">
      <progress class="bar" max={1} value={most ? share : undefined} aria-label={bench.say("dock.searching")} /><span>{said}</span>
      <button class="text" onClick={() => void bench.desk.enough()}>{bench.say("dock.stop")}</button>
    </div>
  );
}

function Candidates({ bench }: { bench: Bench }) {
  const { desk, say } = bench, sought = desk.sought.value, target = bench.target.value;
  useEffect(() => () => foresee(bench, null), []);
  if (!sought || sought.kind === "optimum" || sought.kind === "run") return <p class="no-curves">{say("dock.no_candidates")}</p>;
  const goal: Vec[] = sought.kind === "curve" && target ? [...target.points, ...(target.closed ? [target.points[0]] : [])] : [];
  return (
    <div class="candidates" role="region" aria-label={say("dock.synthesis")}>
      {sought.sentence && <p class="not" role="alert">{sought.sentence}</p>}
      {!sought.candidates.length && !sought.sentence && <p class="no-curves">{sought.running ? say("dock.searching") : say("dock.no_candidates")}</p>}
      <ol>{sought.candidates.map((each, k) => <Card key={each.text} bench={bench} candidate={each} number={k + 1} target={goal} />)}</ol>
      {sought.kind === "synthesis" && sought.notes?.map((note) => <p key={note} class="note">{note}</p>)}
    </div>
  );
}

/** A length of an error with its unit, or that there is none. */
function errorOf(candidate: Candidate | Design, bench: Bench): string {
  const error = typeof candidate.error === "number" ? quantity(candidate.error, "length", candidate.error, 2) : candidate.error;
  return error ? bench.say("dock.off", { error }) : bench.say("dock.exact");
}

/** Below this the transmission angle is a warning, rad. */
const LOW = (40 * Math.PI) / 180;

function Card({ bench, candidate, number, target }: { bench: Bench; candidate: Candidate | Design; number: number; target: Vec[] }) {
  const { desk } = bench, error = errorOf(candidate, bench), { transmission_angle: angle } = candidate;
  const type = "type" in candidate ? candidate.type : bench.say("dock.bars", { count: String(candidate.links) }), more = "lengths" in candidate ? [...candidate.lengths, ...candidate.values].map((each) => each.join(" ")).join(", ") : "";
  const look = () => foresee(bench, candidate), leave = () => foresee(bench, null);
  const take = () => {
    leave();
    if (desk.sought.value?.running) void desk.enough();
    desk.change(candidate.text);
    void desk.solve().then(() => bench.sheet.value?.fit());
  };
  return (
    <li>
      <button
        class="candidate" aria-pressed={desk.text.value === candidate.text} aria-label={bench.say("dock.take_candidate", { number: String(number), type, error })} data-tip={more || undefined}
        onPointerEnter={look} onPointerLeave={leave} onFocus={look} onBlur={leave} onClick={take}
      >
        <Thumb drawing={candidate.drawing} curve={candidate.curve} target={target} />
        <span class="candidate-foot"><b>{error}</b><span>{type}{"defects" in candidate && candidate.defects && <em class="low"> {candidate.defects}</em>}</span>{angle !== null && <em class={angle < LOW ? "low" : ""}><i class="sym">μ</i>{bench.say("dock.least_angle", { angle: quantity(angle, "angle", 1, 2) }).replace("μ", "")}</em>}</span>
      </button>
    </li>
  );
}

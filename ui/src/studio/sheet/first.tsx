// An empty sheet: four pictured steps, machines to begin with, other ways to begin. The first click on the sheet removes it.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Vec } from "../../shapes";
import type { ToolName } from "../bench";
import { fileCommands } from "../frame/commands";
import { Icon } from "../frame/icons";
import { writes } from "../frame/keys";
import { KEYS } from "../tools/tool";
import { GALLERY, MACHINES } from "./machines";
import type { Board } from "./sheet";

/** Drawings that have been begun with the first click, by the name of their file. */
const begun = signal<ReadonlySet<string>>(new Set());

/** Whether nothing has been drawn, and nothing begun. */
function empty({ bench }: Board): boolean {
  const { solved, text, name, gone } = bench.desk, { picture } = solved.value;
  if (!picture || begun.value.has(name.value) || bench.target.value || bench.photo.value || gone.value) return false;
  return !Object.keys(picture.points).length && !Object.keys(picture.links).length && solved.value.text === text.value;
}

export function First({ board }: { board: Board }) {
  const { bench } = board, shown = empty(board), { name } = bench.desk;
  useEffect(() => {
    if (shown && bench.tool.peek() === "move") bench.tool.value = "pivot";
  }, [shown]);
  useEffect(() => {
    const begin = () => begun.value.has(name.value) || (begun.value = new Set([...begun.value, name.value]));
    // Who takes a tool, on the rail or by its key, begins as well, be it before the steps are there to see.
    const pressed = ({ target }: Event) => target instanceof Element && target.closest("button[data-tool]") && begin();
    const typed = ({ key, target, ctrlKey, metaKey, altKey }: KeyboardEvent) => {
      if (!ctrlKey && !metaKey && !altKey && !writes(target) && Object.values(KEYS).includes(key.toUpperCase())) begin();
    };
    board.host.addEventListener("pointerdown", begin);
    document.addEventListener("click", pressed);
    document.addEventListener("keydown", typed);
    return () => {
      board.host.removeEventListener("pointerdown", begin);
      document.removeEventListener("click", pressed);
      document.removeEventListener("keydown", typed);
    };
  }, []);
  if (!shown) return null;
  const say = (key: string, values?: Record<string, string>) => bench.say(key, values);
  const take = (tool: ToolName) => {
    begun.value = new Set([...begun.value, name.value]);
    bench.tool.value = tool;
    board.host.focus();
  };
  const begin = (machine: string) => {
    bench.tool.value = "move";
    void bench.desk.open({ gallery: machine });
  };
  return (
    <section class="first-steps" aria-labelledby="first-title">
      <h1 id="first-title">{say("first")}</h1>
      <ol class="steps">
        {(["pivot", "link", "drive"] as const).map((tool, k) => (
          <li key={tool}>
            <button class="step" onClick={() => take(tool)}>
              <Strokes size={[148, 96]} strokes={step(k)} />
              <span class="step-text"><b aria-hidden="true">{k + 1}</b><strong>{say(`tool.${tool}`)}</strong><kbd aria-hidden="true">{KEYS[tool]}</kbd><small>{say(`first.${tool}`)}</small></span>
            </button>
          </li>
        ))}
        <li>
          <div class="step"><Strokes size={[148, 96]} strokes={step(3)} />
          <span class="step-text"><b aria-hidden="true">4</b><strong>{say("first.run")}</strong><kbd aria-hidden="true">{say("first.space")}</kbd><small>{say("first.moves")}</small></span></div>
        </li>
      </ol>
      <p class="or">{say("first.or")}</p>
      <ul class="machine-cards">
        {Object.keys(MACHINES).map((machine) => (
          <li key={machine}>
            <button class="machine-card" onClick={() => begin(machine)}>
              <Strokes size={[132, 74]} strokes={MACHINES[machine]} />
              <span>{say(`first.${machine}`)}</span>
            </button>
          </li>
        ))}
      </ul>
      <p class="ways">
        <button onClick={() => fileCommands(bench).gallery.act()}>{say("first.gallery", { count: String(GALLERY) })}</button>
        <button onClick={() => take("target")}><Icon name="target" size={18} />{say("first.curve")}</button>
        <button onClick={() => take("photo")}><Icon name="photo" size={18} />{say("first.photo")}</button>
      </p>
    </section>
  );
}

export type Stroke = [style: string, d: string];

export function Strokes({ strokes, size: [w, h] }: { strokes: Stroke[]; size: Vec }) {
  return <svg class="strokes" viewBox={`0 0 ${w} ${h}`} width={w} height={h} aria-hidden="true">{strokes.map(([style, d], k) => <path key={k} class={style} d={d} />)}</svg>;
}

// the steps ------------------------------------------------------------------------------------

const O1: Vec = [32, 62], A: Vec = [47, 33], B: Vec = [124, 10], O2: Vec = [135, 73];
const place = ([x, y]: Vec) => `${x.toFixed(1)} ${y.toFixed(1)}`;
const bar = (from: Vec, to: Vec) => `M${place(from)}L${place(to)}`;
const pin = ([x, y]: Vec, r = 4.6) => `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`;
const support = ([x, y]: Vec) => `M${x} ${y}L${x - 9.5} ${y + 16}H${x + 9.5}Z`;
const ground = ([x, y]: Vec) => `M${x - 14} ${y + 16}H${x + 14}`;
const hatch = ([x, y]: Vec) => [-9, -3, 3, 9, 15].map((u) => `M${x + u} ${y + 16}l-4.6 6`).join("");
const far = (a: Vec, b: Vec) => Math.hypot(b[0] - a[0], b[1] - a[1]);

/** The joint of coupler and rocker for a place of the crank's. */
function follower(a: Vec): Vec {
  const [r, s, d] = [far(A, B), far(B, O2), far(a, O2)], x = (r * r - s * s + d * d) / (2 * d), y = Math.sqrt(Math.max(0, r * r - x * x));
  const [u, v] = [(O2[0] - a[0]) / d, (O2[1] - a[1]) / d];
  return [a[0] + x * u + y * v, a[1] + x * v - y * u];
}

/** The way of the coupler's middle over a turn. */
function coupler(): string {
  const r = far(O1, A), way: Vec[] = [];
  for (let k = 0; k < 72; k++) {
    const a: Vec = [O1[0] + r * Math.cos(k / 11.46), O1[1] + r * Math.sin(k / 11.46)], b = follower(a);
    way.push([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
  }
  return `M${way.map(place).join("L")}Z`;
}

/** What stands on the sheet after a step; what the step has made is lit. */
function step(k: number): Stroke[] {
  const lit = (now: number) => (now === k ? " lit" : ""), found: Stroke[] = [O1, O2].flatMap((at): Stroke[] => [["hatch", hatch(at)], ["support", support(at)], ["ground", ground(at)]]);
  if (k > 0) found.push([`bar${lit(1)}`, bar(O1, A) + bar(A, B) + bar(B, O2)]);
  if (k === 3) found.push(["curve", coupler()]);
  if (k > 1) found.push(["input", "M47.5 66a16 16 0 0 0 -21.5 -19.4"], ["input head", "M18.6 49.6L27.6 51.4L26.4 42.8Z"]);
  for (const at of [O1, O2]) found.push([`pin${lit(0)}`, pin(at)]);
  if (k > 0) for (const at of [A, B]) found.push(["pin", pin(at)]);
  if (k === 3) found.push(["dot", pin([(A[0] + B[0]) / 2, (A[1] + B[1]) / 2], 2.6)]);
  return found;
}

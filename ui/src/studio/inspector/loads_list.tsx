// Loads as a list: each with its size and a line of what it is; gravity is a switch.
import type { Bench } from "../bench";
import { set, tell, unset } from "./change";
import { at, list, type Table, table, word, words } from "./entries";
import { shownUnit } from "./quantities";

export const GRAVITY = ["0 m/s²", "-9.81 m/s²"];
const DOWN = "↓", ARROWS = ["→", "↗", "↑", "↖", "←", "↙", DOWN, "↘"];

/** A unit as it is shown, in a text with numbers. */
export const shownText = (text: string) => text.replace(/\s*deg\b/g, shownUnit("deg")).replaceAll("-", "−");

/** What a load is called: a spring that pushes at its free length is a gas spring, one without stiffness a cylinder. */
export function sortOf(load: Table): string {
  const kind = word(load.kind), push = Number.parseFloat(word(load.preload)) < 0;
  if (kind !== "spring" || !push) return kind;
  return Number.parseFloat(word(load.stiffness)) === 0 ? "cylinder" : "gas_spring";
}

/** The size of a load as it is written. */
export function sizeOf(load: Table): string {
  if (["gas_spring", "cylinder"].includes(sortOf(load))) return shownText(word(load.preload));
  const ramp = words(load.ramp);
  if (ramp.length === 2) return shownText(`${ramp[0]} … ${ramp[1]}`);
  const components = words(load.components);
  return components.length ? shownText(`(${components.join(", ")})`) : shownText(word(load.magnitude) || word(load.stiffness) || word(load.damping));
}

/** What a load is, in a line. */
export function aboutLoad(bench: Bench, load: Table): string {
  const { say } = bench, kind = sortOf(load), between = words(load.between), links = words(load.links);
  if (between.length === 2 || links.length === 2) {
    const [a, b] = between.length ? between : links;
    return say(`insp.load_${kind in LINES ? kind : "other"}`, { kind, a: inWords(a), b: inWords(b) });
  }
  return say(`insp.load_${kind in LINES ? kind : "other"}`, { kind, link: word(load.on) || word(load.joint), at: word(load.at) });
}

const LINES: Record<string, true> = { force: true, torque: true, spring: true, damper: true, torsion_spring: true, torsion_damper: true, pressure: true, gas_spring: true, cylinder: true };
const inWords = (end: string) => end.replace(/^frame\./, "");

export function gravityOf(entries: Table): [number, number] | null {
  const parts = list(entries.gravity).map(word).map(Number.parseFloat);
  return parts.length === 2 && parts.every(Number.isFinite) ? [parts[0], parts[1]] : null;
}

/** Size and direction of gravity, as they are read. */
export function gravityText([x, y]: [number, number]): string {
  const turn = Math.round(Math.atan2(y, x) / (Math.PI / 4));
  return `${Number(Math.hypot(x, y).toPrecision(5))} m/s² ${ARROWS[(turn + 8) % 8]}`;
}

export function LoadList({ bench, entries, names, gravity = false }: { bench: Bench; entries: Table; names: string[]; gravity?: boolean }) {
  const field = gravityOf(entries), { say } = bench, on = field !== null && Math.hypot(...field) > 0;
  return (
    <ul class="list">
      {gravity && (
        <li class="with-switch">
          <button type="button" onClick={() => bench.select()}>
            <b>{say("insp.gravity")}</b><small>{on ? gravityText(field) : say("insp.off")}</small>
          </button>
          <button type="button" class="switch" role="switch" aria-checked={on} aria-label={say("insp.gravity")} onClick={() => void tell(bench, on ? unset(bench, ["gravity"]) : set(bench, ["gravity"], GRAVITY))}><i /></button>
        </li>
      )}
      {names.map((name) => {
        const load = table(at(entries, "loads", name)), chosen = bench.has({ kind: "load", name });
        return (
          <li key={name} class={chosen ? "chosen" : ""}>
            <button type="button" aria-current={chosen ? true : undefined} onClick={() => bench.select({ kind: "load", name })} onPointerEnter={() => (bench.hovered.value = { kind: "load", name })} onPointerLeave={() => (bench.hovered.value = null)}>
              <b class="load-t">{name}</b><span>{sizeOf(load)}</span><small>{aboutLoad(bench, load)}</small>
            </button>
          </li>
        );
      })}
    </ul>
  );
}

/** All loads of the machine, gravity first. */
export const allLoads = (entries: Table) => Object.keys(table(entries.loads));

// What can be drawn over the input: quantities in words (what, of what, as), and their values before and now.
import type { Language } from "../../data";
import { unwrap } from "../../loads";
import { isForce } from "../../numbers";
import type { Session } from "../../session";
import type { Bench } from "../bench";

export const CONTENTS = [
  "position", "displacement", "velocity", "acceleration", "angle", "angular_velocity", "angular_acceleration", "transmission", "effort", "reaction", "shaking",
] as const;
export type What = (typeof CONTENTS)[number];
/** As a number, the size of a vector, one of its components, or the way of its tip. */
export type As = "value" | "size" | "x" | "y" | "polar";

export interface Quantity {
  /** The signal's, with the component behind a tilde. */
  id: string;
  what: What;
  /** The link, point or joint that it is of; of a joint force the link that it acts on. */
  of: string;
  on: string;
  as: As;
  /** Sort of unit: angle, velocity, torque … */
  kind: string;
  /** The signal that it is, "" where it is a component. */
  signal: string;
  rows: string[];
}

const PREFIXES: Record<string, What> = {
  angle: "angle", w: "angular_velocity", g: "angular_acceleration", s: "displacement", sv: "velocity", sa: "acceleration", v: "velocity", a: "acceleration",
  m: "transmission", effort: "effort", r: "reaction", shake: "shaking",
};
/** Custom properties of the style sheet by what is drawn: one quantity has one colour everywhere. */
const COLOURS: Partial<Record<What, string>> = {
  velocity: "velocity", angular_velocity: "velocity", acceleration: "acceleration", angular_acceleration: "acceleration", transmission: "good", effort: "input",
  reaction: "force", shaking: "force",
};

export const colourOf = ({ what }: Quantity) => COLOURS[what] ?? "accent";

/** Everything that a machine can show, in the order of its signals. */
export function quantities({ data, model }: Session): Quantity[] {
  const found: Quantity[] = data.points.filter(({ fixed }) => !fixed).flatMap(({ key }) =>
    (["x", "y"] as const).map((as) => ({ id: `p:${key}~${as}`, what: "position" as const, of: key, on: "", as, kind: "length", signal: "", rows: [`p:${key}.${as}`] })),
  );
  for (const { id, form, kind, rows } of data.signals) {
    const [prefix, name = ""] = id.split(/:(.*)/s), what = PREFIXES[prefix];
    if (!what) continue;
    const [of, on = ""] = name.split("|"), own = { what, of, on, kind };
    found.push({ ...own, id, as: form === "size" ? "size" : "value", signal: id, rows });
    if (form !== "size") continue;
    for (const [k, as] of (["x", "y"] as const).entries()) found.push({ ...own, id: `${id}~${as}`, as, signal: "", rows: [rows[k]] });
    found.push({ ...own, id: `${id}~polar`, as: "polar", signal: "", rows });
  }
  return found.filter(({ rows }) => rows.every((row) => model.main.has(row)));
}

/** The values over the positions of the machine as its rows are now; of a vector diagram the x components. */
export function values({ model }: Session, quantity: Quantity, component = 0): Float64Array {
  if (quantity.signal) return model.row(quantity.signal);
  const row = model.main.row(quantity.rows[component]).slice();
  if (isForce(quantity.id.split("~")[0]) && !model.forces) row.fill(NaN);
  return quantity.kind === "angle" && quantity.as === "value" ? unwrap(row) : row;
}

const before = new WeakMap<object, Record<string, Float64Array>>();

/** The same of the design that it is compared with. */
export function valuesBefore(session: Session, quantity: Quantity, component = 0): Float64Array {
  const { model } = session, { original } = model;
  if (quantity.signal) return original.rows[quantity.signal];
  const known = before.get(original) ?? {}, key = `${quantity.id} ${component}`;
  before.set(original, known);
  if (!known[key]) {
    model.evaluate(original.values);
    known[key] = values(session, quantity, component);
    model.evaluate(model.values);
  }
  return known[key];
}

/** The largest size before, by which the unit is chosen. */
export function largest(session: Session, quantity: Quantity): number {
  let most = 0;
  for (const k of quantity.as === "polar" ? [0, 1] : [0]) for (const x of valuesBefore(session, quantity, k)) if (Math.abs(x) > most) most = Math.abs(x);
  return most;
}

/** The smallest transmission angle that is still good, rad. */
export const GOOD = (40 * Math.PI) / 180;

/** The words of a quantity. */
export interface Words {
  say: (key: string, values?: Record<string, string>) => string;
  language: Language;
  /** The driven link, where there is one driver. */
  driven: string | null;
}

export function wordsOf(bench: Bench): Words {
  const { picture } = bench.desk.solved.value, one = bench.session.value?.data.positions.inputs.length === 1;
  return { say: bench.say, language: bench.page.language.value, driven: one ? (picture?.driver ?? null) : null };
}

export const whatOf = ({ what, kind }: Quantity, { say }: Words) => say(what === "effort" && kind === "force" ? "dock.q.effort_force" : `dock.q.${what}`);

export function ofWhat({ what, of, on }: Quantity, { say, driven }: Words): string {
  const name = what === "effort" ? (driven ?? of) : what === "transmission" ? of.split("+").join(", ") : of;
  return on ? say("dock.of_on", { name, link: on }) : name;
}

export const asWhat = ({ as }: Quantity, { say }: Words) => say(`dock.as.${as}`);

/** A quantity in a line, to be read or searched for. */
export function sentence(quantity: Quantity, words: Words): string {
  const parts = [whatOf(quantity, words), ofWhat(quantity, words)];
  if (quantity.as !== "value" && quantity.as !== "size") parts.push(asWhat(quantity, words));
  return parts.filter(Boolean).join(words.language === "zh" ? "，" : ", ");
}

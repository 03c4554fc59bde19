// Metrics of the machine by words: what is measured, of what, as which number; which of them a person has put in or hidden.
import { signal } from "@preact/signals";
import type { Figure, Signal } from "../../data";
import { number } from "../../numbers";
import type { Session } from "../../session";
import type { Bench } from "../bench";
import { at, table, word } from "./entries";

export const GROUPS = ["motion", "transmission", "force"] as const;
export type Group = (typeof GROUPS)[number];
/** Kinds of signals by the beginning of their ids. */
const KINDS: Record<string, Group> = {
  angle: "motion", w: "motion", g: "motion", s: "motion", sv: "motion", sa: "motion", v: "motion", a: "motion", m: "transmission", effort: "force", r: "force", shake: "force",
};
const STORED = "linkwright.numbers";
const AS: Figure["kind"][] = ["largest", "least", "range", "rms"];

interface Choice {
  hidden: string[];
  added: string[];
}

/** Ids that have been hidden or added, remembered in the browser. */
export const choice = signal<Choice>(stored());

function stored(): Choice {
  try {
    return { hidden: [], added: [], ...(JSON.parse(localStorage.getItem(STORED) ?? "{}") as Partial<Choice>) };
  } catch {
    return { hidden: [], added: [] };
  }
}

export function choose(change: Partial<Choice>): void {
  choice.value = { ...choice.value, ...change };
  try {
    localStorage.setItem(STORED, JSON.stringify(choice.value));
  } catch {
    // A browser that stores nothing forgets the choice with the page.
  }
}

export const kindOf = (id: string) => id.split(":")[0];
/** The kind of a signal in words: an input is a torque or a force. */
export const kindIn = (id: string, quantity: string) => (kindOf(id) === "effort" && quantity === "force" ? "effort_force" : kindOf(id));
export const groupOf = (id: string): Group => KINDS[kindOf(id)] ?? "motion";
/** What a signal is of: the link, the point, the joint and the link of a reaction. */
export const ownerOf = (id: string) => id.split(":").slice(1).join(":");

/** The metrics of a machine: the usual ones, then those that have been added. */
export function figures(session: Session): Figure[] {
  const { data } = session, own = new Set(data.numbers.map(({ id }) => id));
  const added = choice.value.added.filter((id) => !own.has(id)).flatMap((id): Figure[] => {
    const [kind, of] = split(id), known = data.signals.find((each) => each.id === of);
    return known && AS.includes(kind) ? [figure(kind, known)] : [];
  });
  return [...data.numbers, ...added];
}

const split = (id: string): [Figure["kind"], string] => [id.split(":")[0] as Figure["kind"], id.split(":").slice(1).join(":")];

export const figure = (kind: Figure["kind"], of: Signal): Figure => ({ id: `${kind}:${of.id}`, kind, signal: of.id, quantity: of.kind, name: of.name });

/** Ways to make a number of a signal. */
export const ways = (of: Signal): Figure["kind"][] => (of.form === "angle" ? ["range"] : AS);

/** A metric in words, without what it is of. */
export function named(bench: Bench, { kind, signal: id, quantity }: Figure): string {
  const of = kindIn(id, quantity), own = `${kind}_${of}`;
  return OWN.has(own) ? bench.say(`metric.${own}`) : bench.say(`metric.as_${kind}`, { what: bench.say(`metric.of_${of}`) });
}

const OWN = new Set(["range_angle", "ratio_angle", "ratio_s", "range_s", "largest_effort", "rms_effort", "largest_effort_force", "rms_effort_force", "largest_r", "largest_shake"]);

/** Every metric now and as it was: those of the original design, of those put in by evaluating it once. */
export function valuesOf(session: Session): (figure: Figure) => { now: number; before: number } {
  const { model } = session, now = model.numbers(), { original } = model, differs = model.differs;
  const before = { ...original.numbers }, more = figures(session).filter(({ id }) => !(id in now));
  for (const each of more) now[each.id] = number(model, each);
  const unknown = more.filter(({ id }) => !(id in before));
  if (unknown.length) {
    if (!differs) for (const each of unknown) before[each.id] = now[each.id];
    else asBefore(session, () => unknown.forEach((each) => (before[each.id] = number(model, each))));
  }
  return ({ id }) => ({ now: now[id] ?? NaN, before: before[id] ?? NaN });
}

/** Does something while the machine is as it was before. */
function asBefore({ model }: Session, work: () => void): void {
  const { values } = model, past = { ...values, ...model.original.values };
  if (model.evaluate(past)) {
    model.evaluate(values);
    return;
  }
  model.values = past;
  work();
  model.values = values;
  model.evaluate(values);
}

export interface Limit {
  /** Degrees or SI, as in the metric. */
  least: number;
  text: string;
}

const DEGREE = Math.PI / 180, USUAL = 40;

/** What a metric is held to: the least transmission angle that is usual, or that the optimisation keeps. */
export function limitOf(bench: Bench, { kind, signal: id }: Figure): Limit | null {
  if (kind !== "least" || kindOf(id) !== "m") return null;
  const keep = table(at(bench.desk.solved.value.outline?.entries, "optimize", "keep")), [, wanted] = Object.entries(keep).find(([name]) => name.startsWith("transmission_angle")) ?? [];
  const asked = /at least ([\d.]+) ?(deg|°)/.exec(typeof wanted === "object" ? `at least ${word(table(wanted).at_least)}` : word(wanted)), angle = asked ? Number(asked[1]) : USUAL;
  return { least: angle * DEGREE, text: `${angle}°` };
}

// Metrics of the machine: those that the server finds for its text, live ones of the page while a hand moves, and outputs
// that a person has put in; which of them are shown.
import { signal } from "@preact/signals";
import type { Figure, Signal } from "../../data";
import { number } from "../../numbers";
import type { Design } from "../../model";
import type { Session } from "../../session";
import { unitFor } from "../../words";
import type { Bench } from "../bench";
import { at, table, word } from "./entries";

export const GROUPS = ["motion", "transmission", "force", "size"] as const;
export type Group = (typeof GROUPS)[number];

/** A metric as the server finds it; SI. */
export interface Found {
  metric: string;
  subject: string;
  label: string;
  of: string;
  value: number | null;
  quantity: string;
  unit: string;
  /** From SI to the unit. */
  factor: number;
  limit: number | null;
  better: "higher" | "lower" | null;
  remark: string;
}

/** A line of the table. */
export interface Row {
  key: string;
  group: Group;
  label: string;
  of: string;
  now: number;
  before: number;
  /** Its unit, with what a value (SI) is multiplied by. */
  unit: string;
  factor: number;
  limit: { value: number; least: boolean } | null;
  remark: string;
  /** It is that of the machine before the hand moved. */
  stale: boolean;
  usual: boolean;
}

const TRANSMISSION = new Set(["transmission_angle", "transmission_angle_of_stroke", "pressure_angle", "mechanical_advantage", "velocity_ratio", "singularity"]);
const SIZE = new Set(["swept_area", "grashof"]), FORCES = new Set(["force", "torque", "power", "energy", "inertia"]);
/** Metrics that are shown unasked. */
const USUAL = new Set([
  "stroke", "swing_angle", "quick_return_ratio", "peak_acceleration", "transmission_angle", "peak_input_torque", "rms_input_torque", "peak_reaction", "peak_shaking_force",
  "mean_power", "efficiency", "flywheel", "swept_area",
]);
const STORED = "linkwright.numbers";
const AS: Figure["kind"][] = ["largest", "least", "range", "rms"];

interface Choice {
  /** Metrics by name that are shown or hidden, other than usual. */
  shown: Record<string, boolean>;
  /** Outputs with what is made of them ("largest:v:B"). */
  added: string[];
}

export const choice = signal<Choice>(stored());

function stored(): Choice {
  try {
    return { shown: {}, added: [], ...(JSON.parse(localStorage.getItem(STORED) ?? "{}") as Partial<Choice>) };
  } catch {
    return { shown: {}, added: [] };
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

/** The text for which metrics have been found, and those of the machine before. */
export const found = signal<{ text: string; list: Found[] }>({ text: "", list: [] });
export const before = signal<Record<string, number>>({});

/** Asks for the metrics of a machine; those of one that is as it was first are those before. */
export async function ask(bench: Bench, session: Session): Promise<void> {
  const { text } = session.data, answer = await bench.desk.ask<{ metrics: Found[] }>("metrics", { text });
  if (!answer || bench.session.value !== session) return;
  found.value = { text, list: answer.metrics };
  const { model } = session;
  if (!model.differs) keep(session, answer.metrics);
  else if (design !== model.original) await askBefore(bench, session);
}

/** The design whose metrics are those before. */
let design: Design | null = null;

export function keep({ model }: Session, list: Found[]): void {
  design = model.original;
  before.value = Object.fromEntries(list.map((each) => [keyOf(each), each.value ?? NaN]));
}

/** Asks for the metrics of the design before, by the text that it would have. */
async function askBefore({ desk, page }: Bench, session: Session): Promise<void> {
  const { model, data } = session, { original } = model, changed = data.dimensions.filter(({ address, written }) => written && address in original.values && original.values[address] !== model.values[address]);
  const values = Object.fromEntries(changed.map(({ address }) => [address, original.values[address]]));
  const set = await desk.ask<{ text: string }>("set", { text: data.text, values }), answer = set && (await desk.ask<{ metrics: Found[] }>("metrics", { text: set.text }));
  if (answer && model.original === original) keep(session, answer.metrics);
  else page.note.value = "";
}

const keyOf = ({ metric, subject }: Found) => `${metric} ${subject}`;

/** The number of the page that is the same while dimensions move. */
function twin({ metric, subject }: Found, data: Session["data"]): Figure | undefined {
  const ids: Record<string, string[]> = {
    swing_angle: [`range:angle:${subject}`], stroke: [`range:s:${subject}`], quick_return_ratio: [`ratio:angle:${subject}`, `ratio:s:${subject}`], transmission_angle: [`least:m:${subject}`],
    peak_input_torque: [`largest:effort:${subject}`], rms_input_torque: [`rms:effort:${subject}`], peak_shaking_force: ["largest:shake"],
  };
  return data.numbers.find(({ id }) => (metric === "peak_reaction" ? id.startsWith(`largest:r:${subject}|`) : ids[metric]?.includes(id)));
}

function groupOf({ metric, quantity }: Found): Group {
  if (TRANSMISSION.has(metric)) return "transmission";
  if (SIZE.has(metric)) return "size";
  return FORCES.has(quantity) ? "force" : "motion";
}

/** All lines: of metrics by the server, with live values where the page has them, then of outputs that were put in. */
export function rows(bench: Bench, session: Session): Row[] {
  const { list, text } = found.value, { model, data } = session, live = model.numbers(), old = model.original.numbers, moved = text !== data.text || model.changed;
  const known = list.map((each): Row => {
    const figure = twin(each, data), key = keyOf(each), now = figure && (moved || !Number.isFinite(each.value ?? NaN)) ? live[figure.id] : (each.value ?? NaN), past = before.value[key] ?? (figure ? old[figure.id] : NaN);
    const usual = USUAL.has(each.metric), { unit, factor } = scale(each, Math.abs(past) || Math.abs(now));
    return { key, group: groupOf(each), label: capital(each.label), of: about(each, data), now, before: past, unit, factor, limit: limitOf(bench, each), remark: each.remark, stale: moved && !figure, usual };
  });
  return [...known, ...more(bench, session)];
}

const capital = (text: string) => text.slice(0, 1).toUpperCase() + text.slice(1);

/** What it is of; nothing where that is the machine, its frame or its only driver. */
const about = ({ of, subject }: Found, { name, positions }: Session["data"]) =>
  Object.values(name).includes(of) || subject === "frame" || (positions.inputs.length < 2 && subject === positions.inputs[0]?.name) ? "" : of;

/** The unit in which a value of about this size (SI) reads well, and the factor to it. */
function scale({ quantity, unit, factor }: Found, size: number): { unit: string; factor: number } {
  if (quantity === "length" || quantity === "force" || quantity === "torque") {
    const own = unitFor(quantity, size);
    return { unit: own.symbol, factor: 1 / own.factor };
  }
  if ((quantity === "power" || quantity === "energy") && size >= 1e3) return { unit: `k${unit}`, factor: 1e-3 };
  return { unit, factor };
}

function limitOf(bench: Bench, { metric, limit, better }: Found): Row["limit"] {
  const kept = table(at(bench.desk.solved.value.outline?.entries, "optimize", "keep")), wanted = kept[metric] ?? kept[`${metric}_min`];
  const asked = /(?:at least|>=|≥) ?([\d.]+) ?(deg|°)/.exec(word(wanted)) ?? /([\d.]+) ?(deg|°)/.exec(word(table(wanted).at_least));
  const value = asked ? (Number(asked[1]) * Math.PI) / 180 : limit;
  return value === null ? null : { value, least: better !== "lower" };
}

// outputs by choice -------------------------------------------------------------------------

export const kindOf = (id: string) => id.split(":")[0];
/** The kind of a signal in words: an input is a torque or a force. */
export const kindIn = (id: string, quantity: string) => (kindOf(id) === "effort" && quantity === "force" ? "effort_force" : kindOf(id));
/** What a signal is of: the link, the point, the joint and the link of a reaction. */
export const ownerOf = (id: string) => id.split(":").slice(1).join(":");
/** A number of the page in words, without what it is of. */
export function named(bench: Bench, { kind, signal: id, quantity }: Figure): string {
  const of = kindIn(id, quantity), own = `${kind}_${of}`;
  if (own === "least_m") return bench.say("metric.least_m", { mu: "μ" });
  return OWN.has(own) ? bench.say(`metric.${own}`) : bench.say(`metric.as_${kind}`, { what: bench.say(`metric.of_${of}`) });
}

const OWN = new Set(["range_angle", "ratio_angle", "ratio_s", "range_s", "largest_effort", "rms_effort", "largest_effort_force", "rms_effort_force", "largest_r", "largest_shake"]);
/** Ways to make a number of a signal. */
export const ways = (of: Signal): Figure["kind"][] => (of.form === "angle" ? ["range"] : AS);

function more(bench: Bench, session: Session): Row[] {
  const { data, model } = session;
  const figures = choice.value.added.flatMap((id): Figure[] => {
    const [kind, ...rest] = id.split(":"), of = rest.join(":"), known = data.signals.find((each) => each.id === of);
    return known && AS.includes(kind as Figure["kind"]) ? [{ id, kind: kind as Figure["kind"], signal: of, quantity: known.kind, name: known.name }] : [];
  });
  if (!figures.length) return [];
  const past: Record<string, number> = {};
  if (model.differs) asBefore(session, () => figures.forEach((each) => (past[each.id] = number(model, each))));
  return figures.map((figure): Row => {
    const now = number(model, figure), old = past[figure.id] ?? now, { symbol, factor } = unitFor(figure.quantity, Math.abs(old) || Math.abs(now)), kind = kindOf(figure.signal);
    const group: Group = kind === "m" ? "transmission" : FORCES.has(figure.quantity) ? "force" : "motion", what = bench.say(`metric.of_${kindIn(figure.signal, figure.quantity)}`);
    return { key: figure.id, group, label: capital(bench.say(`metric.as_${figure.kind}`, { what })), of: ownerOf(figure.signal), now, before: old, unit: symbol, factor: 1 / factor, limit: null, remark: "", stale: false, usual: true };
  });
}

/** Does something while the machine is as it was before. */
function asBefore({ model }: Session, work: () => void): void {
  const { values } = model, past = { ...values, ...model.original.values };
  if (!model.evaluate(past)) {
    model.values = past;
    work();
    model.values = values;
  }
  model.evaluate(values);
}

// One dimension over a range: the metrics of the machines, and the paths of their points, on a model of its own.
import type { Figure } from "../../data";
import { Model } from "../../model";
import type { Session } from "../../session";
import { code } from "../../solver";
import type { Ghost } from "../../view";

export interface Swept {
  address: string;
  /** Values of the dimension, SI; the metrics at each, not numbers where the machine cannot be. */
  values: Float64Array;
  metrics: Record<string, Float64Array>;
  /** Paths of the traced points of the machines that can be. */
  ghosts: Ghost[];
  /** Places of all points of every one of them over the positions, by the number of its value. */
  machines: Map<number, Record<string, Ghost>>;
  done: number;
}

/** How long the page may be busy at a time, ms. */
const MOMENT = 24;

/** The model on which the sweeps of a session are made. */
const models = new WeakMap<Session, Model>();

async function modelOf(session: Session): Promise<Model> {
  const known = models.get(session) ?? new Model(session.data, await code(session.data));
  models.set(session, known);
  return known;
}

/** Goes through a range in steps while `wanted` holds; tells what it has found now and then. */
export async function sweep(session: Session, address: string, low: number, high: number, steps: number, tell: (found: Swept) => void, wanted: () => boolean): Promise<void> {
  const model = await modelOf(session), base = { ...session.model.values }, figures: Figure[] = session.data.numbers;
  model.change(base);
  const values = Float64Array.from({ length: steps }, (_, k) => low + ((high - low) * k) / (steps - 1));
  const found: Swept = { address, values, metrics: Object.fromEntries(figures.map(({ id }) => [id, new Float64Array(steps).fill(NaN)])), ghosts: [], machines: new Map(), done: 0 };
  let since = performance.now();
  for (const k of outwards(values, base[address])) {
    if (!wanted()) return;
    const tried = { ...base, [address]: values[k] };
    if (model.allows(tried)) {
      model.change(tried);
      const numbers = model.numbers();
      for (const { id } of figures) found.metrics[id][k] = numbers[id];
      const points = Object.fromEntries(session.data.points.map(({ key }) => [key, { x: model.main.row(`p:${key}.x`).slice(), y: model.main.row(`p:${key}.y`).slice() }]));
      found.machines.set(k, points);
      for (const key of session.traced) found.ghosts.push(points[key]);
    }
    found.done++;
    if (performance.now() - since < MOMENT) continue;
    tell({ ...found });
    await new Promise((go) => setTimeout(go));
    since = performance.now();
  }
  if (wanted()) tell({ ...found });
}

/** Numbers of the values from the present one outwards, so that the machine keeps its assembly. */
export function outwards(values: ArrayLike<number>, now: number): number[] {
  const all = Array.from({ length: values.length }, (_, k) => k);
  return all.sort((a, b) => Math.abs(values[a] - now) - Math.abs(values[b] - now));
}

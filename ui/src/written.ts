// The text of a machine as it is now, which reads back as that machine (designs/varied_dimensions.py for the page), and
// the machine of such a text.
import type { ModelData, Written } from "./data";
import type { Call } from "./engine";
import type { Model } from "./model";
import type { Values } from "./solver";

// Fewest and most digits of a number that is read back as the same.
const FEWEST = 12, MOST = 17;

/** The model's text with the changed numbers in their places, and the names of those that have none. */
export function written(model: Model): { text: string; missing: string[] } {
  const { data } = model, changed = data.dimensions.filter(({ address, value }) => model.values[address] !== value);
  const edits: [Written, string][] = [], missing: string[] = [];
  for (const { address, written: how, factor, drawn } of changed) {
    if (how) edits.push([how, digits(model.values[address], factor)]);
    else if (!drawn) missing.push(address);
  }
  if (changed.some(({ moves }) => moves)) edits.push(...drawing(model));
  // Offsets count characters beyond the basic plane as one, as Python does.
  const all = Array.from(data.text);
  edits.sort(([a], [b]) => b[0] - a[0] || b[1] - a[1]);
  for (const [[start, end, before, after], number] of edits) all.splice(start, end - start, before + number + after);
  return { text: all.join(""), missing };
}

/** Where the points of the drawing are now, with its drivers where they stand in it. */
function drawing({ data, solver }: Model): [Written, string][] {
  const { input, at, places } = data.drawing, { steady } = data.positions;
  const all = (call: Call, i: number) => places.map(([row, how, factor]): [Written, string] => [how, digits(call.row(row)[i], factor)]);
  let found = all(solver.main, at);
  if (steady && input !== null) solver.valueAt((input - steady.start) / steady.step, (call) => ((found = all(call, 0)), 0));
  return found;
}

/** The shortest number that gives an SI value in a unit again, to the last digit where there is one. */
function digits(value: number, factor: number): string {
  for (let count = FEWEST; count <= MOST; count++) {
    const near = Number((value / factor).toPrecision(count));
    if (near * factor === value) return String(near);
  }
  return String(value / factor);
}

const literally = (text: string) => text.replace(/[^\w\s]/g, "\\$&");

/** The dimensions in a text that is the model's own but for numbers that the page can change; null: another machine. */
export function readBack(text: string, { text: own, dimensions, drawing: drawn }: Pick<ModelData, "text" | "dimensions" | "drawing">): Values | null {
  const places = dimensions.flatMap(({ address, factor, written: how }): [string, Written, number][] => (how ? [[address, how, factor]] : []));
  // The drawing follows the dimensions, where it gives none of them.
  if (!dimensions.some((each) => each.drawn)) places.push(...drawn.places.map(([, ...how]): [string, Written, number] => ["", ...how]));
  // What is put in at one place stands there in turned order.
  places.reverse().sort(([, a], [, b]) => a[0] - b[0] || a[1] - b[1]);
  const all = Array.from(own), part = (from: number, to?: number) => literally(all.slice(from, to).join(""));
  let pattern = "^", last = 0;
  for (const [, [start, end, before, after]] of places) {
    pattern += `${part(last, start)}(?:${part(start, end)}|${literally(before)}([-+.\\deE]+)${literally(after)})`;
    last = end;
  }
  const found = new RegExp(`${pattern}${part(last)}$`).exec(text);
  if (!found) return null;
  const values = Object.fromEntries(dimensions.map(({ address, value }) => [address, value]));
  places.forEach(([address, , factor], k) => {
    if (address && found[k + 1]) values[address] = Number(found[k + 1]) * factor;
  });
  return Object.values(values).every(Number.isFinite) ? values : null;
}

// The text of a machine as it is now, which reads back as that machine: designs/varied_dimensions.py for the page.
import type { Written } from "./data";
import type { Call } from "./engine";
import type { Model } from "./model";

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

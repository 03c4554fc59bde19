// The text of a machine as it is now, which reads back as that machine: study/changed_text.py for the page.
import type { Written } from "./data";
import type { Call } from "./engine";
import type { Model } from "./model";

// Fewest and most digits of a number that is read back as the same.
const FEWEST = 12, MOST = 17;

/** The model's text with the changed numbers in their places, and the names of those that have none. */
export function written(model: Model): { text: string; missing: string[] } {
  const { data } = model, changed = data.dimensions.filter(({ address, value }) => model.values[address] !== value);
  const edits: [Written, number][] = [], missing: string[] = [];
  for (const { address, written: how, drawn } of changed) {
    if (how) edits.push([how, model.values[address]]);
    else if (!drawn) missing.push(address);
  }
  if (changed.some(({ moves }) => moves)) edits.push(...places(model));
  // Offsets count characters beyond the basic plane as one, as Python does.
  const all = [...data.text];
  edits.sort(([a], [b]) => b.span[0] - a.span[0] || b.span[1] - a.span[1]);
  for (const [{ span: [start, end], before, after, factor }, value] of edits)
    all.splice(start, end - start, before + digits(value, factor) + after);
  return { text: all.join(""), missing };
}

/** Where the points of the drawing are now, with its drivers where they stand in it. */
function places({ data, solver }: Model): [Written, number][] {
  const { input, at, places } = data.drawing, steady = input !== null && data.positions.steady !== null;
  const all = (call: Call, i: number) => places.map(({ row, written: how }): [Written, number] => [how, call.row(row)[i]]);
  let found = all(solver.main, at);
  if (steady) solver.valueAt(input, (call) => ((found = all(call, 0)), 0));
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

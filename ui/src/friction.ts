// Friction in joints that agrees with the reactions it causes: the same iteration as the core's.
import type { FrictionTerm } from "./data";
import type { Call } from "./engine";

const STEPS = 400, CHANGE = 1e-12, GROWING = 25;

/** Runs a program until its friction agrees with its reactions; false where it locks. The first run is done. */
export function settle(call: Call, terms: FrictionTerm[]): boolean {
  const rates = terms.map((term) => call.row(term.rate).slice()), arm = Math.max(...terms.map((term) => term.arm));
  const reactions = call.program.outputs.filter((name) => name.startsWith("r:"));
  let previous = Infinity, growing = 0;
  for (let step = 0; step < STEPS; step++) {
    let change = 0;
    const sizes = terms.map((term, k) => pressing(call, term).map((force, i) => -Math.sign(rates[k][i]) * term.arm * force));
    terms.forEach(({ field }, k) => {
      const row = call.fields[field];
      sizes[k].forEach((size, i) => (change = Math.max(change, Math.abs(size - row[i]))));
    });
    // Beyond the last position a program repeats it.
    terms.forEach(({ field }, k) => call.fields[field].forEach((_, i, row) => (row[i] = sizes[k][Math.min(i, call.n - 1)])));
    if (!Number.isFinite(change)) break;
    call.run();
    if (change <= CHANGE * arm * reactions.reduce((most, name) => call.row(name).reduce((a, x) => Math.max(a, Math.abs(x)), most), 0)) return true;
    growing = change > previous ? growing + 1 : 0;
    if (growing > GROWING) break;
    previous = change;
  }
  for (const { field } of terms) call.fields[field].fill(0);
  call.run();
  return false;
}

/** Size of the force that presses the two parts together. */
function pressing(call: Call, { joint, on, slides }: FrictionTerm): Float64Array {
  const sum = (axis: string, i: number) => on.reduce((total, link) => total + call.row(`r:${joint}|${link}.${axis}`)[i], 0);
  return Float64Array.from({ length: call.n }, (_, i) => {
    const x = sum("x", i), y = sum("y", i);
    return slides ? Math.abs(call.row(`d:${joint}.x`)[i] * y - call.row(`d:${joint}.y`)[i] * x) : Math.hypot(x, y);
  });
}

// What is to be known about numbers: which are not found again, where largest values are those of the positions alone.
import { isForce, sampled } from "../../numbers";
import type { Session } from "../../session";
import { digits } from "../../words";
import type { Bench } from "../bench";

export function Notes({ bench, session }: { bench: Bench; session: Session }) {
  const found = notes(bench, session);
  return found.length ? <ul class="notes">{found.map((each) => <li key={each}>{each}</li>)}</ul> : null;
}

function notes({ page }: Bench, { model, data }: Session): string[] {
  const { solver } = model, found: string[] = [], what = sampled(model), forces = data.numbers.some(({ signal }) => isForce(signal));
  if (model.changed && data.held.length) found.push(page.say("not_found_again", { names: data.held.join(", ") }));
  if (solver.locking) found.push(page.say("locking"));
  if (solver.doubtful) found.push(page.say("doubtful"));
  if (solver.iterated) found.push(page.say("followed", { value: digits(solver.margin ?? 0, 2) }));
  if (data.undrawn.length) found.push(page.say("undrawn", { names: data.undrawn.join(", ") }));
  if (what && model.n > 1 && (what === "all" || forces)) found.push(page.say(`sampled_${what}`, { count: String(model.n) }));
  return found;
}

// What another design of a machine would do, before it is taken.
import type { Session } from "../session";
import type { Values } from "../solver";

/** Draws the paths of another design, if it can be built, over the present one; null: as before. */
export function foreseen(session: Session, values: Values | null): void {
  if (!values) return session.sweep(session.swept.value);
  const { model } = session, known = Object.entries(values).filter(([address]) => address in model.values);
  const met = !model.evaluate({ ...model.values, ...Object.fromEntries(known) });
  const paths = session.traced.map((key) => ({ x: model.main.row(`p:${key}.x`).slice(), y: model.main.row(`p:${key}.y`).slice() }));
  model.evaluate(model.values);
  session.view?.ghosts(met ? paths : []);
}

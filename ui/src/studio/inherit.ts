// A session that goes on where another one of the same machine was, as the studio does after every change of the text.
import type { Session } from "../session";

/** Takes over what is shown, kept and compared with. */
export function inherit(session: Session, old: Session): void {
  const { model, data, shown } = session, known = (id: string) => id in model.signals;
  if (data.numbers.every(({ id }) => id in old.model.original.numbers) && Object.keys(model.signals).every((id) => id in old.model.original.rows)) {
    model.original = old.model.original;
    session.variants.value = old.variants.value;
    session.counted = old.counted;
  }
  const chosen = old.curves.value;
  if (chosen.join() !== old.data.curves.join() && chosen.every(known)) session.curves.value = chosen;
  const points = new Set(data.points.map(({ key }) => key));
  Object.assign(shown, old.shown, { paths: new Set([...old.shown.paths].filter((key) => points.has(key))) });
  const close = (address: string) => Math.abs(model.values[address] - old.model.values[address]) <= 1e-9 * Math.abs(model.values[address]);
  if (data.dimensions.every(({ address }) => close(address))) model.wall = old.model.wall;
  for (const address of old.model.locked) if (address in model.values) model.locked.add(address);
}

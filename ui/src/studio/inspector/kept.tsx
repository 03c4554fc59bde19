// Designs that have been kept, to be taken again.
import type { Session } from "../../session";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { Act, Section } from "./fields";

export function Kept({ bench, session }: { bench: Bench; session: Session }) {
  const { say } = bench, { value: variants } = session.variants, { data, model } = session;
  /** The dimensions in which a design differs from the present one, in a line. */
  const apart = (values: Record<string, number>) => {
    const changed = data.dimensions.filter(({ address }) => address in values && Math.abs(values[address] - model.values[address]) > 1e-9 * Math.abs(model.values[address]));
    return changed.slice(0, 3).map(({ address, factor, unit }) => `${address} ${Number((values[address] / factor).toPrecision(4))} ${unit}`.trim()).join(", ") + (changed.length > 3 ? " …" : "");
  };
  return (
    <Section bench={bench} id="insp.kept" title={say("insp.kept")} count={variants.length} open={variants.length > 0}>
      {() => (
        <>
          {variants.length > 0 && (
            <ul class="list">
              {variants.map(({ number, design }) => (
                <li key={number} class="with-switch">
                  <button type="button" title={say("insp.take_design")} onClick={() => session.take({ ...model.values, ...design.values })}><b>{say("design", { number: String(number) })}</b><small>{apart(design.values) || say("insp.as_now")}</small></button>
                  <button type="button" class="small" aria-label={say("insp.delete", { name: say("design", { number: String(number) }) })} onClick={() => session.forget(number)}><Icon name="close" size={13} /></button>
                </li>
              ))}
            </ul>
          )}
          <div class="row-acts"><Act act={() => session.keep()}>{say("insp.keep_design")}</Act></div>
        </>
      )}
    </Section>
  );
}

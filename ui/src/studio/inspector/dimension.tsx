// A dimension that drives the drawing: its value, what tolerance it is made to, its sweep.
import type { Bench } from "../bench";
import { put, set } from "./change";
import { addressPath, at, itemOf, pathOf, word } from "./entries";
import { Act, Chips, Quantity } from "./fields";
import { Head, Written } from "./head";
import { rangeOf } from "./hand";
import type { PanelProps } from "./selected";

export function DimensionPanel({ bench, item, entries }: PanelProps) {
  const { say } = bench, { name } = item, path = addressPath(entries, name), value = path ? word(at(entries, ...path)) : "", owner = path ? itemOf(entries, path.join(".")) : null;
  const known = bench.session.value?.data.dimensions.find(({ address }) => address === name);
  return (
    <>
      <Head bench={bench} icon="dimension" title={name} item={item} fixedName locks={[name]} remove={null}>{say("insp.dimension_about")}</Head>
      <div class="form">
        {path && <Quantity label={say("insp.value")} value={value} unit={known?.unit ?? bench.settings.value.unit} set={(text) => set(bench, path, text)} />}
        {at(entries, "optimize", "vary") !== undefined && <Quantity label={say("insp.tolerance")} value={word(at(entries, "optimize", "tolerance", name))} unit={known?.unit ?? "mm"} preset="–" optional set={(text) => put(bench, ["optimize", "tolerance", name], text)} />}
        {owner && <Chips label={say("insp.belongs")} names={[owner.name]} symbols={owner.kind === "point"} pick={() => bench.select(owner)} />}
      </div>
      {known && <div class="row-acts"><Act icon="sweep" act={() => sweep(bench, name)}>{say("insp.sweep")}</Act></div>}
      <Written bench={bench} path={owner ? pathOf(entries, owner) : path} />
    </>
  );
}

function sweep(bench: Bench, address: string): void {
  const session = bench.session.value, dimension = session?.data.dimensions.find((each) => each.address === address);
  if (!session || !dimension) return;
  bench.inHand.value = { address, ...rangeOf(session, dimension) };
  bench.dock.value = "sweep";
}

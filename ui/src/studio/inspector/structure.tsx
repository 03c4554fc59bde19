// How the mechanism is put together: its mobility worked as a formula, its groups with their links, what drives it.
import type { Bench } from "../bench";
import { table, word } from "./entries";
import { Chips, Row, Section } from "./fields";
import { Layers } from "./layer_list";

/** A formula with its indices lowered. */
function Formula({ text }: { text: string }) {
  return <span class="formula">{text.split(/_(\p{L}|\d)/u).map((part, k) => (k % 2 ? <sub key={k}>{part}</sub> : part))}</span>;
}

export function Structure({ bench }: { bench: Bench }) {
  const { structure, outline, mobility } = bench.desk.solved.value, { say } = bench;
  if (!structure) return <p class="quiet">{mobility === undefined ? say("insp.no_structure") : say("mobility", { value: String(mobility) })}</p>;
  const pick = (name: string) => bench.select({ kind: "link", name }), entries = outline?.entries ?? {}, driver = table(entries.driver), drivers = [driver, ...Object.values(table(entries.drivers)).map(table)];
  const driven = drivers.map((each) => word(each.turn) || word(table(table(entries.joints)[word(each.slide)]).block)).filter(Boolean);
  return (
    <>
      <h2 class="headline">{structure.headline}</h2>
      <div class="form">
        <Row label={say("insp.mobility")}><Formula text={structure.formula} /></Row>
        {structure.class && <Row label={say("insp.class")}><span class="quiet">{structure.class}</span></Row>}
        {driven.length > 0 && <Chips label={say("insp.driven")} names={driven} symbols={false} pick={pick} />}
      </div>
      {structure.groups.length > 0 && (
        <Section bench={bench} id="insp.groups" title={say("insp.groups")} count={structure.groups.length}>
          {() => structure.groups.map((group) => (
            <div class="group-of" key={group.name} onPointerEnter={() => (bench.hovered.value = { kind: "link", name: group.links[0] })} onPointerLeave={() => (bench.hovered.value = null)}>
              <button type="button" class="text" onClick={() => bench.select(...group.links.map((name) => ({ kind: "link" as const, name })))}>{group.signature}</button>
              <span class="quiet">{group.class}</span>
              <Chips label={say("insp.links")} names={group.links} symbols={false} pick={pick} />
              {group.joints.length > 0 && <Chips label={say("insp.joints")} names={group.joints} pick={(name) => bench.select({ kind: "point", name })} />}
            </div>
          ))}
        </Section>
      )}
      <Layers bench={bench} />
    </>
  );
}

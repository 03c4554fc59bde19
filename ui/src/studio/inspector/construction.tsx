// How a machine is made: material, sizes, supports of all its parts.
import type { Bench } from "../bench";
import type { Entry } from "../outline";
import { put, set, tell, unset } from "./change";
import { at, isTable, type Table, word } from "./entries";
import { Choice, Quantity, Section } from "./fields";

/** Materials that have names in a file. */
const MATERIALS = ["steel", "stainless_steel", "cast_iron", "aluminium", "brass", "bronze", "pom", "abs", "pla", "acrylic", "plywood", "mdf"];
/** Lengths of the section, with what holds where they are not written: "": a usual size. */
const LENGTHS: [key: string, usual: string][] = [["thickness", ""], ["width", ""], ["pin_radius", ""], ["clearance", "0"]];
/** Words of the section, the usual one first. */
const WORDS: [key: string, words: string[]][] = [["supports", ["cantilevered", "both"]], ["ends", ["heads", "flush"]]];

export function Construction({ bench, entries }: { bench: Bench; entries: Table }) {
  const { say } = bench, own = at(entries, "construction");
  return (
    <Section bench={bench} id="insp.construction" title={say("insp.construction")} open={false}>
      {() => (
        <div class="form">
          <MaterialChoice bench={bench} own={at(own, "material")} usual={MATERIALS[0]} write={(to) => put(bench, ["construction", "material"], to)} />
          {LENGTHS.map(([key, usual]) => (
            <Quantity key={key} label={say(`insp.made_${key}`)} value={word(at(own, key))} unit={bench.settings.value.unit} preset={usual || say("insp.made_usual")} optional set={(text) => put(bench, ["construction", key], text)} />
          ))}
          {WORDS.map(([key, words]) => (
            <Choice
              key={key} label={say(`insp.made_${key}`)} value={word(at(own, key)) || words[0]} options={words.map((each) => [each, say(`insp.made_${each}`)])}
              set={(to) => void tell(bench, to === words[0] ? unset(bench, ["construction", key]) : set(bench, ["construction", key], to))}
            />
          ))}
        </div>
      )}
    </Section>
  );
}

interface MaterialProps {
  bench: Bench;
  /** As it is written. */
  own: Entry | undefined;
  /** The one of nothing written; none: that of the machine. */
  usual?: string;
  /** Takes a name, "" for nothing. */
  write: (name: string) => Promise<string | null>;
}

/** A material by its name; one that the file describes itself stays until another is chosen. */
export function MaterialChoice({ bench, own, usual = "", write }: MaterialProps) {
  const { say } = bench, options = MATERIALS.map((each): [string, string] => [each, say(`insp.of_${each}`)]);
  if (!usual) options.unshift(["", say("insp.as_machine")]);
  if (isTable(own)) options.push(["own", say("insp.mat_other")]);
  return <Choice label={say("insp.material")} value={isTable(own) ? "own" : word(own) || usual} options={options} set={(to) => void (to === "own" || tell(bench, write(to === usual ? "" : to)))} />;
}

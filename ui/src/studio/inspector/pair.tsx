// Entries of `joints`: guides and slots, welds, gears, racks, cams, belts and chains, each by its list of fields.
import type { Bench } from "../bench";
import type { IconName } from "../frame/icons";
import { quantity } from "../../words";
import { CamLaw } from "./cam";
import { put, set, tell, unset } from "./change";
import { at, type Path, type Table, table, word, words } from "./entries";
import { Chips, Choice, Lock, Quantity, Row, Typing } from "./fields";
import { Head, Written } from "./head";
import type { PanelProps } from "./selected";

/** A field of an entry: a quantity with its unit, two of them, or one of some words. */
export type Spec =
  | { key: string; label: string; form: "quantity"; unit: string; preset?: string; lock?: true }
  | { key: string; label: string; form: "two"; unit: string }
  | { key: string; label: string; form: "words"; words: string[]; preset: string };

const friction: Spec = { key: "friction", label: "friction", form: "quantity", unit: "", preset: "0" };
const pressure: Spec = { key: "pressure_angle", label: "pressure_angle", form: "quantity", unit: "deg", preset: "20" };
const phase: Spec = { key: "phase", label: "phase", form: "quantity", unit: "deg", preset: "–" };
const radii: Spec = { key: "radii", label: "radii", form: "two", unit: "mm" };
const teeth: Spec = { key: "teeth", label: "teeth", form: "two", unit: "" };
const mesh: Spec = { key: "mesh", label: "mesh", form: "words", words: ["external", "internal"], preset: "external" };

interface Kind {
  icon: IconName;
  /** Roles of the links, in the order in which a sentence names them. */
  links: string[];
  fields: Spec[];
}

const KINDS: Record<string, Kind> = {
  prismatic: {
    icon: "slider", links: ["block", "guide"],
    fields: [
      { key: "direction", label: "direction", form: "quantity", unit: "deg", lock: true }, { key: "offset", label: "offset", form: "quantity", unit: "mm", preset: "0", lock: true },
      { key: "block_angle", label: "block_angle", form: "quantity", unit: "deg", preset: "0", lock: true }, friction,
    ],
  },
  weld: { icon: "weld", links: ["links"], fields: [{ key: "angle", label: "angle", form: "quantity", unit: "deg", preset: "0", lock: true }] },
  gear: { icon: "gears", links: ["links"], fields: [teeth, { key: "module", label: "module", form: "quantity", unit: "mm", preset: "–" }, radii, mesh, pressure, phase] },
  rolling: { icon: "gears", links: ["links"], fields: [radii, mesh, phase] },
  belt: { icon: "gears", links: ["links"], fields: [radii, { key: "run", label: "run", form: "words", words: ["open", "crossed"], preset: "open" }, { key: "pretension", label: "pretension", form: "quantity", unit: "N", preset: "0" }, phase] },
  chain: { icon: "gears", links: ["links"], fields: [teeth, { key: "pitch", label: "pitch", form: "quantity", unit: "mm", preset: "–" }, radii, phase] },
  rack: {
    icon: "rack", links: ["pinion", "rack"],
    fields: [
      { key: "radius", label: "radius", form: "quantity", unit: "mm", preset: "–" }, { key: "teeth", label: "teeth", form: "quantity", unit: "", preset: "–" },
      { key: "module", label: "module", form: "quantity", unit: "mm", preset: "–" }, pressure, phase,
    ],
  },
  cam: {
    icon: "cam", links: ["cam", "follower"],
    fields: [
      { key: "touch", label: "touch", form: "words", words: ["roller", "knife", "flat"], preset: "roller" }, { key: "base_radius", label: "base_radius", form: "quantity", unit: "mm", lock: true },
      { key: "roller_radius", label: "roller_radius", form: "quantity", unit: "mm", preset: "–", lock: true }, { key: "phase", label: "phase", form: "quantity", unit: "deg", preset: "0" },
      { key: "turn", label: "turn", form: "words", words: ["counterclockwise", "clockwise"], preset: "counterclockwise" },
      { key: "closure", label: "closure", form: "words", words: ["force", "groove"], preset: "force" },
    ],
  },
};

export function PairPanel({ bench, item, entries }: PanelProps) {
  const { say } = bench, { name } = item, path: Path = ["joints", name], joint = table(at(entries, ...path)), kind = word(joint.kind);
  const { icon, links, fields } = KINDS[kind] ?? { icon: "joint", links: [], fields: [] };
  const joined = links.flatMap((role) => (Array.isArray(joint[role]) ? words(joint[role]) : [word(joint[role])])).filter(Boolean);
  const slot = kind === "prismatic" && word(joint.guide) !== "frame";
  return (
    <>
      <Head bench={bench} icon={slot ? "slot" : icon} title={name} item={item} locks={fields.filter((each) => "lock" in each && word(joint[each.key])).map(({ key }) => `${name}.${key}`)}>
        {say(`insp.pair_${slot ? "slot" : kind in KINDS ? kind : "other"}`, { a: joined[0] ?? "", b: joined[1] ?? "" })}
      </Head>
      <div class="form">
        <Chips label={say("insp.links")} names={joined.filter((each) => each !== "frame")} symbols={false} pick={(link) => bench.select({ kind: "link", name: link })} />
        <Fields bench={bench} path={path} entry={joint} specs={fields} address={name} />
        {kind === "gear" && <Ratio bench={bench} joint={joint} path={path} />}
        {kind === "prismatic" && <Stroke bench={bench} name={name} />}
      </div>
      {kind === "cam" && <CamLaw bench={bench} path={path} joint={joint} />}
      <Written bench={bench} path={path} />
    </>
  );
}

/** The fields of an entry as they are written; what is not written shows what holds then. */
export function Fields({ bench, path, entry, specs, address }: { bench: Bench; path: Path; entry: Table; specs: Spec[]; address?: string }) {
  const { say } = bench;
  return (
    <>
      {specs.map((spec) => {
        const label = say(`insp.key_${spec.label}`), own = [...path, spec.key], value = entry[spec.key];
        if (spec.form === "words")
          return (
            <Choice
              key={spec.key} label={label} value={word(value) || spec.preset} options={spec.words.map((each) => [each, say(`insp.word_${each}`)])}
              set={(to) => void tell(bench, to === spec.preset && value !== undefined && spec.key !== "touch" ? unset(bench, own) : set(bench, own, to))}
            />
          );
        if (spec.form === "two") {
          const both = words(value);
          if (both.length !== 2) return null;
          return (
            <Row key={spec.key} label={label}>
              <span class="two">{both.map((each, k) => <Typing key={k} label={`${label} ${k + 1}`} value={each} unit={spec.unit} set={(text) => set(bench, own, both.map((old, j) => (j === k ? text : old)))} />)}</span>
            </Row>
          );
        }
        if (Array.isArray(value)) return <Row key={spec.key} label={label}><span class="quiet">{words(value).join(" → ")}</span></Row>;
        return (
          <Quantity
            key={spec.key} label={label} value={word(value)} unit={spec.unit} preset={spec.preset} optional={spec.preset !== undefined}
            set={(text) => put(bench, own, text)} aside={spec.lock && word(value) && address ? <Lock bench={bench} address={`${address}.${spec.key}`} /> : undefined}
          />
        );
      })}
    </>
  );
}

/** The ratio of speeds of two gears: as their teeth or radii have it, or as it is written. */
function Ratio({ bench, joint, path }: { bench: Bench; joint: Table; path: Path }) {
  const sizes = words(joint.teeth).length ? words(joint.teeth) : words(joint.radii), [a, b] = sizes.map(Number.parseFloat), label = bench.say("insp.key_ratio");
  if (sizes.length !== 2) return <Quantity label={label} value={word(joint.ratio)} unit="" set={(text) => put(bench, [...path, "ratio"], text)} />;
  const ratio = (a / b) * (word(joint.mesh) === "internal" ? 1 : -1);
  return <Quantity label={label} value={Number.isFinite(ratio) ? String(Number(ratio.toPrecision(5))) : ""} unit="" follows />;
}

/** How far a block goes over the cycle. */
function Stroke({ bench, name }: { bench: Bench; name: string }) {
  const session = bench.session.value;
  void session?.calm.value;
  if (!session || !(`s:${name}` in session.model.signals) || session.model.n < 2) return null;
  const row = session.model.row(`s:${name}`), span = Math.max(...row) - Math.min(...row);
  return Number.isFinite(span) ? <Row label={bench.say("insp.stroke")}><span class="quiet">{quantity(span, "length")}</span></Row> : null;
}

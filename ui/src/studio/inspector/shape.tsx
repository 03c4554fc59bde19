// What a link is cut from: its shape with sizes and material, and the layer in which it lies.
import type { Bench } from "../bench";
import type { Entry } from "../outline";
import { useRoom } from "../room";
import { put, set, tell, unset } from "./change";
import { MaterialChoice } from "./construction";
import { at, isTable, type Table, word } from "./entries";
import { Choice, Quantity, Section } from "./fields";
import { inUnit } from "./quantities";

/** Kinds that can be chosen; others are drawn in the text. */
const KINDS = ["bar", "plate", "disc", "none"];
/** Keys that go with a kind besides material and thickness. */
const KEYS: Record<string, string[]> = { "": ["width"], bar: ["width"], plate: ["width"], disc: ["radius"], none: [] };
/** The radius of a disc that has none yet. */
const RADIUS = "20 mm";
const EVERYWHERE = ["thickness", "material"];

/** What is found, unless it is written: typing the same fixes it. */
const found = (number: string) => `(${number})`;

export function Shape({ bench, name, link, entries }: { bench: Bench; name: string; link: Table; entries: Table }) {
  return <Section bench={bench} id="insp.shape" title={bench.say("insp.shape")} open={false}>{() => <Fields bench={bench} name={name} shape={link.shape} entries={entries} />}</Section>;
}

function Fields({ bench, name, shape, entries }: { bench: Bench; name: string; shape: Entry | undefined; entries: Table }) {
  const { say } = bench, { unit } = bench.settings.value, room = useRoom(bench), own: Table = isTable(shape) ? shape : word(shape) ? { kind: word(shape) } : {};
  const kind = kindOf(own), size = room?.sizes[name], layer = room?.outlines.find((each) => each.name === name)?.layer, options = ["", ...KINDS, ...(KINDS.includes(kind) || !kind ? [] : [kind])];
  /** Writes one key; beside a word the shape becomes a table. */
  const write = (key: string) => (text: string) => (isTable(shape) || !text.trim() || !own.kind ? put(bench, ["links", name, "shape", key], text) : set(bench, ["links", name, "shape"], { ...own, [key]: text }));
  const sized = (key: string, preset = "", optional = true) => (
    <Quantity label={say(`insp.made_${key}`)} value={word(own[key])} unit={unit} preset={preset} optional={optional} set={write(key)} />
  );
  return (
    <div class="form">
      <Choice label={say("insp.kind")} value={kind} options={options.map((each) => [each, say(`insp.cut_${each || "usual"}`)])} set={(to) => void tell(bench, change(bench, name, own, to))} />
      {kind === "disc" ? sized("radius", "", false) : kind !== "none" && kind !== "outline" && sized("width", size && found(inUnit(size.width, unit)))}
      {kind !== "none" && (
        <>
          {sized("thickness", size && found(inUnit(size.thickness, unit)))}
          <MaterialChoice bench={bench} own={own.material} write={write("material")} />
          <Quantity label={say("insp.layer")} value={word(at(entries, "construction", "layers", name))} unit="" preset={layer === null || layer === undefined ? say("insp.made_usual") : found(String(layer))} optional set={(text) => put(bench, ["construction", "layers", name], text)} />
        </>
      )}
    </div>
  );
}

/** The kind that is written, or that the other keys mean. */
function kindOf(shape: Table): string {
  return word(shape.kind) || (shape.through ? "path" : shape.outline || shape.file ? "outline" : shape.radius ? "disc" : "");
}

/** Another kind, with what goes with it of what is written. */
function change(bench: Bench, name: string, shape: Table, kind: string): Promise<string | null> {
  const path = ["links", name, "shape"], fits = new Set([...(KEYS[kind] ?? []), ...(kind === "none" ? [] : EVERYWHERE)]);
  const kept = Object.fromEntries(Object.entries(shape).filter(([key]) => fits.has(key))), more: Table = kind === "disc" && !kept.radius ? { radius: RADIUS } : {};
  const all: Table = { ...(kind && kind !== "disc" ? { kind } : {}), ...kept, ...more }, keys = Object.keys(all);
  if (!keys.length) return unset(bench, path);
  return set(bench, path, keys.length === 1 && kind && kind !== "disc" ? kind : all);
}

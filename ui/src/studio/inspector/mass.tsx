// The mass of a link: by hand, or of the bar that it is cut from.
import { signal } from "@preact/signals";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { perform, put, set, tell, unset } from "./change";
import { type Path, type Table, word, words } from "./entries";
import { Choice, Quantity, Row, Section, Select, Switch, Typing } from "./fields";
import { inUnit } from "./quantities";

/** What the file has in place of a mass that the shape gives. */
const FROM_SHAPE = "from shape";

type Shape = "flat" | "round" | "tube";

interface Bar {
  shape: Shape;
  size: string[];
  density: string;
  /** The length for which mass and inertia were found. */
  length: string;
}

const SIZES: Record<Shape, string[]> = { flat: ["20 mm", "5 mm"], round: ["12 mm"], tube: ["20 mm", "16 mm"] };
/** Usual densities, kg/m³; of alloys the common ones. */
const MATERIALS: [string, string][] = [
  ["steel", "7850 kg/m³"], ["aluminium", "2700 kg/m³"], ["iron", "7200 kg/m³"], ["brass", "8500 kg/m³"], ["titanium", "4430 kg/m³"], ["pom", "1410 kg/m³"],
  ["pla", "1240 kg/m³"], ["acrylic", "1190 kg/m³"], ["plywood", "680 kg/m³"],
];
/** Bars of links, by their names, as they have been chosen in this window: the file has mass and inertia alone. */
const bars = signal<Record<string, Bar>>({});

export function Mass({ bench, name, link, points }: { bench: Bench; name: string; link: Table; points: string[] }) {
  const { say } = bench, path: Path = ["links", name], bar = bars.value[name], shaped = word(link.mass) === FROM_SHAPE;
  const begin = () => void take(bench, name, { shape: "flat", size: SIZES.flat, density: MATERIALS[0][1], length: word(link.length) });
  return (
    <Section bench={bench} id="insp.mass" title={say("insp.mass")}>
      {() => (
        <>
          <div class="form">
            {points.length > 0 && <Switch label={say("insp.from_shape")} on={shaped} set={(on) => void tell(bench, on ? fromShape(bench, name, link) : unset(bench, [...path, "mass"]))} />}
          </div>
          {shaped ? <Weighed bench={bench} name={name} /> : <><div class="form">
            <Quantity label={say("insp.mass")} value={word(link.mass)} unit="kg" preset="0" optional set={(text) => (drop(name), put(bench, [...path, "mass"], text))} />
            <Quantity label={say("insp.inertia")} value={word(link.inertia)} unit="kg·m²" preset="0" optional set={(text) => (drop(name), put(bench, [...path, "inertia"], text))} />
            <Centre bench={bench} path={[...path, "mass_centre"]} value={link.mass_centre === undefined ? "" : word(link.mass_centre) || "place"} place={words(link.mass_centre)} points={points} />
          </div>
          {bar ? <BarSection bench={bench} name={name} bar={bar} length={word(link.length)} /> : points.length > 1 && <button type="button" class="text" onClick={begin}><Icon name="mass" size={16} />{say("insp.from_bar")}</button>}</>}
        </>
      )}
    </Section>
  );
}

/** Mass and inertia as the shape gives them. */
function Weighed({ bench, name }: { bench: Bench; name: string }) {
  const { say } = bench, found = bench.desk.solved.value.picture?.masses?.[name], mass = found?.mass ?? null, inertia = found?.inertia ?? null;
  return (
    <div class="form">
      {mass !== null && <Quantity label={say("insp.mass")} value={`${inUnit(mass, "kg", 5)} kg`} unit="kg" follows />}
      {inertia !== null && <Quantity label={say("insp.inertia")} value={`${inUnit(inertia, "kg·m²", 5)} kg·m²`} unit="kg·m²" follows />}
    </div>
  );
}

/** Takes mass, inertia and centre from the shape, in place of those that are written. */
function fromShape(bench: Bench, name: string, link: Table): Promise<string | null> {
  const gone = ["inertia", "mass_centre"].filter((key) => link[key] !== undefined).map((key) => ({ do: "unset", path: ["links", name, key] }));
  drop(name);
  return perform(bench, [...gone, { do: "set", path: ["links", name, "mass"], value: FROM_SHAPE }]);
}

/** Where the mass centre is: midway, at a point, or at a place in the link's axes. */
function Centre({ bench, path, value, place, points }: { bench: Bench; path: Path; value: string; place: string[]; points: string[] }) {
  const { say } = bench, unit = bench.settings.value.unit;
  const pick = (to: string) => void (to === "" ? unset(bench, path) : set(bench, path, to === "place" ? [`0 ${unit}`, `0 ${unit}`] : to));
  return (
    <>
      <Choice label={say("insp.centre")} value={value} set={pick} options={[["", say("insp.midway")], ...points.map((point): [string, string] => [point, say("insp.at_point", { name: point })]), ["place", say("insp.at_place")]]} />
      {value === "place" && (
        <Row label="">
          <span class="two">
            {place.map((each, k) => <Typing key={k} label={say(k ? "insp.across" : "insp.along")} value={each} unit={unit} set={(text) => set(bench, path, place.map((old, j) => (j === k ? text : old)))} />)}
          </span>
        </Row>
      )}
    </>
  );
}

function BarSection({ bench, name, bar, length }: { bench: Bench; name: string; bar: Bar; length: string }) {
  const { say } = bench, change = (part: Partial<Bar>) => take(bench, name, { ...bar, ...part, length });
  const sizes = bar.size.map((value, k) => (
    <Typing key={`${bar.shape}${k}`} label={say(`insp.size_${bar.shape}_${k}`)} value={value} unit="mm" set={(text) => change({ size: bar.size.map((old, j) => (j === k ? text : old)) })} />
  ));
  const known = MATERIALS.find(([, density]) => density === bar.density);
  return (
    <div class="box">
      <div class="box-h"><Icon name="mass" size={16} /><b>{say("insp.from_bar")}</b><button type="button" class="text" onClick={() => drop(name)}>{say("insp.by_hand")}</button></div>
      <div class="form tight">
        <Row label={say("insp.section")}>
          <Select label={say("insp.section")} value={bar.shape} options={(["flat", "round", "tube"] as const).map((each) => [each, say(`insp.shape_${each}`)])} set={(shape) => void change({ shape: shape as Shape, size: SIZES[shape as Shape] })} />
        </Row>
        <Row label={say(bar.shape === "flat" ? "insp.size" : "insp.diameter")}><span class="two">{sizes[0]}{sizes[1] && <i>{bar.shape === "flat" ? "×" : "/"}</i>}{sizes[1]}</span></Row>
        <Row label={say("insp.material")}>
          <Select
            label={say("insp.material")} value={known?.[0] ?? "other"} options={[...MATERIALS.map(([each, density]): [string, string] => [each, `${say(`insp.mat_${each}`)}, ${density}`]), ["other", say("insp.mat_other")]]}
            set={(to) => void change({ density: MATERIALS.find(([each]) => each === to)?.[1] ?? "1000 kg/m³" })}
          />
        </Row>
        {!known && <Quantity label={say("insp.density")} value={bar.density} unit="kg/m³" set={(density) => change({ density })} />}
        {bar.length !== length && <button type="button" class="text" onClick={() => void change({})}>{say("insp.find_again", { length })}</button>}
      </div>
    </div>
  );
}

function drop(name: string): void {
  const { [name]: _, ...rest } = bars.value;
  bars.value = rest;
}

/** Writes the mass and inertia of a bar; gives the sentence of a refusal. */
async function take(bench: Bench, name: string, bar: Bar): Promise<string | null> {
  const { shape, size, density } = bar, sentence = await perform(bench, [{ do: "mass", link: name, section: { shape, size, density } }]);
  if (!sentence) bars.value = { ...bars.value, [name]: bar };
  else bench.page.note.value = sentence;
  return sentence;
}

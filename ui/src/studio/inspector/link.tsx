// A link or plate: its lengths, angle, points, mass, loads.
import type { Vec } from "../../shapes";
import { quantity } from "../../words";
import type { Bench } from "../bench";
import { Icon } from "../frame/icons";
import { make, perform, put, set } from "./change";
import { at, isTable, loadsOn, type Path, pointsOf, type Table, table, word, words } from "./entries";
import { Act, Chips, Lock, Quantity, Row, Section, Sentence, Typing } from "./fields";
import { Head, Written } from "./head";
import { LoadList } from "./loads_list";
import { Look } from "./look";
import { Mass } from "./mass";
import { placeOf, useNow } from "./now";
import { Shape } from "./shape";
import { inUnit, si } from "./quantities";
import type { PanelProps } from "./selected";

const TURN = 2 * Math.PI, NEAR = 1e-6;

export function LinkPanel({ bench, item, entries }: PanelProps) {
  const { name } = item, { say } = bench, path: Path = ["links", name], link = table(at(entries, ...path));
  const { own, also } = pointsOf(link), all = [...own, ...also], loads = loadsOn(entries, name);
  const plate = own.length > 2 || also.length > 0;
  return (
    <>
      <Head bench={bench} icon={plate ? "plate" : own.length < 2 ? "slider" : "link"} title={name} item={item} locks={lockable(bench, name)}>
        <Sentence text={say(about(own, also), { a: "{0}", b: "{1}", c: "{2}", more: String(also.length), count: String(all.length) })} names={all} />
      </Head>
      <div class="form">
        <Lengths bench={bench} name={name} link={link} />
        <Angle bench={bench} name={name} points={own} link={link} />
        <Swing bench={bench} name={name} />
        <Chips label={say("insp.points")} names={all} pick={(point) => bench.select({ kind: "point", name: point })}>
          <button type="button" class="add" aria-label={say("insp.add_point")} title={say("insp.add_point")} onClick={() => (bench.select(item), (bench.tool.value = "plate"))}><Icon name="plus" size={13} /></button>
        </Chips>
      </div>
      <Shape bench={bench} name={name} link={link} entries={entries} />
      <Mass bench={bench} name={name} link={link} points={own} />
      {loads.length > 0 && <Section bench={bench} id="insp.loads_on" title={say("insp.loads_on")} count={loads.length}>{() => <LoadList bench={bench} entries={entries} names={loads} />}</Section>}
      {own.length + also.length > 1 && <Look bench={bench} path={[...path, "colour"]} link={link} />}
      <div class="row-acts">
        <Act icon="split" act={() => void split(bench, name, own)} disabled={own.length < 2}>{say("insp.split")}</Act>
        <Act icon="mirror" act={() => void paste(bench, name, [0, 0], "x")}>{say("insp.mirror")}</Act>
        <Act icon="copy" act={() => void paste(bench, name, [0.02, -0.02])}>{say("insp.copy")}</Act>
      </div>
      <Written bench={bench} path={path} />
    </>
  );
}

function about(own: string[], also: string[]): string {
  if (own.length < 2) return own.length ? "insp.block" : "insp.link_bare";
  if (own.length === 2) return also.length === 0 ? "insp.link_of" : also.length === 1 ? "insp.link_with" : "insp.link_more";
  return own.length === 3 && !also.length ? "insp.plate_of" : "insp.plate_more";
}

/** The dimensions of a link that a lock can hold. */
export function lockable(bench: Bench, name: string): string[] {
  const link = at(bench.desk.solved.value.outline?.entries, "links", name), own = table(link);
  const found = ["length", "angle"].filter((key) => word(own[key])).map((key) => `${name}.${key}`);
  return [...found, ...words(own.lengths).map((_, k) => `${name}.lengths.${k}`)];
}

function Lengths({ bench, name, link }: { bench: Bench; name: string; link: Table }) {
  const { say } = bench, path: Path = ["links", name], { own } = pointsOf(link), unit = bench.settings.value.unit;
  if (isTable(link.points)) return <Coordinates bench={bench} path={[...path, "points"]} label={say("insp.places")} entry={link.points} />;
  const lengths = words(link.lengths);
  if (lengths.length === 2 && own.length > 2)
    return (
      <>
        {lengths.map((value, k) => (
          <Quantity
            key={k} label={`${own[0]} – ${own[k + 1]}`} name={say("insp.length_between", { a: own[0], b: own[k + 1] })} value={value} unit={unit}
            set={(text) => set(bench, [...path, "lengths"], lengths.map((old, j) => (j === k ? text : old)))} aside={<Lock bench={bench} address={`${name}.lengths.${k}`} />}
          />
        ))}
        <Quantity label={say("insp.corner")} value={word(link.angle)} unit="deg" set={(text) => put(bench, [...path, "angle"], text)} aside={<Lock bench={bench} address={`${name}.angle`} />} />
      </>
    );
  if (own.length < 2) return null;
  const written = word(link.length), [a, b] = own.slice(0, 2).map((point) => bench.desk.solved.value.picture?.points[point]);
  const measured = a && b ? `${inUnit(Math.hypot(b[0] - a[0], b[1] - a[1]), unit)} ${unit}` : "";
  return (
    <>
      <Quantity
        label={say("insp.length")} value={written || measured} unit={unit} follows={!written} set={(text) => set(bench, [...path, "length"], text)}
        aside={written ? <Lock bench={bench} address={`${name}.length`} /> : undefined}
      />
      {isTable(link.also) && <Coordinates bench={bench} path={[...path, "also"]} label={say("insp.places")} entry={link.also} />}
    </>
  );
}

/** Places of points in the axes of a link: along it from its first point, and square to it. */
export function Coordinates({ bench, path, label, entry }: { bench: Bench; path: Path; label: string; entry: Table }) {
  return (
    <>
      {Object.entries(entry).map(([point, value]) => <Pair key={point} bench={bench} path={[...path, point]} label={label} point={point} values={words(value)} />)}
    </>
  );
}

function Pair({ bench, path, label, point, values }: { bench: Bench; path: Path; label: string; point: string; values: string[] }) {
  const take = (k: number) => (text: string) => set(bench, path, values.map((old, j) => (j === k ? text : old)));
  return (
    <Row label={label ? bench.say("insp.place_of", { name: point }) : point}>
      <span class="two">
        {values.map((value, k) => <Typing key={k} label={bench.say(k ? "insp.across_of" : "insp.along_of", { name: point })} value={value} unit={bench.settings.value.unit} set={take(k)} />)}
      </span>
    </Row>
  );
}

/** The angle that is shown; where the link is drawn, it can be typed, and its end goes there. */
function Angle({ bench, name, points, link }: { bench: Bench; name: string; points: string[]; link: Table }) {
  const index = useNow(bench), session = bench.session.value, [first, second] = points;
  if (!second) return null;
  const a = placeOf(bench, first, index), b = placeOf(bench, second, index);
  if (!a || !b) return null;
  const angleOf = (from: Vec, to: Vec) => `${inUnit(Math.atan2(to[1] - from[1], to[0] - from[0]), "deg", 4)} deg`, drawn = !session || (index === session.data.drawing.at && !bench.page.playing.value);
  const turn = async (text: string) => {
    const wanted = (Number.parseFloat(text) * Math.PI) / 180, written = si(word(link.length)), far = written > 0 ? written : Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (!Number.isFinite(wanted) || !/^[-+.\d]+ ?(deg|°)?$/.test(text)) return bench.say("insp.no_angle", { text });
    const to = [a[0] + far * Math.cos(wanted), a[1] + far * Math.sin(wanted)];
    return perform(bench, [{ do: "move", points: { [second]: to }, locked: [...bench.locked.value, ...(word(link.length) ? [`${name}.length`] : [])] }]);
  };
  return <Quantity label={bench.say(session ? "insp.angle_now" : "insp.angle")} value={angleOf(a, b)} unit="deg" live={session ? { bench, at: (i) => angleOf(placeOf(bench, first, i) ?? a, placeOf(bench, second, i) ?? b) } : undefined} follows set={drawn ? turn : undefined} />;
}

/** How far a link swings over the cycle. */
function Swing({ bench, name }: { bench: Bench; name: string }) {
  const session = bench.session.value;
  void session?.calm.value;
  if (!session || !(`angle:${name}` in session.model.signals) || session.model.n < 2) return null;
  const row = session.model.row(`angle:${name}`), low = Math.min(...row), high = Math.max(...row);
  const { closed, drift } = session.data.positions, degrees = (x: number) => quantity(x, "angle", 1);
  if (!Number.isFinite(low + high) || high - low < NEAR) return null;
  const round = closed && high - low > 0.9 * TURN && Math.abs(drift) > NEAR;
  return (
    <Row label={bench.say("insp.swing")}>
      <span class="quiet">{round ? bench.say("insp.turns") : bench.say("insp.swings", { by: degrees(high - low), from: degrees(low), to: degrees(high) })}</span>
    </Row>
  );
}

async function split(bench: Bench, link: string, [first, second]: string[]): Promise<void> {
  const places = bench.desk.solved.value.picture?.points ?? {}, a = places[first], b = places[second];
  if (a && b) await make(bench, [{ do: "split", link, at: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] }], [link]);
}

async function paste(bench: Bench, name: string, shift: [number, number], mirror?: "x" | "y"): Promise<void> {
  await make(bench, [{ do: "paste", items: [{ kind: "link", name }], shift, ...(mirror ? { mirror } : {}) }]);
}


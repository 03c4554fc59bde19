// A pivot, a joint, or a point of a link: where it is, what is joined there, its pin, what acts in it now.
import { useLayoutEffect, useRef } from "preact/hooks";
import { write } from "../../strokes";
import { quantity } from "../../words";
import type { Bench } from "../bench";
import type { IconName } from "../frame/icons";
import { typed } from "../tools/typed";
import { perform, put, set, tell } from "./change";
import { at, isFixed, linksAt, type Path, type Table, table, word, words } from "./entries";
import { Act, Chips, Quantity, Row, Section, Switch } from "./fields";
import { Head, Written } from "./head";
import { HodographPlot } from "./hodograph";
import { keyOf, placeOf, rowAt, useLive, useNow } from "./now";
import { inUnit } from "./quantities";
import type { PanelProps } from "./selected";

export function PointPanel({ bench, item, entries }: PanelProps) {
  const { say } = bench, { name } = item, links = linksAt(entries, name), fixed = isFixed(entries, name);
  const kind = fixed ? "pivot" : links.length > 1 ? "joint" : "point", icon: IconName = kind;
  const owner = kind === "point" ? links.find((link) => at(entries, "links", link, "also", name) !== undefined) : undefined;
  const path: Path = fixed ? ["frame", "points", name] : owner ? ["links", owner, "also", name] : word(at(entries, "joints", name, "kind")) ? ["joints", name] : ["drawing", name];
  return (
    <>
      <Head bench={bench} icon={icon} title={name} item={item} locks={fixed ? [`frame.${name}.x`, `frame.${name}.y`] : owner ? [`${owner}.${name}.x`, `${owner}.${name}.y`] : []}>
        {say(links.length ? `insp.${kind}_of` : `insp.${kind}_free`, { links: links.join(say("insp.comma")) })}
      </Head>
      <div class="form">
        <Chips label={say("insp.links_here")} names={links} symbols={false} pick={(link) => bench.select({ kind: "link", name: link })} />
        <Place bench={bench} name={name} path={path} entries={entries} owner={owner} />
        {kind !== "point" && <Switch label={say("insp.fixed")} on={fixed} set={(on) => void tell(bench, perform(bench, [{ do: "fix", point: name, fixed: on }]))}>{say(fixed ? "insp.on_frame" : "insp.moves")}</Switch>}
        <Trace bench={bench} name={name} fixed={fixed} />
      </div>
      {kind !== "point" && <Pin bench={bench} name={name} entries={entries} links={links} />}
      <Now bench={bench} name={name} fixed={fixed} />
      <Velocity bench={bench} name={name} fixed={fixed} />
      <Written bench={bench} path={path} />
    </>
  );
}

/** Its coordinates: on the frame, in its link, or as they follow from the links. */
function Place({ bench, name, path, entries, owner }: { bench: Bench; name: string; path: Path; entries: Table; owner?: string }) {
  const { say } = bench, index = useNow(bench), unit = bench.settings.value.unit, written = words(at(entries, ...path)), session = bench.session.value;
  if (path[0] === "frame" || owner) {
    const take = (k: number) => (text: string) => set(bench, path, written.map((old, j) => (j === k ? text : old)));
    const labels = owner ? ["insp.along", "insp.across"] : ["insp.x", "insp.y"];
    return <>{written.map((value, k) => <Quantity key={k} label={say(labels[k])} value={value} unit={unit} set={take(k)} />)}</>;
  }
  const place = placeOf(bench, name, index), drawn = !session || (index === session.data.drawing.at && !bench.page.playing.value);
  if (!place) return null;
  const move = (k: number) => async (text: string) => {
    const to = [...place], found = typed(text, "length");
    if (!found) return say("insp.no_length", { text });
    to[k] = found.value;
    return perform(bench, [{ do: "move", points: { [name]: to }, locked: [...bench.locked.value] }]);
  };
  return (
    <>
      {place.map((value, k) => <Quantity key={k} label={say(k ? "insp.y" : "insp.x")} value={`${inUnit(value, unit)} ${unit}`} unit={unit} live={session ? { bench, at: (i) => `${inUnit(placeOf(bench, name, i)?.[k] ?? NaN, unit)} ${unit}` } : undefined} follows={!!session} set={drawn ? move(k) : undefined} />)}
    </>
  );
}

function Trace({ bench, name, fixed }: { bench: Bench; name: string; fixed: boolean }) {
  const session = bench.session.value, key = keyOf(bench, name);
  void session?.calm.value;
  if (!session || !key || fixed) return null;
  const { paths } = session.shown, on = paths.has(key);
  const show = () => {
    if (on) paths.delete(key);
    else paths.add(key);
    session.sweep(session.swept.value);
    session.touched();
  };
  return <Switch label={bench.say("insp.path")} on={on} set={show} />;
}

/** The pin that joins the links: its radius and friction are written for the joint of its name. */
function Pin({ bench, name, entries, links }: { bench: Bench; name: string; entries: Table; links: string[] }) {
  const { say } = bench, path: Path = ["joints", name], joint = table(at(entries, ...path));
  const take = (key: string) => (text: string) => {
    if (joint.kind !== undefined || !text) return put(bench, [...path, key], text);
    return set(bench, path, { kind: "revolute", [key]: text });
  };
  return (
    <Section bench={bench} id="insp.pin" title={say("insp.pin")} open={joint.kind !== undefined}>
      {() => (
        <div class="form">
          <Quantity label={say("insp.pin_radius")} value={word(joint.pin_radius)} unit="mm" preset="–" optional set={take("pin_radius")} />
          <Quantity label={say("insp.friction")} value={word(joint.friction)} unit="" preset="0" optional set={take("friction")} />
          {links.length > 1 && (
            <div class="row-acts">
              {links.slice(1).map((link) => <Act key={link} icon="weld" act={() => void tell(bench, perform(bench, [{ do: "weld", point: name, on: link }]))}>{say("insp.weld_links", { a: links[0], b: link })}</Act>)}
            </div>
          )}
        </div>
      )}
    </Section>
  );
}

function Velocity({ bench, name, fixed }: { bench: Bench; name: string; fixed: boolean }) {
  const session = bench.session.value, key = keyOf(bench, name);
  if (!session || !key || fixed || session.model.n < 2 || !(`v:${key}` in session.model.signals)) return null;
  return <Section bench={bench} id="insp.hodograph" title={bench.say("insp.hodograph")} open={false}>{() => <HodographPlot bench={bench} session={session} point={key} name={name} />}</Section>;
}

/** A vector of the machine as it is now: its size, and its direction where it has one. */
function Live({ bench, id, kind, label, tone }: { bench: Bench; id: string; kind: string; label: string; tone: string }) {
  const index = useNow(bench), { model } = bench.session.value!, size = useRef<HTMLElement>(null), way = useRef<HTMLElement>(null), rows = model.signals[id].rows;
  const show = (i: number) => {
    const [x, y] = rows.map((each) => model.main.row(each)[i]), long = rowAt(bench, id, i);
    write(size.current!, Number.isFinite(long) ? quantity(long, kind) : "–");
    write(way.current!, long > 1e-9 ? quantity(Math.atan2(y, x), "angle", 1, 4) : "");
  };
  useLive(bench, show);
  useLayoutEffect(() => show(index));
  return <Row label={label}><span class={`value ${tone}`}><span ref={size} /><small ref={way} /></span></Row>;
}

/** Speed, acceleration and joint forces at the position that is shown. */
function Now({ bench, name, fixed }: { bench: Bench; name: string; fixed: boolean }) {
  const session = bench.session.value, key = keyOf(bench, name), { say } = bench;
  void session?.calm.value;
  if (!session || !key) return null;
  const forces = session.data.signals.filter(({ id }) => id.startsWith(`r:${key}|`)), moving = !fixed && `v:${key}` in session.model.signals;
  if (!forces.length && !moving) return null;
  const row = (id: string, kind: string, label: string, tone: string) => <Live key={id} bench={bench} id={id} kind={kind} label={label} tone={tone} />;
  return (
    <Section bench={bench} id="insp.now" title={say("insp.now")}>
      {() => (
        <div class="form tight">
          {moving && row(`v:${key}`, "velocity", say("insp.speed_now"), "velocity")}
          {moving && row(`a:${key}`, "acceleration", say("insp.acceleration_now"), "acceleration")}
          {forces.map(({ id }) => row(id, "force", say("insp.force_on", { link: id.split("|")[1] }), "force"))}
        </div>
      )}
    </Section>
  );
}


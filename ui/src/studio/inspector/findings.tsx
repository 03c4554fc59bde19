// What is to be mended: each finding with its sentence, its element on the sheet, remedies, and its line.
import type { Found } from "../desk";
import type { Bench, Item } from "../bench";
import type { Gap, Remedy } from "../outline";
import { Icon } from "../frame/icons";
import { quantity } from "../../words";
import { perform, tell } from "./change";
import { at, itemAtLine, itemOf, table, word } from "./entries";
import { Act, Section, Sym } from "./fields";
import { goTo } from "./text";

interface Shown {
  severity: string;
  title: string;
  sentence: string;
  line: number;
  items: Item[];
  remedies: Remedy[];
}

/** What the tab shows: why the machine cannot be assembled first; nothing while the sheet is empty. */
export function findingsOf(bench: Bench): Shown[] {
  const { findings, outline, gap, sentence, model } = bench.desk.solved.value;
  if (outline && !Object.keys(table(outline.entries.links)).length && !Object.keys(outline.entries.frame ?? {}).length) return [];
  const shown: Shown[] = gap ? [{ severity: "error", title: gap.title, sentence: gap.sentence, line: 0, items: gapItems(gap), remedies: gap.remedies }] : [];
  if (sentence && !model && !gap && !findings.some(({ severity }) => severity === "error")) shown.push({ severity: "error", title: "", sentence, line: 0, items: [], remedies: [] });
  const order = ["error", "warning"], all = [...shown, ...findings.map((found): Shown => ({ severity: found.severity, sentence: found.sentence, line: found.line, title: "", items: itemsOf(bench, found), remedies: remediesOf(bench, found) }))];
  const rank = ({ severity }: Shown) => (order.includes(severity) ? order.indexOf(severity) : order.length);
  return all.sort((a, b) => rank(a) - rank(b));
}

const gapItems = ({ chains, point }: Gap): Item[] => [...chains.flat().map((name): Item => ({ kind: "link", name })), ...(point ? [{ kind: "point", name: point } as Item] : [])];

function itemsOf(bench: Bench, { key, line }: Found): Item[] {
  const { outline } = bench.desk.solved.value;
  if (!outline) return [];
  const item = itemOf(outline.entries, key) ?? (line ? itemAtLine(outline, line) : null);
  return item ? [item] : [];
}

/** What a click can do about a finding of the text. */
function remediesOf(bench: Bench, { code, key }: Found): Remedy[] {
  const { outline } = bench.desk.solved.value, [, name = ""] = key.split("."), link = table(at(outline?.entries, "links", name)), mass = word(link.mass);
  if (code !== "no-inertia" || !mass || word(link.length) === "") return [];
  return [{ title: bench.say("insp.even_bar"), change: "m·l²/12", note: name, places: {}, actions: [{ do: "mass", link: name, mass } as Remedy["actions"][number]] }];
}

export function Findings({ bench }: { bench: Bench }) {
  const { say } = bench, found = findingsOf(bench), { gap } = bench.desk.solved.value;
  return (
    <>
      <div role="status" class="unseen">{found.length ? say("insp.count_findings", { count: String(found.length) }) : say("fine")}</div>
      {found.length > 0
        ? <ul class="finds">{found.map((each, k) => <Finding key={`${k}${each.sentence}`} bench={bench} found={each} />)}</ul>
        : <p class="fine"><Icon name="check" size={17} />{say("fine")}</p>}
      {gap && gap.lengths.length > 0 && <Section bench={bench} id="insp.loop" title={say("insp.loop")}>{() => <Lengths gap={gap} />}</Section>}
    </>
  );
}

function Finding({ bench, found }: { bench: Bench; found: Shown }) {
  const { say } = bench, { severity, items, line, remedies, sentence } = found, bad = severity === "error";
  const show = () => {
    bench.select(...items);
    bench.reveal(items);
  };
  const name = items.length === 1 ? items[0].name : "";
  return (
    <li class={bad ? "bad" : severity === "warning" ? "warn" : ""}>
      <h2><Icon name={bad || severity === "warning" ? "alert" : "info"} size={17} />{found.title ? <Title text={found.title} point={items.find(({ kind }) => kind === "point")?.name ?? ""} /> : (name ? say("insp.finding_of", { kind: say(bad ? "insp.error" : severity === "warning" ? "insp.warning" : "insp.note"), name }) : say(bad ? "insp.error" : severity === "warning" ? "insp.warning" : "insp.note"))}</h2>
      <p>{sentence}</p>
      {(items.length > 0 || line > 0) && (
        <p class="do">
          {items.length > 0 && <Act act={show}>{say("insp.show")}</Act>}
          {line > 0 && <button type="button" class="text" onClick={() => goTo(bench, line)}>{say("insp.line", { line: String(line) })}</button>}
        </p>
      )}
      {remedies.map((remedy) => (
        <button key={remedy.title} type="button" class="remedy" disabled={!remedy.actions.length} onClick={() => void tell(bench, perform(bench, remedy.actions))}>
          <b>{remedy.title}</b><span>{remedy.change}</span><small>{remedy.note}</small>
        </button>
      ))}
    </li>
  );
}

/** A title with the name of its point as drawings have it. */
function Title({ text, point }: { text: string; point: string }) {
  const [before, ...after] = point ? text.split(` ${point} `) : [text];
  return <span>{before}{after.length > 0 && <> <Sym name={point} /> {after.join(` ${point} `)}</>}</span>;
}

/** The lengths of the loop that comes apart, as bars; dashed what is missing. */
function Lengths({ gap }: { gap: Gap }) {
  const most = Math.max(...gap.lengths.map(({ length, wanted }) => Math.max(length, wanted ?? 0))), share = (x: number) => `${(98 * x) / most}%`;
  return (
    <>
      <table class="loop">
        <tbody>
          {gap.lengths.map(({ name, length, wanted }) => (
            <tr key={name} class={wanted === null ? "" : "bad"}>
              <th scope="row">{name}</th>
              <td><span class="bar" style={{ width: share(Math.min(length, wanted ?? length)) }} />{wanted !== null && wanted > length && <span class="bar want" style={{ width: share(wanted - length) }} />}</td>
              <td>{quantity(length, "length", length, 4)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </>
  );
}

// The text of a machine as nested values: what is found where, by the names of its elements.
import type { Entry, Outline } from "../outline";
import type { Item } from "../bench";

export type Table = { [key: string]: Entry };
export type Path = (string | number)[];

export const isTable = (entry: Entry | undefined): entry is Table => typeof entry === "object" && !Array.isArray(entry);
export const table = (entry: Entry | undefined): Table => (isTable(entry) ? entry : {});
export const list = (entry: Entry | undefined): Entry[] => (Array.isArray(entry) ? entry : []);
export const word = (entry: Entry | undefined): string => (typeof entry === "string" ? entry : "");
export const words = (entry: Entry | undefined): string[] => list(entry).map(word);

export function at(entries: Entry | undefined, ...path: Path): Entry | undefined {
  let found = entries;
  for (const key of path) found = Array.isArray(found) ? found[Number(key)] : isTable(found) ? found[key] : undefined;
  return found;
}

/** The points of a link: those that make it, then the further ones. */
export function pointsOf(link: Entry | undefined): { own: string[]; also: string[] } {
  const { points, also } = table(link);
  return { own: isTable(points) ? Object.keys(points) : words(points), also: Object.keys(table(also)) };
}

export function linksAt(entries: Table, point: string): string[] {
  return Object.entries(table(entries.links)).filter(([, link]) => {
    const { own, also } = pointsOf(link);
    return own.includes(point) || also.includes(point);
  }).map(([name]) => name);
}

export const isFixed = (entries: Table, point: string) => point in table(at(entries, "frame", "points"));

/** Entries of `joints` that concern a link. */
export function pairsOf(entries: Table, link: string): [string, Table][] {
  return Object.entries(table(entries.joints)).map(([name, joint]): [string, Table] => [name, table(joint)]).filter(([, joint]) =>
    [...words(joint.links), ...["guide", "block", "cam", "follower", "pinion", "rack"].map((key) => word(joint[key]))].includes(link),
  );
}

/** The guide in which a link slides. */
export const guideOf = (entries: Table, link: string) => pairsOf(entries, link).find(([, joint]) => word(joint.block) === link && word(joint.kind) === "prismatic");

/** Where a driver stands in the text, and what it says; by its name, the link that it turns or the joint that it moves. */
export function driverOf(entries: Table, name: string): { path: Path; driver: Table } | null {
  const drives = (driver: Table) => [driver.turn, driver.slide].map(word).includes(name);
  if (isTable(entries.driver) && (name === "driver" || drives(entries.driver))) return { path: ["driver"], driver: entries.driver };
  const several = Object.entries(table(entries.drivers)).map(([key, driver]): [string, Table] => [key, table(driver)]);
  const found = several.find(([key, driver]) => key === name || drives(driver));
  return found ? { path: ["drivers", found[0]], driver: found[1] } : isTable(entries.driver) ? { path: ["driver"], driver: entries.driver } : null;
}

/** Loads that act on a link, or whose ends are on it. */
export function loadsOn(entries: Table, link: string): string[] {
  return Object.entries(table(entries.loads)).filter(([, each]) => {
    const load = table(each), ends = [...words(load.between).map((end) => end.split(".")[0]), ...words(load.links)];
    return word(load.on) === link || ends.includes(link) || (load.joint !== undefined && word(at(entries, "joints", word(load.joint), "block")) === link);
  }).map(([name]) => name);
}

/** Where an element's entry stands. */
export function pathOf(entries: Table, item: Item): Path | null {
  switch (item.kind) {
    case "link": return ["links", item.name];
    case "pair": return ["joints", item.name];
    case "load": return ["loads", item.name];
    case "driver": return driverOf(entries, item.name)?.path ?? null;
    case "point": return isFixed(entries, item.name) ? ["frame", "points", item.name] : item.name in table(entries.joints) ? ["joints", item.name] : ["drawing", item.name];
    case "dimension": return addressPath(entries, item.name);
    default: return null;
  }
}

/** Where a dimension stands in the text, by its address ("crank.length", "frame.O1.x", "loads.work.components.y"); null: nowhere. */
export function addressPath(entries: Table, address: string): Path | null {
  const [first, ...rest] = address.split("."), own: [Path, string[]][] = ["links", "joints", "drivers"].map((section) => [[section, first], rest]);
  const points: [Path, string[]][] = [[["links", first, "also"], rest], [["links", first, "points"], rest], [["frame", "points"], rest]];
  const all: [Path, string[]][] = first === "frame" ? [points[2]] : rest.length ? [[[], [first, ...rest]], ...own, ...points.slice(0, 2)] : [[["parameters"], [first]]];
  for (const [base, keys] of all) {
    const path = follow(entries, base, keys);
    if (path) return path;
  }
  return null;
}

/** The path of keys below a base, where it leads to a value; x and y are the places of a list. */
function follow(entries: Table, base: Path, keys: string[]): Path | null {
  const path = [...base];
  for (const key of keys) path.push(Array.isArray(at(entries, ...path)) ? ({ x: 0, y: 1 }[key] ?? Number(key)) : key);
  return typeof at(entries, ...path) === "string" ? path : null;
}

/** The element that a line of the text belongs to, and that of an address in it ("links.crank.length"). */
export function itemOf(entries: Table, path: string): Item | null {
  const [section, first = "", second = ""] = path.split(".");
  if (section === "links" && first) return { kind: "link", name: first };
  if (section === "joints" && first) return word(at(entries, "joints", first, "kind")) === "revolute" ? { kind: "point", name: first } : { kind: "pair", name: first };
  if (section === "loads" && first) return { kind: "load", name: first };
  if (section === "frame" && second) return { kind: "point", name: second };
  if ((section === "drawing" || section === "assembly") && first) return { kind: "point", name: first };
  if (section === "driver") return { kind: "driver", name: "driver" };
  if (section === "drivers" && first) return { kind: "driver", name: first };
  return null;
}

export function itemAtLine({ entries, lines }: Outline, line: number): Item | null {
  const found = Object.entries(lines).filter(([, each]) => each <= line).sort(([a, x], [b, y]) => y - x || b.length - a.length);
  return found.length ? itemOf(entries, found[0][0]) : null;
}

/** What stands in the file for a path: its own lines where it begins one, else as it would be written on one. */
export function written(text: string, { entries, lines }: Outline, path: Path): string {
  const line = lines[path.join(".")], entry = at(entries, ...path), name = String(path[path.length - 1]);
  if (entry === undefined) return "";
  const all = text.split("\n"), begin = line ? all[line - 1] : "";
  if (!begin?.trim().startsWith(`${name}:`)) return `${name}: ${flow(entry)}`;
  const indent = begin.search(/\S/), end = all.findIndex((each, k) => k >= line && each.trim() !== "" && each.search(/\S/) <= indent);
  return all.slice(line - 1, end < 0 ? undefined : end).map((each) => each.slice(indent)).join("\n").trimEnd();
}

/** The lines of an entry, from 1; null where it has none of its own. */
export function linesOf(text: string, outline: Outline, path: Path): [number, number] | null {
  const first = outline.lines[path.join(".")];
  return first ? [first, first + written(text, outline, path).split("\n").length - 1] : null;
}

function flow(entry: Entry): string {
  if (typeof entry === "string") return entry;
  if (Array.isArray(entry)) return `[${entry.map(flow).join(", ")}]`;
  return `{${Object.entries(entry).map(([key, value]) => `${key}: ${flow(value)}`).join(", ")}}`;
}

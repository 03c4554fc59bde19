// Demands of a task as they are typed, and as the file takes them.

export interface Demand {
  key: string;
  form: string;
  needed: boolean;
  usual: boolean | string | null;
  words: [word: string, label: string][];
}

export interface Task {
  name: string;
  demands: Demand[];
}

/** What is typed: texts, flags, rows of numbers (mm and degrees; null where one is open). */
export type Typed = string | boolean | (number | null)[][];
export type Given = Record<string, Typed>;

/** Numbers in a row of a form, by what they are. */
export const ROWS: Record<string, ("x" | "y" | "angle")[]> = { points: ["x", "y"], point: ["x", "y"], window: ["x", "y"], poses: ["x", "y", "angle"] };
/** The most rows of a form. */
export const MOST: Record<string, number> = { point: 1, window: 2 };
/** Units of bare numbers. */
export const UNITS: Record<string, string> = { length: "mm", lengths: "mm", angle: "deg", angles: "deg" };
export const SHOWN: Record<string, string> = { mm: "mm", deg: "°" };

const BARE = /^[-+−]?[\d.,]+(e[-+]?\d+)?$/i;
const plain = (text: string) => text.trim().replace("−", "-").replace(/^([-+]?\d*),(\d+)/, "$1.$2").replace(/°$/, " deg");

/** A typed text as the file has it: with its unit. */
function quantity(text: string, form: string): string {
  const unit = UNITS[form], read = plain(text);
  return unit && BARE.test(read) ? `${read} ${unit}` : read;
}

/** Whether something stands in a field. */
export function filled(typed: Typed | undefined): boolean {
  if (Array.isArray(typed)) return typed.some(complete);
  return typeof typed === "string" ? typed.trim() !== "" : typed !== undefined;
}

const complete = (row: (number | null)[]) => row.length > 1 && row[0] !== null && row[1] !== null;

/** The demands of a task as its section of a file has them; what is not given, and flags as they are by themselves, stay out. */
export function written(task: Task, given: Given): Record<string, unknown> {
  const found: Record<string, unknown> = {};
  for (const demand of task.demands) {
    const typed = given[demand.key], { key, form, usual } = demand;
    if (!filled(typed)) continue;
    if (typeof typed === "boolean") {
      if (typed !== (usual ?? false)) found[key] = typed;
    } else if (Array.isArray(typed)) {
      // A pose whose angle is open is a place alone.
      const rows = typed.filter(complete).map((row) => row.filter((each) => each !== null));
      found[key] = form === "point" ? rows[0] : rows;
    } else if (form === "angles" || form === "lengths") found[key] = typed.split(/[;,\s]+/).filter(Boolean).map((each) => quantity(each, form));
    else if (form === "word") {
      if (typed !== usual) found[key] = typed;
    } else found[key] = quantity(typed, form);
  }
  return found;
}

/** Rows of numbers in a text, as a spreadsheet gives them. */
export function pasted(text: string, columns: number): (number | null)[][] {
  const rows = text.split(/[\r\n]+/).map((row) => row.split(/[\t;]|,\s+|\s+|,(?=-?\d)/).filter(Boolean).map((each) => Number(plain(each))));
  return rows.filter((row) => row.length > 1 && row.every(Number.isFinite)).map((row) => Array.from({ length: columns }, (_, k) => row[k] ?? null));
}


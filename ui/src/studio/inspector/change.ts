// Changes of the text by the inspector: each is one step that can be undone, or is refused with the server's sentence.
import type { Action } from "../picture";
import type { Bench } from "../bench";
import type { Entry } from "../outline";
import type { Path } from "./entries";

/** Carries out actions as one step; the sentence of the refusal, null where they were admitted. */
export async function perform(bench: Bench, actions: Action[]): Promise<string | null> {
  const { desk } = bench, { note } = bench.page;
  note.value = "";
  if (await desk.act(actions)) return null;
  const sentence = note.value || bench.say("gone");
  // It is said at the field, and need not be said again below.
  note.value = "";
  return sentence;
}

export const set = (bench: Bench, path: Path, value: Entry) => perform(bench, [{ do: "set", path, value }]);
export const unset = (bench: Bench, path: Path) => perform(bench, [{ do: "unset", path }]);

/** Sets a value, or takes it out of the text where it is empty. */
export const put = (bench: Bench, path: Path, value: string) => (value.trim() ? set(bench, path, value) : unset(bench, path));

/** Carries out actions and selects the links that they have made, with others. */
export async function make(bench: Bench, actions: Action[], others: string[] = []): Promise<void> {
  const made = await bench.desk.act(actions), { links = {} } = bench.desk.solved.value.picture ?? {};
  if (made) bench.select(...[...others, ...made].filter((name) => name in links).map((name) => ({ kind: "link" as const, name })));
}

/** Does what was asked; why it was refused is said at the foot. */
export async function tell(bench: Bench, work: Promise<string | null>): Promise<boolean> {
  const sentence = await work;
  if (sentence) bench.page.note.value = sentence;
  return !sentence;
}

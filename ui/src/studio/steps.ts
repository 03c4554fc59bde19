// Steps back and forth of files, kept in the window's own store so that they outlive a page that is loaded again.

/** A change of a text: what stays at its two ends, and what stands between. */
type Change = [head: number, tail: number, between: string];

export interface Steps {
  past: string[];
  now: string;
  future: string[];
}

interface Packed {
  now: string;
  /** From the present text to each one before it, and to each one behind it. */
  back: Change[];
  ahead: Change[];
}

/** Characters of all steps of a file, their number; files of which steps are kept. */
const MOST = 1_500_000, COUNT = 400, FILES = 12;
const STORE = "linkwright.steps";

function change(from: string, to: string): Change {
  const most = Math.min(from.length, to.length);
  let head = 0, tail = 0;
  while (head < most && from[head] === to[head]) head++;
  while (tail < most - head && from[from.length - 1 - tail] === to[to.length - 1 - tail]) tail++;
  return [head, tail, to.slice(head, to.length - tail)];
}

const changed = (text: string, [head, tail, between]: Change) => text.slice(0, head) + between + text.slice(text.length - tail);

/** The steps as changes, from the present text on, as many as have room. */
export function pack({ past, now, future }: Steps, most = MOST): Packed {
  let room = most - now.length;
  const chain = (states: string[]) => {
    const found: Change[] = [];
    let from = now;
    for (const to of states.slice(-COUNT).reverse()) {
      const next = change(from, to);
      room -= next[2].length + 24;
      if (room < 0) break;
      found.push(next);
      from = to;
    }
    return found;
  };
  return { now, back: chain(past), ahead: chain(future) };
}

export function unpack({ now, back, ahead }: Packed): Steps {
  const chain = (changes: Change[]) => {
    const found: string[] = [];
    for (const each of changes) found.push(changed(found.at(-1) ?? now, each));
    return found.reverse();
  };
  return { past: chain(back), now, future: chain(ahead) };
}

/** Stores the steps of a file; of files that were not touched for long they are given up. */
export function keepSteps(name: string, steps: Steps, store: Storage = sessionStorage): void {
  if (!name) return;
  const names = [name, ...known(store).filter((each) => each !== name)];
  for (const old of names.splice(FILES)) store.removeItem(`${STORE}:${old}`);
  const text = JSON.stringify(pack(steps));
  while (names.length) {
    try {
      store.setItem(`${STORE}:${name}`, text);
      return store.setItem(STORE, JSON.stringify(names));
    } catch {
      store.removeItem(`${STORE}:${names.pop()!}`); // no room: the oldest one goes
    }
  }
}

/** The steps of a file whose text is still the one they belong to. */
export function recallSteps(name: string, text: string, store: Storage = sessionStorage): Steps | null {
  try {
    const found = unpack(JSON.parse(store.getItem(`${STORE}:${name}`) ?? "null") as Packed);
    return found.now === text ? found : null;
  } catch {
    return null;
  }
}

function known(store: Storage): string[] {
  try {
    const found: unknown = JSON.parse(store.getItem(STORE) ?? "[]");
    return Array.isArray(found) ? found.filter((each) => typeof each === "string") : [];
  } catch {
    return [];
  }
}

// Steps of texts that outlive a page: packed as changes, unpacked as they were, within their room.
import assert from "node:assert/strict";
import { test } from "node:test";
import { keepSteps, pack, recallSteps, unpack } from "../src/studio/steps";

class Store implements Storage {
  readonly all = new Map<string, string>();
  constructor(private readonly room = Infinity) {}
  get length() { return this.all.size; }
  clear() { this.all.clear(); }
  key(k: number) { return [...this.all.keys()][k] ?? null; }
  getItem(key: string) { return this.all.get(key) ?? null; }
  removeItem(key: string) { this.all.delete(key); }
  setItem(key: string, value: string) {
    const rest = [...this.all].reduce((sum, [name, text]) => sum + (name === key ? 0 : text.length), 0);
    if (rest + value.length > this.room) throw new DOMException("full", "QuotaExceededError");
    this.all.set(key, value);
  }
}

const texts = ["", "a", "ab", "b", "bb", "format: 1\n", "format: 1\nname: x\n", "format: 1\nname: xy\n", "aaaa", "aa", "aaa"];

test("steps are unpacked as they were packed", () => {
  for (const now of texts) {
    const steps = { past: texts, now, future: [...texts].reverse() };
    assert.deepEqual(unpack(pack(steps)), steps);
  }
});

test("the newest steps stay where not all have room", () => {
  const past = Array.from({ length: 50 }, (_, k) => String.fromCharCode(65 + (k % 26)).repeat(100 + k));
  const found = unpack(pack({ past, now: "", future: [] }, 1000));
  assert.ok(found.past.length > 3 && found.past.length < 12);
  assert.deepEqual(found.past, past.slice(-found.past.length));
});

test("steps come back for the same text of the same file only", () => {
  const store = new Store(), steps = { past: ["a", "b"], now: "c", future: ["d"] };
  keepSteps("x.yaml", steps, store);
  assert.deepEqual(recallSteps("x.yaml", "c", store), steps);
  assert.equal(recallSteps("x.yaml", "other", store), null);
  assert.equal(recallSteps("y.yaml", "c", store), null);
  store.setItem("linkwright.steps:x.yaml", "{broken");
  assert.equal(recallSteps("x.yaml", "c", store), null);
});

test("without room the oldest files give up theirs", () => {
  const store = new Store(2000), text = (letter: string) => letter.repeat(700);
  for (const name of ["a", "b", "c"]) keepSteps(name, { past: [], now: text(name), future: [] }, store);
  assert.equal(recallSteps("a", text("a"), store), null);
  assert.notEqual(recallSteps("c", text("c"), store), null);
  keepSteps("d", { past: [], now: "d".repeat(5000), future: [] }, store);
  assert.equal(recallSteps("d", "d".repeat(5000), store), null);
});

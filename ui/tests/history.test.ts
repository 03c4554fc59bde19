import assert from "node:assert/strict";
import test from "node:test";
import { History } from "../src/history";

/** A number with its history. */
function counter() {
  const kept = { state: 0 }, history = new History<number>(() => kept.state, (state) => (kept.state = state));
  const change = (state: number) => {
    history.mark();
    kept.state = state;
  };
  return { kept, history, change };
}

test("steps back and forth go through the same states", () => {
  const { kept, history, change } = counter();
  [3, 1, 4].forEach(change);
  const back = [0, 1, 2].map(() => (history.undo(), kept.state));
  assert.deepEqual(back, [1, 3, 0]);
  assert.equal(history.undoable, false);
  const forth = [0, 1, 2].map(() => (history.redo(), kept.state));
  assert.deepEqual(forth, [3, 1, 4]);
  assert.equal(history.redoable, false);
});

test("a step where there is none changes nothing", () => {
  const { kept, history, change } = counter();
  history.undo();
  history.redo();
  assert.equal(kept.state, 0);
  change(7);
  history.redo();
  assert.equal(kept.state, 7);
});

test("a change after steps back forgets what was ahead", () => {
  const { kept, history, change } = counter();
  [1, 2].forEach(change);
  history.undo();
  change(9);
  assert.equal(history.redoable, false);
  history.undo();
  assert.equal(kept.state, 1);
});

test("a change that was none leaves no step, and what was before it is known", () => {
  const { kept, history, change } = counter();
  change(5);
  assert.equal(history.before, 0);
  history.mark();
  assert.equal(history.before, 5);
  history.unmark();
  history.undo();
  assert.equal(kept.state, 0);
  assert.equal(history.undoable, false);
  history.redo();
  history.clear();
  assert.deepEqual([history.undoable, history.redoable, kept.state], [false, false, 5]);
});

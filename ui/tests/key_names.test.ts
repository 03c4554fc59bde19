// Keys are called as they are on the keyboard at hand.
import assert from "node:assert/strict";
import { test } from "node:test";
import { keyNames } from "../src/studio/frame/key_names";

test("keys have the signs of the keyboard", () => {
  assert.equal(keyNames("Ctrl Shift S", true), "⌘ ⇧ S");
  assert.equal(keyNames("Ctrl Shift S", false), "Ctrl Shift S");
  assert.equal(keyNames("V", true), "V");
});

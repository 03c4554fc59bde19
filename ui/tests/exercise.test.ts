// What an exercise asks of the server, and the names of results that it can ask for.
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Session } from "../src/session";
import { asked, results } from "../src/studio/frame/exercise";

const signal = (id: string) => ({ id, name: { en: `words of ${id}`, zh: "" } }) as unknown as Session["data"]["signals"][number];

test("results are named as the file has them", () => {
  const found = results(["angle:rocker", "w:rocker", "g:rocker", "sv:guide", "effort:driver", "r:O5|jaw", "v:A", "m:rod+slider", "shake"].map(signal), "en");
  assert.deepEqual(found.map(([name]) => name), ["rocker.angle", "rocker.angular_velocity", "rocker.angular_acceleration", "guide.velocity", "driver.effort", "O5 on jaw.magnitude"]);
  assert.equal(found[0][1], "words of angle:rocker");
});

test("only what is chosen is asked", () => {
  const usual = { count: "10", seed: "1", share: "8", at: " ", vary: [], ask: [] };
  assert.deepEqual(asked(usual), { count: 10, seed: 1 });
  assert.deepEqual(asked({ ...usual, share: "2,5", at: "60 deg", vary: ["a.length"], ask: ["b.angle"] }), { count: 10, seed: 1, at: "60 deg", vary: { "a.length": "2.5 %" }, ask: ["b.angle"] });
});

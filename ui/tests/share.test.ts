// Models in links: back as they were, refused where they are none, and small enough to be taken.
import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateRawSync } from "node:zlib";
import { holdsModel, modelOf, shareLink } from "../src/share";

const TEXT = "format: 1\nname: {en: Press, zh: 压力机}\nlinks:\n  crank: {points: [O1, A], length: 60 mm}\n";
const link = (content: string | Uint8Array) => `https://any.example/page?x=1#model=${deflateRawSync(content).toString("base64url")}`;

test("a link gives the text that it was made of", async () => {
  const made = await shareLink(TEXT);
  assert.match(made, /^http:\/\/127\.0\.0\.1\/#model=[\w-]+$/);
  assert.equal(await modelOf(made), TEXT);
  assert.equal(await modelOf(await shareLink(TEXT, "http://127.0.0.1:4711/")), TEXT);
});

test("it is the deflated text in base 64 of addresses, by other hands too", async () => {
  assert.equal(await modelOf(link(TEXT)), TEXT);
  assert.equal(await modelOf(`see ${link(TEXT)}`), TEXT);
  assert.ok(holdsModel(link(TEXT)) && !holdsModel("https://any.example/#0.crank.length=0.1"));
});

test("what is no model is none", async () => {
  for (const each of ["", "#model=", "#model=AAAA", "#model=%%%", link(""), link(" \n"), link(new Uint8Array([255, 254, 253])), link("x".repeat(1_000_001)), link(TEXT).slice(0, -6)])
    assert.equal(await modelOf(each), null, each.slice(0, 60));
});

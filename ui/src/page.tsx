// The living page by itself.
import { render } from "preact";
import { App, keys } from "./app";
import type { PageData } from "./data";
import { Page } from "./living";
import { code } from "./solver";
import { Session } from "./session";

async function open(): Promise<void> {
  const data = (globalThis as unknown as { packed: PageData }).packed;
  const sessions = await Promise.all(data.models.map(async (each, k) => new Session(each, await code(each), k)));
  const page = new Page(data, sessions);
  const host = document.getElementById("page")!;
  host.textContent = "";
  render(<App page={page} />, host);
  page.follow(location.hash);
  window.addEventListener("hashchange", () => page.follow(location.hash));
  keys(page);
  Object.assign(globalThis, { linkwright: page });
}

void open();

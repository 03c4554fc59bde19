// The first script of a page: unpacks the others, the style and the models.
import type { PageData } from "./data";

export interface Packed {
  style: string;
  scripts: string[];
  data: PageData;
}

async function unpack(): Promise<void> {
  const text = document.getElementById("packed")!.textContent!;
  const stream = new Blob([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))]).stream();
  const whole = await new Response(stream.pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
  const length = new DataView(whole).getUint32(0, true);
  const found = JSON.parse(new TextDecoder().decode(new Uint8Array(whole, 4, length))) as Packed;
  let place = 4 + length;
  for (const model of found.data.models) {
    if (typeof model.module !== "number") continue;
    const size = model.module;
    model.module = new Uint8Array(whole, place, size);
    place += size;
  }
  Object.assign(globalThis, { packed: found.data });
  const add = (tag: string, text: string) => {
    const made = document.createElement(tag);
    made.textContent = text;
    document.head.append(made);
  };
  add("style", found.style);
  for (const script of found.scripts) add("script", script);
}

void unpack();

// The first script of a page: unpacks the others, the style and the models.
import type { PageData } from "./data";

export interface Packed {
  style: string;
  script: string;
  data: PageData;
}

/** The digits of base 85 are the signs from this one on, with ! for the one that opens tags. */
const ZERO = 40;

/** Bytes of a text in base 85; what lacks at its end are largest digits. */
function bytes(text: string): Uint8Array<ArrayBuffer> {
  const whole = text.replaceAll("!", "<") + "||||", found = new DataView(new ArrayBuffer(4 * Math.ceil(text.length / 5)));
  for (let k = 0; k < text.length; k += 5) {
    let sum = 0;
    for (let j = 0; j < 5; j++) sum = 85 * sum + whole.charCodeAt(k + j) - ZERO;
    found.setUint32((4 * k) / 5, sum);
  }
  return new Uint8Array(found.buffer, 0, Math.floor((4 * text.length) / 5));
}

async function unpack(): Promise<void> {
  const text = document.getElementById("packed")!.textContent;
  const stream = new Blob([bytes(text)]).stream();
  const whole = await new Response(stream.pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
  const length = new DataView(whole).getUint32(0, true);
  const found = JSON.parse(new TextDecoder().decode(new Uint8Array(whole, 4, length))) as Packed;
  let place = 4 + length;
  for (const model of found.data.models) {
    const size = model.module as number;
    model.module = new Uint8Array(whole, place, size);
    place += size;
  }
  Object.assign(globalThis, { packed: found.data });
  const add = (tag: string, content: string) => {
    const made = document.createElement(tag);
    made.textContent = content;
    document.head.append(made);
  };
  add("style", found.style);
  add("script", found.script);
}

void unpack();

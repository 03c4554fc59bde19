// A model in the fragment of a link: its text, deflated, in the alphabet that addresses may have. No server sees a fragment.

/** Where a link leads that was made without a studio; only what stands behind its sign counts. */
const NOWHERE = "http://127.0.0.1/";
/** Characters of a text that a studio takes; a link that unpacks to more is none. */
const LARGEST = 1_000_000;
/** Characters from which on some programs cut links: it is said how long one is. */
export const LONG = 2000;
const MODEL = /(?:^|[#&\s])model=([\w-]+)/;

export async function shareLink(text: string, base = NOWHERE): Promise<string> {
  const packed = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(packed).arrayBuffer());
  let signs = "";
  for (const each of bytes) signs += String.fromCharCode(each);
  return `${base}#model=${btoa(signs).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
}

/** Whether a text is, or has in it, a link with a model. */
export const holdsModel = (text: string) => MODEL.test(text);

/** The text of the model in a link; null where there is none that can be read. */
export async function modelOf(link: string): Promise<string | null> {
  const [, packed] = MODEL.exec(link) ?? [];
  if (!packed) return null;
  try {
    const bytes = Uint8Array.from(atob(packed.replaceAll("-", "+").replaceAll("_", "/")), (each) => each.charCodeAt(0));
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
    const parts: Uint8Array<ArrayBuffer>[] = [];
    for (let size = 0; ; ) {
      const { done, value } = await reader.read();
      if (done) break;
      size += value.length;
      if (size > LARGEST) {
        await reader.cancel();
        return null;
      }
      parts.push(value);
    }
    const text = new TextDecoder("utf-8", { fatal: true }).decode(await new Blob(parts).arrayBuffer());
    return text.trim() ? text : null;
  } catch {
    return null;
  }
}

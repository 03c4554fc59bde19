// Models that come and go in links: copied, taken from the address of the page, dropped on the sheet.
import { holdsModel, LONG, modelOf, shareLink } from "../../share";
import type { Bench } from "../bench";

/** Copies a link with the model in it. */
export async function share(bench: Bench): Promise<void> {
  const link = await shareLink(bench.desk.text.value, `${location.origin}/`);
  bench.shared.value = { link, shown: link, copied: (await copy(link)) ? "link" : "" };
}

/** Copies the command that opens the model of a link in a studio; shows it where it cannot be copied. */
export async function shareCommand(bench: Bench, link: string): Promise<void> {
  // These quotes are taken by every shell.
  const command = `linkwright studio "${link.slice(link.indexOf("#"))}"`;
  bench.shared.value = { link, shown: command, copied: (await copy(command)) ? "command" : "" };
}

async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

export const long = (link: string) => link.length > LONG;

/** Opens the model in a link as a new drawing; says where there is none. */
export async function openLink(bench: Bench, link: string): Promise<boolean> {
  const text = await modelOf(link);
  if (text === null) bench.page.note.value = bench.say("link.none");
  else await bench.desk.begin(text);
  return text !== null;
}

/** The model in the address of the page, which it leaves at once. */
export function linkInAddress(): string | null {
  const { hash } = location;
  if (!holdsModel(hash)) return null;
  history.replaceState(null, "", location.pathname + location.search);
  return hash;
}

/** Model files and links that are dropped on the page, or follow in its address, are opened. */
export function takeDropped(bench: Bench): () => void {
  const fileOf = (data: DataTransfer | null) => [...(data?.files ?? [])].find(({ name }) => /\.(ya?ml|json)$/i.test(name));
  const over = (event: DragEvent) => {
    const { types } = event.dataTransfer!;
    if (types.includes("Files") || types.includes("text/uri-list") || types.includes("text/plain")) event.preventDefault();
  };
  const drop = async (event: DragEvent) => {
    if (event.defaultPrevented) return;
    const file = fileOf(event.dataTransfer), link = event.dataTransfer?.getData("text/plain") ?? "";
    if (event.dataTransfer?.types.includes("Files")) event.preventDefault(); // the browser would leave the page for the file
    if (!file && !holdsModel(link)) return;
    event.preventDefault();
    if (file) await bench.desk.begin(await file.text());
    else await openLink(bench, link);
  };
  const dropped = (event: DragEvent) => void drop(event);
  const follow = () => {
    const link = linkInAddress();
    if (link) void openLink(bench, link);
  };
  document.addEventListener("dragover", over);
  document.addEventListener("drop", dropped);
  window.addEventListener("hashchange", follow);
  return () => {
    document.removeEventListener("dragover", over);
    document.removeEventListener("drop", dropped);
    window.removeEventListener("hashchange", follow);
  };
}

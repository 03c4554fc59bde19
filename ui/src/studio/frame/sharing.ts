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

/** A share link of PMKS+, whose text is decoded. */
export const isForeign = (link: string) => /pmks[\w.]*\.com\S*\?\S/i.test(link);

/** Opens the model in a link as a new drawing; says where there is none. */
export async function openLink(bench: Bench, link: string): Promise<boolean> {
  if (isForeign(link)) return bench.desk.bring("link", link.trim()).then(() => true);
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

/** Model files, files of other programs and links that are dropped on the page, or follow in its address, are opened. */
export function takeDropped(bench: Bench): () => void {
  const fileOf = (data: DataTransfer | null) => [...(data?.files ?? [])].find(({ name }) => /\.(ya?ml|json|linkage2|pmks|txt|xml|mjcf|urdf|dxf)$/i.test(name));
  const over = (event: DragEvent) => {
    const { types } = event.dataTransfer!;
    if (types.includes("Files") || types.includes("text/uri-list") || types.includes("text/plain")) event.preventDefault();
  };
  const drop = async (event: DragEvent) => {
    if (event.defaultPrevented) return;
    const file = fileOf(event.dataTransfer), link = event.dataTransfer?.getData("text/plain") ?? "";
    if (event.dataTransfer?.types.includes("Files")) event.preventDefault(); // the browser would leave the page for the file
    if (!file && !holdsModel(link) && !isForeign(link)) return;
    event.preventDefault();
    if (!file) return void openLink(bench, link);
    const text = await file.text();
    const own = /\.ya?ml$/i.test(file.name) || (/\.json$/i.test(file.name) && /"format"\s*:/.test(text));
    await (own ? bench.desk.begin(text) : bench.desk.bring(file.name, text));
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

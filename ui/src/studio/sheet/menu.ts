// The menu of what is under the pointer: what can be done to it at once.
import type { Vec } from "../../shapes";
import type { Item } from "../bench";
import { type Choices, showMenu } from "../frame/menu";
import { dist, nearestOn } from "./geometry";
import { spoken } from "./names";
import { copy, cut, duplicate, erase, everything, hasCopy, mirror, paste } from "./selection";
import type { Board } from "./sheet";
import { pairs } from "../tools/weld";

/** Shows the menu at a place of the window, for what is selected there. */
export function showElementMenu(board: Board, event: MouseEvent, screen: Vec): void {
  const { bench } = board, spot = board.spotAt(screen, event, false), chosen = spot.under.find((each) => bench.has(each)) ?? spot.under[0];
  if (chosen && !bench.has(chosen)) bench.select(chosen);
  const label = chosen ? spoken(bench, board.scene, chosen) : bench.say("sheet.label");
  showMenu(label, { x: event.clientX, y: event.clientY }, chosen ? ofElement(board, chosen, spot.free) : ofSheet(board));
}

function ofElement(board: Board, item: Item, at: Vec): Choices {
  const { bench } = board, { say } = bench, own = special(board, item, at), copied = ["point", "link", "pair", "load"].includes(item.kind);
  return [
    ...own, ...(own.length ? [null] : []),
    ...(copied ? [
      { label: say("sheet.menu_duplicate"), icon: "copy" as const, keys: "Ctrl D", act: () => void duplicate(board) },
      { label: say("sheet.menu_mirror"), icon: "mirror" as const, keys: "Shift M", act: () => void mirror(board) },
      { label: say("sheet.menu_copy"), keys: "Ctrl C", act: () => void copy(board) },
      { label: say("sheet.menu_cut"), keys: "Ctrl X", act: () => void cut(board) },
      null,
    ] : []),
    { label: say("sheet.menu_delete"), icon: "trash" as const, keys: "Del", act: () => void erase(board) },
  ];
}

/** What can be done to elements of its kind alone. */
function special(board: Board, { kind, name }: Item, at: Vec): Choices {
  const { bench, scene } = board, { say } = bench, act = (action: { do: string } & Record<string, unknown>) => () => void board.act([action]);
  if (kind === "point") {
    const { fixed = false, links = [] } = scene.points.get(name) ?? {}, welded = pairs(bench, "weld").some((each) => each.at === name);
    return [
      { label: say(fixed ? "sheet.menu_free" : "sheet.menu_fix"), icon: "pivot" as const, act: act({ do: "fix", point: name, fixed: !fixed }) },
      ...(links.length + Number(fixed) > 1 ? [{ label: say(welded ? "sheet.menu_pin" : "sheet.menu_weld"), icon: "weld" as const, act: act({ do: "weld", point: name, on: !welded }) }] : []),
    ];
  }
  const corners = scene.corners(name), pivot = (scene.links[name] ?? []).find((point) => scene.points.get(point)?.fixed);
  if (kind !== "link" || corners.length < 2) return [];
  const place = corners.map((a, k) => nearestOn(at, a, corners[(k + 1) % corners.length]).at).sort((a, b) => dist(a, at) - dist(b, at))[0];
  return [
    ...(pivot && scene.driver !== name ? [{ label: say("sheet.menu_drive"), icon: "drive" as const, act: act({ do: "driver", link: name, about: pivot }) }] : []),
    { label: say("sheet.menu_split"), icon: "split" as const, act: act({ do: "split", link: name, at: place }) },
    { label: say("sheet.menu_point"), act: act({ do: "add_point", link: name, at: place }) },
  ];
}

function ofSheet(board: Board): Choices {
  const { say } = board.bench;
  return [
    { label: say("sheet.menu_paste"), keys: "Ctrl V", act: () => void paste(board), not: hasCopy() ? undefined : say("sheet.menu_nothing_copied") },
    { label: say("sheet.menu_all"), keys: "Ctrl A", act: () => void everything(board) },
    { label: say("sheet.menu_fit"), icon: "fit" as const, keys: "Shift 1", act: () => board.fit() },
  ];
}

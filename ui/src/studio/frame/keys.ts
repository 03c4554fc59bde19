// Keys of the whole room: tools, steps back and forth. Those of the sheet are the sheet's own.
import { type Bench, SPRINGS, type ToolName } from "../bench";
import { KEYS } from "../tools/tool";

const TOOLS = new Map(Object.entries(KEYS).map(([tool, key]) => [key.toLowerCase(), tool as ToolName]));

/** Whether keys are letters there. */
export function writes(at: EventTarget | null): boolean {
  if (!(at instanceof HTMLElement)) return false;
  return at.isContentEditable || at instanceof HTMLTextAreaElement || at instanceof HTMLSelectElement || (at instanceof HTMLInputElement && !["range", "checkbox", "radio", "button", "file"].includes(at.type));
}

/** Commands by their keys, in the order of their signs: "Ctrl+Shift+S". */
export type Commands = Record<string, () => void>;

function pressed(event: KeyboardEvent): string {
  const ctrl = event.ctrlKey || event.metaKey;
  const key = event.code.startsWith("Key") && (ctrl || event.altKey) ? event.code.slice(3) : event.key.length === 1 ? event.key.toUpperCase() : event.key;
  return [ctrl && "Ctrl", event.altKey && "Alt", event.shiftKey && (ctrl || key.length > 1 || /[A-Z]/.test(key)) && "Shift", key].filter(Boolean).join("+");
}

export function listen(bench: Bench, commands: Commands): () => void {
  const { desk } = bench;
  const steps: Commands = { "Ctrl+Z": () => desk.history.undo(), "Ctrl+Shift+Z": () => desk.history.redo(), "Ctrl+Y": () => desk.history.redo() };
  const hear = (event: KeyboardEvent) => {
    if (event.defaultPrevented || event.isComposing || bench.dialog.value) return;
    const keys = pressed(event), editing = writes(event.target), command = commands[keys] ?? (editing ? undefined : steps[keys]);
    if (command && !(editing && !keys.startsWith("Ctrl"))) {
      event.preventDefault();
      command();
    } else if (!editing && keys === "Shift+K") {
      bench.spring.value = SPRINGS[(SPRINGS.indexOf(bench.spring.value) + (bench.tool.value === "spring" ? 1 : 0)) % SPRINGS.length];
      bench.tool.value = "spring";
    } else if (!editing && keys.length === 1 && TOOLS.has(keys.toLowerCase())) bench.tool.value = TOOLS.get(keys.toLowerCase())!;
  };
  document.addEventListener("keydown", hear);
  return () => document.removeEventListener("keydown", hear);
}

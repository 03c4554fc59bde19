// Keys as they are called on the keyboard in front of the person.

const APPLE = typeof navigator !== "undefined" && /^(Mac|iP)/.test(navigator.platform);
const SIGNS: Record<string, string> = { Ctrl: "⌘", Alt: "⌥", Shift: "⇧", Delete: "⌫", Enter: "↵" };

export const keyNames = (keys: string, apple = APPLE) => (apple ? keys.replace(/\b(Ctrl|Alt|Shift|Delete|Enter)\b/g, (name) => SIGNS[name]) : keys);

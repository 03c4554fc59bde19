// The values in hand: a small panel at the cursor whose numbers can be typed; at the foot of the sheet on a phone.
import type { Board } from "./sheet";
import type { Field } from "../tools/tool";
import { shown, typed } from "../tools/typed";
import type { Vec } from "../../shapes";
import { element } from "../../strokes";
import { strokes } from "../frame/signs";

// How far the panel stays from the point in hand and from the edges of the sheet, px.
const AWAY = 28, EDGE = 8;

interface Input {
  box: HTMLLabelElement;
  label: HTMLSpanElement;
  field: HTMLInputElement;
  unit: HTMLSpanElement;
}

export class Hand {
  private readonly panel: HTMLFormElement;
  private readonly title: HTMLSpanElement;
  private readonly row: HTMLDivElement;
  private readonly error: HTMLParagraphElement;
  private readonly keys: HTMLParagraphElement;
  private readonly set: HTMLButtonElement;
  private inputs: Input[] = [];
  private known = "";
  /** Whether quiet fields are shown, too: something is typed. */
  private called = false;

  constructor(private readonly board: Board, stage: HTMLElement) {
    const make = <K extends keyof HTMLElementTagNameMap>(tag: K, style: string, parent?: HTMLElement) => {
      const made = Object.assign(document.createElement(tag), { className: style });
      parent?.append(made);
      return made;
    };
    this.panel = make("form", "hand-panel", stage);
    const head = make("p", "hand-snap", this.panel), magnet = element("svg", { class: "icon", viewBox: "0 0 20 20", width: 16, height: 16, "aria-hidden": "true" }, head);
    for (const [style, d] of strokes("magnet")) element("path", { class: `i-${style}`, d }, magnet);
    this.title = make("span", "", head);
    this.row = make("div", "hand-row", this.panel);
    this.set = make("button", "hand-set", this.row);
    this.set.type = "submit";
    this.error = make("p", "hand-error", this.panel);
    this.error.setAttribute("role", "alert");
    this.keys = make("p", "hand-keys", this.panel);
    this.panel.hidden = true;
    this.panel.addEventListener("submit", (event) => {
      event.preventDefault();
      this.enter();
    });
    this.panel.addEventListener("keydown", (event) => this.key(event));
  }

  end(): void {
    this.panel.remove();
  }

  get fields(): Field[] {
    return (this.board.tool.fields?.() ?? []).filter(({ quiet, text }) => !quiet || text !== null || this.called);
  }

  /** Takes the first of what is typed, in a field that may have been quiet; true where there is one. */
  begin(): boolean {
    this.called = true;
    this.show();
    const first = this.inputs[0];
    if (this.panel.hidden || !first) return false;
    first.field.focus();
    first.field.select();
    return true;
  }

  private enter(): void {
    if (this.panel.querySelector("[aria-invalid=true]")) return;
    this.board.tool.enter?.();
    this.board.host.focus({ preventScroll: true });
    this.board.redraw();
  }

  private key(event: KeyboardEvent): void {
    event.stopPropagation();
    if (event.key === "Escape") {
      event.preventDefault();
      const k = this.inputs.findIndex(({ field }) => field === document.activeElement);
      if (k >= 0) this.take(this.fields[k], "");
      this.board.host.focus({ preventScroll: true });
      this.board.redraw();
    }
    if (event.key !== "Tab" || !this.inputs.length) return;
    event.preventDefault();
    const k = this.inputs.findIndex(({ field }) => field === document.activeElement), { length } = this.inputs;
    const next = this.inputs[(k + (event.shiftKey ? length - 1 : 1)) % length].field;
    next.focus();
    next.select();
  }

  /** Gives the tool what is typed, with its unit; what cannot be read is said at the field. */
  private take(field: Field, text: string): void {
    const { bench, tool } = this.board, found = text.trim() ? (typed(text, field.quantity, bench.settings.value.unit)?.text ?? null) : "";
    const wrong = found === null ? bench.say("sheet.unreadable", { text }) : (tool.type?.(field.key, found) ?? null);
    this.error.textContent = wrong ?? "";
    this.inputs[this.fields.findIndex(({ key }) => key === field.key)]?.field.setAttribute("aria-invalid", String(wrong !== null));
    this.board.redraw();
  }

  /** Shows the values as they are now, beside the point in hand. */
  draw(): void {
    this.called &&= this.panel.contains(document.activeElement);
    this.show();
  }

  private show(): void {
    const { board, panel } = this, { bench, spot } = board, { fields } = this;
    panel.hidden = !fields.length;
    if (!fields.length) {
      this.known = "";
      return;
    }
    const known = [bench.page.language.value, ...fields.map(({ key, label }) => key + label)].join();
    if (known !== this.known) this.build(fields);
    this.known = known;
    fields.forEach((field, k) => this.fill(field, this.inputs[k]));
    const snapped = board.tool.note?.() || (spot?.snap?.sentence ?? "");
    if (this.title.textContent !== snapped) this.title.textContent = snapped;
    this.title.parentElement!.hidden = !snapped;
    // It goes with a mouse, which would never reach it, and is not in its way.
    panel.classList.toggle("passed", !spot?.touch);
    if (spot) this.put(spot.screen);
  }

  private build(fields: Field[]): void {
    const { bench } = this.board;
    for (const { box } of this.inputs) box.remove();
    this.error.textContent = "";
    this.set.textContent = bench.say("sheet.set");
    this.keys.innerHTML = "";
    for (const [key, word] of [["Tab", "next"], ["↵", "set"], ["Alt", "no_snap"]]) {
      const mark = Object.assign(document.createElement("kbd"), { textContent: key });
      this.keys.append(mark, ` ${bench.say(`sheet.key_${word}`)} `);
    }
    this.inputs = fields.map((field) => {
      const box = document.createElement("label"), label = document.createElement("span"), input = document.createElement("input"), unit = document.createElement("span");
      label.textContent = field.label;
      unit.className = "hand-unit";
      Object.assign(input, { type: "text", autocomplete: "off", spellcheck: false, inputMode: field.quantity === "teeth" ? "text" : "decimal", name: field.key });
      box.append(label, input, unit);
      box.classList.toggle("hand-first", field === fields[0]);
      input.addEventListener("input", () => this.take(field, input.value));
      this.row.insertBefore(box, this.set);
      return { box, label, field: input, unit };
    });
  }

  private fill(field: Field, { box, field: input, unit }: Input): void {
    const [number, symbol] = typeof field.value === "number" ? shown(field.value, field.quantity, this.board.bench.settings.value.unit) : [field.value, ""];
    const fixed = field.text !== null;
    box.classList.toggle("fixed", fixed);
    if (document.activeElement !== input && !fixed && input.value !== number) input.value = number;
    if (document.activeElement === input && !fixed && input.value && input.getAttribute("aria-invalid") !== "true" && input.value !== number) {
      const all = input.selectionStart === 0 && input.selectionEnd === input.value.length;
      input.value = number;
      if (all) input.select();
    }
    if (unit.textContent !== symbol) unit.textContent = symbol;
  }

  /** Beside a place of the sheet, never over it or the element that begins elsewhere, inside of the sheet. */
  private put(at: Vec): void {
    const { panel } = this, { camera, tool } = this.board, from = tool.begins?.() ?? tool.anchor?.() ?? null;
    const [x, y] = beside(at, [panel.offsetWidth, panel.offsetHeight], camera.size, from && camera.screen(from));
    panel.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`;
  }
}

// Shares of an element in hand that the panel should not cover.
const SHARES = [0, 0.25, 0.5, 0.75];

/** The corner of a panel beside a place: of the four sides the first that is inside of the sheet and off the element. */
export function beside([x, y]: Vec, [wide, tall]: Vec, [w, h]: Vec, from: Vec | null): Vec {
  const lefts = [x + AWAY, x - AWAY - wide], tops = [y + AWAY, y - AWAY - tall], shares = from ? SHARES : [];
  const inside = (value: number, size: number, all: number) => Math.max(EDGE, Math.min(value, all - size - EDGE));
  let best = Infinity, found: Vec = [0, 0];
  for (const left of lefts)
    for (const top of tops) {
      const at: Vec = [inside(left, wide, w), inside(top, tall, h)], out = Math.abs(at[0] - left) + Math.abs(at[1] - top);
      const over = shares.filter((share) => {
        const [u, v] = [from![0] + share * (x - from![0]), from![1] + share * (y - from![1])];
        return u > at[0] - EDGE && u < at[0] + wide + EDGE && v > at[1] - EDGE && v < at[1] + tall + EDGE;
      });
      const worse = 10 * out + over.length;
      if (worse < best) [best, found] = [worse, at];
    }
  return found;
}

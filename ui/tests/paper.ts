// As much of a document as drawing needs: elements that keep their attributes and what is put into them.

export class Element {
  readonly attributes: Record<string, string> = {};
  readonly children: (Element | string)[] = [];
  /** How often an attribute was written. */
  written = 0;

  constructor(readonly tag: string) {}

  get svg(): SVGElement {
    return this as unknown as SVGElement;
  }

  get textContent(): string {
    return this.children.map((each) => (typeof each === "string" ? each : each.textContent)).join("");
  }

  getAttribute(name: string): string | null {
    return this.attributes[name] ?? null;
  }

  setAttribute(name: string, value: string): void {
    this.attributes[name] = value;
    this.written++;
  }

  append(child: Element | string): void {
    this.children.push(child);
  }
}

Object.assign(globalThis, { document: { createElementNS: (_: string, tag: string) => new Element(tag) } });

/** The places of a path of straight strokes, or of a shift. */
export function numbersOf(text: string): [number, number][] {
  const numbers = Array.from(text.matchAll(/-?\d+(?:\.\d+)?/g), ([each]) => Number(each));
  return Array.from({ length: numbers.length / 2 }, (_, k) => [numbers[2 * k], numbers[2 * k + 1]]);
}

// Colours of the style sheet for what is painted on canvases.

const NAMES = [
  "ink", "soft", "line", "accent", "a", "b", "c", "d", "velocity", "acceleration", "force", "load", "input", "good", "warn", "bad", "axis", "grid-major",
] as const;
export type Colour = (typeof NAMES)[number];

let known: Record<Colour, string> | null = null;
const painters = new Set<() => void>();

/** Paints every canvas again, in the colours that the page has now. */
export function repaint(): void {
  known = null;
  for (const paint of painters) paint();
}

for (const query of ["(prefers-color-scheme: dark)", "print"]) matchMedia(query).addEventListener("change", repaint);

export function colours(): Record<Colour, string> {
  if (known) return known;
  const style = getComputedStyle(document.documentElement);
  return (known = Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`)])) as Record<Colour, string>);
}

/** A canvas whose picture is kept as sharp as the display and in the colours of the page; `paint` after each change. */
export function painted(host: Element, paint: () => void): { canvas: HTMLCanvasElement; pen: CanvasRenderingContext2D; end: () => void } {
  const canvas = host.appendChild(document.createElement("canvas"));
  const observer = new ResizeObserver(([{ contentRect: box }]) => {
    const dense = devicePixelRatio || 1;
    const [wide, tall] = [Math.round(box.width * dense), Math.round(box.height * dense)];
    if (wide < 1 || (canvas.width === wide && canvas.height === tall)) return;
    [canvas.width, canvas.height] = [wide, tall];
    paint();
  });
  observer.observe(canvas);
  painters.add(paint);
  const end = () => {
    observer.disconnect();
    painters.delete(paint);
    canvas.remove();
  };
  return { canvas, pen: canvas.getContext("2d")!, end };
}

// An offset slider-crank whose program is written by hand, so that the page's solver and numbers meet closed forms.
import type { Dimension, ModelData } from "../src/data";
import type { Code, Program } from "../src/engine";

export const CRANK = 0.05, ROD = 0.2, OFFSET = 0.01, SPEED = 4;

/** Rows as pages carry them. */
export const packed = (row: ArrayLike<number>) => Buffer.from(Float64Array.from(row).buffer).toString("base64");

export const dimension = (address: string, value: number, more: Partial<Dimension> = {}): Dimension => ({
  address, value, unit: "m", factor: 1, written: null, positive: true, geometry: true, moves: false, drawn: false, ...more,
});

const program: Program = {
  outputs: [
    "ok", "outcome", "quality:slide", "fact:slide|height", "fact:slide|length²",
    "p:A.x", "p:A.y", "p:B.x", "p:B.y", "s:guide", "sv:guide", "sa:guide", "e:crank.x", "e:crank.y",
  ],
  parameters: ["crank.length", "rod.length", "guide.offset", "driver.speed"],
  positions: ["cos:driver", "sin:driver"], fields: [], tables: [],
};

type Rows = Float64Array[];
export type Formulas = (parameters: Float64Array, positions: Rows, fields: Rows, out: Float64Array, n: number) => void;

/** Formulas as the code of a program: they read the call block as a module does. */
export function asCode({ parameters, positions, fields, outputs }: Program, run: Formulas): Code {
  const inputs = 9;
  return ({ __linear_memory: memory }) => (address) => {
    const { buffer } = memory as WebAssembly.Memory, block = new BigInt64Array(buffer, address), n = Number(block[1]);
    const row = (place: number, count: number) => new Float64Array(buffer, Number(block[place]), count);
    const rows = [...positions, ...fields].map((_, k) => row(inputs + k, n));
    run(row(7, parameters.length), rows.slice(0, positions.length), rows.slice(positions.length), row(8, outputs.length * n), n);
  };
}

export const formulas: Formulas = ([r, l, e, w], [cos, sin], _fields, out, n) => {
  for (let i = 0; i < n; i++) {
    const [x, y] = [r * cos[i], r * sin[i]], height = y - e, along = Math.sqrt(l * l - height * height);
    const apart = Number(Math.abs(height) > l), rate = -y * w - (height * x * w) / along;
    // Of along² = l² − height² twice the rate.
    const grown = (-height * x * w) / along, second = -x * w * w - ((x * w) ** 2 - height * y * w * w + grown ** 2) / along;
    [1 - apart, apart, 1 - (height / l) ** 2, height, l * l, x, y, x + along, e, x + along, rate, second, cos[i], sin[i]]
      .forEach((value, k) => (out[k * n + i] = value));
  }
};

/** The machine at so many positions of a turn. */
export function sliderCrank(count: number): { data: ModelData; code: Code } {
  const step = (2 * Math.PI) / count, said = (text: string) => ({ en: text, zh: text });
  const data: ModelData = {
    name: said("slider-crank"), purpose: said(""), source: said(""), text: "", module: "",
    program, tables: {}, sizes: "", drawing: { input: null, at: 0, places: [] },
    values: { "crank.length": CRANK, "rod.length": ROD, "guide.offset": OFFSET, "driver.speed": SPEED },
    dimensions: [
      dimension("crank.length", CRANK), dimension("rod.length", ROD),
      dimension("guide.offset", OFFSET, { positive: false }), dimension("driver.speed", SPEED, { positive: false, geometry: false }),
    ],
    positions: {
      count, closed: true, period: (2 * Math.PI) / SPEED, modes: {}, breaks: null, time: null, arrays: {}, drift: 2 * Math.PI,
      steady: { driver: "driver", turns: true, start: 0, step, speed: SPEED, begin: 0 },
      inputs: [{ name: "driver", turns: true, values: null }],
    },
    fields: {}, starts: {}, held: [], phases: [], angles: [], friction: [], bends: [],
    groups: [{ name: "slide", signature: "RRP", links: ["rod", "slider"], facts: ["height", "length²"], wheels: [], dyad: true }],
    signals: [
      { id: "s:guide", form: "row", rows: ["s:guide"], kind: "length", name: said("way") },
      { id: "v:B", form: "row", rows: ["sv:guide"], kind: "velocity", name: said("speed") },
      { id: "angle:crank", form: "angle", rows: ["e:crank.x", "e:crank.y"], kind: "angle", name: said("angle") },
      { id: "y:A", form: "row", rows: ["p:A.y"], kind: "length", name: said("height") },
    ],
    numbers: [
      { id: "range", kind: "range", signal: "s:guide", quantity: "length", name: said("stroke") },
      { id: "ratio", kind: "ratio", signal: "s:guide", quantity: "ratio", name: said("quick return") },
      { id: "least", kind: "least", signal: "s:guide", quantity: "length", name: said("least") },
      { id: "largest", kind: "largest", signal: "y:A", quantity: "length", name: said("largest") },
      { id: "rms", kind: "rms", signal: "y:A", quantity: "length", name: said("rms") },
    ],
    curves: [], points: [
      { key: "A", fixed: false, moved: ["crank.length"] },
      { key: "B", fixed: false, moved: ["crank.length", "rod.length", "guide.offset"] },
    ],
    glyphs: [], masses: [], undrawn: [],
  };
  return { data, code: asCode(program, formulas) };
}

/** Where the slider is by the theorem of Pythagoras. */
export function slider(angle: number, crank = CRANK, rod = ROD, offset = OFFSET): number {
  return crank * Math.cos(angle) + Math.sqrt(rod ** 2 - (crank * Math.sin(angle) - offset) ** 2);
}

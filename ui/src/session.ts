// One machine with what its user has done to it: history, variants, what is shown.
import { signal } from "@preact/signals";
import type { ModelData } from "./data";
import { type Design, Model } from "./model";
import type { Values } from "./solver";
import type { Code } from "./engine";
import { History } from "./history";
import type { Shown, View } from "./view";
import { written } from "./written";

export interface Variant {
  number: number;
  design: Design;
}

interface Path {
  x: Float64Array;
  y: Float64Array;
}

/** Machines within tolerances: `width` of their lengths, m; how many were tried and can be built; the farthest off, m. */
export interface Cloud {
  width: number;
  count: number;
  built: number;
  off: number;
}

const SHARE = 0.2;
// How many machines are drawn as ghosts, and the time that they may take, ms.
const FEWEST = 41, MOST = 500, MOMENT = 400, TRIED = 4;
// Tables and fields are read again when a hand rests this long, and while it goes on as often as this, ms.
const REST = 120, LONGEST = 700;
// Digits of dimensions that a hand has moved, the fewest first.
const DIGITS = [4, 5, 7];

export class Session {
  readonly model: Model;
  readonly shown: Shown;
  readonly version = signal(0);
  /** The same for what is read and not followed by the eye: tables and fields, when a hand rests. */
  readonly calm = signal(0);
  readonly curves = signal<string[]>([]);
  readonly variants = signal<Variant[]>([]);
  readonly swept = signal<string | null>(null);
  readonly cloud = signal<Cloud | null>(null);
  readonly hodograph = signal<string>("");
  view: View | null = null;
  /** Between the beginning and the end of a change. */
  moving = false;
  /** Between the first letter and the last of a number, or while a joint or a bar is held: it is not replaced. */
  held = false;
  /** Called when a change has ended. */
  ended: (() => void) | null = null;
  readonly history = new History<Values>(() => ({ ...this.model.values }), (values) => this.go(values));
  /** Variants that have been kept so far. */
  counted = 0;
  private resting = 0;
  /** When the movement began that tables and fields do not show yet. */
  private since = 0;

  constructor(readonly data: ModelData, code: Code, readonly number: number) {
    this.model = new Model(data, code);
    this.curves.value = data.curves;
    const free = data.points.filter(({ key, fixed }) => !fixed && key.includes("."));
    this.shown = {
      paths: new Set(free.slice(0, 2).map(({ key }) => key)),
      names: true, velocities: false, accelerations: false, forces: false, centres: false,
    };
  }

  /** Something has changed, and stays so. */
  touched(): void {
    this.version.value++;
    this.settle();
  }

  private settle(): void {
    window.clearTimeout(this.resting);
    this.resting = 0;
    this.calm.value++;
  }

  /** The machine is being moved: what the eye follows changes at once, the rest when the hand and the browser rest. */
  moved(): void {
    this.version.value++;
    const now = performance.now();
    if (!this.resting) this.since = now;
    window.clearTimeout(this.resting);
    this.resting = window.setTimeout(() => idle(() => this.resting && this.settle()), Math.min(REST, this.since + LONGEST - now));
  }

  /** A change begins: what was before can be had back. */
  begin(): void {
    this.moving = true;
    this.history.mark();
  }

  /** A change has ended; one that changed nothing leaves no step behind. What a hand has moved (`roughly`) is rounded. */
  end(roughly = false): void {
    this.moving = false;
    const { before } = this.history;
    if (roughly && before && !this.model.wall) this.round(before);
    if (before && same(before, this.model.values)) this.history.unmark();
    if (this.view?.outside) this.view.fit();
    this.sweep(this.swept.value);
    this.touched();
    this.ended?.();
  }

  /** Takes the changed dimensions with as few digits as a file is written with, where the machine can have them. */
  private round(before: Values): void {
    const { model } = this, changed = this.data.dimensions.filter(({ address }) => model.values[address] !== before[address]);
    for (const digits of DIGITS) {
      const near = changed.map(({ address, factor }) => [address, Number((model.values[address] / factor).toPrecision(digits)) * factor]);
      const rounded = { ...model.values, ...Object.fromEntries(near) };
      if (model.allows(rounded)) return model.change(rounded);
    }
  }

  /** Takes given values as a step of its own. */
  take(values: Values): void {
    this.begin();
    this.go(values);
  }

  private go(values: Values): void {
    this.moving = false;
    this.model.change({ ...values });
    this.view?.fit();
    this.sweep(this.swept.value);
    this.touched();
    this.ended?.();
  }

  keep(): void {
    this.variants.value = [...this.variants.value, { number: ++this.counted, design: this.model.design() }];
  }

  forget(number: number): void {
    this.variants.value = this.variants.value.filter((each) => each.number !== number);
  }

  /** The points whose paths are looked at: the shown ones, all that move where none is shown. */
  get traced(): string[] {
    return this.shown.paths.size ? [...this.shown.paths] : this.data.points.filter(({ fixed }) => !fixed).map(({ key }) => key);
  }

  /** Paths of the traced points while a dimension varies about its present value, as far as the machine can. */
  sweep(address: string | null): void {
    this.swept.value = address;
    if (address) this.cloud.value = null;
    const { model } = this, here = address ? model.values[address] : 0, reach = SHARE * (Math.abs(here) || model.size);
    if (address || !this.cloud.value) this.ghosts(address ? (k, count) => ({ [address]: here + reach * ((2 * k) / (count - 1) - 1) }) : null);
    else this.scatter(this.cloud.value.width);
  }

  /** The same for machines whose lengths are off by at most `width`, m, each as likely as the others; 0 ends it. */
  scatter(width: number): void {
    this.swept.value = null;
    if (!(width > 0)) {
      this.cloud.value = null;
      this.ghosts(null);
      return;
    }
    const { model } = this, lengths = this.data.dimensions.filter((d) => d.geometry && d.unit !== "deg" && d.unit !== "rad");
    const nominal = this.traced.map((key) => ["x", "y"].map((axis) => model.main.row(`p:${key}.${axis}`).slice()));
    let off = 0, built = 0;
    const count = this.ghosts(
      () => Object.fromEntries(lengths.map(({ address }) => [address, model.values[address] + width * (2 * Math.random() - 1)])),
      (paths) => {
        built++;
        paths.forEach(({ x, y }, k) => x.forEach((_, i) => (off = Math.max(off, Math.hypot(x[i] - nominal[k][0][i], y[i] - nominal[k][1][i])))));
      },
    );
    this.cloud.value = { width, count, built, off };
  }

  /** Draws the paths of up to 500 changed machines, as many as may be found in a moment; gives their number. */
  private ghosts(changed: ((k: number, count: number) => Values) | null, seen: (paths: Path[]) => void = () => {}): number {
    const rows: Path[] = [], { model } = this;
    let count = 0;
    if (changed) {
      const begin = performance.now();
      for (let k = 0; k < TRIED; k++) model.evaluate({ ...model.values });
      count = Math.max(FEWEST, Math.min(MOST, Math.floor((MOMENT * TRIED) / (performance.now() - begin + 0.1))));
      for (let k = 0; k < count; k++) {
        if (model.evaluate({ ...model.values, ...changed(k, count) })) continue;
        const paths = this.traced.map((key) => ({ x: model.main.row(`p:${key}.x`).slice(), y: model.main.row(`p:${key}.y`).slice() }));
        rows.push(...paths);
        seen(paths);
      }
      model.evaluate(model.values);
    }
    this.view?.ghosts(rows);
    return count;
  }

  /** The model's text with the changed numbers in their places, and the names of those that have none. */
  text(): { text: string; missing: string[] } {
    return written(this.model);
  }
}

/** Runs work when the page has nothing else to do, at the latest after a rest. */
function idle(work: () => void): void {
  if ("requestIdleCallback" in window) requestIdleCallback(work, { timeout: REST });
  else work();
}

function same(a: Values, b: Values): boolean {
  return Object.keys(b).every((name) => a[name] === b[name]);
}

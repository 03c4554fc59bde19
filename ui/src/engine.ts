// Traced programs in the browser: kernels of a WebAssembly module or of JavaScript text, and cycle programs made of them.

export interface Program {
  outputs: string[];
  parameters: string[];
  positions: string[];
  fields: string[];
  states: string[];
  tables: string[];
}

export interface Reduction {
  name: string;
  output: string;
  kind: string;
  of: string;
}

export interface Stage {
  kernel: number;
  reductions: Reduction[];
  valid: string | null;
  count: string;
  complete: boolean;
  steps: number | null;
  starts: Record<string, string | number>;
  after: number | null;
  keep: number | null;
}

type Rows = Float64Array[];
type Plain = (
  parameters: Float64Array, positions: Rows, fields: Rows, tables: Rows,
  starts: Float64Array, out: Float64Array, n: number,
) => void;
export type Code = { module: WebAssembly.Module } | { functions: Plain[] };

const HEAD = 5;
const PAGE = 65536;
// Places of the call block, 64 bits each.
const BLOCK = { designs: 0, length: 1, count: 2, fullEnd: 3, tailStart: 4, tailLow: 5, tailHigh: 6, parameters: 7, out: 8, starts: 9 };
const INPUTS = 10;
// Positions that a kernel takes at a time.
const LANES = 4;

/** Value or derivative of a piecewise cubic; the numbers of a table: pieces, start, span, periodic, drift, breaks, rows. */
export function look(table: Float64Array, x: number, order: number): number {
  const pieces = table[0], rows = HEAD + pieces + 1;
  const whole = Math.floor((x - table[1]) / table[2]);
  const y = table[3] !== 0 ? x - whole * table[2] : x;
  let piece = 0;
  for (let left = pieces; left > 1; ) {
    const half = left >> 1;
    if (table[HEAD + piece + half] <= y) piece += half;
    left -= half;
  }
  const u = y - table[HEAD + piece], at = rows + 4 * piece;
  const [c0, c1, c2, c3] = [table[at], table[at + 1], table[at + 2], table[at + 3]];
  if (order === 0) {
    const value = c0 + u * (c1 + u * (c2 + u * c3));
    return table[3] !== 0 ? value + whole * table[4] : value;
  }
  if (order === 1) return c1 + u * (2 * c2 + u * (3 * c3));
  if (order === 2) return 2 * c2 + u * (6 * c3);
  // oxlint-disable-next-line oxc/erasing-op -- a place that is no number gives none
  return 6 * c3 + 0 * u;
}

/** One program bound to arrays for n positions: fill them, run, read. Rows of `out` are `stride` numbers apart. */
export class Call {
  readonly parameters: Float64Array;
  readonly positions: Record<string, Float64Array> = {};
  readonly fields: Record<string, Float64Array> = {};
  readonly starts: Float64Array;
  readonly out: Float64Array;
  readonly stride: number;
  private readonly rows: Record<string, Float64Array> = {};

  constructor(readonly program: Program, readonly n: number, room: Room, tables: Rows) {
    const carried = program.states.length > 0;
    this.stride = carried ? n : Math.max(n, LANES);
    this.parameters = room.floats(program.parameters.length);
    for (const name of program.positions) this.positions[name] = room.floats(this.stride);
    for (const name of program.fields) this.fields[name] = room.floats(this.stride);
    this.starts = room.floats(program.states.length);
    this.out = room.floats(program.outputs.length * this.stride);
    const inputs = [...Object.values(this.positions), ...Object.values(this.fields), ...tables];
    this.run = room.caller(this, inputs, tables, carried);
    program.outputs.forEach((name, k) => (this.rows[name] = this.out.subarray(k * this.stride, k * this.stride + n)));
  }

  readonly run: () => void;

  /** The values of an output over the positions; a view that the next run changes. */
  row(name: string): Float64Array {
    return this.rows[name];
  }

  has(name: string): boolean {
    return name in this.rows;
  }

  set(values: Record<string, number>): void {
    this.program.parameters.forEach((name, k) => (this.parameters[k] = values[name]));
  }

  give(arrays: Record<string, ArrayLike<number>>): void {
    for (const kind of [this.positions, this.fields])
      for (const name in kind) {
        const given = arrays[name];
        if (given) for (let i = 0; i < this.stride; i++) kind[name][i] = given[Math.min(i, given.length - 1)];
      }
  }
}

interface Room {
  floats(count: number): Float64Array;
  caller(call: Call, inputs: Rows, tables: Rows, carried: boolean): () => void;
}

/** Kernels with their programs; makes calls. */
export class Kernels {
  private readonly room: (kernel: number) => Room;
  private readonly tables: Record<string, Float64Array>;

  constructor(readonly programs: Program[], code: Code, tables: Record<string, number[]> = {}, megabytes = 16) {
    if ("functions" in code) {
      this.tables = Object.fromEntries(Object.entries(tables).map(([name, t]) => [name, Float64Array.from(t)]));
      const floats = (count: number) => new Float64Array(count);
      this.room = (kernel) => ({
        floats,
        caller: (call, _inputs, own) => () =>
          code.functions[kernel](
            call.parameters, Object.values(call.positions), Object.values(call.fields), own,
            call.starts, call.out, call.stride,
          ),
      });
      return;
    }
    const memory = new WebAssembly.Memory({ initial: (megabytes * 1048576) / PAGE });
    const env: Record<string, WebAssembly.ImportValue> = { __linear_memory: memory };
    for (const name of ["sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "pow"] as const)
      env[`linkwright_${name}`] = Math[name] as WebAssembly.ImportValue;
    const kernels = new WebAssembly.Instance(code.module, { env }).exports as Record<string, (block: number) => void>;
    let free = 1024;
    const floats = (count: number) => {
      const bytes = (8 * Math.max(count, 1) + 63) & ~63;
      if (free + bytes > memory.buffer.byteLength) throw new RangeError("the page's memory is too small for this model");
      free += bytes;
      return new Float64Array(memory.buffer, free - bytes, count);
    };
    this.tables = Object.fromEntries(
      Object.entries(tables).map(([name, t]) => {
        const kept = floats(t.length);
        kept.set(t);
        return [name, kept];
      }),
    );
    this.room = (kernel) => ({
      floats,
      caller: (call, inputs, _tables, carried) => {
        const block = new BigInt64Array(memory.buffer, floats(INPUTS + inputs.length).byteOffset, INPUTS + inputs.length);
        fill(block, call, inputs, carried);
        const run = kernels[`kernel${kernel}`], at = block.byteOffset;
        return () => run(at);
      },
    });
  }

  call(kernel: number, n: number): Call {
    const program = this.programs[kernel];
    return new Call(program, n, this.room(kernel), program.tables.map((name) => this.tables[name]));
  }
}

function fill(block: BigInt64Array, call: Call, inputs: Rows, carried: boolean): void {
  const put = (place: number, value: number) => (block[place] = BigInt(value));
  const n = call.n, rest = n % LANES, full = n - rest;
  put(BLOCK.designs, 1);
  put(BLOCK.length, call.stride);
  put(BLOCK.count, n);
  put(BLOCK.fullEnd, full);
  const [start, low, high] = full ? (rest ? [n - LANES, LANES - rest, LANES] : [-1, 0, 0]) : [0, 0, rest];
  if (!carried) {
    put(BLOCK.tailStart, start);
    put(BLOCK.tailLow, low);
    put(BLOCK.tailHigh, high);
  }
  put(BLOCK.parameters, call.parameters.byteOffset);
  put(BLOCK.out, call.out.byteOffset);
  put(BLOCK.starts, call.starts.byteOffset);
  inputs.forEach((array, k) => put(INPUTS + k, array.byteOffset));
}

/** The stages of a cycle program for one design; what they find joins the dimensions under its own names. */
export class Cycle {
  private readonly calls: { stage: Stage; call: Call; after: Call | null; keep: Call | null }[];
  readonly kept: Record<string, Float64Array> = {};

  constructor(kernels: Kernels, stages: Stage[], n: number) {
    this.calls = stages.map((stage) => {
      const length = stage.steps ?? n;
      return {
        stage,
        call: kernels.call(stage.kernel, length),
        after: stage.after === null ? null : kernels.call(stage.after, 1),
        keep: stage.keep === null ? null : kernels.call(stage.keep, length),
      };
    });
  }

  run(values: Record<string, number>, positions: Record<string, ArrayLike<number>>): Record<string, number> {
    const known = { ...values };
    const found: Record<string, number> = {};
    let failed = false;
    for (const { stage, call, after, keep } of this.calls) {
      evaluate(call, stage, known, positions, this.kept);
      const own = reduce(stage, call);
      const results: Record<string, number> = {};
      for (const { name, output, kind, of } of stage.reductions) results[name] = own(output, kind, of);
      const count = own("", "valid", "");
      if (after) {
        after.program.parameters.forEach((name, k) => (after.parameters[k] = known[name] ?? named(name, own)));
        after.run();
        for (const name of after.program.outputs) results[name] = after.row(name)[0];
      }
      if (stage.count) results[stage.count] = count;
      failed ||= stage.complete && count !== call.n;
      if (failed) for (const name in results) results[name] = NaN;
      if (keep) {
        evaluate(keep, stage, known, positions, this.kept);
        for (const name of keep.program.outputs) this.kept[name] = keep.row(name);
      }
      Object.assign(known, results);
      Object.assign(found, results);
    }
    return found;
  }
}

function evaluate(
  call: Call, stage: Stage, known: Record<string, number>,
  positions: Record<string, ArrayLike<number>>, kept: Record<string, ArrayLike<number>>,
): void {
  call.set(known);
  call.give(positions);
  call.give(kept);
  call.program.states.forEach((name, k) => {
    const start = stage.starts[name];
    call.starts[k] = typeof start === "string" ? known[start] : start;
  });
  call.run();
}

function named(name: string, own: (output: string, kind: string, of: string) => number): number {
  if (name === "valid.count") return own("", "valid", "");
  for (const kind of ["at_min", "at_max"]) {
    const cut = name.indexOf(`.${kind}.`);
    if (cut >= 0) return own(name.slice(0, cut), kind, name.slice(cut + kind.length + 2));
  }
  const dot = name.lastIndexOf(".");
  return own(name.slice(0, dot), name.slice(dot + 1), "");
}

/** Summaries over the valid positions of a call that has run. */
export function reduce(stage: { valid: string | null }, call: Call): (output: string, kind: string, of: string) => number {
  const { n } = call;
  const judged = stage.valid !== null && call.has(stage.valid) ? call.row(stage.valid) : null;
  const places: number[] = [];
  for (let i = 0; i < n; i++) if (!judged || judged[i] !== 0) places.push(i);
  const value = (output: string) => (output === "#" ? (i: number) => i : (i: number) => call.row(output)[i]);
  const extreme = (output: string, sign: number) => {
    const at = value(output);
    let best = Infinity, place = -1;
    for (const i of places) if (sign * at(i) < best) [best, place] = [sign * at(i), i];
    return place;
  };
  const total = (output: string, of: (x: number) => number) => places.reduce((sum, i) => sum + of(value(output)(i)), 0);
  return (output, kind, of) => {
    const there = (place: number, what: string) => (place < 0 ? NaN : value(what)(place));
    switch (kind) {
      case "min": return there(extreme(output, 1), output);
      case "max": return there(extreme(output, -1), output);
      case "argmin": return extreme(output, 1);
      case "argmax": return extreme(output, -1);
      case "at_min": return there(extreme(of, 1), output);
      case "at_max": return there(extreme(of, -1), output);
      case "first": return there(places[0] ?? -1, output);
      case "last": return there(places[places.length - 1] ?? -1, output);
      case "sum": return total(output, (x) => x);
      case "mean": return total(output, (x) => x) / places.length;
      case "rms": return Math.sqrt(total(output, (x) => x * x) / places.length);
      case "count": return total(output, (x) => (x !== 0 ? 1 : 0));
      case "valid": return places.length;
      default: throw new Error(`no reduction ${kind}`);
    }
  };
}

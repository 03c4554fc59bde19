// Traced programs in the browser: kernels of WebAssembly modules or of JavaScript text.

export interface Program {
  outputs: string[];
  parameters: string[];
  positions: string[];
  fields: string[];
  tables: string[];
}

type Rows = Float64Array[];
type Plain = (
  parameters: Float64Array, positions: Rows, fields: Rows, tables: Rows,
  out: Float64Array, n: number,
) => void;
export type Code = { module: WebAssembly.Module } | { run: Plain };

const HEAD = 5;
const PAGE = 65536;
// Places of the call block, 64 bits each.
const BLOCK = { designs: 0, length: 1, count: 2, fullEnd: 3, tailStart: 4, tailLow: 5, tailHigh: 6, parameters: 7, out: 8 };
const INPUTS = 9;
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
  readonly out: Float64Array;
  readonly stride: number;
  private readonly rows: Record<string, Float64Array> = {};

  constructor(readonly program: Program, readonly n: number, room: Room, tables: Rows) {
    this.stride = Math.max(n, LANES);
    this.parameters = room.floats(program.parameters.length);
    for (const name of program.positions) this.positions[name] = room.floats(this.stride);
    for (const name of program.fields) this.fields[name] = room.floats(this.stride);
    this.out = room.floats(program.outputs.length * this.stride);
    const inputs = [...Object.values(this.positions), ...Object.values(this.fields), ...tables];
    this.run = room.caller(this, inputs, tables);
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
  caller(call: Call, inputs: Rows, tables: Rows): () => void;
}

/** A program with its kernel; makes calls. */
export class Kernel {
  private readonly room: Room;
  private readonly tables: Rows;

  constructor(readonly program: Program, code: Code, tables: Record<string, number[]> = {}, megabytes = 16) {
    this.room = "run" in code ? texts(code.run) : compiled(code.module, megabytes);
    this.tables = program.tables.map((name) => {
      const kept = this.room.floats(tables[name].length);
      kept.set(tables[name]);
      return kept;
    });
  }

  call(n: number): Call {
    return new Call(this.program, n, this.room, this.tables);
  }
}

function texts(run: Plain): Room {
  return {
    floats: (count) => new Float64Array(count),
    caller: (call, _inputs, tables) => () =>
      run(call.parameters, Object.values(call.positions), Object.values(call.fields), tables, call.out, call.stride),
  };
}

function compiled(module: WebAssembly.Module, megabytes: number): Room {
  const memory = new WebAssembly.Memory({ initial: (megabytes * 1048576) / PAGE });
  const env: Record<string, WebAssembly.ImportValue> = { __linear_memory: memory };
  for (const name of ["sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "pow"] as const)
    env[`linkwright_${name}`] = Math[name] as WebAssembly.ImportValue;
  const { kernel } = new WebAssembly.Instance(module, { env }).exports as { kernel: (block: number) => void };
  let free = 1024;
  const floats = (count: number) => {
    const bytes = (8 * Math.max(count, 1) + 63) & ~63;
    if (free + bytes > memory.buffer.byteLength) throw new RangeError("the page's memory is too small for this model");
    free += bytes;
    return new Float64Array(memory.buffer, free - bytes, count);
  };
  return {
    floats,
    caller: (call, inputs) => {
      const block = new BigInt64Array(memory.buffer, floats(INPUTS + inputs.length).byteOffset, INPUTS + inputs.length);
      fill(block, call, inputs);
      const at = block.byteOffset;
      return () => kernel(at);
    },
  };
}

function fill(block: BigInt64Array, call: Call, inputs: Rows): void {
  const put = (place: number, value: number) => (block[place] = BigInt(value));
  const n = call.n, rest = n % LANES, full = n - rest;
  put(BLOCK.designs, 1);
  put(BLOCK.length, call.stride);
  put(BLOCK.count, n);
  put(BLOCK.fullEnd, full);
  const [start, low, high] = full ? (rest ? [n - LANES, LANES - rest, LANES] : [-1, 0, 0]) : [0, 0, rest];
  put(BLOCK.tailStart, start);
  put(BLOCK.tailLow, low);
  put(BLOCK.tailHigh, high);
  put(BLOCK.parameters, call.parameters.byteOffset);
  put(BLOCK.out, call.out.byteOffset);
  inputs.forEach((array, k) => put(INPUTS + k, array.byteOffset));
}

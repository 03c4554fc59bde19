// Traced programs in the browser: kernels of WebAssembly modules.

export interface Program {
  outputs: string[];
  parameters: string[];
  positions: string[];
  fields: string[];
  tables: string[];
}

type Rows = Float64Array[];
type Imports = Record<string, WebAssembly.ImportValue>;
/** Makes of memory and functions a kernel, which takes the address of a call block. */
export type Code = (env: Imports) => (block: number) => void;

const PAGE = 65536;
// Places of the call block, 64 bits each.
const BLOCK = { designs: 0, length: 1, count: 2, fullEnd: 3, tailStart: 4, tailLow: 5, tailHigh: 6, parameters: 7, out: 8 };
const INPUTS = 9;
// Positions that a kernel takes at a time.
const LANES = 4;

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
    this.run = room.caller(this, inputs);
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

/** What a program has given: rows over positions, or their values at one. */
export interface Outputs {
  row(name: string): ArrayLike<number>;
  has(name: string): boolean;
}

const places = new WeakMap<Program, Map<string, number>>();

/** The outputs of a call for one position as they are now, whatever it runs later. */
export function taken({ program, out, stride }: Call): Outputs {
  const values = program.outputs.map((_, k) => out[k * stride]);
  let known = places.get(program);
  if (!known) places.set(program, (known = new Map(program.outputs.map((name, k) => [name, k]))));
  const found = known;
  return { row: (name) => [values[found.get(name)!]], has: (name) => found.has(name) };
}

interface Room {
  floats(count: number): Float64Array;
  caller(call: Call, inputs: Rows): () => void;
}

/** The code of a module. */
export const moduleCode = (module: WebAssembly.Module): Code => (env) =>
  new WebAssembly.Instance(module, { env }).exports.kernel as (block: number) => void;

/** A program with its kernel; makes calls. */
export class Kernel {
  private readonly room: Room;
  private readonly tables: Rows;

  constructor(readonly program: Program, code: Code, tables: Record<string, number[]> = {}, megabytes = 16) {
    this.room = roomFor(code, megabytes);
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

function roomFor(code: Code, megabytes: number): Room {
  const memory = new WebAssembly.Memory({ initial: (megabytes * 1048576) / PAGE });
  const env: Imports = { __linear_memory: memory };
  for (const name of ["sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "pow"] as const)
    env[`linkwright_${name}`] = Math[name] as WebAssembly.ImportValue;
  const kernel = code(env);
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

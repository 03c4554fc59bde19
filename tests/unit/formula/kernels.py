"""The six-bar with all reactions over 360 positions, in browsers and native.

    python -m tests.unit.formula.kernels

The same program as WebAssembly in Node and in Chromium and as native code of one thread, in turns within one run; the
ratio is the median over the rounds.
"""

from __future__ import annotations

import json
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from importlib.resources import files as resources
from pathlib import Path
from typing import Any

import numpy as np
from benchmarks.kernels_alone import bare_call
from tests.ui.browser import browser
from tests.unit.formula.node import work

import linkwright as lw
from linkwright.formula.llvm_backend import aligned, compile_program
from linkwright.kinetostatics.solver import ForceSolver

ROUNDS, CALLS, STEPS = 40, 400, 360
_TIMER = """
  const code = engine.moduleCode(new WebAssembly.Module(Uint8Array.from(atob(work.module), c => c.charCodeAt(0))));
  const call = new engine.Kernel(work.program, code, work.tables).call(work.n);
  call.set(work.values);
  call.give(Object.fromEntries(Object.entries(work.positions).map(([name, row]) => [name, Float64Array.from(row)])));
  const timed = count => {
    const begin = performance.now();
    for (let k = 0; k < count; k++) call.run();
    return 1000 * (performance.now() - begin) / count;
  };
"""
_NODE = f"""
import {{ createInterface }} from "node:readline";
const [engine, work] = [await import(process.argv[2]), JSON.parse(process.argv[3])];
{_TIMER}
for await (const line of createInterface({{input: process.stdin}})) console.log(timed(Number(line)));
"""

Timer = Callable[[int], float]


def native(program: Any, numbers: list[float], positions: dict[str, Any], fields: dict[str, Any]) -> Timer:
    """Microseconds of a call of native code."""
    compiled = compile_program(program)
    assert compiled is not None
    out = aligned((len(program.outputs), STEPS))
    run = bare_call(compiled, np.array(numbers), positions, out, fields)

    def timed(count: int) -> float:
        begin = time.perf_counter()
        for _ in range(count):
            run()
        return 1e6 * (time.perf_counter() - begin) / count

    return timed


@contextmanager
def in_node(job: dict[str, Any], folder: Path) -> Iterator[Timer]:
    """The same of WebAssembly in Node."""
    node = shutil.which("node")
    assert node is not None
    script, engine = folder / "timer.mjs", resources("linkwright") / "page" / "built" / "engine.mjs"
    script.write_text(_NODE)
    command = [node, str(script), Path(str(engine)).as_uri(), json.dumps(job)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:

        def timed(count: int) -> float:
            assert process.stdin is not None
            assert process.stdout is not None
            process.stdin.write(f"{count}\n")
            process.stdin.flush()
            return float(process.stdout.readline())

        yield timed
        process.terminate()


@contextmanager
def in_chromium(job: dict[str, Any]) -> Iterator[Timer]:
    """The same of WebAssembly in Chromium."""
    engine = (resources("linkwright") / "page" / "built" / "engine.mjs").read_text(encoding="utf-8")
    with browser() as chromium:
        tab = chromium.new_page()
        tab.evaluate(
            "async ([text, work]) => { const url = URL.createObjectURL(new Blob([text], {type: 'text/javascript'}));"
            f" const engine = await import(url); {_TIMER} window.timed = timed; }}",
            [engine, job],
        )
        yield lambda count: float(tab.evaluate("count => timed(count)", count))


def main() -> int:
    """Medians and ratios of all ways."""
    motion = lw.solve_motion(lw.load("gallery:jaw_crusher_sixbar"), steps=STEPS)
    solver = ForceSolver(motion.solver)
    program = solver.program(solver.outputs.standard).program
    fields = lw.solve_forces(motion).fields
    positions = {name: motion.positions.arrays[name] for name in program.positions}
    values = {name: motion.design.parameters[name] for name in program.parameters}
    rows = {name: fields[name] for name in program.fields}
    job = work(program, values, {**positions, **rows}, STEPS)
    with ExitStack() as stack, tempfile.TemporaryDirectory() as folder:
        ways = {
            "native": native(program, list(values.values()), positions, rows),
            "Node": stack.enter_context(in_node(job, Path(folder))),
            "Chromium": stack.enter_context(in_chromium(job)),
        }
        for each in ways.values():
            each(40 * CALLS)
        rounds = [{name: each(CALLS) for name, each in ways.items()} for _ in range(ROUNDS)]
    for name in ways:
        times = [each[name] for each in rounds]
        ratio = statistics.median(each[name] / each["native"] for each in rounds)
        best = min(times) / min(each["native"] for each in rounds)
        print(
            f"{name:<9} median {statistics.median(times):6.2f} µs   shortest {min(times):6.2f} µs"
            f"   to native {ratio:5.2f} (shortest rounds {best:5.2f})"
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())

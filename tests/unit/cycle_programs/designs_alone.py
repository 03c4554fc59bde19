"""Every registered number of some designs side by side and alone, over the gallery and the machines of the tests.

``python -m tests.unit.cycle_programs.designs_alone [NAME] [--friction]``: the largest relative difference of each
machine whose name has NAME in it, which numbers are found one by one, and milliseconds a design.
"""

import importlib
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from time import process_time

import numpy as np
from tests.invariants.rubbing import rubbing

import linkwright as lw
from linkwright.cycle_programs.terms import measured
from linkwright.errors import LinkwrightError
from linkwright.metrics import METRICS, Analysis
from linkwright.study.design_numbers import side_by_side

FACTORS = np.array([1.0, 1.002, 0.998])
MANY = 64
VARIED = (".length", ".x", ".y", "radius", "offset", "mass")


def machines() -> Iterator[tuple[str, Callable[[], lw.Mechanism]]]:
    """Names, and what reads them."""
    for path in sorted(Path("src/linkwright/gallery").glob("*.yaml")):
        yield path.stem, partial(lw.load, f"gallery:{path.stem}")
    for path in sorted(Path("tests").rglob("test_*.py")):
        if "ui" not in path.parts and "format: 1" in path.read_text("utf-8"):
            module = importlib.import_module(".".join(path.with_suffix("").parts))
            for name, text in vars(module).items():
                if isinstance(text, str) and "format: 1" in text and "links:" in text:
                    yield f"{path.stem}:{name}", partial(lw.loads, text)


def compared(machine: lw.Mechanism) -> str:
    """What is found of one machine, in a line."""
    varied = [a for a in machine.dimensions() if a.endswith(VARIED) and abs(machine.dimension(a)) > 1e-6]
    if not varied:
        return "nothing to vary"
    by = varied[:: max(1, len(varied) // 2)][:2]
    analysis = Analysis.of(lw.solve_forces(machine))
    names = [name for name in METRICS if measured(name, analysis) is not None]
    found, together = side_by_side(machine, by, names), set[str]()
    columns = {a: machine.dimension(a) * FACTORS for a in by}
    start, alone = process_time(), []
    for k in range(len(FACTORS)):
        design = machine.with_dimensions({a: float(column[k]) for a, column in columns.items()})
        each = Analysis.of(lw.solve_forces(design))
        alone.append({name: measured(name, each) for name in names})
    single, many, worst, certain = process_time() - start, 0.0, (0.0, ""), 0
    for cycle in found:
        values = cycle.evaluate(columns, threads=1)
        certain += int(values.certain.sum())
        together |= {term.name for term in cycle.terms}
        for name in values.values:
            for k in np.flatnonzero(values.certain):
                known, value = alone[k].get(name), float(values.values[name][k])
                if known is not None and abs(known[0]) > 1e-12:
                    worst = max(worst, (abs(value / known[0] - 1.0), name))
        block = {a: machine.dimension(a) * np.linspace(0.998, 1.002, MANY) for a in by}
        for _ in range(2):
            start = process_time()
            cycle.evaluate(block, threads=1)
        many += process_time() - start
    rest = [name for name in names if name not in together]
    share = f"certain {certain}/{len(found) * len(FACTORS)}"
    times = f"{1e3 * many / MANY:.2f} ms, alone {1e3 * single / len(FACTORS):.0f}"
    return f"{worst[0]:.1e} {worst[1]:<22} {share} {times}; one by one: {', '.join(rest)}"


def main() -> None:
    asked = [each for each in sys.argv[1:] if each != "--friction"]
    for name, read in machines():
        if not asked or asked[0] in name:
            try:
                machine = read()
                line = compared(rubbing(machine, 0.05) if "--friction" in sys.argv else machine)
            except (LinkwrightError, ValueError, KeyError) as error:
                line = f"left out: {str(error).splitlines()[0]}"
            print(f"{name:<40} {line}", flush=True)


if __name__ == "__main__":
    main()

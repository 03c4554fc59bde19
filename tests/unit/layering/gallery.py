"""Layers of all machines of the gallery, checked: ``python -m tests.unit.layering.gallery [NAME …]``.

Of every machine, supported on one side and on both: how many layers, or what contradicts; seconds for solids and gaps
and for the search. That nothing overlaps in a layer is checked by shapely at 180 positions, that a layer less is not
enough by orders, not by the integer program that found them.
"""

import sys
from collections.abc import Iterable
from math import inf
from time import perf_counter
from typing import get_args

from tests.unit.layering.bounds import below_a_lid, problem_of
from tests.unit.layering.overlaps import Oracle

import linkwright as lw
from linkwright.layering.orders import any_layers
from linkwright.layering.search import arrange
from linkwright.mechanism.construction import Supports


def main(names: Iterable[str]) -> int:
    """Prints a line for every machine; how many failed a check."""
    return sum(_checked(name, supports) for name in names or lw.gallery_names() for supports in get_args(Supports))


def _checked(name: str, supports: Supports) -> bool:
    start = perf_counter()
    try:
        found = lw.layers(lw.load(f"gallery:{name}"), supports=supports)
    except lw.LinkwrightError as error:
        print(f"{name:32} {supports:13} refused: {error}")
        return False
    whole = perf_counter() - start
    problem = problem_of(found)
    start = perf_counter()
    arrange(problem)
    search = perf_counter() - start
    told, failed = _verdict(found), ""
    if found.layer:
        bad = Oracle(found.mechanism, found.solids, 180).collisions(found.layer)
        fewer = any_layers(below_a_lid(problem, found.count - 1 if problem.cover else found.count), inf)
        failed = f" OVERLAP {bad[:2]}" if bad else " FEWER DO" if fewer is not None else ""
    print(f"{name:32} {supports:13} {whole:6.2f} s, search {1e3 * search:6.1f} ms  {told}{failed}", flush=True)
    return bool(failed)


def _verdict(found: lw.Layers) -> str:
    if found.conflicts:
        return "; ".join(str(each.sentence) for each in found.conflicts)
    proved = "" if found.fewest and found.shortest else " (not proved)"
    return f"{found.count} layers, {sum(each.length for each in found.pins):.4g} m of pins{proved}"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

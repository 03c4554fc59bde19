"""``python -m benchmarks.free_curves``: how closely linkages draw letters and the curves of random linkages."""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from linkwright.formula.threads import cores
from linkwright.synthesis.free_curve import search as searching
from linkwright.synthesis.free_curve.atlas import LEVELS, atlas
from linkwright.synthesis.free_curve.linkages import Placed
from linkwright.synthesis.free_curve.target import EVEN, Target, even_points, normal, symmetric_distance
from linkwright.synthesis.free_curve.topology import node_paths, random_structure

Curve = tuple[str, NDArray[np.complex128], bool]
#: Strokes of letters drawn without lifting the pen, on a grid of 4 x 6; "o" after a place rounds that corner.
STROKES = {
    "A": "00 26 40 32 12",
    "B": "00 06 36o 33o 03 33o 40o 00",
    "C": "45 36o 06o 00o 30o 41",
    "D": "00 06 46o 40o 00",
    "E": "46 06 03 33 03 00 40",
    "F": "00 03 33 03 06 46",
    "G": "45 36o 06o 00o 40o 43 23",
    "H": "00 06 03 43 46 40",
    "I": "06 46 26 20 00 40",
    "J": "46 40o 00o 02",
    "K": "00 06 03 46 03 40",
    "L": "06 00 40",
    "M": "00 06 23 46 40",
    "N": "00 06 40 46",
    "O": "20 40o 46o 06o 00o 20",
    "P": "00 06 46o 43o 03",
    "Q": "22 40 20 00o 06o 46o 40o 20",
    "R": "00 06 46o 43o 03 40",
    "S": "45 46o 06o 03o 43o 40o 00o 01",
    "T": "06 46 26 20",
    "U": "06 00o 40o 46",
    "V": "06 20 46",
    "W": "06 10 24 30 46",
    "X": "00 46 23 06 40",
    "Y": "06 23 46 23 20",
    "Z": "06 46 00 40",
}


def letter(strokes: str) -> NDArray[np.complex128]:
    """Points of a letter; rounded corners are quadratic curves between the middles of their sides."""
    given = [(complex(int(each[0]), int(each[1])), each.endswith("o")) for each in strokes.split()]
    points = [given[0][0]]
    for k in range(1, len(given)):
        corner, rounded = given[k]
        if not rounded:
            points.append(corner)
            continue
        before = given[k - 1][0] if not given[k - 1][1] else (given[k - 1][0] + corner) / 2
        after = given[k + 1][0] if not given[k + 1][1] else (given[k + 1][0] + corner) / 2
        t = np.linspace(0, 1, 17)[1:]
        points += list((1 - t) ** 2 * before + 2 * t * (1 - t) * corner + t**2 * after)
    return np.array(points)


def linkage_curves(count: int, seed: int) -> Iterator[Curve]:
    """Whole curves and parts of curves of random six- and eight-bars that the atlas does not have."""
    draw = np.random.default_rng(seed)
    while count:
        dyads = 2 + count % 2
        nodes = random_structure(dyads, 6 + 2 * dyads, draw)
        x = np.concatenate([draw.normal(0.6, 0.7, 2 * (len(nodes) // 4 - 2)), np.zeros(3)])
        closed = count % 4 < 2
        first, span = draw.uniform(0, 6), draw.uniform(2, 5)
        crank = np.linspace(0, 2 * np.pi, 401)[:-1] if closed else np.linspace(first, first + span, 300)
        paths = node_paths(nodes, x, crank)[0]
        if node_paths(nodes, x, np.linspace(0, 2 * np.pi, 361))[1] > 0.03 and np.ptp(np.abs(paths[-1])) > 0.3:
            yield f"{2 + 2 * dyads}-bar {count}", paths[-1], closed
            count -= 1


def outline(character: str) -> NDArray[np.complex128]:
    """The longest closed outline of a character of the typeface DejaVu Sans."""
    from matplotlib.textpath import TextPath

    rings = [each[:-1] @ [1, 1j] for each in TextPath((0, 0), character, size=10).to_polygons()]
    return np.asarray(max(rings, key=lambda ring: float(np.abs(np.diff(ring)).sum())))


def curves(names: Sequence[str], outlines: str, linkages: int) -> Iterator[Curve]:
    """Letters drawn in one stroke, outlines of characters, curves of random linkages."""
    for name in names:
        points = letter(STROKES[name])
        yield name, points[:-1] if name == "O" else points, name == "O"
    for name in outlines:
        yield f"<{name}>", outline(name), True
    yield from linkage_curves(linkages, 5)


def curve_distance(a: NDArray[np.complex128], b: NDArray[np.complex128], closed: bool) -> float:
    """The measure: both curves even in arc length, laid on each other by centroid, rms radius and best turn.

    Mean nearest distance from a to b plus that from b to a, in rms radii; mirror images are different curves. It is
    that of EVEN points, as others take it: a curve of n radii that is drawn exactly, but from other points, is up to
    n / EVEN from itself, n / (2 EVEN) in the mean; :meth:`Target.deviation` is that of the lines. A turn
    by δ changes it by 2 δ at most (both mean radii are at most 1), so of the valleys among a turn's 360 degrees only
    those within that of the least can hold it.
    """
    a, b = (normal(even_points(each, EVEN, closed)) for each in (a, b))

    def at(turn: float, step: int = 1) -> float:
        return symmetric_distance(a[::step] * np.exp(1j * turn), b[::step])

    grid = np.arange(360) * (2 * np.pi / 360)
    rough = np.array([at(turn, 5) for turn in grid])
    valley = (rough <= np.roll(rough, 1)) & (rough <= np.roll(rough, -1))
    found: list[float] = []
    for turn in grid[valley & (rough < rough.min() + 2 * grid[1])]:
        bounds: Sequence[float] = (turn - grid[1], turn + grid[1])
        found.append(float(minimize_scalar(at, bounds=bounds, method="bounded", options={"xatol": 1e-7}).fun))
    return min(found)


class _Cores:
    """A clock of processor time: seconds that the process would take alone on all cores."""

    @staticmethod
    def perf_counter() -> float:
        """Seconds."""
        return time.process_time() / cores()


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints a row for each curve and the means."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.free_curves", description=__doc__)
    parser.add_argument("letters", nargs="*", help="letters drawn in one stroke; all where no curves are named")
    parser.add_argument("--outlines", default="", help="characters whose outlines are drawn")
    parser.add_argument("--linkages", type=int, default=0, help="number of curves of random linkages")
    parser.add_argument("--joints", type=int, default=searching.JOINTS[-1], help="most joints")
    parser.add_argument("--seeds", type=int, nargs="+", default=[0], help="seeds, a row for each")
    parser.add_argument("--seconds", type=float, default=15.0, help="time for each curve")
    parser.add_argument("--angle", type=float, default=20.0, help="least transmission angle, deg")
    parser.add_argument("--size", type=float, default=6.0, help="farthest joint, rms radii")
    parser.add_argument("--swinging", action="store_true", help="the input need not turn fully")
    parser.add_argument("--processor", action="store_true", help="measure processor time over all cores")
    options = parser.parse_args(arguments)
    if options.processor:
        searching.time = _Cores  # type: ignore[assignment]
    for level in range(len(LEVELS)):
        atlas(level)
    table = []
    letters = options.letters or ([] if options.outlines or options.linkages else list(STROKES))
    for name, curve, closed in curves(letters, options.outlines, options.linkages):
        for seed in options.seeds:
            row, text = measured(curve, closed, seed, options)
            table.append(row)
            print(f"{name:8s}", text, flush=True)
    for name, over in (("mean", np.mean), ("median", np.median)):
        print(f"{name:8s}", *(f"{each:9.5f}" for each in over(table, 0)))
    print("Four means by 2000 points of each curve, as others measure, and four of the lines themselves.")
    return 0


def measured(
    curve: NDArray[np.complex128], closed: bool, seed: int, options: argparse.Namespace
) -> tuple[list[float], str]:
    """Least errors with up to 5, 8, 10 and 12 joints within the demands, and a line of text."""
    target = Target(curve, closed, math.radians(options.angle), options.size, not options.swinging)
    begin = time.process_time()
    search = searching.Search(target, options.joints, options.seconds, seed)
    designs, best = search.run(), dict.fromkeys(searching.JOINTS, (math.inf, math.nan, math.nan, math.inf))
    spent = time.process_time() - begin
    for each in designs:
        judged = target.judged(each, 3601)
        least, size = node_paths(each.nodes, each.x, judged)[1], Placed(each, target).size()
        angle = math.degrees(math.asin(math.sqrt(max(least, 0))))
        if angle >= options.angle and size <= options.size:
            drawn = Placed(each, target).curve(8000)
            row = curve_distance(drawn, curve, closed), angle, size, target.deviation(each)[0]
            best |= {most: min(best[most], row) for most in searching.JOINTS if each.joints <= most}
    cells = [f"{error:9.5f} ({angle:4.1f} deg, {size:3.1f})" for error, angle, size, _ in best.values()]
    return [each[k] for k in (0, 3) for each in best.values()], "".join(
        cells
    ) + f"  {search.attempts} attempts, {spent:.0f} CPU s"


if __name__ == "__main__":
    raise SystemExit(main())

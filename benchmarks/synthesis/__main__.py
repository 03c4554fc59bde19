"""``python -m benchmarks.synthesis``: what Linkwright and general optimisers make of the same demands."""

from __future__ import annotations

import argparse
import math
import time
import warnings
from collections.abc import Sequence

import numpy as np

import linkwright as lw
from benchmarks.synthesis.cases import NINE, Case, hidden, published
from benchmarks.synthesis.others import OTHERS, Best, Enough, facts

GOAL = 1e-3


class Clock:
    """Seconds of each stretch: of the processor, and on the wall."""

    def __init__(self) -> None:
        self.processor: list[float] = []
        self.wall: list[float] = []

    def __enter__(self) -> None:
        self.began = time.process_time(), time.perf_counter()

    def __exit__(self, *_: object) -> None:
        self.processor.append(time.process_time() - self.began[0])
        self.wall.append(time.perf_counter() - self.began[1])

    def __str__(self) -> str:
        return f"median {np.median(self.processor):.3f} CPU s, {np.median(self.wall):.3f} s on the wall"


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.synthesis", description=__doc__)
    parser.add_argument("--seeds", type=int, default=10, help="seeds of every published path")
    parser.add_argument("--hidden", type=int, default=50, help="hidden four-bars")
    parser.add_argument("--others", type=int, default=5, help="hidden four-bars given to the other optimisers")
    parser.add_argument("--limit", type=float, default=30.0, help="seconds for each of them")
    parser.add_argument("--nine", type=int, default=0, help="hidden four-bars of nine points, of each kind")
    parser.add_argument("--loops", type=int, default=0, help="triangles around which the start set is carried")
    options = parser.parse_args(arguments)
    warnings.simplefilter("ignore")
    for case in published() if options.seeds else ():
        print(_published(case, options.seeds), flush=True)
    print(_poses(1000), flush=True)
    if options.hidden:
        print(_hidden(options.hidden), flush=True)
    for name in OTHERS if options.others else ():
        print(_other(name, options.others, options.limit), flush=True)
    for kind in NINE if options.nine else ():
        print(_nine(options.nine, kind), flush=True)
    if options.loops:
        print(_loops(options.loops), flush=True)
    return 0


def _published(case: Case, seeds: int) -> str:
    """The least error of the candidates; errors within a quarter of a per cent are ranked by transmission angle."""
    errors, clock, found = [], Clock(), None
    for seed in range(seeds):
        with clock:
            found = lw.path_generation(case.points, seed=seed, **case.demands)
        sound = [each.error for each in found if not each.defects]
        errors.append(min(sound, default=found.best.error))
    assert found is not None
    best, reached = found.best, sum(error <= case.best * (1 + 1e-6) for error in errors)
    return (
        f"{case.name}: best {min(errors):.8g}, worst {max(errors):.8g}; published {case.best:.8g} reached by "
        f"{reached} of {seeds} seeds; {clock}; {_angles([best.transmission_angle])}; "
        f"defects {', '.join(best.defects) or 'none'}"
    )


def _hidden(count: int) -> str:
    lw.path_generation(hidden(0).points, **hidden(0).demands)
    errors, angles, defects, clock = [], [], 0, Clock()
    for seed in range(count):
        case = hidden(seed)
        with clock:
            best = lw.path_generation(case.points, **case.demands).best
        size = np.sqrt(np.mean(np.abs(case.points - case.points.mean()) ** 2))
        errors.append(math.sqrt(best.error / len(case.points)) / float(size))
        angles.append(best.transmission_angle)
        defects += bool(best.defects)
    reached = sum(error <= GOAL for error in errors)
    return (
        f"hidden four-bars, 36 timed points: {reached} of {count} within 0.1 %, worst error {max(errors):.2g}; "
        f"{clock}, slowest {max(clock.processor):.3f} CPU s; {_angles(angles)}; {defects} with defects"
    )


def _angles(angles: Sequence[float]) -> str:
    degrees = np.degrees(angles)
    if len(degrees) == 1:
        return f"μ {degrees[0]:.1f}°"
    return f"μ {degrees.min():.1f}° to {degrees.max():.1f}°, median {np.median(degrees):.1f}°"


def _other(name: str, count: int, limit: float) -> str:
    errors, reached, angles, defects, clock = [], [], [], 0, Clock()
    for seed in range(count):
        case, best = hidden(seed), Best(GOAL, limit)
        try:
            with clock:
                OTHERS[name](case, best, seed)
        except Enough:
            errors.append(best.error)
            reached.append(best.seconds)
        except ImportError as error:
            return f"{name}: {error}"
        known = facts(case, best)
        if known is not None:
            angles.append(float(known.transmission[0]))
            defects += not known.sound[0]
    within = sum(math.isfinite(each) for each in reached)
    return (
        f"{name}: {within} of {count} within 0.1 % in {limit:g} s each, median {np.median(reached):.2f} CPU s to "
        f"there ({clock}); worst error {max(errors):.2g}; {_angles(angles)}; {defects} with defects"
    )


def _poses(count: int) -> str:
    """Five poses of hidden four-bars: is the hidden pair among the solutions?"""
    from linkwright.synthesis.motion_generation.burmester import five_poses

    rng = np.random.default_rng(1)
    p, phi, pins = [], [], []
    while len(p) < count:
        a, b, c = rng.uniform(0.3, 2.0, 3)
        pin = a * np.exp(1j * np.sort(rng.uniform(0, 2 * np.pi, 5)))
        reach = np.abs(1 - pin)
        cosine = (reach**2 + b * b - c * c) / (2 * reach * b)
        if np.abs(cosine).max() > 0.99:
            continue
        turn = (1 - pin) / reach * np.exp(1j * np.arccos(cosine))
        p.append(pin + complex(*rng.normal(0, 1, 2)) * turn)
        phi.append(np.angle(turn))
        pins.append((pin[0], pin[0] + b * turn[0]))
    places, angles = np.array(p), np.array(phi)
    begin = time.perf_counter()
    z, _, real, _ = five_poses(places, angles)
    seconds = time.perf_counter() - begin
    off = np.abs(z[:, None] - (np.array(pins) - places[:, :1])[:, :, None])
    nearest = np.where(real[:, None], off, np.inf).min(2).max(1)
    each, hits = 1e3 * seconds / count, int((nearest < 1e-6).sum())
    return f"five poses: {hits} of {count} hidden ones found, {each:.3f} ms each"


def _nine(count: int, kind: str) -> str:
    """Nine points of hidden four-bars: are all classes found, and the hidden one among the real ones?"""
    from linkwright.synthesis.path_generation.nine_points import class_keys, is_real, nine_points

    complete = found = lost = 0
    clock = Clock()
    for seed in range(count):
        points, dyads = NINE[kind](seed)
        with clock:
            result = nine_points(points)
        complete += result.complete
        lost += result.lost
        wanted = class_keys(np.concatenate([dyads / result.scale, np.zeros(8)])[None])
        real = result.solutions[is_real(result.solutions)]
        found += bool(len(real)) and bool(np.abs(class_keys(real) - wanted).min() < 1e-6)
    return (
        f"nine points, {kind}: the hidden four-bar found in {found} of {count}, all 1442 classes in {complete}, "
        f"{lost} paths lost at first; {clock}, slowest {max(clock.processor):.2f} CPU s"
    )


def _loops(count: int) -> str:
    """Saturation: the start set carried around random triangles comes back to itself.

    Were classes missing, a loop that permutes all classes freely would leave the known ones among themselves with a
    probability of 1/1443 at most.
    """
    from linkwright.synthesis.path_generation.nine_points import around, class_keys, new_classes, start_set

    q, u = start_set()
    new = twice = lost = moved = 0
    begin = time.process_time()
    for seed in range(count):
        ends, missing = around(q, u, np.random.default_rng(seed))
        new += len(new_classes(ends, class_keys(u)))
        twice += len(ends) - len(new_classes(ends, np.empty(0, complex)))
        lost += missing
        moved += int((np.abs(class_keys(ends[: len(u)]) - class_keys(u)[: len(ends)]) > 1e-6).sum())
    seconds = time.process_time() - begin
    return (
        f"start set around {count} triangles: {3 * count * len(u)} paths, {new} new classes, {twice} ends twice, "
        f"{lost} lost, {moved / count:.0f} of {len(u)} classes exchanged each time; {seconds:.1f} CPU s"
    )


if __name__ == "__main__":
    raise SystemExit(main())

"""All assignments of layers tried one after the other, as the demands on them are stated in words."""

from collections.abc import Iterator, Mapping
from itertools import product

from linkwright.layering.problem import Apart, Fixed, Level, Problem

Found = tuple[int, int, int]


def layers_of(problem: Problem, name: str, layer: Mapping[str, int], top: int) -> tuple[set[int], set[int]]:
    """The layers of a body and those of its heads."""
    fixed = {each.plate: each.layer for each in problem.demands if isinstance(each, Fixed)}
    walls = {plate for plate, level in fixed.items() if level is None}
    plates = problem.bodies[name]
    if plates == (name,) and name in walls:
        return set(range(top + 1)), set()
    at = [layer[each] for each in plates if each not in walls or each == problem.base]
    heads = {min(at) - 1, max(at) + 1} - {-1}
    return set(range(min(at), max(at) + 1)), heads - {top + 1} if problem.cover else heads


def holds(problem: Problem, layer: Mapping[str, int], top: int) -> bool:
    """Whether an assignment keeps all demands."""
    fixed = {each.plate: each.layer for each in problem.demands if isinstance(each, Fixed)}
    for plate, at in layer.items():
        level = {each.second for each in problem.demands if isinstance(each, Level) and each.first == plate}
        if any(layer[each] != at for each in level if None not in (fixed.get(each, 0), fixed.get(plate, 0))):
            return False
        if fixed.get(plate) is not None and fixed[plate] != at:
            return False
        low = 0 if plate == problem.base else top if plate == problem.cover else 1
        high = 0 if plate == problem.base else top if plate == problem.cover or not problem.cover else top - 1
        if not low <= at <= high:
            return False
    for each in problem.demands:
        if isinstance(each, Apart):
            sets = zip((each.first, each.second), each.parts, strict=True)
            one, other = (layers_of(problem, name, layer, top)[part == "heads"] for name, part in sets)
            if one & other:
                return False
    return True


def measure(problem: Problem, layer: Mapping[str, int], top: int) -> Found:
    """How many layers, how many of them bodies reach through, and the sum of the layers of plates."""
    reached = [layers_of(problem, name, layer, top)[0] for name in problem.bodies]
    return top, sum(map(len, reached)), sum(layer.values())


def assignments(problem: Problem, top: int) -> Iterator[dict[str, int]]:
    """All assignments with so many layers that keep the demands."""
    walls = {each.plate for each in problem.demands if isinstance(each, Fixed) and each.layer is None}
    plates = [each for each in problem.plates if each not in walls or each == problem.base]
    for each in product(range(top + 1), repeat=len(plates)):
        layer = dict(zip(plates, each, strict=True))
        if holds(problem, layer, top):
            yield layer


def best(problem: Problem, most: int) -> Found | None:
    """The fewest layers, then the least layers reached through; None where so many are not enough."""
    for top in range(1, most + 1):
        found = [measure(problem, layer, top) for layer in assignments(problem, top)]
        if found:
            return min(found)
    return None

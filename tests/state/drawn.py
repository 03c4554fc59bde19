"""Random mechanisms from fixed seeds: links and groups of all kinds, limits, gears, loops, loads."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from tests.reference.geared_loops import looped_case
from tests.reference.geared_mechanisms import geared_case
from tests.reference.general_case import general_case
from tests.reference.random_mechanisms import random_case
from tests.state import machines
from tests.state.machines import Machine
from tests.state.rows import Entries, attempt

import linkwright as lw

STEPS = 24
#: Kinds of random mechanisms: how many, and the text by its number.
KINDS: Mapping[str, tuple[int, Callable[[int], str]]] = {
    "groups": (130, lambda seed: random_case(1000 + seed, with_loads=True).text),
    "general": (100, lambda seed: general_case(2000 + seed).text),
    "geared": (40, lambda seed: geared_case(3000 + seed).text),
    "looped": (30, lambda seed: looped_case(4000 + seed).text),
}
#: Of the random mechanisms with wheels every so manyth gives its metrics, which take long.
METRICS_OF = {"geared": 5, "looped": 3}


def drawn(subject: str) -> Entries:
    """Motion, forces, metrics and limits of one subject ``kind number``."""
    kind, number = subject.split()
    machine = Machine(lw.loads(KINDS[kind][1](int(number))), STEPS)
    for part in ("structure", "motion", "forces"):
        yield from attempt(part, lambda part=part: machines.PARTS[part](machine))
    if int(number) % METRICS_OF.get(kind, 1) == 0:
        yield from attempt("metrics", lambda: asked(machine))
        yield from attempt("limits", lambda: limits(machine))
    yield from attempt("ranges", lambda: machines.ranges(machine))


def asked(machine: Machine) -> Entries:
    """The metrics that apply, without their places."""
    for row in lw.metrics(machines.solved(machine)).data():
        yield f"{row['metric']}/{row['subject']}", row["unit"] or "", row["value"]


def limits(machine: Machine) -> Entries:
    """Limit positions of the links."""
    for link in machine.mechanism.links:
        yield from attempt(link, lambda link=link: machines.limits_of(machine, link))


def subjects() -> tuple[str, ...]:
    return tuple(f"{kind} {number}" for kind, (most, _) in KINDS.items() for number in range(most))

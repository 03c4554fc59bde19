"""Every gallery file: its standard diagrams are drawn without a warning, or refused with a sentence.

Those of forces are drawn of every second file in turn.
"""

import re
from importlib.resources import files

import numpy as np
import pytest

import linkwright as lw
from linkwright.errors import LinkwrightError
from linkwright.plot import plot

NAMES = sorted(
    each.name.removesuffix(".yaml")
    for each in files("linkwright.gallery").iterdir()
    if each.name.endswith(".yaml")
)
#: Kinds that are written as pictures, two of them for every file, in turn; all others are laid out only.
WRITTEN = ("sva", "reactions", "hodograph", "paths", "acceleration_polygon", "torque")
OF_MOTION = ("sva", "angles", "paths")
OF_FORCES = ("torque", "power", "energy", "speed", "reactions", "hodograph", "shaking", "force_polygon")
#: What a refusal may say: the diagram makes no sense for the machine.
REASONS = (
    "has no driver|carries a force|mean torque|no link of|one turning driver|does not turn at constant"
    "|is not whole turns|does not reach all|change point"
)


@pytest.fixture(scope="module", params=NAMES)
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def motion(name: str) -> lw.Motion:
    return lw.solve_motion(lw.load(f"gallery:{name}"), steps=120, failures="mark")


@pytest.fixture(scope="module")
def written(name: str) -> set[str]:
    turn = NAMES.index(name)
    return {WRITTEN[turn % 6], WRITTEN[(turn + 3) % 6]}


def drawn(result: object, kind: str, written: set[str], **options: object) -> bool:
    """Whether a diagram is drawn; a refusal must be one of those that are meant."""
    try:
        diagram = plot(result, kind, **options)  # type: ignore[arg-type]
    except LinkwrightError as problem:
        refusal = str(problem)
    else:
        refusal = ""
    if refusal:
        assert re.search(REASONS, refusal), refusal
        return False
    if kind in written:
        assert diagram.svg().rstrip().endswith("</svg>")
    return True


def test_motion_is_drawn(motion: lw.Motion, written: set[str]) -> None:
    made = [drawn(motion, kind, written) for kind in OF_MOTION]
    assert made[0] == bool(motion.mechanism.drivers)


def test_polygons_are_drawn(motion: lw.Motion, written: set[str]) -> None:
    if not motion.mechanism.drivers:
        return
    good = int(np.flatnonzero(motion.ok)[len(np.flatnonzero(motion.ok)) // 3])
    steady = all(type(driver.law).__name__ == "ConstantSpeed" for driver in motion.mechanism.drivers.values())
    place = float((motion.input if steady else motion.time)[good])
    for kind in ("velocity_polygon", "acceleration_polygon"):
        assert drawn(motion, kind, written, at=place)


def test_forces_are_drawn(name: str, motion: lw.Motion, written: set[str]) -> None:
    forces = lw.solve_forces(motion)
    made = {kind: drawn(forces, kind, written) for kind in OF_FORCES[NAMES.index(name) % 2 :: 2]}
    masses = any(link.mass for link in motion.mechanism.links.values())
    if (masses or motion.mechanism.loads) and motion.mechanism.drivers:
        assert all(made[kind] for kind in ("torque", "power", "reactions", "hodograph") if kind in made)

"""Every gallery file: its standard diagrams, in turn, are drawn without a warning or refused with a sentence."""

import re
from importlib.resources import files

import numpy as np
import pytest
from tests.gallery_turns import in_turn

import linkwright as lw
from linkwright.errors import LinkwrightError
from linkwright.plot import plot

NAMES = sorted(
    each.name.removesuffix(".yaml")
    for each in files("linkwright.gallery").iterdir()
    if each.name.endswith(".yaml")
)
#: Kinds that are written as pictures, one of each test in turn; all others are laid out only.
POLYGONS = ("velocity_polygon", "acceleration_polygon")
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
def turn(name: str) -> int:
    return NAMES.index(name)


def drawn(result: object, kind: str, written: bool = False, **options: object) -> bool:
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
    if written:
        assert diagram.svg().rstrip().endswith("</svg>")
    return True


def test_motion_is_drawn(motion: lw.Motion, turn: int) -> None:
    for k, kind in enumerate(in_turn(OF_MOTION, turn, 1)):
        assert drawn(motion, kind, turn % 4 == k) == bool(motion.mechanism.drivers) or kind != "sva"


def test_polygons_are_drawn(motion: lw.Motion, turn: int) -> None:
    if not motion.mechanism.drivers:
        return
    good = int(np.flatnonzero(motion.ok)[len(np.flatnonzero(motion.ok)) // 3])
    steady = all(type(driver.law).__name__ == "ConstantSpeed" for driver in motion.mechanism.drivers.values())
    place = float((motion.input if steady else motion.time)[good])
    for k, kind in enumerate(in_turn(POLYGONS, turn, 1)):
        assert drawn(motion, kind, turn % 5 == k, at=place)


def test_forces_are_drawn(motion: lw.Motion, turn: int) -> None:
    forces = lw.solve_forces(motion)
    kinds = in_turn(OF_FORCES, turn, 2)
    made = {kind: drawn(forces, kind, turn % 5 == k) for k, kind in enumerate(kinds)}
    masses = any(link.mass for link in motion.mechanism.links.values())
    if (masses or motion.mechanism.loads) and motion.mechanism.drivers:
        assert all(made[kind] for kind in ("torque", "power", "reactions", "hodograph") if kind in made)

"""A closed form of a package: ratio and torque by hand, refused where its root is negative or vanishes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from tests.contract.elements_for_a_while import taken_away
from tests.refusals import refused

import linkwright as lw
from linkwright.groups import DYADS
from linkwright.groups.base import Solved
from linkwright.topology import Group

GEARS = """
format: 1
name: external gears
frame: {{points: {{O: [0 m, 0 m], Q: [1 m, 0 m]}}}}
links:
  pinion: {{points: {{O: [0 m, 0 m], P: [0.2 m, 0 m]}}, mass: 1 kg, inertia: {unit} kg·m²}}
  wheel: {{points: {{Q: [0 m, 0 m], W: [{root} m, 0 m]}}, mass: 1 kg}}
joints:
  packaged: {{kind: gear, links: [pinion, wheel], teeth: [20, 40]}}
driver: {{turn: pinion, about: O, speed: 1 rad/s}}
loads:
  work: {{kind: torque, on: wheel, magnitude: 40 N·m}}
"""
UNITS = ["1e-12", "1", "1e12"]
#: What the package says; it stands in what the user reads.
REASON = "the wheels stand too far apart"


class Meshing:
    """Two external wheels on the frame: wheel = -1/2 pinion, as if under a root of ``wheel.W.x`` in some unit."""

    signature = "RG"
    words = ("", "")

    def fits(self, group: Group) -> bool:
        return [cut.joint for cut in group.cuts] == ["packaged"]

    def place(self, tracer: Any, group: Group) -> Solved:
        unit = tracer.dimensions("pinion.inertia")
        root = tracer.dimensions("wheel.W.x")
        return Solved((-0.5 * tracer.angles("pinion"),), 1.0, root * unit, unit)

    def explain(self, facts: object) -> str:
        return REASON


@pytest.fixture(autouse=True, scope="module")
def registered() -> Iterator[None]:
    DYADS.register("meshing")(Meshing)
    yield
    taken_away(DYADS, "meshing")


def gears(root: str, unit: str) -> lw.Mechanism:
    return lw.loads(GEARS.format(root=root, unit=unit))


@pytest.mark.parametrize("unit", UNITS)
def test_it_places_its_links(unit: str) -> None:
    forces = lw.solve_forces(gears("0.5", unit), steps=24)
    turned = forces.motion.link("wheel").angle
    assert turned - turned[0] == pytest.approx(-0.5 * forces.motion.time, abs=1e-13)
    assert forces.motion.link("wheel").angular_velocity == pytest.approx(-0.5, abs=1e-14)
    assert forces.input_torque == pytest.approx(20.0, rel=1e-12)


@pytest.mark.parametrize("unit", UNITS)
def test_it_says_why_its_links_do_not_reach(unit: str) -> None:
    with refused("motion.refused", lw.PositionError, name="external gears", failed=4) as caught:
        lw.solve_motion(gears("-0.5", unit), steps=4)
    assert (caught.value.outcome.kind, caught.value.outcome.group) == ("unreachable", "wheel")
    assert REASON in str(caught.value)


@pytest.mark.parametrize("unit", UNITS)
def test_it_is_singular_where_its_root_vanishes(unit: str) -> None:
    with refused("motion.refused", lw.PositionError, name="external gears", failed=4) as caught:
        lw.solve_motion(gears("1e-14", unit), steps=4)
    assert (caught.value.outcome.kind, caught.value.outcome.group) == ("singular", "wheel")

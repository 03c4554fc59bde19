"""Every gallery model against the numbers that stand in its file: published, closed form, or independent."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pytest

import linkwright as lw
from linkwright import gallery, units

ROMAN = {3: "III", 4: "IV"}
DIMENSIONS = {
    "angle": "angle", "angular_velocity": "angular_velocity", "angular_acceleration": "angular_acceleration",
    "position": "length", "velocity": "velocity", "acceleration": "acceleration", "force": "force",
    "magnitude": "force", "direction": "angle",
}  # fmt: skip


def quantity(text: str, dimension: str) -> tuple[float, float]:
    """SI value, and one unit of its last printed digit."""
    number, _, unit = text.partition(" ")
    decimals = len(number.partition(".")[2])
    return units.parse(text, dimension), units.parse(f"{10.0**-decimals:.{decimals}f} {unit}", dimension)


def agree(found: float, text: str, dimension: str, *, where: str) -> None:
    value, digit = quantity(text, dimension)
    error = found - value
    if dimension == "angle":
        error = math.remainder(error, 2 * math.pi)
    assert abs(error) <= 1.001 * digit, f"{where}: {found!r}, the file says {text}"


def states() -> Iterator[Any]:
    for name in gallery.names():
        for number, state in enumerate(lw.load(f"gallery:{name}").expected.get("states", ())):
            place = state.get("input") or state.get("time") or "at rest"
            yield pytest.param(name, state, id=f"{name}-{number}-{place}")


STATES = list(states())


def solved(name: str, state: Mapping[str, Any]) -> Any:
    mechanism = lw.load(f"gallery:{name}")
    if "time" in state:
        return lw.solve_motion(mechanism, times=[units.parse(state["time"], "time")])
    if "input" in state:
        return lw.solve_motion(mechanism, at=[units.parse(state["input"], "angle")])
    return lw.solve_motion(mechanism)


@pytest.mark.parametrize("name", gallery.names())
def test_structure(name: str) -> None:
    expected = lw.load(f"gallery:{name}").expected
    found = lw.structure(lw.load(f"gallery:{name}"))
    assert found.mobility == expected["mobility"]
    assert found.grubler == expected.get("grubler", expected["mobility"])
    if "groups" in expected:
        groups = [group for group in found.groups if group.assur_class > 1]
        words = [
            group.signature
            if group.assur_class == 2
            else f"class {ROMAN[group.assur_class]}, order {group.assur_order}"
            for group in groups
        ]
        assert sorted(words) == sorted(expected["groups"])
        assert max(group.assur_class for group in groups) == expected["class"]


@pytest.mark.parametrize(("name", "state"), STATES)
def test_motion(name: str, state: Mapping[str, Any]) -> None:
    motion = solved(name, state)
    for link, numbers in state.get("links", {}).items():
        for what, text in numbers.items():
            agree(getattr(motion.link(link), what)[0], text, DIMENSIONS[what], where=f"{link}.{what}")
    for point, numbers in state.get("points", {}).items():
        for what, pair in numbers.items():
            for axis, found, text in zip("xy", getattr(motion.point(point), what)[0], pair, strict=True):
                agree(found, text, DIMENSIONS[what], where=f"{point}.{what}.{axis}")


@pytest.mark.parametrize(("name", "state"), STATES)
def test_forces(name: str, state: Mapping[str, Any]) -> None:
    if not {"reactions", "efforts", "input_torque"} & set(state):
        pytest.skip("the file has no forces at this position")
    forces = lw.solve_forces(solved(name, state))
    for joint, numbers in state.get("reactions", {}).items():
        found = forces.reaction(joint, on=numbers["on"])[0]
        for axis, value, text in zip("xy", found, numbers.get("force", ()), strict=False):
            agree(value, text, "force", where=f"{joint}.{axis}")
        if "magnitude" in numbers:
            agree(float(np.hypot(*found)), numbers["magnitude"], "force", where=joint)
            agree(math.atan2(found[1], found[0]), numbers["direction"], "angle", where=f"{joint} direction")
    for driver, text in state.get("efforts", {}).items():
        kind = "torque" if text.endswith("N·m") else "force"
        agree(forces.driver_effort(driver)[0], text, kind, where=driver)
    if "input_torque" in state:
        agree(forces.input_torque[0], state["input_torque"], "torque", where="input torque")

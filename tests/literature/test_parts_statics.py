"""Force systems, bodies, belts and wedges against closed forms; printed numbers are compared in test_published."""

import math

import numpy as np
import pytest

import linkwright as lw
from linkwright import parts


def test_wrench_carries_the_same_moments() -> None:
    forces = {
        "a": parts.Force(force=(3, -1, 2), at=(0.2, 1, -0.4)),
        "b": parts.Force(force=(-1, 4, 0.5), at=(1, 0.3, 2)),
    }
    found = parts.ForceSystem(forces, {"c": (0.1, 2, -1)}, about=(0.5, 0.5, 0.5)).solve()
    for place in np.random.default_rng(3).normal(size=(4, 3)):
        whole = sum(np.cross(f.place - place, f.vector) for f in forces.values()) + np.array([0.1, 2, -1])
        wrench = np.cross(found.axis_point - place, found.force) + found.pitch * found.force
        assert wrench == pytest.approx(whole, abs=1e-12)


def test_two_bars_as_structure() -> None:
    """Six reactions of the lecture's two bars, by moments about C."""
    found = parts.equilibrium(lw.load("gallery:two_bars_equilibrium"))
    a_y = (250 + 100 * math.sqrt(3)) / (1 + math.sqrt(3))
    assert found.reaction("A", "bar_1") == pytest.approx([250 - a_y, a_y], abs=1e-9)
    assert found.reaction("B", "bar_2") == pytest.approx([a_y - 250, 300 - a_y], abs=1e-9)
    assert found.reaction("C", "bar_2") == pytest.approx([250 - a_y, a_y - 200], abs=1e-9)


def test_bracket() -> None:
    values = parts.load("gallery:bracket").solve().values
    assert values["B.S"] == pytest.approx(600, abs=1e-9)
    assert values["A.Fx"] == pytest.approx(300 * math.sqrt(3), abs=1e-9)
    assert values["A.Fy"] == pytest.approx(300, abs=1e-9)


def test_body_in_space_on_three_feet_and_three_guides() -> None:
    """A table: each foot carries its share by the centroid's barycentric coordinates."""
    feet = {"A": (0.0, 0.0, 0.0), "B": (2.0, 0.0, 0.0), "C": (0.0, 1.0, 0.0)}
    supports = {name: parts.Support(at=at, along=(0, 0, 1)) for name, at in feet.items()}
    supports["guide"] = parts.Support(at=(0.0, 0.0, 0.0), holds=("x", "y", "turn_z"))
    body = parts.RigidBody(supports, {"W": parts.Force(force=(0, 0, -100), at=(0.5, 0.25, 1.0))})
    values = body.solve().values
    assert [values[f"{n}.S"] for n in "ABC"] == pytest.approx([50, 25, 25], abs=1e-9)


def test_belt_brake_and_v_belt() -> None:
    brake = parts.load("gallery:band_brake").solve()
    ratio = math.exp(0.3 * math.radians(225))
    assert brake.tight / brake.slack == pytest.approx(ratio, rel=1e-12)
    assert brake.tight - brake.slack == pytest.approx(1500, rel=1e-12)
    vee = parts.Belt(
        friction=0.3, wrap=math.pi, groove=math.radians(38), tight=500, mass=0.2, speed=20
    ).solve()
    assert (500 - 80) / (vee.slack - 80) == pytest.approx(
        math.exp(0.3 * math.pi / math.sin(math.radians(19)))
    )


def test_wedge_without_friction_is_an_inclined_plane() -> None:
    found = parts.Wedge(load=1000, angle=0.2, friction=0.0).solve()
    assert found.raising == pytest.approx(1000 * math.tan(0.2), rel=1e-12)
    assert found.lowering == pytest.approx(found.raising, rel=1e-12)
    assert found.efficiency == pytest.approx(1.0)


@pytest.mark.parametrize("sense", [1, -1])
def test_wedge_against_the_balance_of_forces(sense: int) -> None:
    """Normal and friction forces on load and wedge as unknowns of one linear system."""
    load, angle, slope, floor, wall = 800.0, 0.15, 0.2, 0.1, 0.25
    s, c = math.sin(angle), math.cos(angle)
    f1, f2, f3 = (sense * each for each in (slope, floor, wall))
    # unknowns: normal on the slope, on the floor, on the wall, push on the wedge
    balance = [
        [-s - f1 * c, 0, 1, 0],
        [c - f1 * s, 0, -f3, 0],
        [s + f1 * c, f2, 0, -1],
        [-c + f1 * s, 1, 0, 0],
    ]
    push = np.linalg.solve(balance, [0, load, 0, 0])[3]
    assert parts.Wedge(load, angle, slope, floor, wall).push(sense) == pytest.approx(push, rel=1e-12)


def test_wedge_locks_where_the_angle_is_below_both_friction_angles() -> None:
    limit = 2 * math.atan(0.15)
    assert parts.Wedge(1.0, 0.99 * limit, 0.15).solve().locks
    assert not parts.Wedge(1.0, 1.01 * limit, 0.15).solve().locks

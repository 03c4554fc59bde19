"""Assemblies that nearly coincide, cycles walked backwards, several drivers, drivers on inner joints.

Each against the independent code followed in tiny steps, or against all roots that it finds.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from tests.reference.adapter import reference_system
from tests.reference.assemblies import distance, other_assemblies
from tests.reference.fine_path import FinePath

import linkwright as lw

Vec = np.ndarray[Any, np.dtype[np.float64]]


def worst(motion: Any, path: FinePath, every: int = 1) -> float:
    """Largest difference of a link's direction at positions that the path, ``every`` times as fine, reaches."""
    found = {name: path.direction(name)[::every] for name in motion.mechanism.links}
    return max(float(np.abs(motion.link(name).direction[: len(rows)] - rows).max()) for name, rows in found.items())


@cache
def fine_path(text: str, steps: int, backwards: bool = False) -> FinePath:
    """The fine path through the positions of a cycle in so many steps, or those before it."""
    mechanism = lw.loads(text)
    time = lw.solve_motion(mechanism, steps=steps, failures="mark").time
    return FinePath(mechanism, -time if backwards else time)


def reached(path: FinePath, every: int) -> int:
    """How many positions a motion of fewer steps reaches."""
    return -(-path.reached // every)


# nearly coinciding --------------------------------------------------------------------------------------
PLATE = """
format: 1
name: plate on three bars
frame: {{points: {{O1: [0 m, 0 m], O2: [1 m, 0 m], O3: [{x!r} m, {y!r} m]}}}}
links:
  crank: {{points: [O1, A], length: 0.2 m}}
  bar_1: {{points: [A, P], length: {first!r} m}}
  bar_2: {{points: [O2, Q], length: {second!r} m}}
  bar_3: {{points: [O3, R], length: 0.5 m}}
  plate: {{points: {{P: [0 m, 0 m], Q: [0.4 m, 0 m], R: [0.15 m, 0.3 m]}}}}
drawing: {drawing}
driver: {{turn: crank, about: O1, speed: 1 rad/s, start: 0.7 rad}}
cycle: {{duration: 0.7 s}}
"""


def written(points: dict[str, Vec]) -> str:
    return "{" + ", ".join(f"{name}: [{float(x)!r} m, {float(y)!r} m]" for name, (x, y) in points.items()) + "}"


def plate(gap: float, drawing: str | None = None) -> str:
    """The third bar's line misses the point where the other two cross by ``gap``: two assemblies lie near."""
    crank = 0.2 * np.array([np.cos(0.7), np.sin(0.7)])
    turn = np.array([[np.cos(0.1), -np.sin(0.1)], [np.sin(0.1), np.cos(0.1)]])
    p = np.array([0.35, 0.55])
    q, r, fixed = p + turn @ [0.4, 0.0], p + turn @ [0.15, 0.3], np.array([1.0, 0.0])
    share = np.linalg.solve(np.stack([p - crank, fixed - q], axis=1), fixed - crank)[0]
    cross = crank + share * (p - crank)
    aside = np.array([r[1] - cross[1], cross[0] - r[0]])
    goal = cross + gap * aside / np.hypot(*aside)
    o3 = r - 0.5 * (goal - r) / np.hypot(*(goal - r))
    return PLATE.format(
        x=float(o3[0]),
        y=float(o3[1]),
        first=float(np.hypot(*(p - crank))),
        second=float(np.hypot(*(q - fixed))),
        drawing=drawing or written({"A": crank, "P": p, "Q": q, "R": r}),
    )


@pytest.mark.parametrize(("gap", "apart"), [(0.0037, 0.01)])
def test_assemblies_a_hundredth_apart_are_told_from_each_other(gap: float, apart: float) -> None:
    text = plate(gap)
    mechanism = lw.loads(text)
    start, others = other_assemblies(mechanism)
    near = min(others, key=lambda q: distance(q, start))
    assert distance(start, near) == pytest.approx(apart, rel=0.05)
    system = reference_system(mechanism)
    names = {
        "A": ("crank", (0.2, 0.0)),
        "P": ("plate", (0.0, 0.0)),
        "Q": ("plate", (0.4, 0.0)),
        "R": ("plate", (0.15, 0.3)),
    }
    place = {}
    for point, (link, (x, y)) in names.items():
        x0, y0, phi = near[system.index[link]]
        place[point] = np.array([x0 + x * np.cos(phi) - y * np.sin(phi), y0 + x * np.sin(phi) + y * np.cos(phi)])
    for drawn in (text, plate(gap, written(place))):
        model = lw.loads(drawn)
        for steps in (6, 60):
            motion = lw.solve_motion(model, steps=steps, failures="mark")
            path = FinePath(model, motion.time)
            assert motion.ok.tolist() == [k < path.reached for k in range(steps + 1)]
            assert worst(motion, path) < 1e-9


# closed cycles ------------------------------------------------------------------------------------------
STEPHENSON = """
format: 1
name: Stephenson III six-bar driven by its output rocker
frame: {points: {O1: [0 mm, 0 mm], O2: [200 mm, 0 mm], O3: [300 mm, 200 mm]}}
links:
  crank: {points: [O1, A], length: 50 mm}
  coupler: {points: [A, B], length: 180 mm, also: {C: [110 mm, 70 mm]}}
  rocker: {points: [O2, B], length: 130 mm}
  bar: {points: [C, D], length: 190 mm}
  output: {points: [O3, D], length: 140 mm}
drawing: {A: [-47.0 mm, 17.1 mm], B: [114.0 mm, 97.5 mm], C: [20.1 mm, 128.9 mm], D: [168.4 mm, 247.7 mm]}
driver: {turn: output, about: O3, speed: SPEED rad/s, start: 160 deg}
"""


@pytest.mark.parametrize(("speed", "steps"), [(1, 60), (1, 360), (-1, 60)])
def test_a_closed_cycle_is_walked_backwards_from_its_first_position_as_well(speed: int, steps: int) -> None:
    text, every = STEPHENSON.replace("SPEED", str(speed)), 360 // steps
    motion = lw.solve_motion(lw.loads(text), steps=steps, failures="mark")
    ahead, behind = fine_path(text, 360), fine_path(text, 360, True)
    there, back = reached(ahead, every), reached(behind, every)
    assert 1 < there < steps / 4 and 1 < back < steps / 4
    assert motion.ok.tolist() == [k < there or steps - k < back for k in range(steps)]
    assert worst(motion, ahead, every) < 1e-9
    order = [0, *range(steps - 1, steps - back, -1)]
    for name in motion.mechanism.links:
        expected = behind.direction(name)[::every]
        assert motion.link(name).direction[order] == pytest.approx(expected, abs=1e-9)
    stops = {outcome.sentence.rsplit("= ", 1)[-1] for outcome in motion.outcomes if not outcome.ok}
    assert len(stops) == 2


def test_positions_asked_for_by_themselves_are_found_the_other_way_round() -> None:
    mechanism = lw.loads(STEPHENSON.replace("SPEED", "1"))
    near = lw.solve_motion(mechanism, at=np.radians([150.0]))
    far = lw.solve_motion(mechanism, at=np.radians([160.0, 510.0, 250.0, 140.0]), failures="mark")
    assert far.ok.tolist() == [True, True, False, True]
    for name in mechanism.links:
        assert far.link(name).direction[1] == pytest.approx(near.link(name).direction[0], abs=1e-12)


# drivers ------------------------------------------------------------------------------------------------
TWO_CRANKS = """
format: 1
name: plate on two cranks
frame: {points: {O1: [0 m, 0 m], O2: [1 m, 0 m], O3: [0.5 m, 1.3 m]}}
links:
  crank_1: {points: [O1, A]}
  crank_2: {points: [O2, C]}
  bar_1: {points: [A, P]}
  bar_2: {points: [C, Q]}
  bar_3: {points: [O3, R]}
  plate: {points: [P, Q, R]}
drawing: {P: [0.28 m, 0.46 m], Q: [0.68 m, 0.5 m], R: [0.47 m, 0.77 m], A: [0.04 m, 0 m], C: [1.04 m, 0 m]}
drivers:
  first: {turn: crank_1, about: O1, speed: 2 rad/s}
  second: {turn: crank_2, about: O2, LAW}
cycle: {duration: 3 s}
"""
INNER = """
format: 1
name: plate lifted by a cylinder and turned by a motor on a bar
frame: {points: {O1: [0 m, 0 m], O2: [1 m, 0 m], O3: [0.5 m, 1.3 m]}}
links:
  bar_1: {points: [O1, P]}
  arm: {points: [O2, K]}
  bar_2: {points: [K, Q]}
  body: {points: [O3, S]}
  rod: {points: [R, T]}
  plate: {points: [P, Q, R]}
joints:
  cylinder: {kind: prismatic, guide: body, through: O3, direction: [O3, S], block: rod, at: R}
drawing:
  {P: [0.28 m, 0.47 m], Q: [0.68 m, 0.5 m], R: [0.5 m, 0.77 m], K: [0.8 m, 0.2 m], S: [0.5 m, 1.2 m],
   T: [0.5 m, 0.6 m]}
drivers:
  lift: {slide: cylinder, position: "0.53 m + 0.05 m*sin(2*pi*t/(2 s))"}
  elbow: {turn: bar_2, about: K, relative_to: arm, position: "ELBOW rad + 0.1 rad*sin(2*pi*t/(1 s))"}
cycle: {duration: 2 s}
"""
ELBOW = np.arctan2(0.3, -0.12) - np.arctan2(0.2, -0.2)
LAWS = (
    "speed: -3 rad/s",
    'position: "0.4 rad*sin(2*pi*t/(1 s))"',
    "table: {time: [0 s, 1 s, 3 s], position: [0 rad, 0.5 rad, -1 rad]}",
)


def follows_the_fine_path(text: str, steps: int) -> None:
    """Positions and refusals are those of the fine path through 120 steps."""
    motion = lw.solve_motion(lw.loads(text), steps=steps, failures="mark")
    path, every = fine_path(text, 120), 120 // steps
    count = reached(path, every)
    assert count > steps / 3 and motion.ok.tolist() == [k < count for k in range(motion.steps)]
    assert worst(motion, path, every) < 1e-9


@pytest.mark.parametrize("steps", [8, 120])
@pytest.mark.parametrize("law", LAWS)
def test_several_drivers_move_one_way(law: str, steps: int) -> None:
    text = TWO_CRANKS.replace("LAW", law)
    assert lw.structure(lw.loads(text)).mechanism_class == 3
    follows_the_fine_path(text, steps)


@pytest.mark.parametrize("steps", [8, 120])
def test_drivers_on_inner_joints_are_part_of_the_group(steps: int) -> None:
    text = INNER.replace("ELBOW", repr(float(ELBOW)))
    (group,) = (g for g in lw.structure(lw.loads(text)).groups if len(g.links) > 2)
    assert set(group.drivers) == {"lift", "elbow"}
    follows_the_fine_path(text, steps)

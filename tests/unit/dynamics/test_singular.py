"""Motion through dead points and change points: energy, closed forms, and the same motion in other coordinates."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.dynamics.models import ELBOWS, ENGINE, bar, windows
from tests.unit.dynamics.course import integrated

import linkwright as lw
from linkwright.core.arrays import Floats
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.singular import SingularPositions

FOUR_BAR = """
format: 1
name: {name}
frame: {{points: {{P: [0 m, 0 m], Q: [{base} m, 0 m]}}}}
links:
  left: {left}
  bar: {bar}
  right: {right}
assembly: {{B: {mode}}}
driver: {{turn: left, about: P, speed: 1 rad/s, start: {start} deg}}
gravity: [0, -9.81 m/s²]
"""


def four_bar(lengths: tuple[float, float, float, float], start: float, mode: str = "left") -> lw.Mechanism:
    """A four-bar of slender bars: base, left, coupler, right."""
    base, left, coupler, right = lengths
    links = {"left": bar("P", "A", left), "bar": bar("A", "B", coupler), "right": bar("Q", "B", right)}
    return lw.loads(FOUR_BAR.format(name="Four-bar", base=base, start=start, mode=mode, **links))


@pytest.mark.parametrize("count", [2, 5])
def test_windows_go_on_through_their_change_points(count: int) -> None:
    """All rods stay parallel: the energy is that of one pendulum; the end for two windows is the printed one."""
    found = integrated(lw.loads(windows(count)), [math.pi / 2], [-1.0], 10.0 if count == 2 else 3.0)
    y = np.concatenate(found.states, axis=1)
    inertia, weight = (count + 1) / 3 + count, ((count + 1) / 2 + count) * 9.81
    energy = 0.5 * inertia * y[1] ** 2 + weight * np.sin(y[0])
    assert np.abs(energy / energy[0] - 1.0).max() < 1e-10
    assert sum(each.point is not None for each in found.stretches) >= (8 if count == 2 else 2)
    if count == 2:
        assert (math.cos(y[0, -1]), math.sin(y[0, -1])) == pytest.approx((0.3284581112, 0.9445185383), abs=2e-9)


def test_forty_windows_have_one_change_point_together() -> None:
    """All forty groups touch zero in one place, and their modes flip together."""
    positions = SingularPositions(EquationOfMotion(lw.loads(windows(40)), flipping=True))
    stretch, _q, _w = positions.first(np.array([0.2]), np.array([-1.0]))
    assert stretch.point is not None
    assert len(stretch.point.modes) == 40
    assert stretch.point.place == pytest.approx(0.0, abs=1e-10)


def by_multipliers(lengths: tuple[float, float, float, float], angles: list[float], end: float) -> Floats:
    """Angles of the three bars at the end of a motion from rest: slender bars of 1 kg, the loop closed by
    multipliers, with no coordinate chosen."""
    base, *own = lengths
    l1, l2, l3 = own
    own_inertia = [each**2 / 12 for each in own]
    mass = np.diag([own_inertia[0] + l1**2 / 4 + l1**2, own_inertia[1] + l2**2 / 4, own_inertia[2] + l3**2 / 4])

    def slopes(t: float, y: Floats) -> Floats:
        (t1, t2, t3), w = y[:3], y[3:]
        m = mass.copy()
        m[0, 1] = m[1, 0] = l1 * l2 / 2 * math.cos(t1 - t2)
        turn = l1 * l2 / 2 * math.sin(t1 - t2)
        force = np.array(
            [
                -turn * w[1] ** 2 - 9.81 * 1.5 * l1 * math.cos(t1),
                turn * w[0] ** 2 - 9.81 * l2 / 2 * math.cos(t2),
                -9.81 * l3 / 2 * math.cos(t3),
            ]
        )
        signed = np.array([l1, l2, -l3])
        c, s = np.cos(y[:3]) * signed, np.sin(y[:3]) * signed
        loop = np.array([-s, c])
        gap = np.array([c.sum() - base, s.sum()])
        bend = np.array([c @ w**2, s @ w**2]) - 200.0 * loop @ w - 1e4 * gap
        matrix = np.block([[m, loop.T], [loop, np.zeros((2, 2))]])
        return np.concatenate([w, np.linalg.solve(matrix, [*force, *bend])[:3]])

    begin = np.array([*angles, 0.0, 0.0, 0.0])
    return solve_ivp(slopes, (0.0, end), begin, method="DOP853", rtol=1e-10, atol=1e-11).y[:3, -1]


@pytest.mark.parametrize(
    ("lengths", "start", "end"), [((4.0, 2.0, 2.0, 3.0), 40.0, 3.0), ((4.0, 3.0, 1.5, 3.0), 70.0, 2.0)]
)
def test_rockers_pass_their_dead_points_in_other_coordinates(
    lengths: tuple[float, float, float, float], start: float, end: float
) -> None:
    """A triple and a double rocker, whose rockers have dead points each, against multipliers."""
    found = integrated(four_bar(lengths, start), [math.radians(start)], [0.0], end)
    assert found.drift < 1e-10
    assert {name for names in found.coordinates for name in names} == {"driver", "right@Q"}
    last = found.stretches[-1].description
    own = last.place(found.states[-1][:1, -1], found.states[-1][1:2, -1])
    begin = found.stretches[0].description.place(found.states[0][:1, 0], found.states[0][1:2, 0])
    links = ("left", "bar", "right")
    other = by_multipliers(lengths, [begin.angles[each] for each in links], end)
    for link, angle in zip(links, other.tolist(), strict=True):
        assert own.links[link][2:] == pytest.approx((math.cos(angle), math.sin(angle)), abs=2e-7)


def test_rockers_keep_their_energy_through_many_dead_points() -> None:
    """Eight seconds with nine changes of coordinates."""
    found = integrated(four_bar((4.0, 2.0, 2.0, 3.0), 40.0), [math.radians(40)], [0.0], 8.0, 1e-13)
    assert found.drift < 2e-11
    assert len(found.stretches) == 10


def test_of_two_freedoms_one_coordinate_is_exchanged() -> None:
    """A chain of four bars between two pins of the frame, both driven: its elbows stretch and fold."""
    found = integrated(lw.loads(ELBOWS), [math.radians(70), math.radians(110)], [0.0, 0.0], 3.0)
    assert found.drift < 1e-10
    assert len(found.stretches) > 4


ON_ARM = f"""
format: 1
frame: {{points: {{O: [0 m, 0 m]}}}}
links:
  arm: {{points: {{O: [0 m, 0 m], P: [1 m, 0 m], Q: [1.7 m, 0 m]}},
        mass: 2 kg, inertia: 0.4 kg·m², mass_centre: [0.8 m, 0 m]}}
  a: {bar("P", "A", 0.4)}
  c: {bar("A", "B", 0.7)}
  b: {bar("Q", "B", 0.4)}
drivers:
  one: {{turn: arm, about: O, speed: 1 rad/s, start: 10 deg}}
  two: {{turn: a, about: P, relative_to: arm, speed: 1 rad/s, start: 60 deg}}
assembly: {{B: right}}
gravity: [0, -9.81 m/s²]
"""


@pytest.mark.parametrize("against", ["arm", "frame"])
def test_a_change_point_moves_with_the_other_coordinate(against: str) -> None:
    """A parallelogram on a turning arm is as a rod of the same mass on it: against the frame its change point is
    where the arm is, not at one angle."""
    text = ON_ARM if against == "arm" else ON_ARM.replace(" relative_to: arm,", "").replace("60 deg", "70 deg")
    start = [math.radians(10), math.radians(60 if against == "arm" else 70)]
    found = integrated(lw.loads(text), start, [0.0, 6.0], 1.5)
    assert found.drift < 1e-9
    assert sum(each.point is not None for each in found.stretches) > 1


def test_a_run_may_begin_at_a_dead_point_from_rest() -> None:
    """The slide of a slider-crank at its end: the crank's angle takes over."""
    found = integrated(lw.loads(ENGINE), [1.1], [0.0], 1.0)
    assert found.coordinates == [["crank@O"]]
    assert found.states[0][0, 0] == pytest.approx(0.0, abs=1e-6)
    assert found.drift < 1e-10


def test_a_speed_at_a_dead_point_is_refused() -> None:
    """The speed of the slide is zero there whatever the crank does."""
    with pytest.raises(lw.LinkwrightError, match="begins at a dead point, at driver = 1100 mm"):
        integrated(lw.loads(ENGINE), [1.1], [1.0], 1.0)


def test_loads_go_by_the_models_driver_in_other_coordinates() -> None:
    """A torsion spring by the driver's angle, given by an expression of the input: its energy, the weights' and the
    kinetic one add up to a constant through dead points."""
    sizes = {"left": 2.0, "bar": 2.0, "right": 3.0}
    links = {k: bar(*ends, sizes[k]) for k, ends in (("left", "PA"), ("bar", "AB"), ("right", "QB"))}
    text = FOUR_BAR.format(name="Sprung", base=4.0, start=40.0, mode="left", **links)
    text += 'loads: {spring: {kind: torque, on: left, magnitude: "-30 N*m*input"}}\n'
    found = integrated(lw.loads(text), [math.radians(40)], [0.0], 4.0)
    assert found.drift < 1e-10
    assert len(found.stretches) > 2
    energies = []
    for stretch, y, kinetic in zip(found.stretches, found.states, found.kinetic, strict=True):
        equation, description = stretch.description.equation, stretch.description
        given = {**description.held, f"q:{equation.names[0]}": y[0], f"qd:{equation.names[0]}": y[1]}
        angle = equation.evaluate(["input:driver"], given, y.shape[1])[0] if equation.replaced else y[0]
        places = [description.place(each[:1], each[1:2]) for each in y.T]
        heights = [
            sum(each.links[k][1] + size / 2 * each.links[k][3] for k, size in sizes.items()) for each in places
        ]
        energies.append(kinetic + 15.0 * angle**2 + 9.81 * np.array(heights))
    total = np.concatenate(energies)
    assert np.ptp(total) < 1e-10 * np.abs(total).max()

"""Two drivers that follow a path: closed inverse kinematics, the textbook's robot equation, power, refusals."""

from __future__ import annotations

import re
from math import cos, pi, sin
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.refusals import faulty, refused

import linkwright as lw

Floats = NDArray[np.float64]
L1, L2, M1, M2, J1, J2, G = 0.5, 0.4, 2.0, 1.0, 0.05, 0.02, 9.81
ROBOT = """
format: 1
name: Robot arm
frame: {points: {O: [0 m, 0 m]}}
links:
  upper: {points: [O, A], length: 0.5 m, mass: 2 kg, inertia: 0.05 kg·m²}
  fore: {points: [A, P], length: 0.4 m, mass: 1 kg, inertia: 0.02 kg·m²}
assembly: {A: left}
gravity: [0, -9.81 m/s²]
drivers:
  one: {turn: upper, about: O}
  two: {turn: fore, about: A, relative_to: upper}
path: PATH
"""
LINE = "{point: fore.P, along: [[0.4 m, 0.2 m], [0.7 m, 0.3 m]], over: 1 s}"
CIRCLE = "{point: fore.P, along: [[0.7 m, 0 m], {about: [0.55 m, 0 m], turn: 360 deg}], speed: 0.3 m/s}"
ROUND_BASE = "{point: fore.P, along: [[0.7 m, 0 m], {about: [0 m, 0 m], turn: -360 deg}], speed: 1 m/s}"


def robot(path: str) -> lw.Mechanism:
    return lw.loads(ROBOT.replace("PATH", path))


def arm(x: Floats, y: Floats, elbow: float = -1.0) -> tuple[Floats, Floats]:
    """Joint angles by the cosine law; ``elbow``: sign of the second."""
    second = elbow * np.arccos((x**2 + y**2 - L1**2 - L2**2) / (2 * L1 * L2))
    return np.arctan2(y, x) - np.arctan2(L2 * np.sin(second), L1 + L2 * np.cos(second)), second


def rates(q1: Floats, q2: Floats, v: Floats, a: Floats) -> tuple[Floats, Floats]:
    """Joint rates and accelerations, (n, 2), by the Jacobian matrix of the arm and its rate."""
    s1, c1, s12, c12 = np.sin(q1), np.cos(q1), np.sin(q1 + q2), np.cos(q1 + q2)
    jacobian = np.array([[-L1 * s1 - L2 * s12, -L2 * s12], [L1 * c1 + L2 * c12, L2 * c12]]).transpose(2, 0, 1)
    w = np.linalg.solve(jacobian, v[..., None])[..., 0]
    total = w.sum(axis=1)
    drift = np.stack(
        [-L1 * c1 * w[:, 0] ** 2 - L2 * c12 * total**2, -L1 * s1 * w[:, 0] ** 2 - L2 * s12 * total**2], axis=1
    )
    return w, np.linalg.solve(jacobian, (a - drift)[..., None])[..., 0]


def torques(q1: Floats, q2: Floats, w: Floats, g: Floats) -> tuple[Floats, Floats]:
    """M(q) q'' + h(q, q') + g(q), mass centres in the middle (Siciliano, Robotics, chapter 7)."""
    c2, s2, r1, r2 = np.cos(q2), np.sin(q2), L1 / 2, L2 / 2
    m11 = J1 + J2 + M1 * r1**2 + M2 * (L1**2 + r2**2 + 2 * L1 * r2 * c2)
    m12, m22 = J2 + M2 * (r2**2 + L1 * r2 * c2), J2 + M2 * r2**2
    h = -M2 * L1 * r2 * s2
    weight2 = M2 * G * r2 * np.cos(q1 + q2)
    weight1 = (M1 * r1 + M2 * L1) * G * np.cos(q1) + weight2
    first = m11 * g[:, 0] + m12 * g[:, 1] + h * (2 * w[:, 0] * w[:, 1] + w[:, 1] ** 2) + weight1
    return first, m12 * g[:, 0] + m22 * g[:, 1] - h * w[:, 0] ** 2 + weight2


def on_line(t: Floats) -> tuple[Floats, Floats, Floats]:
    """Place, velocity and acceleration by the polynomial 10 u³ - 15 u⁴ + 6 u⁵ over one second."""
    start, way = np.array([0.4, 0.2]), np.array([0.3, 0.1])
    share = 10 * t**3 - 15 * t**4 + 6 * t**5
    first, second = 30 * t**2 - 60 * t**3 + 30 * t**4, 60 * t - 180 * t**2 + 120 * t**3
    return start + share[:, None] * way, first[:, None] * way, second[:, None] * way


def on_circle(t: Floats, radius: float = 0.15, x: float = 0.55, speed: float = 0.3) -> tuple[Floats, ...]:
    """The same on a circle at constant speed, counter-clockwise from its right."""
    w = speed / radius
    out, across = np.stack([np.cos(w * t), np.sin(w * t)], 1), np.stack([-np.sin(w * t), np.cos(w * t)], 1)
    return np.array([x, 0.0]) + radius * out, speed * across, -(speed**2) / radius * out


@pytest.mark.parametrize(("path", "course", "until"), [(LINE, on_line, 1.0), (CIRCLE, on_circle, pi)])
def test_an_arm_has_the_closed_angles_rates_and_torques(path: str, course: object, until: float) -> None:
    machine = robot(path)
    motion = lw.solve_motion(machine, steps=24, endpoint=True)
    forces, t = lw.solve_forces(motion), motion.time
    assert t[-1] == pytest.approx(until)
    place, v, a = course(t)  # type: ignore[operator]
    q1, q2 = arm(place[:, 0], place[:, 1])
    w, g = rates(q1, q2, v, a)
    for k, (name, angle) in enumerate((("one", q1), ("two", q2))):
        q, rate, second = motion.positions.coordinates[name]
        assert q == pytest.approx(angle, abs=1e-12)
        assert rate == pytest.approx(w[:, k], abs=1e-11)
        assert second == pytest.approx(g[:, k], abs=1e-10)
    assert motion.point("P").position == pytest.approx(place, abs=1e-13)
    assert motion.point("P").acceleration == pytest.approx(a, abs=1e-10)
    for name, effort in zip(("one", "two"), torques(q1, q2, w, g), strict=True):
        assert forces.driver_effort(name) == pytest.approx(effort, abs=1e-10)


def test_both_drivers_supply_the_power_of_weight_and_motion() -> None:
    forces = lw.solve_forces(robot(CIRCLE), steps=36)
    supplied = sum(
        forces.driver_effort(each) * forces.motion.positions.coordinates[each][1] for each in ("one", "two")
    )
    t = forces.motion.time

    def energy(time: Floats) -> Floats:
        place, v, a = on_circle(time)
        q1, q2 = arm(place[:, 0], place[:, 1])
        w, _unused = rates(q1, q2, v, a)
        middle = (
            L1 / 2 * np.stack([np.cos(q1), np.sin(q1)], 1),
            place - L2 / 2 * np.stack([np.cos(q1 + q2), np.sin(q1 + q2)], 1),
        )
        fast = v - L2 / 2 * (w.sum(axis=1))[:, None] * np.stack([-np.sin(q1 + q2), np.cos(q1 + q2)], 1)
        moving = 0.5 * (J1 + M1 * L1**2 / 4) * w[:, 0] ** 2 + 0.5 * J2 * w.sum(axis=1) ** 2
        return moving + 0.5 * M2 * (fast**2).sum(axis=1) + G * (M1 * middle[0][:, 1] + M2 * middle[1][:, 1])

    step = 1e-4
    power = (energy(t - 2 * step) - 8 * energy(t - step) + 8 * energy(t + step) - energy(t + 2 * step)) / (12 * step)
    assert supplied == pytest.approx(power, abs=1e-8)
    assert np.abs(forces.power_residual).max() < 1e-12


def test_a_path_round_the_base_turns_the_shoulder_once() -> None:
    motion = lw.solve_motion(robot(ROUND_BASE), steps=48, endpoint=True)
    q = motion.positions.coordinates["one"][0]
    assert motion.positions.closed and motion.positions.period == pytest.approx(1.4 * pi)
    assert q[0] - q[-1] == pytest.approx(2 * pi) and np.abs(np.diff(q)).max() < 0.2
    further = lw.solve_motion(robot(ROUND_BASE), times=[0.1, 0.1 + 1.4 * pi, 0.1 - 1.4 * pi])
    turns = further.positions.coordinates["one"][0]
    assert turns == pytest.approx(turns[0] + np.array([0, -2 * pi, 2 * pi]))


def test_words_choose_the_elbow() -> None:
    for word, sign in (("left", -1.0), ("right", 1.0)):
        motion = lw.solve_motion(lw.loads(ROBOT.replace("PATH", LINE).replace("A: left", f"A: {word}")))
        place = on_line(motion.time)[0]
        second = arm(place[:, 0], place[:, 1], sign)[1]
        assert motion.positions.coordinates["two"][0] == pytest.approx(second, abs=1e-12)


FIVE_BAR = """
format: 1
name: Five-bar
frame: {points: {O1: [0 m, 0 m], O2: [0.3 m, 0 m]}}
links:
  left_arm: {points: [O1, A], length: 0.25 m, mass: 1 kg, inertia: 0.006 kg·m²}
  left_rod: {points: [A, P], length: 0.35 m, mass: 0.8 kg, inertia: 0.009 kg·m²}
  right_arm: {points: [O2, B], length: 0.25 m, mass: 1 kg, inertia: 0.006 kg·m²}
  right_rod: {points: [B, P], length: 0.35 m, mass: 0.8 kg, inertia: 0.009 kg·m²}
assembly: {A: left, B: right}
gravity: [0, -9.81 m/s²]
drivers:
  one: {turn: left_arm, about: O1}
  two: {turn: right_arm, about: O2}
path: {point: P, along: [[0.23 m, 0.4 m], {about: [0.15 m, 0.4 m], turn: 360 deg}], speed: 0.4 m/s}
"""


def circle_meets(x: Floats, y: Floats, first: float, second: float, sign: float) -> Floats:
    """Angle of the arm whose rod reaches (x, y) from its pivot."""
    far = np.hypot(x, y)
    return np.asarray(np.arctan2(y, x) + sign * np.arccos((far**2 + first**2 - second**2) / (2 * far * first)))


def test_a_five_bar_follows_a_circle() -> None:
    machine = lw.loads(FIVE_BAR)
    motion = lw.solve_motion(machine, steps=60)
    t = motion.time
    w = 0.4 / 0.08
    x, y = 0.15 + 0.08 * np.cos(w * t), 0.4 + 0.08 * np.sin(w * t)
    assert motion.point("P").position == pytest.approx(np.stack([x, y], 1), abs=1e-13)
    one, two = circle_meets(x, y, 0.25, 0.35, 1.0), circle_meets(x - 0.3, y, 0.25, 0.35, -1.0)
    for name, angle in (("one", one), ("two", two)):
        assert motion.positions.coordinates[name][0] == pytest.approx(angle, abs=1e-12)

    def at(time: float) -> Floats:
        px, py = np.array([0.15 + 0.08 * cos(w * time)]), np.array([0.4 + 0.08 * sin(w * time)])
        return np.concatenate([circle_meets(px, py, 0.25, 0.35, 1.0), circle_meets(px - 0.3, py, 0.25, 0.35, -1.0)])

    step = 1e-3
    for k in (3, 17, 44):
        around = [at(t[k] + j * step) for j in (-2, -1, 0, 1, 2)]
        first = (around[0] - 8 * around[1] + 8 * around[3] - around[4]) / (12 * step)
        second = (-around[0] + 16 * around[1] - 30 * around[2] + 16 * around[3] - around[4]) / (12 * step**2)
        for n, name in enumerate(("one", "two")):
            _q, rate, acceleration = motion.positions.coordinates[name]
            assert rate[k] == pytest.approx(first[n], abs=1e-7)
            assert acceleration[k] == pytest.approx(second[n], abs=1e-5)


def test_a_five_bar_at_rest_holds_its_weight_by_virtual_work() -> None:
    """Σ M dq = Σ m g dy: torques of both drivers against the heights of all mass centres."""
    forces = lw.solve_forces(lw.loads(FIVE_BAR), static=True, steps=40)
    motion = forces.motion
    done = sum(forces.driver_effort(each) * motion.positions.coordinates[each][1] for each in ("one", "two"))
    lifted = sum(
        machine.mass * G * motion.point(f"{name}.centre").velocity[:, 1]
        for name, machine in motion.mechanism.links.items()
    )
    assert done == pytest.approx(lifted, abs=1e-11)
    assert np.abs(lw.solve_forces(lw.loads(FIVE_BAR), steps=40).power_residual).max() < 1e-11


def test_cylinders_follow_a_path_while_a_third_has_its_own_law() -> None:
    text = lw.read_document("gallery:excavator").text
    x, y = lw.solve_motion(lw.loads(text), times=[0.0]).point("B").position[0]
    text = re.sub(r'\n    position: "2\.12[^"]*"', "", text)
    text = re.sub(r"\n    table: .*", "", text)
    text += f"path: {{point: stick.B, along: [[{x} m, {y} m], [{x - 0.5} m, {y + 0.2} m]], over: 8 s}}\n"
    led = lw.solve_motion(lw.loads(text), steps=8)
    assert led.point("B").position[0] == pytest.approx([x, y], abs=1e-12)
    assert led.point("B").position[-1] == pytest.approx([x - 0.5, y + 0.2], abs=1e-12)
    found = led.positions.coordinates
    assert found["boom_lift"][0][0] == pytest.approx(2.12) and found["stick_swing"][0][0] == pytest.approx(2.66)
    curl = 2 + 0.18 * np.sin(4 * pi * led.time / 8)
    assert found["bucket_curl"][0] == pytest.approx(curl)
    assert np.abs(lw.solve_forces(led).power_residual).max() < 1e-8


def test_a_smooth_path_goes_through_its_points_at_its_speed() -> None:
    points = [(0.4, 0.2), (0.6, 0.35), (0.75, 0.15), (0.55, 0.0), (0.4, 0.2)]
    along = ", ".join(f"[{x} m, {y} m]" for x, y in points)
    machine = robot(f"{{point: fore.P, along: [{along}], smooth: true, speed: 0.2 m/s}}")
    motion = lw.solve_motion(machine, steps=1440)
    place, v = motion.point("P").position, motion.point("P").velocity
    assert np.hypot(*v.T) == pytest.approx(0.2, abs=1e-12)
    assert motion.positions.closed
    length = np.hypot(*np.diff(np.vstack([place, place[:1]]), axis=0).T).sum()
    assert motion.positions.period == pytest.approx(length / 0.2, rel=1e-5)
    for x, y in points:
        assert np.hypot(place[:, 0] - x, place[:, 1] - y).min() < 1e-3
    a = motion.point("P").acceleration
    t, step = motion.time[100], 1e-3
    around = lw.solve_motion(machine, times=[t - step, t + step]).point("P").velocity
    assert (around[1] - around[0]) / (2 * step) == pytest.approx(a[100], abs=1e-5)


def test_over_rests_at_corners_with_equal_mean_speeds() -> None:
    path = "{point: fore.P, along: [[0.4 m, 0.2 m], [0.7 m, 0.2 m], [0.7 m, 0 m]], over: 5 s, law: cycloidal}"
    motion = lw.solve_motion(robot(path), times=[0.0, 3.0, 5.0])
    assert motion.point("P").position == pytest.approx(np.array([[0.4, 0.2], [0.7, 0.2], [0.7, 0.0]]), abs=1e-13)
    assert motion.point("P").velocity == pytest.approx(np.zeros((3, 2)), abs=1e-9)


def test_the_file_keeps_the_path_and_its_dimensions() -> None:
    for path in (LINE, CIRCLE, LINE.replace("over: 1 s", "over: 1 s, law: cycloidal")):
        machine = robot(path)
        assert lw.loads(lw.dump(machine)) == machine
    machine = robot(CIRCLE)
    assert machine.dimension("path.along.1.about.x") == 0.55
    moved = machine.with_dimensions({"path.along.1.about.x": 0.5, "path.along.0.x": 0.6, "upper.length": 0.55})
    assert lw.solve_motion(moved, steps=4).point("P").position[2] == pytest.approx([0.4, 0.0], abs=1e-12)
    assert lw.loads(lw.dump(moved)) == moved
    document = lw.read_document("gallery:crank_rocker").with_text(lw.dump(machine))
    document.set("path.speed", "0.1 m/s")
    assert lw.solve_motion(document.mechanism, steps=4).positions.period == pytest.approx(3 * pi)


def test_metrics_between_positions_know_the_exact_course() -> None:
    """The largest acceleration of the quintic is 10/√3 times the way over the time squared, between the positions."""
    found = lw.metrics(lw.solve_forces(robot(LINE), steps=17))
    peak = next(each for each in found if each.metric == "peak_acceleration")
    assert peak.value == pytest.approx(10 / 3**0.5 * 0.1**0.5, rel=1e-9)


def test_designs_of_other_lengths_have_other_courses() -> None:
    machine = robot(LINE)
    with refused("study.moves_positions", address="upper.length"):
        lw.sensitivity(machine, of=["one.effort"], by=["upper.length"])
    with refused("study.moves_positions", address="upper.length"):
        lw.sweep(machine, {"upper.length": [0.5, 0.55]}, outputs=["one.effort"])
    assert lw.sweep(machine, {"fore.mass": [1.0, 1.5]}, outputs=["one.effort"]) is not None


def test_under_forces_a_machine_begins_where_its_path_begins() -> None:
    run = lw.run(lw.loads(FIVE_BAR), duration=0.05)
    assert run.motion(5).point("P").position[0] == pytest.approx([0.23, 0.4], abs=1e-9)


def test_check_asks_for_the_elbows_that_nothing_tells(tmp_path: Path) -> None:
    file = tmp_path / "five_bar.yaml"
    file.write_text(FIVE_BAR.replace("assembly: {A: left, B: right}\n", ""), encoding="utf-8")
    assert [each.code for each in lw.check(file)] == ["assembly", "assembly"]
    file.write_text(FIVE_BAR, encoding="utf-8")
    assert not lw.check(file)


def test_what_cannot_be_followed_is_refused_with_place_and_cause() -> None:
    with refused("path.unreachable", x="877.778 mm", y="200 mm"):
        lw.solve_motion(robot("{point: P, along: [[0.4 m, 0.2 m], [1.2 m, 0.2 m]], speed: 0.1 m/s}"))
    with refused("path.unreachable", x="900 mm"):
        lw.solve_motion(robot("{point: P, along: [[0.4 m, 0.2 m], [0.9 m, 0 m]], speed: 0.1 m/s}"))
    with refused("path.corner", speed="0.5 m/s"):
        path = "{point: P, along: [[0.4 m, 0.2 m], [0.6 m, 0.2 m], [0.6 m, 0 m]], position: 0.5 m/s*t}"
        lw.solve_motion(robot(f"{path}\ncycle: {{duration: 0.7 s}}"))
    with refused("path.beyond"):
        lw.solve_motion(robot("{point: P, along: [[0.4 m, 0.2 m], [0.6 m, 0.2 m]], speed: 0.1 m/s}"), times=[3.0])


def test_a_path_through_a_position_in_which_drivers_do_not_hold_the_point_is_refused() -> None:
    """Below the line A B both rods of the five-bar are in line: there the arms cannot push the point on."""
    circle = "[0.23 m, 0.4 m], {about: [0.15 m, 0.4 m], turn: 360 deg}"
    text = FIVE_BAR.replace(circle, "[0.15 m, 0.4 m], [0.15 m, -0.3 m]")
    with refused("path.singular"):
        lw.solve_motion(lw.loads(text), steps=40)


ROBOT_LINE = ROBOT.replace("PATH", LINE)


@pytest.mark.parametrize(
    ("old", "new", "key", "code"),
    [
        ("over: 1 s", "speed: 1 m/s, over: 1 s", "path", "choice"),
        (", over: 1 s", "", "path", "choice"),
        ("over: 1 s", "over: 1 s, start: 0.1 m", "path.start", "choice"),
        ("over: 1 s", "speed: 1 m/s, law: cycloidal", "path.law", "choice"),
        ("[0.7 m, 0.3 m]]", "[0.7 m, 0.3 m], [0.4 m, 0 m]], speed: 1 m/s", "path", "choice"),
        ("[0.7 m, 0.3 m]], over: 1 s", "[0.7 m, 0.3 m], [0.4 m, 0 m]], speed: 1 m/s", "path.along", "corner"),
        (", [0.7 m, 0.3 m]]", "]", "path.along", "count"),
        (", [0.7 m, 0.3 m]]", ", [0.4 m, 0.2 m]]", "path.along.1", "range"),
        (", [0.7 m, 0.3 m]]", ", {about: [0.4 m, 0.2 m], turn: 90 deg}]", "path.along.1", "range"),
        (", [0.7 m, 0.3 m]]", ", {about: [0.4 m, 0.3 m]}]", "path.along.1.turn", "missing-key"),
        ("over: 1 s", "over: 1 s, smooth: true", "path.smooth", "choice"),
        ("point: fore.P", "point: O", "path.point", "reference"),
        ("point: fore.P", "point: Q", "path.point", "unknown-name"),
        ("about: O}", "about: O, speed: 1 rad/s}", "path", "choice"),
        ("about: O}", "about: O, start: 1 rad}", "drivers.one.start", "choice"),
        ("A: left", "O: left", "assembly.O", "motion.not_inner"),
    ],
)
def test_what_is_wrong_is_found_at_its_place(old: str, new: str, key: str, code: str) -> None:
    assert old in ROBOT_LINE
    if code == "motion.not_inner":
        with refused(code):
            lw.solve_motion(lw.loads(ROBOT_LINE.replace(old, new)))
        return
    with faulty(code, key):
        lw.loads(ROBOT_LINE.replace(old, new))

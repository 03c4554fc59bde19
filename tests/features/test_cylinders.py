"""Drivers between two points: lengths by the cosine law, thrusts by moments and virtual work, files, refusals."""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin

import numpy as np
import pytest
from tests.refusals import faulty, findings, refused

import linkwright as lw

O_U, O_K = hypot(0.5, 0.3), hypot(2.2, 0.5)
#: A boom on a ram: 900 kg at 2.1 m and 0.5 m, so that the weight alone decides at rest.
BOOM = """
format: 1
name: Boom on a ram
frame: {points: {O: [0 m, 0 m], U: [0.5 m, -0.3 m]}}
links:
  boom: {points: {O: [0 m, 0 m], K: [2.2 m, 0.5 m]}, mass: 900 kg, inertia: 1600 kg·m², mass_centre: [2.1 m, 0.5 m]}
drawing: {K: [1.783 m, 1.383 m]}
gravity: [0, -9.81 m/s²]
driver: {between: [frame.U, boom.K], speed: 50 mm/s, start: 2 m}
cycle: {duration: 8 s}
"""
RAM = "driver: {between: [frame.U, boom.K], speed: 50 mm/s, start: 2 m}"


def boom(driver: str = RAM, cycle: str = "{duration: 8 s}") -> lw.Mechanism:
    return lw.loads(BOOM.replace(RAM, driver).replace("{duration: 8 s}", cycle))


def inclination(length: float) -> float:
    """Of the boom, rad, by the cosine law in the triangle O, U, K."""
    opening = np.arccos((O_U**2 + O_K**2 - length**2) / (2 * O_U * O_K))
    return float(opening + atan2(-0.3, 0.5) - atan2(0.5, 2.2))


def test_the_distance_of_the_points_is_the_coordinate() -> None:
    motion = lw.solve_motion(boom(), steps=8)
    assert motion.input == pytest.approx(2 + 0.05 * motion.time)
    gap = motion.point("K").position - motion.point("U").position
    assert np.hypot(*gap.T) == pytest.approx(motion.input, rel=1e-14)
    assert motion.link("boom").angle == pytest.approx([inclination(each) for each in motion.input], abs=1e-12)


def test_the_thrust_has_the_moment_of_the_weight() -> None:
    forces = lw.solve_forces(boom(), static=True, steps=8)
    for length, effort in zip(forces.motion.input, forces.driver_effort("driver"), strict=True):
        angle = inclination(length)
        c, s = cos(angle), sin(angle)
        k = (2.2 * c - 0.5 * s, 2.2 * s + 0.5 * c)
        along = ((k[0] - 0.5) / length, (k[1] + 0.3) / length)
        arm = k[0] * along[1] - k[1] * along[0]
        assert effort == pytest.approx(900 * 9.81 * (2.1 * c - 0.5 * s) / arm, rel=1e-12)


def test_inertia_of_all_parts_is_the_rate_of_their_energy() -> None:
    """F·v is the rate of kinetic and potential energy of boom, barrel and rod, taken from their places alone."""
    parts = "barrel: {mass: 60 kg, inertia: 12 kg·m², mass_centre: [0.6 m, 0]}, rod: {mass: 40 kg, inertia: 8 kg·m²}"
    law = 'position: "2 m + 0.1 m*sin(2*pi*t/(1 s))"'
    machine = boom(f"driver: {{between: [frame.U, boom.K], {parts}, {law}}}", "{duration: 1 s}")
    times, step = np.array([0.13, 0.4, 0.77]), 1e-4
    around = (times[:, None] + step * np.array([-2, -1, 1, 2])).ravel()
    motion, energy = lw.solve_motion(machine, times=around), np.zeros(len(around))
    for name in machine.links:
        link, centre = machine.links[name], motion.point(f"{name}.centre")
        energy += 0.5 * link.mass * (centre.velocity**2).sum(axis=1) + 9.81 * link.mass * centre.position[:, 1]
        energy += 0.5 * link.inertia * motion.link(name).angular_velocity ** 2
    power = energy.reshape(3, 4) @ [1, -8, 8, -1] / (12 * step)
    speed = 0.1 * 2 * pi * np.cos(2 * pi * times)
    forces = lw.solve_forces(lw.solve_motion(machine, times=times))
    assert forces.driver_effort("driver") * speed == pytest.approx(power, rel=1e-7)


#: A scissor lift: bars of 2 m that cross in their middle, a platform with a load 0.3 m from its pin.
SCISSORS = """
format: 1
name: Scissor lift
frame: {points: {O: [0 m, 0 m], E: [0.4 m, -0.2 m]}}
links:
  first: {points: [O, P], length: 2 m, also: {M: [1 m, 0 m]}}
  second: {points: [Q, R], length: 2 m, also: {M: [1 m, 0 m], D: [0.5 m, 0 m]}}
  foot: {points: [Q]}
  platform: {points: {R: [0 m, 0 m], L: [0.3 m, 0 m]}}
  head: {points: [P]}
joints:
  floor: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: foot, at: Q}
  table: {kind: prismatic, guide: platform, through: R, direction: 0 deg, block: head, at: P}
drawing: {P: [1.7 m, 1 m], M: [0.85 m, 0.5 m], Q: [1.7 m, 0 m], R: [0 m, 1 m], D: [1.275 m, 0.25 m]}
driver: {between: ENDS, speed: 10 mm/s, start: START}
cycle: {duration: 10 s}
loads: {weight: {kind: force, on: platform, at: L, components: [0 N, -5 kN]}}
"""


@pytest.mark.parametrize("where", ["foot", "bars"])
def test_a_scissor_lift_needs_the_weight_times_the_rate_of_the_height(where: str) -> None:
    """F = W·dh/dl; between the feet l = 2a·cos φ, h = 2a·sin φ and F = -W·cot φ, wherever the load is."""
    text, phi = SCISSORS, np.radians(np.linspace(20, 35, 4))
    if where == "foot":
        text, length = text.replace("ENDS", "[frame.O, foot.Q]"), 2 * np.cos(phi)
        expected = -5000 / np.tan(phi)
    else:  # E on the frame, D a quarter up the second bar: (1.5 cos φ, 0.5 sin φ)
        text = text.replace("ENDS", "[frame.E, second.D]")
        x, y = 1.5 * np.cos(phi) - 0.4, 0.5 * np.sin(phi) + 0.2
        length = np.hypot(x, y)
        slope = (-1.5 * np.sin(phi) * x + 0.5 * np.cos(phi) * y) / length
        expected = 5000 * 2 * np.cos(phi) / slope
    machine = lw.loads(text.replace("START", f"{float(length[0])} m"))
    forces = lw.solve_forces(lw.solve_motion(machine, at=length), static=True)
    assert forces.motion.point("R").position[:, 1] == pytest.approx(2 * np.sin(phi))
    assert forces.driver_effort("driver") == pytest.approx(expected, rel=1e-11)


def test_a_cylinder_counts_as_two_links_and_three_joints() -> None:
    machine = boom()
    assert set(machine.links) == {"boom", "driver_barrel", "driver_rod"}
    assert machine.cylinder_parts == {"driver_barrel": "driver", "driver_rod": "driver"}
    assert (machine.structure().mobility, machine.joints["driver"].kind) == (1, "prismatic")
    assert machine.structure().chain == "RRR(boom, driver_barrel, driver_rod)"


def test_the_file_keeps_it_as_one_element() -> None:
    parts = "stroke: [1.8 m, 2.4 m], barrel: {mass: 60 kg, inertia: 1 kg·m²}"
    machine = boom(RAM.replace("speed", f"{parts}, speed"))
    text = lw.dump(machine)
    assert "barrel: {mass: 60 kg" in text and "prismatic" not in text
    assert lw.loads(text) == machine
    changed = machine.with_dimensions({"driver_barrel.mass": 70.0, "driver.stroke.1": 2.5})
    assert lw.loads(lw.dump(changed)) == changed
    moved = machine.with_dimensions({"driver.offset": 0.1})  # no longer the distance of two points
    assert "prismatic" in lw.dump(moved) and lw.loads(lw.dump(moved)).joints["driver"] == moved.joints["driver"]
    document = lw.read_document("gallery:excavator")
    document.set("boom_lift_barrel.mass", "61 kg")
    document.set("boom_lift.stroke.0", "1.8 m")
    assert document.mechanism.links["boom_lift_barrel"].mass == 61.0
    assert document.mechanism.dimension("boom_lift.stroke.0") == 1.8


def test_a_model_in_code_stretches_two_points() -> None:
    model = lw.Model("ram")
    model.frame(O=(0, 0), U=(0.5, -0.3))
    model.link("boom", {"O": (0, 0), "K": (2.2, 0.5)})
    model.drawing(K=(1.783, 1.383))
    model.stretch("frame.U", "boom.K", stroke=(1.8, 2.4), barrel={"mass": 2, "inertia": 1}, speed=0.05, start=2)
    machine = model.build()
    assert machine.drivers["driver"].cylinder is not None
    assert machine.links["driver_barrel"].mass == 2.0


def test_a_cylinder_that_rocks_uses_its_stroke() -> None:
    machine = boom("driver: {between: [frame.U, boom.K], stroke: [1.8 m, 2.4 m], speed: 50 mm/s}", "rock")
    motion = lw.solve_motion(machine, steps=90)
    assert (motion.input.min(), motion.input.max()) == pytest.approx((1.8, 2.4))
    beyond = boom("driver: {between: [frame.U, boom.K], stroke: [1 m, 2.4 m], speed: 50 mm/s}", "rock")
    shortest = O_K - O_U  # a margin is left to where the triangle folds, none to the end of the stroke
    low = lw.solve_motion(beyond, steps=90).input
    assert low.min() == pytest.approx(shortest + 0.01 * (O_K + O_U - shortest), rel=1e-3) and low.max() == 2.4


def test_positions_beyond_the_stroke_are_refused() -> None:
    machine = boom("driver: {between: [frame.U, boom.K], stroke: [1.8 m, 2.3 m], speed: 50 mm/s, start: 2 m}")
    with refused("motion.beyond_stroke", name="driver", low="1800 mm", high="2300 mm"):
        lw.solve_motion(machine, steps=8)
    with refused("motion.beyond_stroke", value="1700 mm"):
        lw.solve_motion(machine, at=[2.0, 1.7])
    with refused("motion.no_distance", value="0 mm"):
        lw.solve_motion(boom("driver: {between: [frame.U, boom.K], speed: 50 mm/s}"), steps=8)


@pytest.mark.parametrize(
    ("driver", "key", "code"),
    [
        ("{between: [frame.U, boom.L], speed: 1 m/s}", "driver.between.1", "unknown-name"),
        ("{between: [frame.U, frame.U], speed: 1 m/s}", "driver.between", "reference"),
        ("{between: [boom.O, boom.K], speed: 1 m/s}", "driver.between", "reference"),
        ("{between: U, speed: 1 m/s}", "driver.between", "type"),
        ("{between: [U, K], turn: boom, speed: 1 m/s}", "driver", "choice"),
        ("{between: [U, K]}", "driver", "choice"),
        ("{between: [U, K], speed: 1 rad/s}", "driver.speed", "wrong-dimension"),
        ("{between: [U, K], speed: 1 m/s, stroke: [2 m, 1 m]}", "driver.stroke", "range"),
        ("{between: [U, K], speed: 1 m/s, barrel: {mas: 3 kg}}", "driver.barrel.mas", "unknown-key"),
        ("{between: [U, K], speed: 1 m/s, rod: {mass: -3 kg}}", "driver.rod.mass", "range"),
    ],
)
def test_what_is_wrong_is_found_at_its_place(driver: str, key: str, code: str) -> None:
    with faulty(code, key):
        boom(f"driver: {driver}")


def test_a_name_that_others_have_is_a_finding() -> None:
    text = BOOM.replace("  boom:", "  ram_rod: {points: [K]}\n  boom:").replace("driver:", "drivers:\n  ram:")
    found = next(each for each in findings(text) if each.code == "duplicate")
    assert found.key == "drivers.ram.between"
    assert 'link, joint or point "ram_rod" already' in found.message


def test_a_drawing_names_the_cylinder_once() -> None:
    text = BOOM.replace("driver:", "drivers:\n  ram:")
    svg = lw.draw(lw.loads(text)).svg
    assert svg.count(">ram<") == 1 and "ram_barrel" not in svg
    assert "_rod" not in lw.draw(boom()).svg

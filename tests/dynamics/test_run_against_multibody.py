"""Motion under forces and the forces in its joints, against an independent integration of all links."""

from __future__ import annotations

import numpy as np
import pytest
from tests.dynamics import andrews, models
from tests.dynamics.agreement import by_multibody, disagreements
from tests.reference.random_mechanisms import random_case

import linkwright as lw

FALLING = {
    "crank-rocker": (models.CRANK_ROCKER, 0.8),
    "double pendulum": (models.DOUBLE_PENDULUM, 0.7),
    "triple rocker": (models.TRIPLE_ROCKER, 0.8),
    "press": (models.PRESS, 0.4),
}


def let_go(text: str, end: float) -> None:
    mechanism = lw.loads(text)
    found = lw.run(mechanism, duration=end, tolerance=1e-12)
    expected = by_multibody(mechanism, np.linspace(0.0, end, 4))
    assert not disagreements(found, expected)
    assert found.energy_residual < 1e-11


@pytest.mark.parametrize(
    ("text", "end"),
    [(models.LOADED, 0.2), (models.TURNING_GUIDE, 0.15), (models.FIVE_BAR, 0.12)],
    ids=["loaded crank-rocker", "guide that turns", "five-bar"],
)
def test_machines_that_are_let_go(text: str, end: float) -> None:
    let_go(text, end)


@pytest.mark.rotating
@pytest.mark.parametrize("name", FALLING)
def test_machines_that_fall_for_longer(name: str) -> None:
    let_go(*FALLING[name])


def test_machines_that_begin_with_a_speed_at_another_position() -> None:
    mechanism = lw.loads(models.FIVE_BAR)
    begin = {"at": {"one": 1.1, "two": 2.0}, "speed": {"one": 3.0, "two": -5.0}}
    found = lw.run(mechanism, duration=0.1, tolerance=1e-12, **begin)  # type: ignore[arg-type]
    assert not disagreements(found, by_multibody(mechanism, [0.0, 0.05, 0.1], **begin))  # type: ignore[arg-type]


def test_a_motor_holds_one_crank_while_the_other_falls() -> None:
    mechanism = lw.loads(models.FIVE_BAR)
    found = lw.run(mechanism, duration=0.2, prescribed=["one"], tolerance=1e-12)
    expected = by_multibody(mechanism, [0.0, 0.1, 0.2], prescribed=["one"])
    assert expected.motion.angle("crank_1")[1] == pytest.approx([1.0, 1.0, 1.0])
    assert not disagreements(found, expected)


@pytest.mark.rotating
@pytest.mark.parametrize("name", ["geared_fivebar", "planetary_two_inputs", "internal_gear_pair", "excavator"])
def test_machines_of_the_gallery(name: str) -> None:
    mechanism = lw.load(f"gallery:{name}")
    speed = dict.fromkeys(mechanism.drivers, 0.1)
    at = {name: float(driver.law.at(0.0)) for name, driver in mechanism.drivers.items()}
    found = lw.run(mechanism, duration=0.05, at=at, speed=speed, tolerance=1e-12)
    assert not disagreements(found, by_multibody(mechanism, [0.0, 0.05], at=at, speed=speed, rtol=1e-11))


@pytest.mark.rotating
@pytest.mark.parametrize("seed", [seed for seed in range(60) if seed not in (55, 58)])
def test_random_mechanisms(seed: int) -> None:
    """Under gravity and random loads; those without torsion springs, which links that turn through would wind."""
    text = random_case(seed, with_loads=True).text
    if "torsion_spring" in text:
        text = random_case(seed).text
    mechanism = lw.loads(text.rstrip() + "\n" + "gravity: [0, -9.81 m/s²]\n" * ("gravity" not in text))
    found = lw.run(mechanism, duration=0.03, tolerance=1e-12)
    assert found.energy_residual < 1e-10
    assert not disagreements(found, by_multibody(mechanism, [0.0, 0.03], rtol=1e-11))


@pytest.mark.rotating
def test_andrews_squeezer() -> None:
    """As printed to the digits that are right there; energy to rounding; to the independent integration."""
    mechanism = lw.loads(models.ANDREWS)
    found = lw.run(mechanism, duration=andrews.END, tolerance=1e-13)
    assert found.energy_residual < 1e-12
    end = found.motion(times=[andrews.END])
    for order, within in enumerate((1e-9, 1e-7, 1e-5)):
        names = ("angle", "angular_velocity", "angular_acceleration")
        links = {name: float(getattr(end.link(name), names[order])[0]) for name in mechanism.links}
        assert andrews.off(links, order) < within
    forces = found.joint_forces(times=[andrews.END])
    for link, force in andrews.FORCES.items():
        assert forces.reaction("E", on=link)[0] == pytest.approx(force, rel=1e-5)
    expected = by_multibody(mechanism, [0.0, andrews.END])
    assert not disagreements(found, expected, within=1e-8, unlike={"direction": 2e-10, "position": 2e-10})


@pytest.mark.rotating
def test_links_of_a_triad_are_found_where_the_run_was() -> None:
    """Long after the start the triad has another position that Newton's method would reach from the end."""
    mechanism = lw.loads(random_case(96, with_loads=True).text)
    found = lw.run(mechanism, duration=0.4, tolerance=1e-12)
    expected = by_multibody(mechanism, [0.0, 0.2, 0.4], rtol=1e-11)
    assert not disagreements(found, expected)


@pytest.mark.parametrize(("at", "speed"), [(0.3, 7.0), (2.0, -7.0), (4.0, 5.0)])
def test_a_machine_with_dry_joints_is_let_go(at: float, speed: float) -> None:
    """Pins between moving links, a slot that turns, a bed: friction from the joint forces, which it changes."""
    mechanism = lw.loads(models.DRY_SHAPER)
    found = lw.release(mechanism, at=at, speed=speed)
    expected = by_multibody(mechanism, [0.0], at={"driver": at}, speed={"driver": speed})
    assert found.accelerations["driver"] == pytest.approx(expected.motion.angle("crank")[2][0], rel=1e-11)
    for joint in mechanism.joints.values():
        for link in joint.joined:
            force = expected.forces.on(joint.name, link)[0][0]
            assert found.forces.reaction(joint.name, on=link)[0] == pytest.approx(force, abs=1e-9)


@pytest.mark.rotating
def test_a_machine_with_dry_joints_coasts() -> None:
    mechanism = lw.loads(models.DRY_SHAPER)
    found = lw.run(mechanism, at=0.3, speed=9.0, duration=0.05, tolerance=1e-11)
    expected = by_multibody(mechanism, [0.0, 0.05], at={"driver": 0.3}, speed={"driver": 9.0}, rtol=1e-9)
    assert not disagreements(found, expected, within=1e-8, forces_within=1e-7)
    assert found.energy_residual < 1e-10


@pytest.mark.rotating
def test_joints_that_could_not_lead_do_not_stop_a_run() -> None:
    """Near a dead point all joints are looked at as coordinates, of which some would determine nothing."""
    mechanism = lw.loads(random_case(128, with_loads=True).text)
    found = lw.run(mechanism, duration=0.5, tolerance=1e-12)
    assert not disagreements(found, by_multibody(mechanism, [0.0, 0.5], rtol=1e-11))

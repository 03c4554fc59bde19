"""A mechanism told in another way moves and carries in the same way.

Units, order, names and steps of random mechanisms of any kind (`tests/reference/general_case.py`), rewritten as data
of their files; rotation, mirror and time of machines of the gallery.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
import yaml
from tests.every import every
from tests.invariants.bracket_machines import numbered, on_a_bracket
from tests.reference.general_case import general_case
from tests.store import machine as stored

import linkwright as lw

SEEDS = range(400, 416)
#: Those whose mechanisms have two loads or more.
SEVERAL_LOADS = (403, 405, 407, 409, 413, 415)
NUMBER = re.compile(r"(?<![\w.])(-?\d+\.?\d*(?:e[+-]?\d+)?) (m|mm|rad|deg|kg|s|N)(?![\w/·²])")


@dataclass
class Told:
    """A model file's data, with its own motion and forces."""

    data: dict[str, Any]
    steps: int

    def solved(self) -> tuple[lw.Motion, Any]:
        motion = lw.solve_motion(lw.loads(json.dumps(self.data)), steps=self.steps, failures="mark")
        return motion, lw.solve_forces(motion)


def told(seed: int) -> Told:
    """A random mechanism without loads that change over the cycle; its weights are part of it."""
    case = general_case(seed)
    data = numbered(yaml.load(case.text, Loader=yaml.BaseLoader))
    data.get("loads", {}).pop("work", None)
    return Told(data, min(case.steps, 12))


@cache
def as_it_was(seed: int) -> tuple[lw.Motion, Any]:
    """What the mechanism does before it is told in another way."""
    motion, forces = told(seed).solved()
    assert motion.ok.any()
    return motion, forces


def everywhere(value: Any, change: Callable[[str], str]) -> Any:
    """The data with all texts changed."""
    if isinstance(value, dict):
        return {key: everywhere(each, change) for key, each in value.items()}
    if isinstance(value, list):
        return [everywhere(each, change) for each in value]
    return change(value) if isinstance(value, str) else value


def in_other_units(text: str) -> str:
    other = {"m": ("mm", 1e3), "rad": ("deg", 180 / math.pi), "s": ("ms", 1e3), "N": ("kN", 1e-3)}

    def put(found: re.Match[str]) -> str:
        unit, factor = other.get(found[2], (found[2], 1.0))
        return f"{float(found[1]) * factor!r} {unit}"

    return NUMBER.sub(put, text)


def alike(a: tuple[lw.Motion, Any], b: tuple[lw.Motion, Any], names: Callable[[str], str] = lambda n: n) -> None:
    """All positions, rates, reactions and efforts are equal but for rounding, which the condition enlarges."""
    (first, forces), (second, others) = a, b
    assert (first.ok == second.ok).all()
    ok = first.ok
    for link in first.mechanism.links:
        x, y = first.link(link), second.link(names(link))
        close(x.direction[ok], y.direction[ok])
        close(x.angular_velocity[ok], y.angular_velocity[ok])
        close(x.centre.acceleration[ok], y.centre.acceleration[ok])
    for name, joint in first.mechanism.joints.items():
        for link in joint.joined:
            close(forces.reaction(name, on=link)[ok], others.reaction(names(name), on=names(link))[ok])
    for name in first.mechanism.drivers:
        close(forces.driver_effort(name)[ok], others.driver_effort(name)[ok])


def close(a: np.ndarray, b: np.ndarray, rtol: float = 1e-6) -> None:
    assert np.isfinite(a).all() and np.isfinite(b).all()
    assert b == pytest.approx(a, rel=rtol, abs=rtol * (1e-3 + np.abs(a).max(initial=0.0)))


@pytest.mark.rotating
@pytest.mark.parametrize("seed", SEEDS)
def test_other_units_change_nothing(seed: int) -> None:
    case = told(seed)
    other = Told(everywhere(case.data, in_other_units), case.steps)
    assert other.data != case.data
    alike(as_it_was(seed), other.solved())


@pytest.mark.rotating
@pytest.mark.parametrize("seed", SEEDS)
def test_the_order_of_the_file_changes_nothing(seed: int) -> None:
    case = told(seed)

    def turned_round(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: turned_round(value[key]) for key in reversed(value)}
        return value

    data = turned_round(case.data)
    for link, before in case.data["links"].items():  # the first two points are the axes
        data["links"][link] = before
    data["frame"] = case.data["frame"]
    if "drivers" in data:
        data["drivers"] = case.data["drivers"]
    alike(as_it_was(seed), Told(data, case.steps).solved())


@pytest.mark.rotating
@pytest.mark.parametrize("seed", SEEDS)
def test_other_names_change_nothing(seed: int) -> None:
    case = told(seed)

    def named(text: str) -> str:
        return re.sub(r"\b(l|P|s)(\d+)\b(?! [a-z])", lambda m: f"{'zyx'['lPs'.index(m[1])]}_{99 - int(m[2])}", text)

    def all_named(value: Any) -> Any:
        if isinstance(value, dict):
            return {named(key): all_named(each) for key, each in value.items()}
        if isinstance(value, list):
            return [all_named(each) for each in value]
        return named(value) if isinstance(value, str) else value

    alike(as_it_was(seed), Told(all_named(case.data), case.steps).solved(), named)


@pytest.mark.rotating
@pytest.mark.parametrize("seed", SEEDS)
def test_more_steps_hold_the_same_positions(seed: int) -> None:
    case = told(seed)
    coarse, forces = as_it_was(seed)
    fine, others = Told(case.data, 3 * case.steps).solved()
    for k in every(np.flatnonzero(coarse.ok)):
        assert fine.ok[3 * k]
        for link in coarse.mechanism.links:
            close(coarse.link(link).direction[k], fine.link(link).direction[3 * k])
            close(coarse.link(link).centre.acceleration[k], fine.link(link).centre.acceleration[3 * k], 1e-5)
        for name in coarse.mechanism.drivers:
            close(forces.driver_effort(name)[k : k + 1], others.driver_effort(name)[3 * k : 3 * k + 1], 1e-5)


GALLERY = ["crank_rocker", "jaw_crusher_sixbar", "shaper_quick_return", "triad", "dyad_rpr", "class_four_group"]


@pytest.mark.parametrize("name", GALLERY)
def test_time_runs_backwards(name: str) -> None:
    """Driven the other way: the same places and accelerations, opposite velocities, the same inertia forces."""
    mechanism = stored(name)
    speeds = {f"{d}.speed": -mechanism.dimension(f"{d}.speed") for d in mechanism.drivers}
    inputs = {d: np.radians(np.linspace(-20, 40, 7)) for d in mechanism.drivers}
    if any(mechanism.joints[d.joint].kind != "revolute" for d in mechanism.drivers.values()):
        starts = {d: mechanism.dimension(f"{d}.start") for d in mechanism.drivers}
        inputs = {d: starts[d] + np.linspace(0, 1e-3, 7) for d in mechanism.drivers}
    forth, back = (
        lw.solve_motion(m, at=inputs, failures="mark") for m in (mechanism, mechanism.with_dimensions(speeds))
    )
    assert forth.ok.any() and (forth.ok == back.ok).all()
    ok = forth.ok
    for link in mechanism.links:
        a, b = forth.link(link), back.link(link)
        close(a.direction[ok], b.direction[ok], 1e-9)
        close(a.angular_velocity[ok], -b.angular_velocity[ok], 1e-9)
        close(a.centre.acceleration[ok], b.centre.acceleration[ok], 1e-9)


def turned(mechanism: lw.Mechanism, angle: float) -> lw.Mechanism:
    """Frame, gravity and driver turned; the words of the assembly stay."""
    c, s = math.cos(angle), math.sin(angle)
    changes = {}
    for name, (x, y) in mechanism.frame.points.items():
        changes[f"frame.{name}.x"], changes[f"frame.{name}.y"] = c * x - s * y, s * x + c * y
    gx, gy = mechanism.gravity
    changes |= {"gravity.x": c * gx - s * gy, "gravity.y": s * gx + c * gy}
    for name in mechanism.drivers:
        changes[f"{name}.start"] = mechanism.dimension(f"{name}.start") + angle
    return mechanism.with_dimensions(changes)


def mirrored(mechanism: lw.Mechanism) -> lw.Mechanism:
    """The machine in a mirror along the x axis: y, angles and sides change their sign."""
    changes = {f"frame.{name}.y": -y for name, (_, y) in mechanism.frame.points.items()}
    changes["gravity.y"] = -mechanism.gravity[1]
    for name in mechanism.drivers:
        changes |= {f"{name}.{key}": -mechanism.dimension(f"{name}.{key}") for key in ("speed", "start")}
    for link in mechanism.links.values():
        changes |= {a: -v for a, v in link.geometry_dimensions().items() if a.endswith((".y", ".angle"))}
    sides = {"left": "right", "right": "left"}
    words = {joint: sides.get(word, word) for joint, word in mechanism.assembly.items()}
    return replace(mechanism.with_dimensions(changes), assembly=words)


PINNED = ["crank_rocker", "jaw_crusher_sixbar", "jaw_crusher_fourbar", "watt_sixbar"]


@pytest.mark.parametrize("name", PINNED)
def test_the_whole_machine_turned(name: str) -> None:
    mechanism = stored(name)
    angle = 0.7
    c, s = math.cos(angle), math.sin(angle)
    one, other = (lw.solve_forces(m, steps=24) for m in (mechanism, turned(mechanism, angle)))
    close(one.input_torque, other.input_torque, 1e-8)
    for joint in mechanism.joints.values():
        for link in joint.joined:
            force = one.reaction(joint.name, on=link)
            close(force @ np.array([[c, s], [-s, c]]), other.reaction(joint.name, on=link), 1e-8)


@pytest.mark.parametrize("name", PINNED)
def test_the_machine_in_a_mirror(name: str) -> None:
    mechanism = replace(stored(name), loads={})
    one, other = (lw.solve_forces(m, steps=24) for m in (mechanism, mirrored(mechanism)))
    close(one.input_torque, -other.input_torque, 1e-8)
    for joint in mechanism.joints.values():
        for link in joint.joined:
            close(one.reaction(joint.name, on=link) * (1.0, -1.0), other.reaction(joint.name, on=link), 1e-8)


@pytest.mark.parametrize("steps", [7, 96, 230, 361])
def test_a_planet_s_curve_has_one_length_whatever_the_steps(steps: int) -> None:
    """Run three times a cycle: carrier (24·1200 + 72·200)/96 = 450 rpm, planet -300 rpm, so once in 60 s/150."""
    t = np.arange(4096) * (0.4 / 4096)
    centre, about = (k * 2 * math.pi / 60 for k in (450, -300))
    z = 0.048 * np.exp(1j * centre * t), 0.02 * np.exp(1j * about * t)
    velocity = 1j * centre * z[0] + 1j * about * z[1]
    length = 0.4 * np.abs(velocity).mean()
    area = 0.4 * np.imag(np.conj(z[0] + z[1]) * velocity).mean() / 2
    found = lw.metrics(
        lw.solve_motion(stored("planetary_two_inputs"), steps=steps), ["coupler_curve_length", "coupler_curve_area"]
    )
    assert found.value("coupler_curve_length", "planet_1.P1") == pytest.approx(length, rel=1e-9)
    assert found.value("coupler_curve_area", "planet_1.P1") == pytest.approx(area, rel=1e-9)


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "shaper_quick_return", "whitworth", "dyad_rpr"])
def test_what_is_welded_to_the_frame_is_part_of_it(name: str) -> None:
    """All metrics are those of the machine without the bracket; the weld's own are more."""
    before, after = (
        {(row.metric, row.subject): row.value for row in lw.metrics(lw.solve_forces(machine, steps=60))}
        for machine in (stored(name), on_a_bracket(name))
    )
    assert {key for key, _ in before} >= {"limit_position", "dead_point"}
    assert after.keys() - before.keys() == {("peak_reaction", "foot"), ("rms_reaction", "foot")}
    assert before.keys() <= after.keys()
    for key in before:
        assert after[key] == pytest.approx(before[key], rel=1e-6, abs=1e-8), key


def test_counterweights_are_the_same_on_a_bracket() -> None:
    one, other = (
        lw.balance(machine, radius=0.2, steps=24)
        for machine in (stored("jaw_crusher_fourbar"), on_a_bracket("jaw_crusher_fourbar"))
    )
    assert [each.link for each in one.counterweights] == [each.link for each in other.counterweights]
    for with_frame, with_bracket in zip(one.counterweights, other.counterweights, strict=True):
        assert with_bracket.mass == pytest.approx(with_frame.mass, rel=1e-12)
        assert with_bracket.place == pytest.approx(with_frame.place, rel=1e-12)


@pytest.mark.parametrize("turn", [0.5, np.pi / 6])
def test_the_grashof_margin_of_a_turned_bracket(turn: float) -> None:
    """The frame's length is that between the pins, one on the frame and one on the bracket, wherever they stand."""
    model = lw.Model("on a bracket")
    model.frame(W=(1.0, 2.0), O2=(1.4, 2.1))
    model.link("bracket", {"W": (0.0, 0.0), "O1": (0.1, 0.2)})
    model.link("crank", ["O1", "A"], length=0.1)
    model.link("coupler", ["A", "B"], length=0.4)
    model.link("rocker", ["O2", "B"], length=0.3)
    model.joint("foot", "weld", links=["frame", "bracket"], at="W", angle=turn)
    model.assemble(B="left")
    model.drive("crank", about="O1", relative_to="bracket", speed=1)
    frame = abs(1.4 + 2.1j - (1 + 2j + np.exp(1j * turn) * (0.1 + 0.2j)))
    s, p, q, longest = sorted([0.1, 0.4, 0.3, frame])
    machine = model.build()
    margins = lw.metrics(lw.solve_motion(machine, steps=24), ["grashof"])
    swept = lw.sweep(machine, {"foot.angle": [turn]}, outputs=["grashof"], steps=24)
    assert margins.value("grashof") == pytest.approx(p + q - s - longest, rel=1e-12)
    assert swept["grashof"][0] == pytest.approx(p + q - s - longest, rel=1e-12)


@pytest.mark.rotating
@pytest.mark.parametrize("seed", SEVERAL_LOADS)
def test_loads_add_up(seed: int) -> None:
    """Without friction reactions and efforts are linear: all loads, less those of one, less those of none."""
    data = told(seed).data
    names = every(data["loads"], least=2)

    def solved(loads: list[str]) -> tuple[lw.Motion, Any]:
        changed = data | {"loads": {name: data["loads"][name] for name in loads}}
        return Told(changed, told(seed).steps).solved()

    motion, full = as_it_was(seed)
    _, none = solved([])
    parts = [solved([name])[1] for name in names]

    def added(read: Callable[[Any], np.ndarray]) -> None:
        one, bare = read(full)[motion.ok], read(none)[motion.ok]
        own = [read(part)[motion.ok] for part in parts]
        size = max(np.abs(each).max(initial=0.0) for each in (bare, *own))
        assert bare + sum(each - bare for each in own) == pytest.approx(one, rel=1e-6, abs=1e-6 * (1e-3 + size))

    for name in motion.mechanism.drivers:
        added(lambda forces: forces.driver_effort(name))  # noqa: B023
    for name, joint in motion.mechanism.joints.items():
        for link in joint.joined:
            added(lambda forces: forces.reaction(name, on=link))  # noqa: B023

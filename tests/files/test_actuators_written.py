"""Actuators, end stops and runs: read, written, changed, built in code, and as the schema says."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

import linkwright as lw

MODEL = """
format: 1
name: Press
parameters: {friction: 900 N·m, supply: 48 V}
frame: {points: {O: [0 m, 0 m], S: [0.3 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.45 m, mass: 12 kg, inertia: 0.25 kg·m²}
  slide: {points: [B], mass: 60 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: -90 deg, block: slide, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, free: true, start: 90 deg}
actuators:
  hand: {kind: constant, along: guide, force: 30 N, until: 2 s}  # a hand
  disc: {kind: brake, on: crank, torque: friction, from: 2 s}
  weight: {kind: flywheel, on: crank, inertia: 0.3 kg·m², ratio: -4}
  mains: {kind: induction, on: crank, power: 4 kW, speed: 1455 rpm, synchronous: 1500 rpm, pull_out: 2.5, starting: 2,
    star_until: 3 s, ratio: 8, efficiency: 0.9, inertia: 0.02 kg·m²}
  battery: {kind: dc, on: rod, against: crank, voltage: supply, constant: 0.9 N·m/A, resistance: 0.8 ohm,
    current: 20 A}
  small: {kind: dc, along: guide, lead: 5 mm/rev, stall_torque: 2 N·m, no_load_speed: 300 rad/s, self_locking: true,
    holding: 3 N·m}
  axis: {kind: servo, on: crank, continuous: 10 N·m, peak: 30 N·m, largest_speed: 300 rad/s, speed: 200 rad/s,
    gain: 2 N·m·s/rad, knee: 100 rad/s, ramp: 0.5 s}
  engine: {kind: curve, on: crank, speed: [0 rpm, 900 rpm], torque: [4 N·m, 0 N·m], interpolation: cubic,
    beyond: straight}
  ram: {kind: cylinder, between: [frame.S, slide.B], bore: 63 mm, rod: 36 mm, pressure: 10 MPa, rod_pressure: 2 bar,
    largest_speed: 0.4 m/s, stroke: [0.2 m, 0.9 m]}
stops:
  buffer: {of: B.y, at: -0.54 m, side: below, restitution: 0.4}
  edge: {of: crank, at: 300 deg, side: above}
run: {at: 30 deg, speed: -2 rad/s, until: rest, at_most: 60 s}
"""
FIRST = lw.loads(MODEL)


def test_every_kind_is_here() -> None:
    known = {each["title"] for each in lw.json_schema()["properties"]["actuators"]["additionalProperties"]["oneOf"]}
    assert {each.kind for each in lw.loads(MODEL).actuators.values()} == known


def test_what_is_written_reads_back_the_same() -> None:
    first = lw.loads(MODEL)
    text = lw.dump(first)
    assert lw.loads(text) == first
    assert lw.dump(lw.loads(text)) == text
    assert "torque: friction" in text and "voltage: supply" in text


def test_the_text_is_as_the_schema_says() -> None:
    sections = lw.json_schema()["properties"]
    kinds = {each["title"]: each for each in sections["actuators"]["additionalProperties"]["oneOf"]}
    for text in (MODEL, lw.dump(lw.loads(MODEL))):
        data = yaml.load(text, yaml.BaseLoader)
        shapes = [(each, kinds[each["kind"]]) for each in data["actuators"].values()]
        shapes += [(each, sections["stops"]["additionalProperties"]) for each in data["stops"].values()]
        for given, shape in [*shapes, (data["run"], sections["run"])]:
            assert set(shape.get("required", ())) <= given.keys() <= shape["properties"].keys()
            words = {key: each["enum"] for key, each in shape["properties"].items() if "enum" in each}
            assert all(given[key] in words[key] for key in given.keys() & words.keys())
        free = next(each for each in sections["driver"]["oneOf"] if each["title"] == "turn, free")
        assert set(free["required"]) <= data["driver"].keys() <= free["properties"].keys()


@pytest.mark.parametrize("address", [each for each in FIRST.dimensions() if each[:4] in ("actu", "stop", "run.")])
def test_every_dimension_is_changed_alone(address: str) -> None:
    first = FIRST
    value = 0.99 * first.dimension(address) + 0.001
    changed = first.with_dimensions({address: value})
    assert {k: v for k, v in changed.dimensions().items() if v != first.dimensions()[k]} == {address: value}
    assert lw.loads(lw.dump(changed)).dimension(address) == pytest.approx(value, rel=1e-15)
    assert first.declared(address) is not None


def test_what_follows_a_parameter_follows_it() -> None:
    changed = lw.loads(MODEL).with_dimensions({"friction": 700.0, "supply": 24.0})
    assert changed.dimension("actuators.disc.torque") == 700.0
    assert changed.dimension("actuators.battery.voltage") == 24.0


def test_a_value_is_changed_in_the_text_and_all_else_is_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "press.yaml"
    path.write_text(MODEL, "utf-8")
    document = lw.read_document(path)
    changes = {
        "actuators.hand.force": ("30 N", "45 N"),
        "stops.buffer.at": ("-0.54 m", "-0.5 m"),
        "run.at.driver": ("{at: 30 deg", "{at: 40 deg"),
        "run.at_most": ("60 s", "30 s"),
    }
    expected = MODEL
    for address, (old, new) in changes.items():
        document.set(address, new.removeprefix("{at: "))
        expected = expected.replace(old, new, 1)
        assert document.text == expected


@pytest.mark.parametrize("value", [-1.0, 1.5])
def test_a_dimension_keeps_the_limits_of_its_key(value: float) -> None:
    with pytest.raises(lw.LinkwrightError):
        lw.loads(MODEL).with_dimensions({"stops.buffer.restitution": value})
    with pytest.raises(lw.LinkwrightError):
        lw.loads(MODEL).with_dimensions({"actuators.mains.efficiency": value})


def test_a_machine_built_in_code_has_them_too() -> None:
    m = lw.Model("rotor")
    m.frame(O=(0, 0))
    m.link("wheel", ["O", "A"], length=1, mass=3, inertia=2)
    m.drive("wheel", about="O", free=True, start=0.5)
    m.actuator("hand", "constant", on="wheel", torque=30, from_=1, until=2)
    m.stop("peg", "wheel", 2.0, "above", restitution=0.5)
    m.run(at=0.25, for_=2)
    mechanism = m.build()
    assert mechanism.dimension("actuators.hand.from") == 1.0
    assert mechanism.stops["peg"].at == 2.0 and mechanism.run is not None
    assert dict(mechanism.run.at) == {"driver": 0.25} and mechanism.run.duration == 2.0
    assert mechanism.drivers["driver"].law.prescribed is False
    again = lw.loads(lw.dump(mechanism))
    assert (again.actuators, again.stops, again.run) == (mechanism.actuators, mechanism.stops, mechanism.run)

"""Files: reading back what was written, changing a value in place, building in code, the schema."""

import json
import math
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.refusals import refused
from tests.unit.files.reading import found_in

from linkwright.errors import LinkwrightError, ModelError, RequestError
from linkwright.file_check import check
from linkwright.files.build import Model
from linkwright.files.model_file import json_schema, load, loads, read_document
from linkwright.files.source import gallery_names
from linkwright.files.write import dump

BLOCK = """\
# head
format: 1
parameters: {l: 1 m, ratio: 3.5}
frame:
  points:
    O1: [0 m, 0 m]   # pivot
    O2: [4*l, 0 m]
links:
  crank:
    points: [O1, A]
    length: l      # chosen
    # about the mass
  coupler: {points: [A, B], length: ratio*l, also: {P: [l/2, 20 mm]}}
  rocker: {points: [O2, B], length: 3 m}  # end
driver:
  turn: crank
  about: O1
  speed: 10 rpm"""


@pytest.mark.parametrize("name", gallery_names())
def test_every_model_of_the_gallery_reads_back_the_same(name: str) -> None:
    first = store.machine(name)
    second = loads(dump(first), name)
    assert second == first
    assert dump(second) == dump(first)
    assert first.with_dimensions({}).dimensions() == first.dimensions()


@pytest.mark.parametrize("name", gallery_names())
def test_the_gallery_has_no_findings(name: str) -> None:
    assert found_in(f"gallery:{name}") == []
    assert [str(each) for each in check(f"gallery:{name}") if each.severity != "note"] == []


#: Bounds of a value, by the keys of their sentences.
ABOVE, OR_MORE = "model.above", "model.or_more"


@pytest.mark.parametrize("ends", ["\n", "\r\n"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_a_changed_value_leaves_every_other_character(tmp_path: Path, ends: str, mark: str) -> None:
    path = tmp_path / "m.yaml"
    path.write_bytes((mark + BLOCK.replace("\n", ends)).encode())
    document = read_document(path)
    document.set("rocker.length", "3.2 m")
    document.set("links.crank.length", "1.1 m")
    document.set("coupler.P.y", "25 mm")
    document.set("crank.mass", "2 kg")
    document.set("driver.start", "5 deg")
    document.set("l", "1.05 m")
    document.save(path, force=True)
    expected = BLOCK.replace("3 m}", "3.2 m}").replace("length: l  ", "length: 1.1 m  ").replace("20 mm", "25 mm")
    expected = expected.replace("# chosen\n", "# chosen\n    mass: 2 kg\n").replace("l: 1 m", "l: 1.05 m")
    expected += "\n  start: 5 deg"
    assert path.read_bytes().decode() == mark + expected.replace("\n", ends)
    assert load(path).dimensions() == document.mechanism.dimensions()
    assert [each.name for each in tmp_path.iterdir()] == ["m.yaml"]


@pytest.mark.parametrize(
    ("address", "value", "code", "values"),
    [
        ("crank.length", "1 kg", "wrong-dimension", {"text": "1 kg"}),
        ("crank.lenght", "1 m", "unknown-key", {"key_": "lenght"}),
        ("x.y", "1", "model.no_place", {"address": "x.y"}),
        ("crank.length", "}{", "expression", {"text": "}"}),
    ],
)
def test_a_refused_change_changes_nothing(
    tmp_path: Path, address: str, value: str, code: str, values: dict[str, object]
) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(BLOCK)
    document = read_document(path)
    with refused(code, **values):
        document.set(address, value)
    assert document.text == BLOCK


@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_values_set_together_read_as_if_set_in_turn(tmp_path: Path, mark: str) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(mark + BLOCK)
    values = {
        "rocker.length": "3.25 m",
        "crank.mass": "2 kg",
        "crank.inertia": "1 kg·m²",
        "links.crank.length": "1.1 m",
        "coupler.P.y": "25 mm",
        "links.coupler.also.P.y": "26 mm",
        "driver.start": "5 deg",
        "l": "1.05 m",
    }
    together, in_turn = read_document(path), read_document(path)
    together.set_all(values)
    for address, value in values.items():
        in_turn.set(address, value)
    assert together.text == in_turn.text and together.text.count("26 mm") == 1
    assert together.mechanism.dimension("crank.inertia") == 1.0
    kept = together.text
    with refused("wrong-dimension", ModelError, text="1 kg"):
        together.set_all({"rocker.length": "4 m", "crank.length": "1 kg"})
    assert together.text == kept and together.mechanism.dimension("rocker.length") == 3.25


def test_json_stays_json(tmp_path: Path) -> None:
    data = {
        "format": 1,
        "frame": {"points": {"O": ["0 m", 0]}},
        "links": {"arm": {"points": ["O", "P"], "length": "1 m"}},
        "driver": {"turn": "arm", "about": "O", "speed": "10 rpm"},
    }
    path = tmp_path / "m.json"
    path.write_text(json.dumps(data, indent="\t"))
    document = read_document(path)
    document.set("arm.length", "2 m")
    document.set("arm.mass", "3 kg")
    changed = json.loads(document.text)
    assert changed["links"]["arm"] == {"points": ["O", "P"], "length": "2 m", "mass": "3 kg"}


def test_dimensions_that_are_expressions_follow_their_parameters() -> None:
    mechanism = loads(BLOCK).with_dimensions({"l": 2.0, "rocker.length": 5.0})
    assert mechanism.dimension("crank.length") == 2.0
    assert mechanism.dimension("coupler.length") == 7.0
    assert mechanism.links["coupler"].points == {"A": (0.0, 0.0), "B": (7.0, 0.0), "P": (1.0, 0.02)}
    assert mechanism.frame.points["O2"] == (8.0, 0.0)
    assert mechanism.dimension("rocker.length") == 5.0
    free = mechanism.with_dimensions({"crank.length": 1.0}).with_dimensions({"l": 3.0})
    assert free.dimension("crank.length") == 1.0


@pytest.mark.parametrize(
    ("address", "value", "kind", "code", "values"),
    [
        ("crank.length", -1.0, RequestError, "model.set_outside", {"value": "-1 m", "limit": ABOVE}),
        ("crank.length", math.nan, RequestError, "model.set_not_finite", {"value": "nan"}),
        ("crank.mass", -1.0, RequestError, "model.set_outside", {"value": "-1 kg", "limit": OR_MORE}),
        ("crank.lenth", 1.0, LinkwrightError, "model.no_dimension", {"offer": "crank.length"}),
        ("loads.s.stiffness", -1.0, RequestError, "model.set_outside", {"value": "-1 N/m", "limit": OR_MORE}),
        ("loads.s.free_length", -0.1, RequestError, "model.set_outside", {"value": "-0.1 m", "limit": OR_MORE}),
        ("A.pin_radius", 0.0, RequestError, "model.set_outside", {"value": "0 m", "limit": ABOVE}),
        ("cycle.duration", 0.0, RequestError, "model.set_outside", {"value": "0 s", "limit": ABOVE}),
        ("gravity.z", 1.0, LinkwrightError, "model.no_dimension", {"offer": "gravity.y"}),
    ],
)
def test_changes_that_make_no_sense_are_refused(
    address: str, value: float, kind: type[LinkwrightError], code: str, values: dict[str, object]
) -> None:
    spring = "loads: {s: {kind: spring, between: [A, O2], stiffness: 1 N/m}}"
    more = f"joints: {{A: {{kind: revolute, pin_radius: 5 mm}}}}\ncycle: {{duration: 1 s}}\n{spring}"
    with refused(code, kind, address=address, **values):
        loads(f"{BLOCK}\n{more}\n").with_dimensions({address: value})


def test_a_mechanism_can_be_pickled() -> None:
    mechanism = loads(BLOCK)
    assert pickle.loads(pickle.dumps(mechanism)) == mechanism


def test_the_ways_of_geometry_place_points_alike() -> None:
    head = "format: 1\nframe: {points: {O: [0, 0]}}\ndriver: {turn: a, about: O, speed: 1 rpm}\n"
    ways = {
        "bent": "links: {a: {points: [O, C, E], lengths: [3 m, 2 m], angle: 90 deg}}",
        "coordinates": "links: {a: {points: {O: [0, 0], C: [3 m, 0], E: [0, 2 m]}}}",
        "drawing": "drawing: {C: [0 m, 3 m], E: [-2 m, 0 m], O: [0, 0]}\nlinks: {a: {points: [O, C, E]}}",
        "length": "links: {a: {points: [O, C], length: 3 m, also: {E: [0, 2 m]}}}",
    }
    for geometry, text in ways.items():
        link = loads(head + text).links["a"]
        assert link.geometry == geometry
        assert np.allclose(list(link.points.values()), [(0, 0), (3, 0), (0, 2)], atol=1e-15)
        assert link.centre == (1.5, 0.0)


def test_code_and_file_build_the_same_mechanism() -> None:
    model = Model("four-bar")
    model.frame(O1=(0, 0), O2=(4, 0))
    model.link("crank", ["O1", "A"], length=1)
    model.link("coupler", ["A", "B"], length="3500 mm", also={"P": (1.5, 1)})
    model.link("rocker", ["O2", "B"], length=3, mass=2)
    model.drive("crank", about="O1", speed=10)
    model.assemble(B="left")
    model.gravity(0, -9.81)
    text = """
format: 1
name: four-bar
frame: {points: {O1: [0, 0], O2: [4 m, 0]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 3.5 m, also: {P: [1.5 m, 1 m]}}
  rocker: {points: [O2, B], length: 3 m, mass: 2 kg}
driver: {turn: crank, about: O1, speed: 10 rad/s}
assembly: {B: left}
gravity: [0, -9.81 m/s²]
"""
    assert model.build() == loads(text)
    model.link("spare", ["X"], length=-1)
    with refused("range", ModelError, shown="-1") as caught:
        model.build()
    assert "links.spare.length" in [each.key for each in caught.value.findings]


def test_pins_are_implied_and_guides_and_welds_take_points_out() -> None:
    text = """
format: 1
frame: {points: {O: [0, 0], G: [0, 0.2 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  rod: {points: [A, F], length: 3 m}
  slider: {points: [F, W], length: 0.1 m}
  tool: {points: [W, T], length: 0.1 m}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: [O, G], block: slider, at: F}
  fixed: {kind: weld, links: [slider, tool], at: W, angle: 90 deg}
driver: {turn: crank, about: O, speed: 1 rpm}
"""
    joints = loads(text).joints
    assert {name: joint.kind for name, joint in joints.items()} == {
        "O": "revolute",
        "A": "revolute",
        "F": "revolute",
        "guide": "prismatic",
        "fixed": "weld",
    }
    assert joints["F"].joined == ("rod", "slider")
    guide: Any = joints["guide"]
    assert guide.direction == pytest.approx(math.pi / 2)


LAWS = [
    ("speed: 60 rpm, start: 90 deg", lambda t: math.pi / 2 + 2 * math.pi * t),
    ('position: "30 deg*sin(2*pi*t/(2 s))"', lambda t: math.pi / 6 * np.sin(np.pi * t)),
    ("table: {time: [0 s, 1 s, 2 s, 3 s], position: [0 rad, 1 rad, 8 rad, 27 rad]}", lambda t: t**3),
]


@pytest.mark.parametrize(("law", "truth"), LAWS)
def test_a_law_gives_its_coordinate_with_exact_derivatives(law: str, truth: Any) -> None:
    text = BLOCK.replace("  speed: 10 rpm", "").replace("driver:\n  turn: crank\n  about: O1\n", "")
    driver = loads(f"{text}\ndriver: {{turn: crank, about: O1, {law}}}").drivers["driver"]
    t, h = np.linspace(0.2, 2.5, 7), 1e-4
    q, qd, qdd = driver.law.coordinate(t)
    assert np.allclose(q, truth(t), rtol=1e-13, atol=1e-13)
    assert np.allclose(qd, (truth(t + h) - truth(t - h)) / (2 * h), rtol=1e-6, atol=1e-7)
    assert np.allclose(qdd, (truth(t + h) - 2 * truth(t) + truth(t - h)) / h**2, rtol=1e-5, atol=1e-6)


def test_the_schema_names_every_section_and_is_plain_json() -> None:
    schema = json_schema()
    assert json.loads(json.dumps(schema)) == schema
    loads_of = schema["properties"]["loads"]["additionalProperties"]["oneOf"]
    assert "force" in {each["title"] for each in loads_of}
    link = schema["properties"]["links"]["additionalProperties"]
    assert set(link["properties"]) == {
        "points",
        "length",
        "lengths",
        "angle",
        "also",
        "mass",
        "inertia",
        "mass_centre",
        "colour",
        "shape",
    }


@pytest.mark.parametrize(
    ("name", "before", "after"),
    [
        ("chain_drive", "pitch: 12.7 mm", "pitch: 12.7 mm, phase: 10 deg"),
        (
            "chain_drive",
            "kind: chain, links: [motor, crank], teeth: [17, 51], pitch: 12.7 mm",
            "kind: belt, links: [motor, crank], radii: [30 mm, 90 mm], run: crossed, pretension: 200 N",
        ),
        ("external_gear_pair", "module: 2 mm", "module: 2 mm, pressure_angle: 25 deg"),
        ("pinion_between_racks", "below: {kind: rack,", "below: {kind: rack, pressure_angle: 14.5 deg,"),
    ],
)
def test_what_wheels_are_given_is_written(name: str, before: str, after: str) -> None:
    text = store.text(name)
    assert before in text
    model = loads(text.replace(before, after))
    again = loads(dump(model))
    assert dict(again.joints) == dict(model.joints) != dict(loads(text).joints)

"""Each tool with numbers known from elsewhere: hand computation, closed forms, an independent solution."""

from __future__ import annotations

import base64
import json
import math
import shutil
import struct
from pathlib import Path

import pytest
from tests.assistants.calls import CRANK_ROCKER, call

import linkwright as lw

IMPORTERS = Path(__file__).parents[1] / "importers"
CRANK, COUPLER, ROCKER, FRAME = 1.0, 3.5, 2.5, 4.0


def transmission_angle(crank: float, coupler: float, rocker: float, frame: float) -> float:
    """The smallest one of a crank-rocker: it is at one of the two positions in line with the frame."""
    found = []
    for across in (frame - crank, frame + crank):
        angle = math.acos((coupler**2 + rocker**2 - across**2) / (2 * coupler * rocker))
        found.append(min(angle, math.pi - angle))
    return min(found)


def test_positions_velocities_accelerations_of_an_independent_solution() -> None:
    found = call("solve_machine", model=CRANK_ROCKER, at="0 deg, 40 deg, 150 deg, 270 deg", columns=["rocker", "P"])
    assert found.data["reached"] == [True] * 4 and not found.data["forces"]
    known = {
        "rocker.angle": [1.7721542, 1.6745706, 2.2911434, 2.3786009],
        "rocker.angular_velocity": [-3.3333333, 0.63477278, 3.3692139, -2.5156246],
        "rocker.angular_acceleration": [45.360921, 54.555457, -20.127707, -25.796819],
        "coupler.P.position.x": [1.3715744, 1.5142487, 0.11866749, 0.16053969],
        "coupler.P.velocity.y": [8.7614188, 5.6925112, -7.7101121, 0.33274902],
        "coupler.P.acceleration.x": [-88.124663, -115.90952, 56.042720, 42.379251],
    }
    for name, values in known.items():
        assert found.column(name) == pytest.approx(values, rel=1e-7), name


def test_forces_are_those_of_the_library_and_balance_a_hand_computed_torque() -> None:
    """A torque on the crank of a machine without masses is carried by the driver alone."""
    text = lw.read_document(CRANK_ROCKER).text + "\nloads: {brake: {kind: torque, on: crank, magnitude: -7 N·m}}\n"
    found = call("solve_machine", model=text, at="10 deg, 200 deg", columns=["driver.effort"])
    assert found.data["forces"]
    assert found.column("driver.effort") == pytest.approx([7.0, 7.0])
    six = call("solve_machine", model="gallery:jaw_crusher_sixbar", columns=["driver.effort"], positions=4)
    forces = lw.solve_forces(lw.solve_motion(lw.load("gallery:jaw_crusher_sixbar"), steps=360, endpoint=True))
    assert six.column("driver.effort") == pytest.approx(list(forces.input_torque[::90]), rel=1e-7)


def test_a_position_out_of_reach_has_no_values_and_says_why() -> None:
    text = lw.read_document(CRANK_ROCKER).text.replace("length: 1 m", "length: 3.2 m")
    found = call("solve_machine", model=text, at="90 deg, 180 deg")
    assert found.data["ok"] and found.data["reached"] == [True, False]
    assert found.column("rocker.angle")[1] is None
    warning = next(each for each in found.data["findings"] if each["severity"] == "warning")
    assert warning["next"]["tool"] == "draw_machine"


def test_design_numbers_in_closed_form() -> None:
    found = call("get_metrics", model=CRANK_ROCKER, names=["transmission_angle", "grashof"])
    angle = next(each for each in found.data["metrics"] if each["metric"] == "transmission_angle")
    assert angle["value"] == pytest.approx(transmission_angle(CRANK, COUPLER, ROCKER, FRAME), rel=1e-8)
    assert angle["unit"] == "rad" and angle["exact"] and angle["limit"] == pytest.approx(math.radians(40.0))


def test_the_picture_is_as_wide_as_asked_for() -> None:
    found = call("draw_machine", model=CRANK_ROCKER, at="40 deg", paths=["P"], width=640, svg=True)
    content = base64.b64decode(found.pictures[0])
    assert content.startswith(b"\x89PNG") and struct.unpack(">I", content[16:20]) == (640,)
    assert found.data["svg"].startswith("<svg") and "lw-trace" in found.data["svg"]


@pytest.mark.rotating
def test_curves_are_a_second_picture() -> None:
    found = call("draw_machine", model="gallery:jaw_crusher_sixbar", curves="torque", ghosts="limits", forces=True)
    assert [base64.b64decode(each)[:4] for each in found.pictures] == [b"\x89PNG"] * 2
    stuck = lw.read_document(CRANK_ROCKER).text.replace("length: 1 m", "length: 3.2 m")
    partly = call("draw_machine", model=stuck, curves="sva")
    assert not partly.failed and partly.pictures
    assert {each["severity"] for each in partly.data["findings"]} >= {"warning"}


def test_a_changed_length_keeps_comments_and_changes_the_stroke(tmp_path: Path) -> None:
    """The stroke of an inline slider-crank is twice its crank."""
    text = lw.read_document("gallery:slider_crank_inline").text
    crank = lw.loads(text).dimension("crank.length")
    found = call(
        "change_dimension", tmp_path, model=text, changes={"crank.length": f"{1.2 * crank} m"}, save_as="a.yaml"
    )
    assert found.data["changed"][0]["before"] == pytest.approx(crank)
    assert found.data["changed"][0]["after"] == pytest.approx(1.2 * crank)
    assert [line for line in found.data["text"].splitlines() if "#" in line] == [
        line for line in text.splitlines() if "#" in line
    ]
    assert (tmp_path / "a.yaml").read_text("utf-8") == found.data["text"] and found.data["written"] == "a.yaml"
    stroke = call("get_metrics", tmp_path, model="a.yaml", names=["stroke"]).data["metrics"][0]
    assert stroke["value"] == pytest.approx(2.4 * crank, rel=1e-8) and stroke["unit"] == "m"


@pytest.mark.rotating
def test_points_of_a_drawing_follow_a_changed_length() -> None:
    text = lw.read_document(CRANK_ROCKER).text.replace(
        "assembly: {B: left}", "drawing: {A: [1 m, 0 m], B: [3.5 m, 2.45 m]}"
    )
    found = call("change_dimension", model=text, changes={"rocker.length": "2.6 m", "driver.speed": "5 rad/s"})
    assert found.data["ok"], found.data["findings"]
    after = lw.loads(found.data["text"])
    assert after.dimension("rocker.length") == pytest.approx(2.6)
    assert after.drivers["driver"].law.constant_speed == pytest.approx(5.0)


def test_a_model_that_does_not_move_any_more_is_not_written(tmp_path: Path) -> None:
    found = call("change_dimension", tmp_path, model=CRANK_ROCKER, changes={"crank.length": "5 m"}, save_as="a.yaml")
    assert not found.data["ok"] and found.data["text"] and not list(tmp_path.iterdir())


def test_a_slider_crank_has_the_stroke_that_was_demanded(tmp_path: Path) -> None:
    demands = {"stroke": "397.5 mm", "rod_ratio": 3.55, "offset_ratio": 0.305}
    found = call("synthesize_machine", tmp_path, task="slider_crank", demands=demands, save_as="press.yaml")
    best = found.data["candidates"][0]
    crank, rod, offset = (best["values"][f"{name} [m]"] for name in ("crank", "rod", "offset"))
    stroke = math.sqrt((rod + crank) ** 2 - offset**2) - math.sqrt((rod - crank) ** 2 - offset**2)
    assert stroke == pytest.approx(0.3975, rel=1e-7)
    measured = call("get_metrics", tmp_path, model="press.yaml", names=["stroke"]).data["metrics"][0]
    assert measured["value"] == pytest.approx(0.3975, rel=1e-6)


def test_the_best_coupler_is_that_of_the_closed_form() -> None:
    asked = {"vary": {"coupler.length": "3.2..4 m"}, "maximize": ["transmission_angle"], "evaluations": 60}
    found = call("optimize_machine", model=CRANK_ROCKER, **asked)
    lengths = [3.2 + 0.8 * k / 20000 for k in range(20001)]
    best = max(lengths, key=lambda length: transmission_angle(CRANK, length, ROCKER, FRAME))
    assert found.data["variables"][0]["start"] == COUPLER
    assert found.data["variables"][0]["found"] == pytest.approx(best, rel=1e-3)
    number = found.data["numbers"][0]
    assert number["start"] == pytest.approx(transmission_angle(CRANK, COUPLER, ROCKER, FRAME))
    assert number["found"] == pytest.approx(transmission_angle(CRANK, best, ROCKER, FRAME), rel=1e-4)
    assert lw.loads(found.data["text"]).dimension("coupler.length") == pytest.approx(
        found.data["variables"][0]["found"]
    )


@pytest.mark.rotating
def test_demands_that_cannot_be_met_are_told_with_the_nearest_design() -> None:
    asked = {"vary": {"coupler.length": "3.4..3.6 m"}, "minimize": ["coupler.length"], "evaluations": 40}
    found = call("optimize_machine", model=CRANK_ROCKER, keep={"transmission_angle": "at least 89 deg"}, **asked)
    assert (
        not found.failed
        and not found.data["ok"]
        and found.data["missed"] == ["transmission_angle"]
        and found.data["variables"]
    )


@pytest.mark.rotating
def test_two_machines_side_by_side() -> None:
    text = lw.read_document(CRANK_ROCKER).text.replace("length: 3.5 m", "length: 3.8 m")
    found = call("compare_machines", models=[CRANK_ROCKER, text], output="rocker", metrics=["transmission_angle"])
    known = [transmission_angle(CRANK, each, ROCKER, FRAME) for each in (3.5, 3.8)]
    row = found.data["criteria"][0]
    assert row["values"] == pytest.approx(known, rel=1e-8) and row["better"] == "higher"
    better = found.data["labels"][known.index(max(known))]
    assert found.data["ranking"][0]["label"] == better and row["best"] == [better]


def test_a_report_is_written_once(tmp_path: Path) -> None:
    asked = {"model": CRANK_ROCKER, "file": "r.html", "sections": ["task", "structure"]}
    found = call("write_report", tmp_path, **asked)
    content = (tmp_path / "r.html").read_bytes()
    assert found.data["file"] == "r.html" and found.data["bytes"] == len(content) and b"Crank-rocker" in content
    assert call("write_report", tmp_path, **asked).codes == ["file.exists"]
    assert call("write_report", tmp_path, **asked, overwrite=True).data["ok"]


def test_a_model_is_checked_with_place_remedy_and_next_call() -> None:
    found = call("check_model", model=CRANK_ROCKER)
    assert found.data["ok"] and (found.data["links"], found.data["mobility"], found.data["structure_class"]) == (
        3,
        1,
        2,
    )
    wrong = lw.read_document(CRANK_ROCKER).text.replace("length: 2.5 m", "lenght: 2.5 m")
    finding = call("check_model", model=wrong).data["findings"][0]
    assert (finding["code"], finding["key"]) == ("unknown-key", "links.rocker.lenght")
    line = wrong.splitlines().index("  rocker: {points: [O2, B], lenght: 2.5 m}") + 1
    assert finding["place"].startswith(f"model:{line}:") and "length" in finding["remedy"] + finding["message"]
    assert finding["next"] == {
        "tool": "read_schema",
        "arguments": {"section": "links"},
        "why": finding["next"]["why"],
    }


def test_the_gallery_is_searched_and_read() -> None:
    found = call("search_gallery", words="quick return")
    assert "gallery:shaper_quick_return" in [each["name"] for each in found.data["models"]]
    assert len(call("search_gallery").data["models"]) > 60
    assert call("search_gallery", name="kite").data["text"] == lw.read_document("gallery:kite").text
    assert "kite" in call("search_gallery", name="kiet").data["findings"][0]["remedy"]


def test_the_schema_has_every_section_and_kind() -> None:
    schema = lw.json_schema()["properties"]
    found = call("read_schema")
    assert [each["name"] for each in found.data["sections"]] == list(schema)
    assert lw.loads(found.data["example"]).name == "four-bar"
    assert call("check_model", model=found.data["example"]).data["findings"] == []
    assert call("read_schema", section="links").data["json_schema"] == json.loads(json.dumps(schema["links"]))
    gear = call("read_schema", section="joints", kind="gear").data["json_schema"]
    assert gear["properties"]["teeth"]["description"]
    assert call("read_schema", section="link").data["findings"][0]["remedy"].count("links")


def test_a_code_is_explained() -> None:
    found = call("explain_finding", code="missing-unit")
    assert found.data["meaning"] == "a number without its unit" and found.data["wrong"] and found.data["right"]
    assert call("explain_finding", code="motion.refused").data["meaning"]
    assert call("explain_finding", ".", "zh", code="missing-unit").data["meaning"] == "数没有单位"
    assert call("explain_finding", code="dynamics.impact").data["meaning"] == "runs under forces"
    assert call("explain_finding", code="mising-unit").failed


EXPECTING = """\
format: 1
name: expecting
frame: {points: {O1: [0 mm, 0 mm], O2: [4 m, 0 mm]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 3.5 m}
  rocker: {points: [O2, B], length: 2.5 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rad/s}
expect: {transmission_angle: at least 40 deg, mobility: 2}
"""


def test_expectations_are_evaluated_where_a_model_has_some() -> None:
    """The smallest transmission angle is 57.12165° in closed form, the mobility 3·3 − 2·4 = 1."""
    found = call("check_model", model=EXPECTING)
    first, second = found.data["expectations"]
    assert not found.failed and not found.data["ok"]
    assert first["holds"] and first["found"].startswith("57.12") and "40" in first["expected"]
    assert not second["holds"] and second["found"] == "1" and found.codes == ["not-met"]
    mended = call("change_dimension", model=EXPECTING, changes={"expect.mobility": "1"})
    assert mended.data["ok"] and [each["holds"] for each in mended.data["expectations"]] == [True, True]
    assert call("check_model", model=CRANK_ROCKER).data["expectations"] == []


@pytest.mark.rotating
def test_files_of_other_programs_are_read_as_models(tmp_path: Path) -> None:
    """Lengths are those that stand in the file."""
    for name in ("open_linkage/coordinates_off.json", "linkage/four_bar.linkage2"):
        shutil.copy(IMPORTERS / name, tmp_path)
    found = call("check_model", tmp_path, model="coordinates_off.json")
    assert found.data["foreign_format"] == "open_linkage" and found.data["ok"] and found.data["mobility"] == 1
    model = lw.loads(found.data["text"])
    data = json.loads((tmp_path / "coordinates_off.json").read_text("utf-8"))
    lengths = sorted(each["length"] / 1000 for each in data["bars"])
    assert sorted(each.lengths[0] for each in model.links.values()) == pytest.approx(lengths, rel=1e-6)
    as_text = call("check_model", tmp_path, model=json.dumps(data))
    assert as_text.data["text"] == found.data["text"].replace(", coordinates_off.json", "") or as_text.data["ok"]
    xml = call("check_model", tmp_path, model="four_bar.linkage2")
    assert xml.data["foreign_format"] == "linkage" and lw.loads(xml.data["text"]).links
    refused = call("get_metrics", tmp_path, model="four_bar.linkage2")
    assert refused.codes == ["assistants.foreign"] and "check_model" in refused.data["summary"]
    assert call("check_model", tmp_path, model="coordinates_off.json", foreign={"unit": "furlong"}).codes == [
        "import.no_unit"
    ]


def test_a_model_of_ours_in_json_is_no_file_of_another_program() -> None:
    text = json.dumps({"format": 1, "name": "x", "frame": {"points": {"O": ["0 mm", "0 mm"]}}, "links": {}})
    assert call("check_model", model=text).data["foreign_format"] == ""


def test_positions_of_several_drivers_and_limit_positions() -> None:
    """At a limit of the rocker its velocity is zero; two sun wheels stand where they are set."""
    found = call(
        "solve_machine", model=CRANK_ROCKER, at="rocker min, rocker max", columns=["rocker.angular_velocity"]
    )
    assert found.column("rocker.angular_velocity") == pytest.approx([0.0, 0.0], abs=1e-7)
    model = "gallery:planetary_two_inputs"
    first, second = lw.load(model).drivers
    asked = f"{first}=10 deg, 20 deg; {second}=-30 deg"
    at = call("solve_machine", model=model, at=asked)
    assert at.column(first) == pytest.approx([math.radians(10), math.radians(20)])
    assert at.column(second) == pytest.approx([math.radians(-30)] * 2)
    assert call("draw_machine", model=model, at=asked.replace(", 20 deg", "")).pictures


ARM = """\
format: 1
name: arm
frame: {points: {O: [0 m, 0 m]}}
links: {arm: {points: [O, G], length: 0.5 m, mass: 2 kg, mass_centre: [0.5 m, 0 m]}}
driver: {turn: arm, about: O, speed: 1 rad/s}
gravity: [0, -9.81 m/s²]
run: {for: 1 s}
"""


def test_a_pendulum_stays_at_rest_below_and_falls_with_its_energy() -> None:
    """A point mass on an arm: at rest above and below, there with √(g/l); let go level it swings as energy says."""
    found = call("solve_machine", model=ARM, under="rest")
    above, below = found.data["rests"]
    assert (above["stability"], below["stability"]) == ("unstable", "stable")
    assert [each["inputs"]["driver"] for each in (above, below)] == pytest.approx([math.pi / 2, 1.5 * math.pi])
    assert below["frequencies"] == pytest.approx([math.sqrt(9.81 / 0.5) / (2 * math.pi)])
    run = call("solve_machine", model=ARM, under="forces", positions=8, columns=["arm.angle", "arm.angular_velocity"])
    assert run.column("time") == pytest.approx([k / 8 for k in range(9)])
    for angle, speed in zip(run.column("arm.angle"), run.column("arm.angular_velocity"), strict=True):
        assert 0.5 * (0.5 * speed) ** 2 + 9.81 * 0.5 * math.sin(angle) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.rotating
def test_a_run_tells_how_it_ends_and_what_happens() -> None:
    found = call("solve_machine", model="gallery:press_stop", under="forces")
    assert "s, then" in found.data["summary"] and any(each.startswith("dynamics.") for each in found.codes)
    assert call("solve_machine", model=CRANK_ROCKER, under="forces").failed

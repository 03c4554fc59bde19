"""Drawing sheets: frames and title blocks of the standards, panels apart from one another, pictures to scale."""

import dataclasses
import io
import math
import re
from itertools import combinations
from typing import Any

import ezdxf
import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import faulty, findings, refused, said

import linkwright as lw

#: Width and height of the frame's inside, mm: GB/T 14689 bound, not bound; ISO 5457.
FRAMES = {
    ("A0", "gb", True): (1154, 821),
    ("A1", "gb", True): (806, 574),
    ("A2", "gb", True): (559, 400),
    ("A3", "gb", True): (390, 287),
    ("A1", "gb", False): (801, 554),
    ("A2", "gb", False): (574, 400),
    ("A1", "iso", True): (811, 574),
    ("A4", "gb", True): (180, 287),
    ("A4", "iso", True): (180, 277),
}
ROUND = (1.0, 2.0, 2.5, 4.0, 5.0)


def sheet(name: str, language: str = "en", **section: Any) -> lw.Sheet:
    return lw.sheet(store.machine(name), language=language, section=section)


def texts(found: lw.Sheet) -> list[str]:
    return ["".join(text for text, _ in each.runs) for each in found.texts]


@pytest.mark.parametrize(("size", "standard", "binding"), FRAMES)
def test_frames_have_the_sizes_of_the_standards(size: str, standard: str, binding: bool) -> None:
    found = sheet("slider_crank_offset", size=size, standard=standard, binding=binding, only=["mechanism"])
    inner = found.paper.frame
    assert (inner.width, inner.height) == FRAMES[size, standard, binding]


def test_the_language_chooses_the_standard() -> None:
    assert sheet("slider_crank_offset", only=["mechanism"]).paper.standard == "iso"
    chinese = sheet("slider_crank_offset", "zh", only=["mechanism"])
    assert chinese.paper.standard == "gb"
    assert (chinese.title_block.width, chinese.title_block.height) == (180.0, 56.0)
    short = sheet("slider_crank_offset", "zh", only=["mechanism"], block="short")
    assert (short.title_block.width, short.title_block.height) == (140.0, 40.0)


def apart(found: lw.Sheet) -> None:
    """Panels do not meet, lie in the frame and off the title block; texts are legible and lie within the frame."""
    inner = found.paper.frame
    for one, other in combinations(found.panels, 2):
        assert not found.panels[one].meets(found.panels[other]), (one, other)
    for name, box in found.panels.items():
        assert inner.holds(box), name
        assert not box.meets(found.title_block), name
    for each in found.texts:
        chinese = any("\u4e00" <= c <= "\u9fff" for text, _ in each.runs for c in text)
        assert each.height >= (3.5 if chinese else 2.5)
        low, high = each.cloud.min(axis=0), each.cloud.max(axis=0)
        assert (low > 0).all() and (high < (found.paper.width, found.paper.height)).all()


@pytest.mark.parametrize(
    ("name", "size", "language"),
    [("shaper_quick_return", "A1", "zh"), ("slider_crank_offset", "A4", "en"), ("truss", "A3", "zh")],
)
def test_nothing_overlaps(name: str, size: str, language: str) -> None:
    found = sheet(name, language, size=size)
    assert "mechanism" in found.panels
    apart(found)


@pytest.mark.rotating
@pytest.mark.parametrize("name", store.names())
def test_nothing_overlaps_over_the_gallery(name: str) -> None:
    for size, language in (("A1", "en"), ("A3", "zh")):
        found = sheet(name, language, size=size)
        assert "mechanism" in found.panels
        apart(found)


def drawn(found: lw.Sheet, kind: str) -> list[Any]:
    """Lines, circles or texts of a sheet."""
    return [item for item in found.picture.items if type(item).__name__ == kind]


def tips(found: lw.Sheet) -> np.ndarray:
    """The points of the arrows on a sheet, (n, 2) mm."""
    heads = [each.points[0] for each in drawn(found, "Line") if each.fill == "ink" and len(each.points) == 3]
    return np.array(heads)


def test_the_velocity_polygon_is_true_to_scale() -> None:
    """Velocities at 100° from the gallery's independent solution: e 540 mm × ω of the lever, f that of the ram."""
    found = sheet(
        "shaper_quick_return", positions=["100 deg"], only=["velocity_1"], panels={"velocity_1": {"scale": 0.01}}
    )
    assert any("0.01 (m/s)/mm" in text for text in texts(found))
    ends = tips(found)
    across = [math.dist(a, b) for a, b in combinations([*ends, *_poles(found)], 2)]
    for velocity in (0.540 * 1.4013053, 0.75368932, 0.110 * 2 * math.pi):
        assert min(abs(each - velocity / 0.01) for each in across) < 1e-3


def _poles(found: lw.Sheet) -> list[np.ndarray]:
    return [each.points[0] for each in drawn(found, "Line") if each.style == "thick" and len(each.points) == 2]


def test_the_force_polygon_is_true_to_scale() -> None:
    """The weight of the ram, 62 kg, at 5 N/mm; reactions at 100° from the independent solution."""
    name = "force_1_ram"
    found = sheet("shaper_quick_return", positions=["100 deg"], only=[name], panels={name: {"scale": 5.0}})
    inertia = 62 * 0.47969231 / 5.0
    starts = [each.points[0] for each in drawn(found, "Line") if len(each.points) == 2]
    sizes = [math.dist(a, b) for a in starts for b in tips(found)]
    for length in (62 * 9.81 / 5.0, inertia):
        assert min(abs(each - length) for each in sizes) < 1e-3


def test_the_mechanism_is_to_a_standard_scale() -> None:
    """The crank of 110 mm at 1:2: its pin runs on a circle of 55 mm, a chain line."""
    found = sheet("shaper_quick_return", only=["mechanism"], panels={"mechanism": {"scale": 0.002}})
    assert found.scale == "1:2"
    spans = [np.ptp(each.points, axis=0) for each in drawn(found, "Line") if each.style == "chain"]
    assert any(np.allclose(span, 110.0, atol=0.01) for span in spans)


@pytest.mark.parametrize("name", ["shaper_quick_return", "jaw_crusher_sixbar", "wedge"])
def test_scales_are_preferred_numbers(name: str) -> None:
    scales = [float(number) for text in texts(sheet(name)) for number in re.findall(r"μ\S+ = ([\d.e+-]+) ", text)]
    assert len(scales) > 4
    for each in scales:
        mantissa = each / 10 ** math.floor(math.log10(each) + 1e-9)
        assert min(abs(mantissa - wanted) for wanted in ROUND) < 1e-6


def test_limit_positions_stand_in_double_dot_chain_lines() -> None:
    """The lever at both limits: two lines of 540 mm, 33.652898° apart."""
    found = sheet("shaper_quick_return", only=["mechanism"], panels={"mechanism": {"scale": 0.002}})
    levers = [
        each.points[-1] - each.points[0]
        for each in drawn(found, "Line")
        if each.style == "double_chain" and abs(math.dist(each.points[0], each.points[-1]) - 270.0) < 0.05
    ]
    angles = sorted({round(math.degrees(math.atan2(*vector[::-1])), 2) for vector in levers})
    assert angles[-1] - angles[0] == pytest.approx(33.652898, abs=0.02)


def test_the_sheet_takes_only_what_is_asked_for() -> None:
    wanted = ["mechanism", "velocity_1", "table_data"]
    assert set(sheet("shaper_quick_return", only=wanted).panels) == set(wanted)
    assert "balance" not in sheet("shaper_quick_return", leave_out=["balance"]).panels


def test_a_panel_stands_where_the_file_places_it() -> None:
    found = sheet("shaper_quick_return", panels={"velocity_1": {"at": ["100 mm", "0.3 m"]}})
    box = found.panels["velocity_1"]
    assert (box.left, box.bottom) == (100.0, 300.0)
    apart(found)


def test_a_panel_has_the_size_that_the_file_gives() -> None:
    found = sheet("shaper_quick_return", only=["mechanism"], panels={"mechanism": {"size": "150 mm"}})
    assert found.panels["mechanism"].height <= 150.0
    assert found.scale == "1:5"


def test_small_sheets_say_what_has_no_room() -> None:
    found = sheet("shaper_quick_return", size="A4")
    assert {"mechanism", "velocity_1", "acceleration_1"} <= set(found.panels)
    (note,) = found.notes
    assert "A4" in note and "table_motion" in note and "force_2_ram" in note


def test_the_title_block_holds_what_the_file_says() -> None:
    given = {
        "school": "Harbour College",
        "student": "A. Reader",
        "adviser": "B. Teacher",
        "number": "MT-01",
        "date": "2026-11-28",
        "sheet": 1,
        "sheets": 2,
        "zh": {"student": "李明", "school": "某大学"},
    }
    english = texts(sheet("slider_crank_offset", only=["mechanism"], **given))
    assert {"Harbour College", "A. Reader", "B. Teacher", "MT-01", "2026-11-28", "1/2"} <= set(english)
    chinese = texts(sheet("slider_crank_offset", "zh", only=["mechanism"], **given))
    assert {"李明", "某大学", "MT-01"} <= set(chinese)
    assert "A. Reader" not in chinese


def test_the_title_block_falls_back_on_the_report() -> None:
    report = {"title": "Course work", "author": "C. Writer", "zh": {"title": "课程设计"}}
    model = dataclasses.replace(store.machine("slider_crank_offset"), report=report)
    assert {"Course work", "C. Writer"} <= set(texts(lw.sheet(model)))
    assert "课程设计" in texts(lw.sheet(model, language="zh"))


@pytest.mark.parametrize("name", ["truss", "two_bars_equilibrium"])
def test_what_has_no_driver_has_no_motion_on_its_sheet(name: str) -> None:
    found = sheet(name)
    assert {"mechanism", "table_data", "table_forces"} <= set(found.panels)
    assert not any(each.startswith(("velocity", "acceleration", "displacement")) for each in found.panels)


def test_what_has_no_mass_has_no_forces_on_its_sheet() -> None:
    assert not any("force" in each or each == "balance" for each in sheet("crank_rocker").panels)


def test_several_sliding_drivers_have_their_diagrams() -> None:
    wanted = {"balance_1", "balance_2", "balance_3"}
    assert set(sheet("excavator", only=sorted(wanted)).panels) == wanted


def test_the_pdf_has_the_size_of_the_paper() -> None:
    found = sheet("slider_crank_offset", size="A3", only=["mechanism"])
    media = re.search(rb"/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)\s*\]", found.content(".pdf"))
    assert media is not None
    assert [float(each) * 25.4 / 72 for each in media.groups()] == pytest.approx([420, 297], abs=0.01)


def test_the_svg_is_in_millimetres() -> None:
    head = sheet("slider_crank_offset", size="A3", only=["mechanism"]).svg()[:300]
    assert 'viewBox="0 0 420 297"' in head and 'width="420mm"' in head and 'height="297mm"' in head


def document(found: lw.Sheet) -> Any:
    return ezdxf.read(io.StringIO(found.content(".dxf").decode("utf-8")))


def test_the_dxf_is_sound_and_in_millimetres() -> None:
    found = sheet("shaper_quick_return", "zh")
    drawing = document(found)
    assert not drawing.audit().errors
    assert drawing.units == 4
    widths = {name: drawing.layers.get(name).dxf.lineweight for name in ("thick", "thin", "chain")}
    assert widths == {"thick": 70, "thin": 35, "chain": 35}
    assert drawing.layers.get("double_chain").dxf.linetype != "CONTINUOUS"
    space = drawing.modelspace()
    assert len(space.query("TEXT MTEXT")) == len(found.texts)
    every_place = np.array([point for line in space.query("LINE") for point in (line.dxf.start, line.dxf.end)])
    assert every_place[:, :2].min() >= -1e-6
    assert (every_place[:, :2].max(axis=0) <= (841.0 + 1e-6, 594.0 + 1e-6)).all()


def test_lines_end_at_pins_in_the_dxf() -> None:
    space = document(sheet("slider_crank_offset", only=["mechanism"])).modelspace()
    pins = [each for each in space.query("CIRCLE") if abs(each.dxf.radius - 1.5) < 1e-6]
    assert len(pins) >= 3
    for pin in pins:
        centre = np.array(pin.dxf.center)[:2]
        for line in every(space.query("LINE[layer=='thick']")):
            a, b = np.array(line.dxf.start)[:2], np.array(line.dxf.end)[:2]
            share = np.clip((centre - a) @ (b - a) / max((b - a) @ (b - a), 1e-12), 0.0, 1.0)
            assert np.hypot(*(a + share * (b - a) - centre)) > 1.45


def test_a_file_keeps_its_section() -> None:
    text = (
        store.text("crank_rocker")
        + "sheet: {size: A2, positions: [30 deg], panels: {mechanism: {at: [30 mm, 200 mm]}}}\n"
    )
    model = lw.loads(text)
    assert model.sheet["size"] == "A2"
    assert lw.loads(lw.dump(model)).sheet == model.sheet
    found = lw.sheet(model)
    assert found.paper.size == "A2"
    assert (found.panels["mechanism"].left, found.panels["mechanism"].bottom) == (30.0, 200.0)


def test_unknown_keys_of_a_file_are_found() -> None:
    told = findings(store.text("crank_rocker") + "sheet: {sise: A2}\n")
    said(told, "unknown-key", "sheet.sise", offer="size")
    said(findings(store.text("crank_rocker") + "sheet: {size: A7}\n"), "unknown-word", "sheet.size")


def test_refusals() -> None:
    with refused("sheet.no_panel", name="velocity_3"):
        sheet("crank_rocker", leave_out=["velocity_3"])
    with refused("sheet.bad_size", size="B1"):
        lw.sheet(store.machine("crank_rocker"), size="B1")
    with refused("sheet.no_kind", kind="gear"):
        lw.sheet(store.machine("crank_rocker"), kind="gear")
    with refused("sheet.outside", name="mechanism"):
        sheet("crank_rocker", panels={"mechanism": {"at": ["0 mm", "0 mm"]}})
    with refused("sheet.meets", name="mechanism", other="title_block"):
        sheet("crank_rocker", panels={"mechanism": {"at": ["600 mm", "20 mm"], "size": "120 mm"}})
    with refused("sheet.bad_ending", ending=".png"):
        sheet("crank_rocker", only=["mechanism"]).content(".png")
    with faulty("wrong-dimension", "sheet.positions.1"):
        sheet("crank_rocker", positions=["30 deg", "60 mm"])
    with faulty("unknown-key", "sheet.papre"):
        sheet("crank_rocker", papre="A1")

"""The DXF drawing is at true scale, in layers, and re-reads without an error."""

import io
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright import export

ezdxf = pytest.importorskip("ezdxf")


@pytest.fixture(scope="module")
def motion() -> lw.Motion:
    return store.motion("jaw_crusher_sixbar", 72)


def read(motion: lw.Motion, folder: Path, **options: Any) -> Any:
    document = ezdxf.readfile(export(motion, folder / "a.dxf", **options))
    assert not document.audit().errors
    return document


def on_layer(document: Any, layer: str, kind: str = "*") -> list[Any]:
    return list(document.modelspace().query(f'{kind}[layer=="{layer}"]'))


def test_links_have_their_lengths(motion: lw.Motion, tmp_path: Path) -> None:
    document = read(motion, tmp_path)
    assert document.units == 4
    lines = on_layer(document, "links")
    found = sorted(
        float(np.hypot(*np.ptp(np.array(line.get_points("xy")), axis=0)))
        for line in lines
        if line.dxftype() == "LWPOLYLINE"
    )
    found += [(line.dxf.end - line.dxf.start).magnitude for line in lines if line.dxftype() == "LINE"]
    assert sorted(found) == pytest.approx([100.0, 1000.0, 1150.0, 1250.0, 1960.0], rel=1e-12)


def measured(document: Any) -> list[float]:
    return sorted(each.get_measurement() for each in on_layer(document, "dimensions", "DIMENSION"))


#: Of the jaw crusher: links and the point D, then O3 and O5 from O1 across and up, mm.
LENGTHS = [100.0, 600.0, 1000.0, 1150.0, 1250.0, 1960.0, 940.0, 1000.0, 1000.0, 850.0]


def test_dimensions_measure_what_places_the_points(motion: lw.Motion, tmp_path: Path) -> None:
    assert measured(read(motion, tmp_path)) == pytest.approx(sorted(LENGTHS), rel=1e-12)
    document = read(motion, tmp_path, unit="m", force=True)
    assert document.units == 6
    assert measured(document) == pytest.approx([each / 1000 for each in sorted(LENGTHS)], rel=1e-12)


def test_an_offset_and_the_decimal_point(tmp_path: Path) -> None:
    """The guide of the press lies 60.5 mm above the crank's pin; its numbers have a point in every language."""
    motion = store.motion("slider_crank_offset", 24)
    for language in ("en", "zh"):
        document = read(motion, tmp_path, language=language, force=True)
        assert measured(document) == pytest.approx([60.5, 198.0, 702.5], rel=1e-12)
        shown = {text.plain_text() for text in numbers_of(document)}
        assert shown == {"60.5", "198", "702.5"}


def test_small_offsets_of_the_frame_and_slopes_of_guides_are_measured(tmp_path: Path) -> None:
    """All that places the frame's points, however small; and how a guide on a link is inclined to its axis."""
    motion = store.motion("slider_crank_offset", 24)
    frame = replace(motion.mechanism.frame, points={**motion.mechanism.frame.points, "G": (5.0, -2e-4)})
    moved = lw.solve_motion(replace(motion.mechanism, frame=frame), steps=24)
    found = measured(read(moved, tmp_path))
    for size in (5000.0, 0.2):
        assert any(each == pytest.approx(size, rel=1e-9) for each in found), size
    assert 15.0 in [round(each, 9) for each in measured(read(store.motion("wedge", 24), tmp_path, force=True))]


def test_the_angle_of_a_bent_link(tmp_path: Path) -> None:
    text = """format: 1
frame: {points: {O1: [0 m, 0 m], O2: [0.4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.1 m}
  coupler: {points: [A, B], length: 0.35 m}
  rocker: {points: [O2, B, C], lengths: [0.3 m, 0.2 m], angle: -50 deg}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 60 rpm}
"""
    document = read(lw.solve_motion(lw.loads(text), steps=12), tmp_path)
    assert measured(document) == pytest.approx([50.0, 100.0, 200.0, 300.0, 350.0, 400.0], rel=1e-12)


def numbers_of(document: Any) -> list[Any]:
    """The texts of dimensions as they are drawn."""
    dimensions = on_layer(document, "dimensions", "DIMENSION")
    return [each for one in dimensions for each in one.get_geometry_block().query("MTEXT")]


@pytest.mark.parametrize("model", ["slider_crank_offset", "swing_conveyor", "jaw_crusher_sixbar"])
def test_numbers_stand_clear_of_guides_links_and_each_other(model: str, tmp_path: Path) -> None:
    """Middles of texts lie further than half a letter from every line, and from other middles."""
    document = read(store.motion(model, 60), tmp_path)
    texts = numbers_of(document)
    middles = np.array([tuple(each.dxf.insert)[:2] for each in texts])
    half = 0.5 * texts[0].dxf.char_height
    lines = [*on_layer(document, "frame"), *on_layer(document, "links")]
    ends = [(each.dxf.start, each.dxf.end) if each.dxftype() == "LINE" else None for each in lines]
    rows = [np.array([tuple(a)[:2], tuple(b)[:2]]) for a, b in filter(None, ends)]
    rows += [np.array(each.get_points("xy")) for each in lines if each.dxftype() == "LWPOLYLINE"]
    for row in every(rows, least=5):
        share = np.linspace(0.0, 1.0, 200)[:, None, None]
        dots = (row[:-1] + share * (row[1:] - row[:-1])).reshape(-1, 2)
        assert np.hypot(*(dots[:, None] - middles).T).min() > half
    gaps = np.hypot(*(middles[:, None] - middles).T) + 1e9 * np.eye(len(middles))
    assert gaps.min() > 2.0 * half


def test_pins_are_where_the_motion_puts_them(motion: lw.Motion, tmp_path: Path) -> None:
    circles = on_layer(read(motion, tmp_path, position=20), "joints", "CIRCLE")
    centres = np.array([[circle.dxf.center.x, circle.dxf.center.y] for circle in circles])
    for name in ("A", "B", "C", "jaw.D"):
        place = 1000 * motion.point(name).position[20]
        assert np.hypot(*(centres - place).T).min() < 1e-9


@pytest.mark.parametrize("curve", ["polyline", "spline"])
def test_paths_go_through_the_solved_positions(motion: lw.Motion, tmp_path: Path, curve: str) -> None:
    document = read(motion, tmp_path, paths=["B"], curve=curve, unit="m")
    (path,) = on_layer(document, "paths")
    through = path.fit_points if curve == "spline" else path.get_points("xy")
    places = np.array([tuple(each)[:2] for each in through])[: motion.steps]
    assert places == pytest.approx(motion.point("B").position, abs=1e-12)


def test_every_kind_has_its_layer(motion: lw.Motion, tmp_path: Path) -> None:
    document = read(motion, tmp_path)
    for layer in ("frame", "links", "joints", "paths", "dimensions", "text"):
        assert on_layer(document, layer), layer
    texts = {each.dxf.text for each in on_layer(document, "text", "TEXT")}
    assert {"A", "B", "C", "D", "O1", "jaw", motion.mechanism.name} <= texts
    assert not on_layer(read(motion, tmp_path, dimensions=False, labels=False, force=True), "text")


def test_a_pin_radius_is_drawn(tmp_path: Path) -> None:
    text = lw.dump(store.machine("fourbar_lecture"))
    joints = "joints:\n  B: {kind: revolute, pin_radius: 7 mm}\n"
    assert "joints:" not in text
    document = read(lw.solve_motion(lw.loads(text + joints), steps=12), tmp_path)
    assert 7.0 in [pytest.approx(circle.dxf.radius) for circle in on_layer(document, "joints", "CIRCLE")]


def test_chinese_names_are_kept(tmp_path: Path) -> None:
    mechanism = replace(store.machine("crank_rocker"), name="曲柄摇杆机构")
    document = read(lw.solve_motion(mechanism, steps=12), tmp_path)
    assert "曲柄摇杆机构" in {each.dxf.text for each in on_layer(document, "text", "TEXT")}
    stream = io.StringIO()
    document.write(stream)
    assert "曲柄摇杆机构" in stream.getvalue()


def test_outlines_are_closed_polylines_with_exact_arcs(tmp_path: Path) -> None:
    """The ends of the crank are half circles (bulge 1) of half its width about its pins, in layer links; the rod is a
    straight bar too."""
    motion = store.motion("slider_crank_offset", 24)
    document = read(motion, tmp_path, outlines=True)
    bars = [each for each in on_layer(document, "links", "LWPOLYLINE") if each.closed]
    arcs = [each.get_points("xyb") for each in bars]
    halves = [(rows[k], rows[k + 1]) for rows in arcs for k in range(len(rows) - 1) if abs(rows[k][2] - 1.0) < 1e-9]
    ends = {tuple(np.round([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], 6)) for a, b in halves}
    for name in ("O", "A"):
        place = (0.0, 0.0) if name == "O" else tuple(1000 * motion.point(name).position[0])
        assert min(np.hypot(*(np.array(end) - place)) for end in ends) < 1e-5

"""Outlines of plates in DXF drawings."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing
from ezdxf.math import Matrix44

import linkwright as lw
from linkwright.core.plane import area
from linkwright.importers.dxf_outline import read_outline

MILLIMETRES, INCHES = 4, 1
#: Line and half circles of a bar, mm: 40 between the ends, 10 wide.
BAR = [(0, -5, 0), (40, -5, 1), (40, 5, 0), (0, 5, 1)]
BAR_AREA = 400e-6 + math.pi * 25e-6


def saved(folder: Path, draw: Callable[[Any], object], unit: int = MILLIMETRES) -> Path:
    document = ezdxf.new()
    document.units = unit
    draw(document.modelspace())
    document.saveas(folder / "jaw.dxf")
    return folder / "jaw.dxf"


def areas(path: Path) -> list[float]:
    rings, findings = read_outline(path)
    assert findings == ()
    places = [np.array([complex(*each) for each in ring]) for ring in rings]
    return [area(np.append(each, each[0])) for each in places]


def pieces_of_bar(space: Any) -> None:
    """Its lines and arcs out of order and direction; one is drawn twice."""
    space.add_line((40, 5), (0, 5))
    space.add_arc((0, 0), 5, 90, 270)
    space.add_line((40, -5), (0, -5))
    space.add_arc((40, 0), 5, 270, 90)
    space.add_line((0, 5), (40, 5))


def in_block(space: Any) -> None:
    document: Drawing = space.doc
    block = document.blocks.new("BAR")
    block.add_lwpolyline([(0.1 * x, 0.1 * y, bulge) for x, y, bulge in BAR], format="xyb", close=True)
    space.add_blockref("BAR", (100, 50), {"xscale": 10, "yscale": 10, "rotation": 30})


def mirrored(space: Any) -> None:
    space.add_lwpolyline(BAR, format="xyb", close=True).transform(Matrix44.scale(-1, 1, 1))


def old_polyline(space: Any) -> None:
    space.add_polyline2d(BAR, format="xyb", close=True)


@pytest.mark.parametrize(
    "draw",
    [
        lambda space: space.add_lwpolyline(BAR, format="xyb", close=True),
        pieces_of_bar,
        in_block,
        mirrored,
        old_polyline,
    ],
)
def test_a_bar_drawn_in_any_way(tmp_path: Path, draw: Callable[[Any], object]) -> None:
    (found,) = areas(saved(tmp_path, draw))
    # chords leave two half circles of 5 mm by less than 1 µm
    assert BAR_AREA - 2.0 * math.pi * 5e-3 * 1e-6 < found <= BAR_AREA * (1.0 + 1e-12)


def test_openings_come_after_the_outer_ring_clockwise(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        space.add_circle((0, 0), 2)
        space.add_ellipse((20, 0), (4, 0), 0.5)
        space.add_lwpolyline(BAR, format="xyb", close=True)
        space.add_text("jaw").set_placement((0, 0))

    outer, *inner = areas(saved(tmp_path, draw))
    assert outer == pytest.approx(BAR_AREA, rel=1e-3)
    assert sorted(inner) == pytest.approx([-math.pi * 8e-6, -math.pi * 4e-6], rel=1e-3)


def test_places_are_in_the_unit_of_the_file(tmp_path: Path) -> None:
    path = saved(tmp_path, lambda space: space.add_lwpolyline([(0, 0), (2, 0), (2, 1), (0, 1)], close=True), INCHES)
    (ring,), findings = read_outline(path)
    assert np.array(ring) == pytest.approx(np.array([(0.0, 0.0), (0.0508, 0.0), (0.0508, 0.0254), (0.0, 0.0254)]))
    assert findings == ()


def test_a_closed_spline(tmp_path: Path) -> None:
    turns = np.linspace(0.0, 2.0 * math.pi, 41)
    points = [(30 * math.cos(t), 20 * math.sin(t)) for t in turns]
    (found,) = areas(saved(tmp_path, lambda space: space.add_spline(points)))
    assert found == pytest.approx(math.pi * 600e-6, rel=1e-3)


@pytest.mark.parametrize(
    ("draw", "code", "said"),
    [
        (lambda space: space.add_lwpolyline([(0, 0), (20, 0), (20, 10), (0, 10)]), "open", "(0, 10) mm"),
        (
            lambda space: [space.add_circle((0, 0), 5), space.add_circle((20, 0), 4)],
            "second",
            "(24, 0) mm is not within the outer one",
        ),
        (lambda space: [pieces_of_bar(space), space.add_line((40, 5), (40, -5))], "branches", "meet at (40, "),
        (lambda space: space.add_text("nothing"), "no_outline", "no lines or curves"),
    ],
)
def test_what_is_no_outline(tmp_path: Path, draw: Callable[[Any], object], code: str, said: str) -> None:
    rings, findings = read_outline(saved(tmp_path, draw))
    assert rings == ()
    assert findings[0].code == f"import.dxf.{code}"
    assert findings[0].where == "jaw.dxf"
    assert said in str(findings[0])


def test_a_drawing_without_unit_is_in_millimetres(tmp_path: Path) -> None:
    path = saved(tmp_path, lambda space: space.add_circle((0, 0), 10), 0)
    (ring,), (finding,) = read_outline(path)
    assert np.abs(np.array(ring) @ [1.0, 1j]) == pytest.approx(0.01)
    assert (finding.severity, finding.code) == ("warning", "import.dxf.unit")
    (ring,), findings = read_outline(path, unit="in")
    assert np.abs(np.array(ring) @ [1.0, 1j]) == pytest.approx(0.254)
    assert findings == ()


def test_ends_that_almost_meet_are_one(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        space.add_lwpolyline([(0, 0), (20, 0), (20, 10)])
        space.add_lwpolyline([(0, 0.001), (0, 10), (20.001, 10)])

    (ring,), (finding,) = read_outline(saved(tmp_path, draw))
    assert len(ring) == 4
    assert (finding.severity, finding.code) == ("note", "import.dxf.apart")


def test_hidden_layers_are_left_out(tmp_path: Path) -> None:
    def draw(space: Any) -> None:
        space.doc.layers.add("CENTRE LINES").off()
        space.add_line((-10, 0), (50, 0), {"layer": "CENTRE LINES"})
        pieces_of_bar(space)

    assert areas(saved(tmp_path, draw)) == pytest.approx([BAR_AREA], rel=1e-3)


def with_file(folder: Path, name: str = "jaw.dxf") -> Path:
    """A crank-rocker whose crank has the outline of a file next to it."""
    text, crank = lw.gallery.content("crank_rocker").decode(), "crank: {points: [O1, A], length: 1 m"
    assert crank in text
    path = folder / "machine.yaml"
    path.write_text(text.replace(crank, f"{crank}, shape: {{file: {name}}}"), encoding="utf-8")
    return path


def test_a_link_has_the_outline_of_a_file(tmp_path: Path) -> None:
    saved(tmp_path, pieces_of_bar)
    shape = lw.load(with_file(tmp_path)).links["crank"].shape
    assert shape is not None
    assert (shape.kind, len(shape.rings)) == ("outline", 1)
    low, high = np.array(shape.rings[0]).min(axis=0), np.array(shape.rings[0]).max(axis=0)
    assert np.array([low, high]) == pytest.approx(np.array([[-0.005, -0.005], [0.045, 0.005]]), abs=1e-6)


def test_a_file_without_closed_outline_is_reported_at_the_key(tmp_path: Path) -> None:
    saved(tmp_path, lambda space: space.add_line((0, 0), (10, 0)))
    (finding,) = lw.check(with_file(tmp_path))
    assert (finding.key, finding.code) == ("links.crank.shape.file", "import.dxf.open")
    assert "jaw.dxf, LINE #2F, 0: a contour is open at (10, 0) mm" in str(finding)

"""The DXF drawing is at true scale, in layers, and re-reads without an error."""

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linkwright as lw
from linkwright.export import export
from linkwright.export.dxf.sheet import LAYERS

ezdxf = pytest.importorskip("ezdxf")


@pytest.fixture(scope="module")
def motion() -> lw.Motion:
    return lw.solve_motion(lw.load("gallery:jaw_crusher_sixbar"), steps=72)


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
    found = sorted(float(np.hypot(*np.ptp(np.array(line.get_points("xy")), axis=0))) for line in lines if
                   line.dxftype() == "LWPOLYLINE")  # fmt: skip
    found += [(line.dxf.end - line.dxf.start).magnitude for line in lines if line.dxftype() == "LINE"]
    assert sorted(found) == pytest.approx([100.0, 1000.0, 1150.0, 1250.0, 1960.0], rel=1e-12)


def test_dimensions_measure_the_lengths(motion: lw.Motion, tmp_path: Path) -> None:
    found = [each.get_measurement() for each in on_layer(read(motion, tmp_path), "dimensions", "DIMENSION")]
    assert sorted(found) == pytest.approx([100.0, 1000.0, 1150.0, 1250.0, 1960.0], rel=1e-12)
    document = read(motion, tmp_path, unit="m", force=True)
    found = [each.get_measurement() for each in on_layer(document, "dimensions", "DIMENSION")]
    assert document.units == 6
    assert sorted(found) == pytest.approx([0.1, 1.0, 1.15, 1.25, 1.96], rel=1e-12)


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
    text = lw.dump(lw.load("gallery:fourbar_lecture"))
    joints = "joints:\n  B: {kind: revolute, pin_radius: 7 mm}\n"
    assert "joints:" not in text
    document = read(lw.solve_motion(lw.loads(text + joints), steps=12), tmp_path)
    assert 7.0 in [pytest.approx(circle.dxf.radius) for circle in on_layer(document, "joints", "CIRCLE")]


def test_chinese_names_are_kept(tmp_path: Path) -> None:
    text = lw.dump(lw.load("gallery:crank_rocker"))
    lines = [line for line in text.splitlines() if not line.startswith("name:")]
    document = read(lw.solve_motion(lw.loads("\n".join([*lines, "name: 曲柄摇杆机构"])), steps=12), tmp_path)
    assert "曲柄摇杆机构" in {each.dxf.text for each in on_layer(document, "text", "TEXT")}
    stream = io.StringIO()
    document.write(stream)
    assert "曲柄摇杆机构" in stream.getvalue()


def luminance(colour: tuple[int, int, int]) -> float:
    """Relative luminance as WCAG 2.2 defines it."""
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in (c / 255 for c in colour)]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize("sheet", [(0, 0, 0), (33, 40, 48), (255, 255, 255)])
def test_every_layer_is_seen_on_dark_and_on_white_sheets(sheet: tuple[int, int, int]) -> None:
    colours = pytest.importorskip("ezdxf.colors")
    ground = luminance(sheet)
    for name, index in LAYERS.items():
        if index == 7:
            continue  # white on dark, black on white, by definition of the format
        ink = luminance(tuple(colours.aci2rgb(index)))
        contrast = (max(ink, ground) + 0.05) / (min(ink, ground) + 0.05)
        assert contrast >= 3.0, name
    assert len(set(LAYERS.values())) == len(LAYERS)

"""A machine put together from its DXF files alone: holes coincide, slots lead blocks, areas give masses."""

import math
from collections import Counter
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import ezdxf
import ezdxf.math
import numpy as np
import pytest
import shapely
from scipy.optimize import least_squares
from tests import store

import linkwright as lw

MM = 1e-3
MACHINES = [
    "crank_rocker",
    "slider_crank_offset",
    *(
        pytest.param(name, marks=pytest.mark.rotating)
        for name in ("theo_jansen_leg", "jaw_crusher_sixbar", "toggle_press")
    ),
]


class Drawn:
    """What a DXF file of a plate shows: circles on layer ``holes``, names on ``engrave``, loops on ``cut``; m."""

    def __init__(self, path: Path) -> None:
        space = ezdxf.readfile(path).modelspace()
        circles = space.query('CIRCLE[layer=="holes"]')
        self.circles = [(MM * complex(c.dxf.center.x, c.dxf.center.y), MM * c.dxf.radius) for c in circles]
        texts = space.query('TEXT[layer=="engrave"]')
        self.texts = {t.dxf.text: MM * complex(t.dxf.align_point.x, t.dxf.align_point.y) for t in texts}
        outer, inner = (space.query(f'LWPOLYLINE[layer=="{layer}"]') for layer in ("cut", "holes"))
        self.outer, self.inner = [_ring(each) for each in outer], [_ring(each) for each in inner]
        holes = math.pi * sum(radius**2 for _centre, radius in self.circles)
        self.area = sum(map(_area, outer)) - sum(map(_area, inner)) - holes

    def hole(self, name: str) -> complex:
        """The centre of the hole next to a name."""
        at = self.texts[name]
        return min(self.circles, key=lambda circle: abs(abs(circle[0] - at) - circle[1]))[0]


def _corners(polyline: Any) -> list[tuple[complex, complex, float]]:
    """Start, end and bulge of the edges of a closed polyline, m."""
    assert polyline.closed
    rows = [(MM * complex(x, y), bulge) for x, y, bulge in polyline.get_points("xyb")]
    return [(a, b, bulge) for (a, bulge), (b, _bulge) in zip(rows, rows[1:] + rows[:1], strict=True)]


def _area(polyline: Any) -> float:
    """Area within a polyline: the polygon of its corners, and over each chord the segment of its arc."""
    total = 0.0
    for a, b, bulge in _corners(polyline):
        angle = 4.0 * math.atan(bulge)
        radius = 0.5 * abs(b - a) / math.sin(0.5 * angle) if bulge else 0.0
        total += 0.5 * ((a.conjugate() * b).imag + radius**2 * (angle - math.sin(angle)))
    return abs(total)


def _ring(polyline: Any) -> shapely.Polygon:
    """The polyline with its arcs as chords of 1/40 of their angle."""
    found = []
    for a, b, bulge in _corners(polyline):
        found.append((a.real, a.imag))
        if bulge:
            centre, _start, _end, _radius = ezdxf.math.bulge_to_arc((a.real, a.imag), (b.real, b.imag), bulge)
            first = np.angle(a - complex(*centre))
            turns = first + 4.0 * math.atan(bulge) * np.arange(1, 40) / 40
            reach = abs(a - complex(*centre))
            found += [(centre.x + reach * math.cos(t), centre.y + reach * math.sin(t)) for t in turns]
    return shapely.Polygon(found)


@cache
def parts(name: str) -> lw.CutParts:
    return lw.cut_parts(store.machine(name))


@cache
def plates(name: str) -> dict[str, Drawn]:
    """The plates of a machine, as their files show them."""
    with TemporaryDirectory() as folder:
        files = parts(name).save(folder, ["dxf"])
        drawn = (each for each in files if each.suffix == ".dxf" and not each.name.startswith("sheet-"))
        return {each.stem: Drawn(each) for each in drawn}


def shared(drawn: dict[str, Drawn]) -> list[str]:
    """Names that are engraved on two plates or more."""
    count = Counter(text for plate in drawn.values() for text in plate.texts)
    return [text for text, number in count.items() if number > 1]


@pytest.mark.parametrize("name", MACHINES)
def test_shared_holes_coincide_where_the_solved_machine_has_its_pins(name: str) -> None:
    motion = store.motion(name, 12)
    names, checked = shared(plates(name)), 0
    for index in (0, 5):
        pins = {text: complex(*motion.point(text).position[index]) for text in names if text in motion.mechanism.pins}
        for plate, drawn in plates(name).items():
            held = [text for text in names if text in drawn.texts and text in pins]
            local, world = (np.array([get(text) for text in held]) for get in (drawn.hole, pins.__getitem__))
            if plate == "frame":
                assert np.abs(local - world).max() < 1e-9
            elif len(held) > 1:
                far = int(np.abs(local - local[0]).argmax())
                turn = (world[far] - world[0]) / (local[far] - local[0])
                assert abs(abs(turn) - 1.0) * abs(local[far] - local[0]) < 1e-9
                assert np.abs(world[0] + turn * (local - local[0]) - world).max() < 1e-9
                checked += 1
    assert checked >= 4


@pytest.mark.parametrize("name", [MACHINES[0], *MACHINES[2:4]])
def test_the_loops_close_from_the_files_alone(name: str) -> None:
    """Plates are unknown poses, the crank's angle is given, and shared holes are to coincide."""
    drawn = plates(name)
    motion, names = store.motion(name, 12), shared(plates(name))
    moving = [plate for plate in drawn if plate != "frame"]
    starts = []
    for plate in moving:
        held = [text for text in names if text in drawn[plate].texts]
        first, last = (complex(*motion.point(text).position[3]) for text in (held[0], held[-1]))
        turn = np.angle((last - first) / (drawn[plate].hole(held[-1]) - drawn[plate].hole(held[0])))
        origin = first - np.exp(1j * turn) * drawn[plate].hole(held[0])
        starts.append([origin.real, origin.imag, turn + 0.02])
    crank = starts[moving.index("crank")][2]

    def gaps(values: np.ndarray) -> np.ndarray:
        poses = dict(zip(moving, values.reshape(-1, 3), strict=True))
        found = [poses["crank"][2] - crank]
        for text in names:
            places = []
            for plate, each in drawn.items():
                if text in each.texts:
                    x, y, turn = poses.get(plate, (0.0, 0.0, 0.0))
                    places.append(complex(x, y) + np.exp(1j * turn) * each.hole(text))
            found += [part for other in places[1:] for part in ((other - places[0]).real, (other - places[0]).imag)]
        return np.array(found)

    closed = least_squares(gaps, np.ravel(starts), xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert np.abs(closed.fun).max() < 1e-9
    moved = closed.x.reshape(-1, 3)[moving.index("crank")]
    assert moved[2] == pytest.approx(crank, abs=1e-9)


def test_a_block_fills_the_width_of_its_slot_and_the_slot_has_room_for_the_stroke() -> None:
    drawn, motion = plates("slider_crank_offset"), store.motion("slider_crank_offset", 36)
    (slot,), block = drawn["guide-guide"].inner, drawn["slider"].outer[0]
    low_x, low_y, high_x, high_y = slot.bounds
    width, height = block.bounds[2] - block.bounds[0], block.bounds[3] - block.bounds[1]
    assert high_y - low_y == pytest.approx(height, abs=1e-9)
    ways = np.array([complex(*row) for row in motion.point("B").position])
    hole = drawn["slider"].hole("B") - complex(0.5 * (block.bounds[0] + block.bounds[2]), 0.0)
    assert np.abs(ways.imag - 0.5 * (low_y + high_y)).max() < 1e-9
    assert low_x < ways.real.min() - 0.5 * width - hole.real and ways.real.max() + 0.5 * width - hole.real < high_x
    posts = [text for text in drawn["frame"].texts if text.startswith("guide.")]
    assert len(posts) == 2
    for text in posts:
        assert abs(drawn["frame"].hole(text) - drawn["guide-guide"].hole(text)) < 1e-9


@pytest.mark.parametrize("name", MACHINES)
def test_outlines_are_simple_and_their_areas_give_the_masses_listed(name: str) -> None:
    for plate in (each for each in parts(name).parts if each.sort == "plate"):
        drawn = plates(name)[plate.name.replace(" ", "-")]
        assert drawn.outer and all(ring.is_valid and ring.exterior.is_simple for ring in (*drawn.outer, *drawn.inner))
        assert all(each.within(drawn.outer[0]) for each in drawn.inner)
        assert drawn.area * plate.length * 7850.0 == pytest.approx(plate.mass, rel=1e-9)

"""The drawing of a mechanism: where things are, what is shown, what is refused."""

import math
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

import linkwright as lw
from linkwright.plot.animation import animate
from linkwright.plot.drawing import Drawing, draw
from linkwright.plot.drawing.limits import limit_positions
from linkwright.plot.drawing.vectors import round_length, with_unit

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def crusher() -> lw.Motion:
    return lw.solve_motion(lw.load("gallery:jaw_crusher_sixbar"), steps=72)


def classes(drawing: Drawing) -> list[str]:
    words = (e.get("class", "") for e in ET.fromstring(drawing.svg).iter())
    return [word for each in words for word in each.split()]


def texts(drawing: Drawing) -> list[str]:
    return ["".join(e.itertext()) for e in ET.fromstring(drawing.svg).iter(f"{SVG}text")]


def circles_on_paper(drawing: Drawing, style: str) -> list[tuple[float, float]]:
    """Centres of circles, through the transforms of their groups."""
    found = []

    def walk(node: ET.Element, matrix: np.ndarray) -> None:
        for kind, numbers in re.findall(r"(translate|rotate)\(([^)]*)\)", node.get("transform", "")):
            values = [float(x) for x in numbers.split()]
            step = np.eye(3)
            if kind == "translate":
                step[:2, 2] = values
            else:
                c, s = math.cos(math.radians(values[0])), math.sin(math.radians(values[0]))
                step[:2, :2] = [[c, -s], [s, c]]
            matrix = matrix @ step
        if node.tag == f"{SVG}circle" and node.get("class") == style:
            x, y, _ = matrix @ [float(node.get("cx", 0)), float(node.get("cy", 0)), 1.0]
            found.append((x, y))
        for child in node:
            walk(child, matrix)

    walk(ET.fromstring(drawing.svg), np.eye(3))
    return found


@pytest.mark.parametrize("position", [0, 17, 50])
def test_pins_stand_to_scale_with_y_up(crusher: lw.Motion, position: int) -> None:
    names = ("O1", "A", "B", "O3", "C", "O5")
    frame = crusher.mechanism.frame.points
    world = np.array([frame[n] if n in frame else crusher.point(n).position[position] for n in names])
    paper = np.array(circles_on_paper(draw(crusher, position=position), "lw-pin"))
    assert len(paper) == len(names)
    scale = np.hypot(*np.ptp(paper, axis=0)) / np.hypot(*np.ptp(world, axis=0))
    expected = (world - world.mean(axis=0)) * (scale, -scale)
    order = [int(np.argmin(np.hypot(*(paper - paper.mean(axis=0) - row).T))) for row in expected]
    assert sorted(order) == list(range(len(names)))
    assert np.allclose((paper - paper.mean(axis=0))[order], expected, atol=0.05)


def test_symbols_of_the_crusher(crusher: lw.Motion) -> None:
    drawing = draw(crusher)
    assert classes(drawing).count("lw-support") == 3
    assert classes(drawing).count("lw-input-head") == 1
    assert set(texts(drawing)) >= {"O1", "A", "B", "C", "D", "O3", "O5", "crank", "pitman", "jaw"}
    assert "crank" not in texts(draw(crusher, labels="points"))
    assert texts(draw(crusher, labels=False)) == []


def test_symbols_do_not_depend_on_the_size_of_the_machine(crusher: lw.Motion) -> None:
    mechanism = crusher.mechanism
    tiny = mechanism.with_dimensions(
        {
            a: 0.01 * v
            for a, v in mechanism.dimensions().items()
            if a.endswith((".length", ".x", ".y")) and "gravity" not in a
        }
    )
    one = circles_on_paper(draw(crusher, position=0), "lw-pin")
    other = circles_on_paper(draw(lw.solve_motion(tiny, steps=72), position=0), "lw-pin")
    assert np.allclose(one, other, atol=0.05)


def test_everything_lies_inside_the_view_box(crusher: lw.Motion) -> None:
    forces = lw.solve_forces(crusher)
    drawing = draw(
        crusher, forces=forces, overlay="limits", velocities=True, dimensions=("pitman", ("O1", "O3"))
    )
    left, top, width, height = map(float, ET.fromstring(drawing.svg).get("viewBox", "").split())
    for x, y in circles_on_paper(drawing, "lw-pin"):
        assert left < x < left + width and top < y < top + height
    for each in ET.fromstring(drawing.svg).iter(f"{SVG}text"):
        x, y = float(each.get("x", "nan")), float(each.get("y", "nan"))
        assert left < x < left + width and top < y < top + height
    assert {"1.25 m", f"{1000 * math.hypot(0.94, 1.0):.6g} mm".replace("1372.44 mm", "1.37244 m")} <= set(
        texts(drawing)
    )


def test_velocity_arrows_are_to_scale(crusher: lw.Motion) -> None:
    drawing = draw(crusher, position=20, velocities=("A", "B", "C"), labels=False, inputs=False)
    marks = [
        e.get("d", "")
        for e in ET.fromstring(drawing.svg).iter(f"{SVG}path")
        if e.get("class") == "lw-velocity-head"
    ]
    lines = [
        e.get("d", "")
        for e in ET.fromstring(drawing.svg).iter(f"{SVG}path")
        if e.get("class") == "lw-velocity-line"
    ]
    tips = [complex(*map(float, re.findall(r"-?[\d.]+", mark)[:2])) for mark in marks]
    feet = [complex(*map(float, re.findall(r"-?[\d.]+", line)[:2])) for line in lines]
    (legend,) = texts(drawing)
    unit = abs(tips[-1] - feet[-1]) / float(legend.split()[0])
    for name, tip, foot in zip(("A", "B", "C"), tips, feet, strict=False):
        vx, vy = crusher.point(name).velocity[20]
        assert abs((tip - foot) - unit * complex(vx, -vy)) < 0.2


def test_limit_positions_of_the_jaw(crusher: lw.Motion) -> None:
    high, low = limit_positions(crusher, "jaw")
    assert (high, low) == (limit_positions(crusher))
    printed = np.degrees([-89.862115, -272.43420]) * 0 + [
        -89.862115,
        -272.43420,
    ]  # of the gallery file, degrees
    assert np.allclose(np.degrees(crusher.input[[high, low]]), printed, atol=2.5)
    assert classes(draw(crusher, overlay="limits")).count("lw-dashed") == 2
    assert classes(draw(crusher, overlay=(5, 10, 15))).count("lw-faded") == 3


def test_path_of_a_point_closes(crusher: lw.Motion) -> None:
    data = next(
        e.get("d", "")
        for e in ET.fromstring(draw(crusher, paths=("B",)).svg).iter()
        if "lw-trace" in e.get("class", "")
    )
    numbers = re.findall(r"-?[\d.]+", data)
    assert len(numbers) == 2 * (crusher.steps + 1)
    assert numbers[:2] == numbers[-2:]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"position": 72}, "position 72 does not exist"),
        ({"paths": ("Bb",)}, "Bb"),
        ({"overlay": "limit"}, '"limits"'),
        ({"overlay": "limits:jam"}, "jam"),
        ({"language": "de"}, '"de"'),
        ({"size": -3}, "pixels above 0"),
        ({"dimensions": ("jam",)}, "jam"),
        ({"velocities": ("Z",)}, "Z"),
    ],
)
def test_what_is_refused(crusher: lw.Motion, options: dict[str, object], words: str) -> None:
    with pytest.raises(lw.LinkwrightError, match=re.escape(words)):
        draw(crusher, **options)  # type: ignore[arg-type]


def test_forces_of_another_motion_are_refused(crusher: lw.Motion) -> None:
    other = lw.solve_forces(lw.solve_motion(crusher.mechanism, steps=12))
    with pytest.raises(lw.LinkwrightError, match="another motion"):
        draw(crusher, forces=other)


def test_position_that_was_not_reached_is_refused() -> None:
    motion = lw.solve_motion(lw.load("gallery:change_point_fourbar"), steps=36, failures="mark")
    failed = int(np.flatnonzero(~motion.ok)[0]) if not motion.ok.all() else None
    if failed is None:
        pytest.skip("all positions of this model are reached")
    with pytest.raises(lw.LinkwrightError, match=f"position {failed} cannot be drawn"):
        draw(motion, position=failed)


def test_names_from_a_file_cannot_break_the_picture() -> None:
    text = """
format: 1
name: 'a < b & "c" </svg>'
frame: {points: {O: [0 m, 0 m]}}
links: {bar: {points: [O, 铰链α], length: 1 m}}
driver: {turn: bar, about: O, speed: 1 rad/s}
"""
    drawing = draw(lw.loads(text), language="zh")
    title = ET.fromstring(drawing.svg).find(f"{SVG}title")
    assert title is not None and title.text is not None and 'a < b & "c" </svg>' in title.text
    assert "铰链α" in texts(drawing)


WELDED = """
format: 1
name: Weld, spring, damper, torque
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m], H: [5 m, 2 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 3.5 m}
  arm: {points: [B, Q], length: 1.4 m}
  rocker: {points: [O2, Q], length: 2.6 m, also: {R: [1.2 m, 0 m]}}
joints:
  fixed: {kind: weld, links: [coupler, arm], at: B, angle: 60 deg}
driver: {turn: crank, about: O1, speed: 10 rad/s}
loads:
  pull: {kind: spring, between: [frame.H, rocker.R], stiffness: 100 N/m, free_length: 1 m}
  brake: {kind: damper, between: [frame.O1, coupler.B], damping: 100 N·s/m}
  drag: {kind: torque, on: rocker, magnitude: -3 N·m}
  coil: {kind: torsion_spring, links: [frame, crank], stiffness: 3 N·m/rad, free_angle: 0 deg}
"""


def test_weld_springs_and_torques_have_symbols() -> None:
    found = classes(draw(lw.loads(WELDED)))
    assert found.count("lw-weld") == 1
    assert found.count("lw-spring") == 1 + 4 + 1
    assert found.count("lw-load-head") == 1
    animation = animate(lw.loads(WELDED), frames=6)
    moving = [e for e in ET.fromstring(animation.svg).iter(f"{SVG}polyline") if e.get("class") == "lw-spring"]
    assert len(moving) == 1 + 4 + 1


def test_size_is_the_longer_side(crusher: lw.Motion) -> None:
    root = ET.fromstring(draw(crusher, size=500).svg)
    assert max(float(root.get("width", 0)), float(root.get("height", 0))) == 500


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [(2e4, "N", "20 kN"), (5.0, "N", "5 N"), (1e6, "N", "1 MN"), (0.5, "m/s", "0.5 m/s")],
)
def test_legend_values(value: float, unit: str, text: str) -> None:
    assert with_unit(value, unit) == text


@pytest.mark.parametrize("largest", [3.7, 85e3, 0.0123])
def test_legend_value_is_round_and_fits(largest: float) -> None:
    scale = 120.0 / largest
    value = round_length(scale)
    assert f"{value:.6e}"[0] in "125" and f"{value:.6e}"[1:8] == ".000000"
    assert largest / 5.001 <= value <= largest / 2 * 1.000001


def test_saving_is_whole_or_not_at_all(
    crusher: lw.Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "crusher.svg"
    assert draw(crusher).save(target) == target
    assert target.read_text(encoding="utf-8") == draw(crusher)._repr_svg_()

    def broken(source: object, goal: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", broken)
    with pytest.raises(lw.LinkwrightError, match="No space left"):
        draw(crusher, position=9).save(target)
    assert target.read_text(encoding="utf-8") == draw(crusher).svg
    assert [file.name for file in tmp_path.iterdir()] == ["crusher.svg"]


@pytest.mark.parametrize(
    ("name", "words"), [("a.bmp", "no kind of picture"), ("no/such/a.svg", "cannot be written")]
)
def test_wrong_targets(crusher: lw.Motion, tmp_path: Path, name: str, words: str) -> None:
    with pytest.raises(lw.LinkwrightError, match=words):
        draw(crusher).save(tmp_path / name)


def test_png_and_pdf(crusher: lw.Motion, tmp_path: Path) -> None:
    pytest.importorskip("resvg_py")
    image = pytest.importorskip("PIL.Image")
    with image.open(draw(crusher).save(tmp_path / "a.png", width=400)) as picture:
        assert picture.width == 400
        dark = np.asarray(picture.convert("L")) < 128
        assert 0.002 < dark.mean() < 0.2
    pytest.importorskip("typst")
    assert draw(crusher).save(tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")


def test_chinese_needs_a_font(crusher: lw.Motion, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("resvg_py")
    monkeypatch.setattr("linkwright.plot.svg.fonts.system_fonts", lambda: (Path("DejaVuSans.ttf"),))
    with pytest.raises(lw.LinkwrightError, match="fonts-noto-cjk"):
        draw(crusher, velocities=("B",), language="zh").png()

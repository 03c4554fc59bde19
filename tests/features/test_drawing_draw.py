"""The drawing of a mechanism: where things are, what is shown, what is refused."""

import math
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright import Drawing, draw
from linkwright.errors import RequestError
from linkwright.plotting.animation import animate

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def crusher() -> lw.Motion:
    return store.motion("jaw_crusher_sixbar", 72)


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
    assert "crushing" in texts(drawing)


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
    drawing = draw(crusher, forces=forces, overlay="limits", velocities=True, dimensions=("pitman", ("O1", "O3")))
    left, top, width, height = map(float, ET.fromstring(drawing.svg).get("viewBox", "").split())
    for x, y in every(circles_on_paper(drawing, "lw-pin"), least=6):
        assert left < x < left + width and top < y < top + height
    for each in every(ET.fromstring(drawing.svg).iter(f"{SVG}text"), least=12):
        x, y = float(each.get("x", "nan")), float(each.get("y", "nan"))
        assert left < x < left + width and top < y < top + height
    assert {"1.25 m", f"{1000 * math.hypot(0.94, 1.0):.6g} mm".replace("1372.44 mm", "1.37244 m")} <= set(
        texts(drawing)
    )


def test_velocity_arrows_are_to_scale(crusher: lw.Motion) -> None:
    drawing = draw(crusher, position=20, velocities=("A", "B", "C"), labels=False, inputs=False)
    marks = [
        e.get("d", "") for e in ET.fromstring(drawing.svg).iter(f"{SVG}path") if e.get("class") == "lw-velocity-head"
    ]
    lines = [
        e.get("d", "") for e in ET.fromstring(drawing.svg).iter(f"{SVG}path") if e.get("class") == "lw-velocity-line"
    ]
    tips = [complex(*map(float, re.findall(r"-?[\d.]+", mark)[:2])) for mark in marks]
    feet = [complex(*map(float, re.findall(r"-?[\d.]+", line)[:2])) for line in lines]
    (legend,) = [each for each in texts(drawing) if re.match(r"[\d.]+ m/s ", each)]
    unit = abs(tips[-1] - feet[-1]) / float(legend.split()[0])
    assert len(tips) == len(feet) == 4  # the last is that of the legend
    for name, tip, foot in zip(("A", "B", "C"), tips, feet, strict=False):
        vx, vy = crusher.point(name).velocity[20]
        assert abs((tip - foot) - unit * complex(vx, -vy)) < 0.2


def test_limit_positions_of_the_jaw_are_exact(crusher: lw.Motion) -> None:
    high, low = lw.limit_positions(crusher, "jaw")
    printed = [-89.862115, -272.43420]  # of the gallery file, degrees
    assert np.degrees([high.input, low.input]) == pytest.approx(printed, abs=1e-4)
    there = lw.solve_motion(crusher.mechanism, times=[high.time, low.time])
    rates = np.abs(crusher.link("jaw").angular_velocity)
    assert np.abs(there.link("jaw").angular_velocity).max() < 1e-9 * rates.max()


def test_limit_positions_are_drawn_there(crusher: lw.Motion) -> None:
    drawing = draw(crusher, overlay="limits", labels=False)
    everything = np.array(circles_on_paper(drawing, "lw-pin"))
    for limit in every(lw.limit_positions(crusher, "jaw"), least=2):
        exact = circles_on_paper(draw(crusher, at=limit.input, labels=False), "lw-pin")
        for x, y in every(exact, least=6):
            assert np.hypot(*(everything - (x, y)).T).min() < 0.02
    assert classes(draw(crusher, overlay=(5, 10, 15))).count("lw-faded") == 3
    assert classes(draw(crusher, overlay="faded:8")).count("lw-faded") == 8


@pytest.mark.parametrize("name", ["crank_rocker", "shaper_quick_return", "slider_crank_inline", "toggle_press"])
def test_both_limit_positions_lie_inside_the_picture(name: str) -> None:
    motion = store.motion(name, 5)
    both = draw(motion, overlay="limits")
    pins = circles_on_paper(both, "lw-pin")
    assert len(pins) > len(circles_on_paper(draw(motion), "lw-pin"))
    left, top, wide, tall = map(float, ET.fromstring(both.svg).get("viewBox", "").split())
    for x, y in every(pins):
        assert left < x < left + wide and top < y < top + tall


def test_position_at_an_input_or_a_time(crusher: lw.Motion) -> None:
    speed = -170.0 * 2 * math.pi / 60  # rad/s, of the gallery file
    x, y = 0.1 * math.cos(math.radians(30)), 0.1 * math.sin(math.radians(30))
    far = np.hypot(0.94, 1.0)  # O1 to O3, m
    for given in ({"at": math.radians(30)}, {"time": math.radians(30) / speed}):
        pins = np.array(circles_on_paper(draw(crusher, labels=False, **given), "lw-pin"))
        o1 = pins[np.argmin(np.hypot(*pins.T))]
        o3 = pins[np.argmax(pins[:, 0])]
        scale = np.hypot(*(o3 - o1)) / far
        assert np.hypot(*(pins - (o1 + np.array([x, -y]) * scale)).T).min() < 0.05


@pytest.mark.parametrize("degrees", [131.3, 223.7, 250.1, 301.1])
def test_position_keeps_the_assembly_beyond_a_change_point(degrees: float) -> None:
    """The links line up at 180°: the pins are drawn beside those of the nearest position, and not mirrored."""
    mechanism = store.machine("change_point_fourbar")
    motion = lw.solve_motion(mechanism, at=np.radians(np.arange(0.0, 352.0, 4.0)), failures="mark")
    near = int(np.abs(np.exp(1j * motion.input) - np.exp(1j * math.radians(degrees))).argmin())
    shown, beside = (
        np.array(circles_on_paper(draw(motion, labels=False, **given), "lw-pin"))
        for given in ({"at": math.radians(degrees)}, {"position": near})
    )
    size = np.hypot(*np.ptp(beside, axis=0))
    assert shown == pytest.approx(beside, abs=0.05 * size)


def test_only_one_position_is_drawn(crusher: lw.Motion) -> None:
    with refused("picture.one_position", RequestError):
        draw(crusher, at=0.1, time=0.2)


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
    ("options", "code", "values"),
    [
        ({"position": 72}, "picture.no_position", {"position": 72, "last": 71}),
        ({"paths": ("Bb",)}, "names.no_such", {"name": "Bb", "offer": "B"}),
        ({"overlay": "limit"}, "picture.bad_overlay", {"overlay": "limit"}),
        ({"overlay": "limits:jam"}, "study.no_such_output", {"name": "jam", "offer": "jaw"}),
        ({"overlay": "limits:crank"}, "picture.no_limit_positions", {"name": "crank"}),
        ({"overlay": "faded:0"}, "picture.bad_overlay", {"overlay": "faded:0"}),
        ({"dimensions": ("jam",), "at": 0.1}, "names.no_such", {"name": "jam", "offer": "jaw"}),
        ({"language": "de"}, "names.no_language", {"language": "de", "languages": ("en", "zh")}),
        ({"size": -3}, "picture.bad_size", {"size": -3, "minimum": 8, "maximum": 32000}),
        ({"dimensions": ("jam",)}, "names.no_such", {"name": "jam", "offer": "jaw"}),
        ({"velocities": ("Z",)}, "names.no_such", {"name": "Z"}),
    ],
)
def test_what_is_refused(
    crusher: lw.Motion, options: dict[str, object], code: str, values: dict[str, object]
) -> None:
    with refused(code, RequestError, **values):
        draw(crusher, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("width", [0, 1_000_000, 7])
def test_a_width_beyond_reason_is_refused_with_its_range(crusher: lw.Motion, width: int) -> None:
    pytest.importorskip("resvg_py")
    with refused("picture.bad_width", RequestError, across=float(width), minimum=8) as caught:
        draw(crusher).png(width=width)
    assert 8 < caught.value.values["maximum"] < 1_000_000
    assert draw(crusher).png(width=8).startswith(b"\x89PNG")


def test_forces_of_another_motion_are_refused(crusher: lw.Motion) -> None:
    other = lw.solve_forces(lw.solve_motion(crusher.mechanism, steps=12))
    with refused("picture.other_motion", RequestError):
        draw(crusher, forces=other)


STUCK = """
format: 1
name: Stuck four-bar
frame: {points: {O1: [0 m, 0 m], O2: [2 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.9 m}
  coupler: {points: [A, B], length: 1.2 m}
  rocker: {points: [O2, B], length: 1.5 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rad/s, start: 170 deg}
"""


def test_position_that_was_not_reached_is_refused() -> None:
    """At 170 degrees A is 2.89 m from O2, farther than 1.2 m and 1.5 m reach."""
    motion = lw.solve_motion(lw.loads(STUCK), steps=36, failures="mark")
    with refused("picture.not_drawn", position=0, links=("coupler", "rocker")):
        draw(motion, position=0)
    with refused("picture.the_position", distance="2900 mm", missing="200 mm"):
        draw(motion, at=math.radians(180))
    assert len(circles_on_paper(draw(motion), "lw-pin")) == 4  # the first that is reached


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


PRESSED = """
format: 1
name: Engine with dampers
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.5 m}
  rod: {points: [A, B], length: 1.8 m}
  piston: {points: [B]}
joints:
  bore: {kind: prismatic, guide: frame, through: O, block: piston, at: B, direction: 0 deg}
driver: {turn: crank, about: O, speed: 10 rad/s}
loads:
  gas: {kind: pressure, joint: bore, area: 20 cm², magnitude: 5 bar, pushes: PUSHES}
  drag: {kind: torsion_damper, links: [frame, crank], damping: 1 N·m·s/rad}
"""


@pytest.mark.parametrize(("pushes", "sign"), [("backward", -1), ("forward", 1)])
def test_pressure_and_torsion_damper_have_symbols(pushes: str, sign: int) -> None:
    root = ET.fromstring(draw(lw.loads(PRESSED.replace("PUSHES", pushes)), labels=False).svg)
    heads = [e.get("d", "") for e in root.iter() if e.get("class") == "lw-load-head"]
    assert len(heads) == 3
    for head in heads:
        tip, *back = [float(x) for x in re.findall(r"-?[\d.]+", head)][::2]
        assert (tip - back[0]) * sign > 0  # the block is on the right of the crank, forward is to the right
    assert [e.get("class") for e in root.iter()].count("lw-spring") == 4


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


def test_saving_is_whole_or_not_at_all(crusher: lw.Motion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "crusher.svg"
    assert draw(crusher).save(target) == target
    assert target.read_text(encoding="utf-8") == draw(crusher)._repr_svg_()

    def broken(source: object, goal: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", broken)
    with refused("file.cannot_write", RequestError, path=str(target)):
        draw(crusher, position=9).save(target, force=True)
    assert target.read_text(encoding="utf-8") == draw(crusher).svg
    assert [file.name for file in tmp_path.iterdir()] == ["crusher.svg"]


@pytest.mark.parametrize(
    ("name", "code"), [("a.bmp", "picture.no_picture_suffix"), ("no/such/a.svg", "file.no_folder")]
)
def test_wrong_targets(crusher: lw.Motion, tmp_path: Path, name: str, code: str) -> None:
    with refused(code, RequestError):
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


def test_notebooks_show_the_drawing() -> None:
    for shown in (store.machine("crank_rocker"), store.motion("crank_rocker", 12), store.forces("crank_rocker", 12)):
        picture = shown._repr_svg_()
        assert picture is not None
        assert ET.fromstring(picture).tag == f"{SVG}svg"


def test_notebooks_show_nothing_of_what_cannot_be_assembled() -> None:
    text = """
format: 1
name: too short
frame: {points: {O1: [0 m, 0 m], O2: [9 m, 0 m]}}
links: {crank: {points: [O1, A], length: 1 m}, rod: {points: [A, B], length: 1 m},
  rocker: {points: [O2, B], length: 1 m}}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 1 rad/s}
"""
    mechanism = lw.loads(text)
    assert mechanism._repr_svg_() is None
    assert lw.solve_motion(mechanism, steps=8, failures="mark")._repr_svg_() is None

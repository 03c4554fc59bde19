"""Diagrams: what is drawn, what is marked, words and fonts, files, refusals."""

from pathlib import Path
from xml.etree import ElementTree

import matplotlib
import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.features.chinese import drawn_in_chinese
from tests.refusals import refused

import linkwright as lw
from linkwright import Diagram, plot
from linkwright.errors import LinkwrightError, RequestError
from linkwright.machine import steady_running

CRUSHER = store.machine("jaw_crusher_sixbar")


@pytest.fixture(scope="module")
def forces() -> lw.Forces:
    return store.forces("jaw_crusher_sixbar", 120)


def words_of(diagram: Diagram) -> list[str]:
    from matplotlib.text import Text

    if isinstance(diagram.figure, lw.Drawing):
        texts = (each for each in ElementTree.fromstring(diagram.svg()).iter() if each.tag.endswith("}text"))
        return ["".join(each.itertext()) for each in texts]
    return [text.get_text() for text in diagram.figure.findobj(Text) if text.get_visible() and text.get_text()]


def test_curves_close_and_go_with_the_motion(forces: lw.Forces) -> None:
    axes = plot(forces.motion, "sva").figure.axes
    assert len(axes) == 3
    line = max(axes[0].lines, key=lambda each: len(each.get_xdata()))
    x, y = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
    assert (x[0], x[-1]) == pytest.approx((0.0, -360.0)) and y[-1] == pytest.approx(y[0])
    passed = np.interp(-np.degrees(forces.motion.input), -x, y)
    assert passed == pytest.approx(np.degrees(forces.motion.link("jaw").angle))
    assert axes[0].get_xlim() == pytest.approx((0.0, -360.0))


def test_hodograph_has_equal_scales_and_the_forces(forces: lw.Forces) -> None:
    figure = plot(forces, "hodograph", joint="O5").figure
    for axes, view in zip(figure.axes, ("frame", "jaw"), strict=True):
        assert axes.get_aspect() == 1.0
        force = forces.reaction("O5", on="jaw", axes=view) / 1e3
        drawn = np.concatenate([np.column_stack(line.get_data()) for line in axes.lines])
        for each in every(force[::10]):
            assert np.abs(drawn - each).max(axis=1).min() < 1e-12


def test_mean_torque_is_marked_as_the_power_over_the_speed(forces: lw.Forces) -> None:
    diagram = plot(forces, "torque")
    mean = lw.solve_forces(forces.mechanism, steps=36_000).power.mean() / (-170 * np.pi / 30)
    levels = [
        line for line in diagram.figure.axes[0].lines if len(set(line.get_ydata())) == 1 and line.get_ydata()[0]
    ]
    assert any(line.get_ydata()[0] == pytest.approx(mean, rel=1e-4) for line in levels)
    assert any("−" in text and text.endswith(" N·m") for text in words_of(diagram))


def test_a_small_mean_has_a_unit_in_which_it_can_be_read() -> None:
    """A wheel that is pushed to and fro by 100 MN·m about a mean that the driver supplies."""
    model = """
format: 1
name: Pushed wheel
frame: {points: {O: [0 m, 0 m]}}
links: {wheel: {points: [O, A], length: 1 m, mass: 1 kg, inertia: 1 kg·m²}}
driver: {turn: wheel, about: O, speed: 10 rad/s}
loads:
  push: {kind: torque, on: wheel, magnitude: "1e8 N·m * sin(input) - MEAN N·m"}
"""
    for mean, shown in ((9426, " 9426 N·m"), (9426e3, " 9.426 MN·m"), (0, " 0 MN·m")):
        forces = lw.solve_forces(lw.loads(model.replace("MEAN", str(mean))))
        diagram = lw.plot(forces, "torque")
        assert any("(MN·m)" in text for text in words_of(diagram))
        assert [text for text in words_of(diagram) if text.endswith(shown)]


def test_results_draw_themselves(forces: lw.Forces) -> None:
    assert forces.motion.plot().kind == "sva"
    assert forces.plot().kind == "torque"
    running = steady_running(forces, fluctuation=0.05)
    diagram = running.plot()
    assert diagram.kind == "speed"
    assert any("δ = 0.05" in text for text in words_of(diagram))
    assert running.plot("energy").kind == "energy"
    with refused("picture.no_motion", RequestError):
        running.plot("sva")


def test_several_results_lie_over_each_other() -> None:
    longer = CRUSHER.with_dimensions({"crank.length": 0.12})
    diagram = plot({"short": CRUSHER, "long": longer}, "sva")
    assert {"short", "long"} <= set(words_of(diagram))
    curves = [line for line in diagram.figure.axes[0].lines if len(line.get_xdata()) > 100]
    swings = [np.ptp(line.get_ydata()) for line in curves]
    assert len(curves) == 2 and swings[1] > swings[0]
    with refused("picture.equal_names", RequestError):
        plot([CRUSHER, longer])


@pytest.mark.rotating
@pytest.mark.parametrize("kind", ["sva", "hodograph", "torque", "acceleration_polygon", "force_polygon"])
def test_chinese_with_greek_letters_and_units_has_no_boxes(kind: str, forces: lw.Forces) -> None:
    diagram = drawn_in_chinese(forces, kind, at=-0.7 if "polygon" in kind else None)
    said = "".join(words_of(diagram))
    assert any("\u4e00" <= letter <= "\u9fff" for letter in said) and {"φ"} & set(said) | {"F"} & set(said)
    for content in (diagram.svg().encode(), diagram.png(dpi=40), diagram.pdf()):
        assert len(content) > 2000


def test_a_character_that_no_font_has_is_refused(forces: lw.Forces) -> None:
    diagram = plot(forces.motion, title="\ue123")
    with refused("picture.no_glyph", RequestError):
        diagram.svg()


def test_names_are_no_formulas() -> None:
    text = (
        'format: 1\nname: "a $x_1$ 50% {b}"\nframe:\n  points: {O: [0 m, 0 m], Q: [2 m, 0 m]}\nlinks:\n'
        "  _k: {points: [O, A], length: 0.5 m}\n  c: {points: [A, B], length: 2 m}\n"
        "  r: {points: [Q, B], length: 1.2 m}\n"
        "assembly: {B: left}\ndriver: {turn: _k, about: O, speed: 1 rad/s}\n"
    )
    mechanism = lw.loads(text)
    for kind in ("sva", "angles", "velocity_polygon"):
        assert plot(mechanism, kind, of=["_k", "c"] if kind == "angles" else ()).svg().rstrip().endswith("</svg>")


def test_settings_of_matplotlib_stay_as_they_were(forces: lw.Forces) -> None:
    before = matplotlib.rcParams.copy()
    plot(forces, "torque").png(dpi=30)
    assert matplotlib.rcParams.copy() == before


def test_the_same_diagram_gives_the_same_file(forces: lw.Forces) -> None:
    assert plot(forces, "power").svg() == plot(forces, "power").svg()


def test_files_are_written_whole_or_not_at_all(forces: lw.Forces, tmp_path: Path) -> None:
    diagram = plot(forces, "torque", title="\ue123")
    with refused("picture.no_glyph", RequestError):
        diagram.save(tmp_path / "t.svg")
    with refused("picture.no_ending", RequestError, ending=".bmp", names=(".svg", ".pdf", ".png")):
        diagram.save(tmp_path / "t.bmp")
    assert list(tmp_path.iterdir()) == []
    good = plot(forces, "torque")
    heads = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF"}
    for ending, head in heads.items():
        assert good.save(tmp_path / f"t.{ending}", dpi=40).read_bytes().startswith(head)
    with refused("file.no_folder", RequestError, path=tmp_path / "none"):
        good.save(tmp_path / "none" / "t.svg")


def test_refusals_say_what_there_is(forces: lw.Forces) -> None:
    with refused("picture.no_kind", RequestError, name="torqe", offer="torque") as unknown:
        plot(forces, "torqe")
    assert "velocity_polygon" in unknown.value.values["names"]
    with refused("names.no_such", RequestError, name="O55", offer="O1"):
        plot(forces, "hodograph", joint="O55")
    with refused("study.no_such_output", RequestError, name="jow", offer="jaw"):
        plot(forces, "sva", of="jow")
    with refused("missing-unit", LinkwrightError):
        plot(forces, "velocity_polygon", at="30")
    with refused("picture.no_forces", LinkwrightError):
        plot(store.machine("crank_rocker"), "hodograph")


#: Which kinds of diagrams an option is for.
USERS = {
    "of": ("angles", "force_polygon", "free_bodies", "hodographs", "paths", "reactions", "sva"),
    "joint": ("hodograph", "reactions"),
    "on": ("hodograph", "reactions"),
    "axes": ("hodograph", "reactions"),
    "at": ("acceleration_polygon", "force_polygon", "free_bodies", "velocity_polygon"),
    "fluctuation": ("speed",),
}
OPTIONS = {"of": "jaw", "joint": "B", "on": "jaw", "axes": "jaw", "at": 1.0, "fluctuation": 0.1}


@pytest.mark.parametrize("option", USERS)
def test_an_option_without_use_is_refused_by_every_kind(option: str, forces: lw.Forces) -> None:
    with refused("picture.no_kind", RequestError) as unknown:
        plot(forces, "none")
    kinds = unknown.value.values["names"]
    assert set(USERS[option]) < set(kinds)
    for kind in every(set(kinds) - set(USERS[option]), least=8):
        with refused("picture.no_use", RequestError, kind=kind, option=option, users=USERS[option]):
            plot(forces, kind, **{option: OPTIONS[option]})  # type: ignore[arg-type]


def test_limit_positions_and_phase_stand_where_the_gallery_file_says(forces: lw.Forces) -> None:
    diagram = plot(forces.motion, "sva")
    for axes in every(diagram.figure.axes, least=3):
        upright = [
            line.get_xdata()[0] for line in axes.lines if len({*line.get_xdata()}) == 1 < len(line.get_xdata())
        ]
        assert upright == pytest.approx([-89.862115, -272.43420], abs=1e-5)
        (phase,) = axes.patches
        assert phase.get_xy()[0] == pytest.approx(-89.862115, abs=1e-5)
        assert phase.get_xy()[0] + phase.get_width() == pytest.approx(-272.43420, abs=1e-5)
    assert any("crushing" in text for text in words_of(diagram))


@pytest.mark.parametrize(
    ("name", "output"), [("swing_conveyor", "guide"), ("geared_fivebar", "bar_2"), ("external_gear_pair", "wheel")]
)
def test_the_output_that_is_drawn_where_none_is_named(name: str, output: str) -> None:
    """A block on the frame means its displacement; a wheel in a fixed ratio to the driver is shown where there is
    nothing else."""
    motion = store.motion(name, 12)
    angle, *_ = plot(motion, "sva").figure.axes
    curve = max(angle.lines, key=lambda line: len(line.get_xdata()))
    expected = 1e3 * motion.joint(output).displacement if output == "guide" else np.degrees(motion.link(output).angle)
    x = np.degrees(motion.input)
    there = np.argsort(curve.get_xdata())
    drawn = np.interp(x, np.asarray(curve.get_xdata())[there], np.asarray(curve.get_ydata())[there])
    assert drawn == pytest.approx(expected, abs=1e-6)


def test_all_outputs_that_are_asked_for_are_drawn() -> None:
    shaper = store.motion("shaper_quick_return", 60)
    diagram = plot(shaper, "sva", of=["lever", "ram", "crank"])
    angles, lines = diagram.figure.axes[0], [axes.lines for axes in diagram.figure.axes]
    drawn = [np.asarray(line.get_ydata())[:-1] for line in angles.lines if len(line.get_ydata()) > 2]
    for link, values in zip(("lever", "crank"), drawn, strict=True):
        assert values == pytest.approx(np.degrees(shaper.link(link).angle))
    travel = [np.asarray(line.get_ydata()) for line in lines[3] if len(line.get_ydata()) > 2]
    assert len(travel) == 1
    assert travel[0][:-1] == pytest.approx(1e3 * shaper.joint("guide").displacement)
    assert {"lever", "ram", "crank"} <= set(words_of(diagram))


def test_sizes_beyond_all_paper_are_refused(forces: lw.Forces) -> None:
    with refused("picture.bad_inches", RequestError):
        plot(forces, "torque", size=(7.0, 1e6))
    with refused("picture.bad_dots", RequestError, dpi=1e5):
        plot(forces, "torque").png(dpi=1e5)


@pytest.mark.rotating
def test_a_joint_that_carries_nothing_has_a_point_for_a_hodograph() -> None:
    """The guide of a yoke in line with its load: 4e-15 N by rounding were drawn as a scribble."""
    axes = plot(store.forces("scotch_yoke"), "hodographs", of=["guide"]).figure.axes[0]
    curves = every(line for line in axes.lines if len(line.get_xydata()) > 2)
    assert not any(np.any(line.get_xydata()) for line in curves)
    assert axes.get_xlim()[1] > 0.5 and axes.get_xlabel() == "Fx (N)"

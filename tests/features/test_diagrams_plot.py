"""Diagrams: what is drawn, what is marked, words and fonts, files, refusals."""

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from matplotlib import font_manager

import linkwright as lw
from linkwright.errors import LinkwrightError
from linkwright.machine import steady_running
from linkwright.plot import Diagram, plot
from linkwright.plot.diagrams import picture
from linkwright.plot.diagrams.axes import round_up, significant, unit_of
from linkwright.plot.diagrams.base import DIAGRAMS
from linkwright.plot.diagrams.marks import limit_marks, phase_marks
from linkwright.plot.diagrams.outputs import main_output, output_named
from linkwright.plot.diagrams.source import Source
from linkwright.words import LANGUAGES, catalogue

CRUSHER = lw.load("gallery:jaw_crusher_sixbar")


@pytest.fixture(scope="module")
def forces() -> lw.Forces:
    return lw.solve_forces(lw.solve_motion(CRUSHER, steps=120))


def words_of(diagram: Diagram) -> list[str]:
    from matplotlib.text import Text

    return [
        text.get_text() for text in diagram.figure.findobj(Text) if text.get_visible() and text.get_text()
    ]


def test_curves_close_and_go_with_the_motion(forces: lw.Forces) -> None:
    axes = plot(forces.motion, "sva").figure.axes
    assert len(axes) == 3
    line = max(axes[0].lines, key=lambda each: len(each.get_xdata()))
    x, y = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
    assert (x[0], x[-1]) == pytest.approx((0.0, -360.0)) and y[-1] == pytest.approx(y[0])
    passed = np.interp(-np.degrees(forces.motion.input), -x, y)
    assert passed == pytest.approx(np.degrees(forces.motion.link("jaw").angle))
    assert axes[0].get_xlim() == pytest.approx((0.0, -360.0))


def test_limit_positions_and_phase_stand_where_the_gallery_file_says(forces: lw.Forces) -> None:
    source = Source(forces.motion)
    limits = limit_marks(source, main_output(forces.motion))
    assert {each.kind: np.degrees(each.place) for each in limits} == pytest.approx(
        {"max": -89.862115, "min": -272.43420}, abs=1e-5
    )
    (phase,) = phase_marks(source, limits)
    assert (phase.name, *np.degrees([phase.begin, phase.end])) == pytest.approx(
        ("crushing", -89.862115, -272.43420), abs=1e-5
    )


def test_hodograph_has_equal_scales_and_the_forces(forces: lw.Forces) -> None:
    figure = plot(forces, "hodograph", joint="O5").figure
    for axes, view in zip(figure.axes, ("frame", "jaw"), strict=True):
        assert axes.get_aspect() == 1.0
        force = forces.reaction("O5", on="jaw", axes=view) / 1e3
        drawn = np.concatenate([np.column_stack(line.get_data()) for line in axes.lines])
        for each in force[::10]:
            assert np.abs(drawn - each).max(axis=1).min() < 1e-12


def test_mean_torque_is_marked_as_the_power_over_the_speed(forces: lw.Forces) -> None:
    diagram = plot(forces, "torque")
    mean = lw.solve_forces(forces.mechanism, steps=36_000).power.mean() / (-170 * np.pi / 30)
    levels = [
        line
        for line in diagram.figure.axes[0].lines
        if len(set(line.get_ydata())) == 1 and line.get_ydata()[0]
    ]
    assert any(line.get_ydata()[0] == pytest.approx(mean, rel=1e-4) for line in levels)
    assert any(text.startswith("mean −") and text.endswith("N·m") for text in words_of(diagram))


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
    for mean, shown in ((9426, "mean 9426 N·m"), (9426e3, "mean 9.426 MN·m"), (0, "mean 0 MN·m")):
        forces = lw.solve_forces(lw.loads(model.replace("MEAN", str(mean))))
        diagram = lw.plot(forces, "torque")
        assert any("(MN·m)" in text for text in words_of(diagram))
        assert shown in words_of(diagram)


def test_results_draw_themselves(forces: lw.Forces) -> None:
    assert forces.motion.plot().kind == "sva"
    assert forces.plot().kind == "torque"
    running = steady_running(forces, fluctuation=0.05)
    diagram = running.plot()
    assert diagram.kind == "speed"
    assert any("δ = 0.05" in text for text in words_of(diagram))
    assert running.plot("energy").kind == "energy"
    with pytest.raises(LinkwrightError, match="speed and energy"):
        running.plot("sva")


def test_several_results_lie_over_each_other() -> None:
    longer = CRUSHER.with_dimensions({"crank.length": 0.12})
    diagram = plot({"short": CRUSHER, "long": longer}, "sva")
    assert {"short", "long"} <= set(words_of(diagram))
    curves = [line for line in diagram.figure.axes[0].lines if len(line.get_xdata()) > 100]
    swings = [np.ptp(line.get_ydata()) for line in curves]
    assert len(curves) == 2 and swings[1] > swings[0]
    with pytest.raises(LinkwrightError, match="give labels"):
        plot([CRUSHER, longer])


def test_a_block_on_the_frame_means_its_displacement() -> None:
    conveyor = lw.load("gallery:swing_conveyor")
    output = output_named(conveyor, "slider")
    assert getattr(output, "kind", None) == "displacement" and getattr(output, "owner", None) == "guide"
    assert main_output(lw.solve_motion(conveyor, steps=12)) == output_named(conveyor, "guide")


def test_a_wheel_in_a_fixed_ratio_to_the_driver_is_shown_where_there_is_nothing_else() -> None:
    five_bar, pair = (lw.load(f"gallery:{name}") for name in ("geared_fivebar", "external_gear_pair"))
    assert str(main_output(lw.solve_motion(five_bar, steps=12))) == "bar_2"
    assert str(main_output(lw.solve_motion(pair, steps=12))) == "wheel"


@pytest.mark.parametrize("kind", ["sva", "hodograph", "torque", "acceleration_polygon", "force_polygon"])
def test_chinese_with_greek_letters_and_units_has_no_boxes(kind: str, forces: lw.Forces) -> None:
    if picture.chinese_font() is None:
        with pytest.raises(LinkwrightError, match="fonts-noto-cjk"):
            plot(forces, kind, language="zh")
        return
    diagram = plot(forces, kind, language="zh", at=-0.7 if "polygon" in kind else None)
    said = "".join(words_of(diagram))
    assert any("\u4e00" <= letter <= "\u9fff" for letter in said) and {"φ"} & set(said) | {"F"} & set(said)
    for content in (diagram.svg().encode(), diagram.png(dpi=40), diagram.pdf()):
        assert len(content) > 2000


def test_without_a_chinese_font_a_sentence_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "chinese_font", lambda: None)
    with pytest.raises(LinkwrightError, match="apt-get install fonts-noto-cjk"):
        plot(CRUSHER, language="zh")


def test_a_character_that_no_font_has_is_refused(forces: lw.Forces) -> None:
    diagram = plot(forces.motion, title="\ue123")
    with pytest.raises(LinkwrightError, match="cannot be written"):
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
        assert plot(mechanism, kind, of=["_k", "c"] if kind == "angles" else ()).svg().endswith("</svg>\n")


def test_settings_of_matplotlib_stay_as_they_were(forces: lw.Forces) -> None:
    before = matplotlib.rcParams.copy()
    plot(forces, "torque").png(dpi=30)
    assert matplotlib.rcParams.copy() == before


def test_the_same_diagram_gives_the_same_file(forces: lw.Forces) -> None:
    assert plot(forces, "power").svg() == plot(forces, "power").svg()


def test_files_are_written_whole_or_not_at_all(forces: lw.Forces, tmp_path: Path) -> None:
    diagram = plot(forces, "torque", title="\ue123")
    with pytest.raises(LinkwrightError):
        diagram.save(tmp_path / "t.svg")
    with pytest.raises(LinkwrightError, match="no kind of picture"):
        diagram.save(tmp_path / "t.bmp")
    assert list(tmp_path.iterdir()) == []
    good = plot(forces, "torque")
    heads = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF"}
    for ending, head in heads.items():
        assert good.save(tmp_path / f"t.{ending}", dpi=40).read_bytes().startswith(head)
    with pytest.raises(LinkwrightError, match="create it first"):
        good.save(tmp_path / "none" / "t.svg")


def test_refusals_say_what_there_is(forces: lw.Forces) -> None:
    with pytest.raises(LinkwrightError, match=r'did you mean "torque"\? \(one of: .*velocity_polygon'):
        plot(forces, "torqe")
    with pytest.raises(LinkwrightError, match="O5"):
        plot(forces, "hodograph", joint="O55")
    with pytest.raises(LinkwrightError, match="jaw"):
        plot(forces, "sva", of="jow")
    with pytest.raises(LinkwrightError, match="no unit"):
        plot(forces, "velocity_polygon", at="30")
    with pytest.raises(LinkwrightError, match="give masses"):
        plot(lw.load("gallery:crank_rocker"), "hodograph")


def test_every_kind_has_its_words() -> None:
    for language in LANGUAGES:
        assert {f"kind.{name}" for name in DIAGRAMS} <= set(catalogue("plot", language))


def test_numbers_and_units() -> None:
    assert [significant(v) for v in (0.0, -0.00012345, 12.3456, -1234.56, 1.0, 2.5e8)] == [
        "0", "−0.0001234", "12.35", "−1235", "1", "2.5e+08",
    ]  # fmt: skip
    assert unit_of("force", [np.array([1.0, -25e3])]).text(-25e3) == "−25 kN"
    assert unit_of("torque", [np.array([1800.0])]).text(1797.25) == "1797 N·m"
    assert [round_up(v) for v in (0.011, 0.2, 3.0, 7.0)] == pytest.approx([0.02, 0.2, 5.0, 10.0])


def test_all_outputs_that_are_asked_for_are_drawn() -> None:
    shaper = lw.solve_motion(lw.load("gallery:shaper_quick_return"), steps=60)
    diagram = plot(shaper, "sva", of=["lever", "ram", "crank"])
    angles, lines = diagram.figure.axes[0], [axes.lines for axes in diagram.figure.axes]
    drawn = [np.asarray(line.get_ydata())[:-1] for line in angles.lines if len(line.get_ydata()) > 2]
    for link, values in zip(("lever", "crank"), drawn, strict=True):
        assert values == pytest.approx(np.degrees(shaper.link(link).angle))
    travel = [np.asarray(line.get_ydata()) for line in lines[3] if len(line.get_ydata()) > 2]
    assert len(travel) == 1
    assert travel[0][:-1] == pytest.approx(1e3 * shaper.joint("guide").displacement)
    assert {"lever", "ram", "crank"} <= set(words_of(diagram))


def test_an_option_without_use_is_refused_by_every_kind(forces: lw.Forces) -> None:
    given = {"of": "jaw", "joint": "B", "on": "jaw", "axes": "jaw", "at": 1.0, "fluctuation": 0.1}
    for kind in DIAGRAMS:
        for option in set(given) - set(DIAGRAMS[kind]().options):
            with pytest.raises(LinkwrightError, match=f'{kind} has no use for "{option}"'):
                plot(forces, kind, **{option: given[option]})  # type: ignore[arg-type]


def test_sizes_beyond_all_paper_are_refused(forces: lw.Forces) -> None:
    with pytest.raises(LinkwrightError, match="1 to 100 each"):
        plot(forces, "torque", size=(7.0, 1e6))
    with pytest.raises(LinkwrightError, match="dots per inch; give 1 to"):
        plot(forces, "torque").png(dpi=1e5)


def test_a_plot_imports_nothing_that_it_does_not_write() -> None:
    code = (
        "import sys, linkwright as lw; from linkwright.plot import plot;"
        "plot(lw.load('gallery:crank_rocker'), 'sva').svg();"
        "print(*(set(sys.modules) & {'fontTools.subset', 'matplotlib.pyplot', 'scipy', 'ezdxf', 'linkwright.study',"
        "'linkwright.parts', 'linkwright.synthesis', 'linkwright.tolerance'}))"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.split() == []


def test_a_joint_that_carries_nothing_has_a_point_for_a_hodograph() -> None:
    """The guide of a yoke in line with its load: 4e-15 N by rounding were drawn as a scribble."""
    axes = plot(lw.solve_forces(lw.load("gallery:scotch_yoke")), "hodographs", of=["guide"]).figure.axes[0]
    assert all(not np.any(line.get_xydata()) for line in axes.lines if len(line.get_xydata()) > 2)
    assert axes.get_xlim()[1] > 0.5 and axes.get_xlabel() == "Fx (N)"


def collection(path: Path, families: Sequence[str], style: str) -> None:
    """A font collection with one face per family, as the packages of Chinese fonts have them."""
    from fontTools.ttLib import TTCollection, TTFont

    faces = TTCollection()
    for family in families:
        face = TTFont(font_manager.findfont("DejaVu Sans:bold" if style == "Bold" else "DejaVu Sans"))
        for number, text in ((1, family), (2, style), (4, f"{family} {style}"), (16, family), (17, style)):
            face["name"].setName(text, number, 3, 1, 0x409)
            face["name"].setName(text, number, 1, 0, 0)
        faces.fonts.append(face)
    faces.save(path)


@pytest.mark.parametrize("package", ["NotoSansCJK", "wqy-microhei"])
def test_the_regular_face_of_a_collection_that_was_installed_after_the_list(
    package: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """Of fonts that matplotlib has not listed: by name, upright and not bold, without its complaints."""
    family = {"NotoSansCJK": "Noto Sans CJK SC", "wqy-microhei": "WenQuanYi Micro Hei"}[package]
    faces = [family, family.replace("CJK", "Mono CJK") if "CJK" in family else f"{family} Mono"]
    for style in ("Bold", "Regular") if package == "NotoSansCJK" else ("Regular",):
        collection(tmp_path / f"{package}-{style}.ttc", faces, style)
    stale = font_manager.FontManager.__new__(font_manager.FontManager)
    stale.__dict__.update(font_manager.fontManager.__dict__)
    stale.ttflist = [font for font in font_manager.fontManager.ttflist if font.name == "DejaVu Sans"]
    monkeypatch.setattr(font_manager, "fontManager", stale)
    monkeypatch.setattr("linkwright.plot.svg.text.system_fonts", lambda: tuple(sorted(tmp_path.iterdir())))
    picture.chinese_font.cache_clear()
    try:
        assert picture.chinese_font() == family
        found = Path(stale.findfont(font_manager.FontProperties(family=[family])))
        assert found.name == f"{package}-Regular.ttc" and not caplog.records
    finally:
        picture.chinese_font.cache_clear()

"""Diagrams from inside: what is marked, the main output, fonts and their absence, words of every kind, numbers."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from matplotlib import font_manager

import linkwright as lw
from linkwright.errors import LinkwrightError
from linkwright.plot import plot
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


def test_a_block_on_the_frame_means_its_displacement() -> None:
    conveyor = lw.load("gallery:swing_conveyor")
    output = output_named(conveyor, "slider")
    assert getattr(output, "kind", None) == "displacement" and getattr(output, "owner", None) == "guide"
    assert main_output(lw.solve_motion(conveyor, steps=12)) == output_named(conveyor, "guide")


def test_a_wheel_in_a_fixed_ratio_to_the_driver_is_shown_where_there_is_nothing_else() -> None:
    five_bar, pair = (lw.load(f"gallery:{name}") for name in ("geared_fivebar", "external_gear_pair"))
    assert str(main_output(lw.solve_motion(five_bar, steps=12))) == "bar_2"
    assert str(main_output(lw.solve_motion(pair, steps=12))) == "wheel"


def test_without_a_chinese_font_a_sentence_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "chinese_font", lambda: None)
    with pytest.raises(LinkwrightError, match="apt-get install fonts-noto-cjk"):
        plot(CRUSHER, language="zh")


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


def test_an_option_without_use_is_refused_by_every_kind(forces: lw.Forces) -> None:
    given = {"of": "jaw", "joint": "B", "on": "jaw", "axes": "jaw", "at": 1.0, "fluctuation": 0.1}
    for kind in DIAGRAMS:
        for option in set(given) - set(DIAGRAMS[kind]().options):
            with pytest.raises(LinkwrightError, match=f'{kind} has no use for "{option}"'):
                plot(forces, kind, **{option: given[option]})  # type: ignore[arg-type]


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

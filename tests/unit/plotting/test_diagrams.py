"""Diagrams from inside: an output by its link, fonts and their absence, words of every kind, numbers."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from matplotlib import font_manager
from tests import store
from tests.every import every
from tests.refusals import refused

from linkwright.kinematics.names import output_meant
from linkwright.pictures import diagram as picture
from linkwright.pictures.picture import round_up
from linkwright.plotting.diagrams.axes import significant, unit_of
from linkwright.plotting.diagrams.base import DIAGRAMS, RESULT_DIAGRAMS, plot, title_of
from linkwright.plotting.diagrams.source import main_output

CRUSHER = store.machine("jaw_crusher_sixbar")


def test_the_main_output_of_a_slider_crank_is_the_displacement() -> None:
    assert main_output(store.motion("swing_conveyor", 12)) == output_meant(store.machine("swing_conveyor"), "guide")


def test_without_a_chinese_font_a_sentence_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "chinese_font", lambda: None)
    with refused("picture.boxes") as caught:
        plot(CRUSHER, language="zh")
    assert "fonts-noto-cjk" in str(caught.value.values["remedy"])


def test_every_kind_has_its_words() -> None:
    for kind in every([*DIAGRAMS, *RESULT_DIAGRAMS], least=20):
        assert title_of(kind)


def test_numbers_and_units() -> None:
    assert [significant(v) for v in (0.0, -0.00012345, 12.3456, -1234.56, 1.0, 2.5e8)] == [
        "0",
        "−0.0001234",
        "12.35",
        "−1235",
        "1",
        "2.5e+08",
    ]
    assert unit_of("force", [np.array([1.0, -25e3])]).text(-25e3) == "−25 kN"
    assert unit_of("torque", [np.array([1800.0])]).text(1797.25) == "1797 N·m"
    assert [round_up(v) for v in (0.011, 0.2, 3.0, 7.0)] == pytest.approx([0.02, 0.2, 5.0, 10.0])


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
    from fontTools.ttLib import TTFont

    family = {"NotoSansCJK": "Noto Sans CJK SC", "wqy-microhei": "WenQuanYi Micro Hei"}[package]
    faces = [family, family.replace("CJK", "Mono CJK") if "CJK" in family else f"{family} Mono"]
    for style in ("Bold", "Regular") if package == "NotoSansCJK" else ("Regular",):
        collection(tmp_path / f"{package}-{style}.ttc", faces, style)
    stale = font_manager.FontManager.__new__(font_manager.FontManager)
    stale.__dict__.update(font_manager.fontManager.__dict__)
    stale.ttflist = [font for font in font_manager.fontManager.ttflist if font.name == "DejaVu Sans"]
    monkeypatch.setattr(font_manager, "fontManager", stale)
    monkeypatch.setattr("linkwright.pictures.fonts.installed_chinese", lambda: tuple(sorted(tmp_path.iterdir())))
    chosen = picture.chinese_font()
    assert chosen is not None
    found = stale.findfont(font_manager.FontProperties(family=[chosen]))
    assert Path(found).name == f"{package}-Regular.ttc" and not caplog.records
    assert TTFont(found, fontNumber=getattr(found, "face_index", 0))["name"].getDebugName(1) == family

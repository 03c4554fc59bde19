"""Fonts that are given, and those installed later: which file writes Chinese, and where --fonts may stand."""

from pathlib import Path

import pytest
from tests.cli.commands import is_refused, shown
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright.pictures import fonts
from linkwright.pictures.diagram import ALIAS, chinese_font

#: Commands that draw, each with what it needs besides.
DRAWING = (
    ("plot", "gallery:crank_rocker"),
    ("draw", "gallery:crank_rocker", "--output", "a.png"),
    ("animate", "gallery:crank_rocker", "--output", "a.gif"),
    ("report", "gallery:crank_rocker"),
    ("export", "gallery:crank_rocker", "--output", "a.png"),
    ("compare", "gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar", "--plot", "a.svg"),
    ("beam", "gallery:cantilever", "--plot", "a.svg"),
    ("cam", "gallery:cam_lecture", "--plot", "a.svg"),
    ("synthesize", "gallery:function_of_three_pairs", "--plot", "a.svg"),
)


def font(path: Path, family: str, characters: str = "中") -> Path:
    """A font with a few characters, all of them empty."""
    pytest.importorskip("fontTools")
    from fontTools.fontBuilder import FontBuilder
    from fontTools.pens.ttGlyphPen import TTGlyphPen

    names = [".notdef", *(f"u{ord(each):04X}" for each in characters)]
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder(names)
    builder.setupCharacterMap({ord(each): f"u{ord(each):04X}" for each in characters})
    builder.setupGlyf({name: TTGlyphPen(None).glyph() for name in names})
    builder.setupHorizontalMetrics(dict.fromkeys(names, (1000, 0)))
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": family, "styleName": "Regular"})
    builder.setupOS2(sTypoAscender=800, usWinAscent=800, usWinDescent=200, usWeightClass=500)
    builder.setupPost()
    builder.save(path)
    return path


def test_a_given_font_goes_before_the_installed_ones(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """Found in its folder, without a word of matplotlib about its weight, and no longer used afterwards."""
    from matplotlib import font_manager

    own = font(tmp_path / "own.ttf", "Own Chinese")
    font(tmp_path / "latin.ttf", "Own Latin", "a")
    with fonts.more_fonts([tmp_path]):
        assert chinese_font() == ALIAS
        assert Path(font_manager.findfont(ALIAS)) == own
        assert Path(font_manager.findfont(f"{ALIAS}:bold")) == own
    assert not caplog.records and fonts.own_fonts() == ()
    assert chinese_font() is None or Path(font_manager.findfont(ALIAS)) != own


def test_a_font_that_is_installed_later_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fonts, "font_folders", lambda: [tmp_path])
    fonts.system_fonts.cache_clear()
    try:
        assert fonts.installed_chinese() == ()
        with refused("picture.no_chinese_font"):
            fonts.check_fonts("<text>中</text>")
        later = font(tmp_path / "wqy-later.ttf", "WenQuanYi Later")
        assert fonts.installed_chinese() == (later,)
        fonts.check_fonts("<text>中</text>")
    finally:
        fonts.system_fonts.cache_clear()


def test_the_regular_file_of_several() -> None:
    """As the packages of the systems name them."""
    for regular, *others in (
        ("NotoSansCJK-Regular.ttc", "NotoSansCJK-Bold.ttc", "NotoSerifCJK-Regular.ttc", "NotoSansCJK-Black.ttc"),
        ("wqy-microhei.ttc", "wqy-zenhei-mono.ttc"),
        ("msyh.ttc", "msyhbd-bold.ttc", "simsun.ttc"),
    ):
        assert fonts.chinese_file(map(Path, [*others, regular])) == Path(regular)


def test_every_command_that_draws_takes_fonts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for command, *arguments in every(DRAWING, least=9):
        assert "--fonts" in shown(command, "--help")
        call = [command, *arguments, "--fonts", str(tmp_path / "nowhere")]
        is_refused(call, "picture.no_font_file", file=str(tmp_path / "nowhere"))
    assert not list(tmp_path.iterdir())


def test_a_drawing_takes_a_folder_of_fonts(tmp_path: Path) -> None:
    pytest.importorskip("resvg_py")
    font(tmp_path / "wqy-own.ttf", "Own Chinese", "速度 ms/05")
    drawing = lw.draw(lw.load("gallery:crank_rocker"), velocities=("P",), language="zh")
    assert drawing.png(fonts=[tmp_path])[:4] == b"\x89PNG"
    with refused("picture.no_font_file"):
        drawing.png(fonts=[tmp_path / "none.ttf"])

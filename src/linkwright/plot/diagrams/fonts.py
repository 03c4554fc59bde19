"""Fonts of diagrams: a Chinese one is found among those installed, else a sentence says how to get one."""

from __future__ import annotations

from functools import lru_cache

from linkwright.errors import LinkwrightError
from linkwright.words.sentence import Sentence

#: Families that hold Chinese characters, the ones that look best first.
CHINESE = (
    "Noto Sans CJK SC", "Noto Sans SC", "Source Han Sans SC", "Source Han Sans CN", "Noto Sans CJK TC",
    "Noto Sans CJK JP", "Noto Sans TC", "Source Han Sans", "Microsoft YaHei", "PingFang SC", "Hiragino Sans GB",
    "WenQuanYi Micro Hei", "WenQuanYi Zen Hei", "SimHei", "Heiti SC", "Heiti TC", "Droid Sans Fallback",
    "Arial Unicode MS", "Microsoft JhengHei", "AR PL UMing CN", "AR PL UKai CN", "SimSun",
)  # fmt: skip
LATIN = "DejaVu Sans"
REMEDY = Sentence("picture.install_font")


@lru_cache(maxsize=1)
def chinese_font() -> str | None:
    """Family of an installed font with Chinese characters."""
    from matplotlib import font_manager

    installed = {font.name for font in font_manager.fontManager.ttflist}
    for family in CHINESE:
        if family in installed:
            return family
    return _registered()


def families(language: str) -> list[str]:
    """Font families for a diagram: the Chinese one first in Chinese, DejaVu Sans first else.

    Raises LinkwrightError in Chinese where no font can write it.
    """
    chinese = chinese_font()
    if language == "zh":
        if chinese is None:
            raise LinkwrightError(Sentence("picture.boxes", remedy=REMEDY))
        return [chinese, LATIN]
    return [LATIN] if chinese is None else [LATIN, chinese]


def _registered() -> str | None:
    """A Chinese font that was installed after matplotlib listed the fonts."""
    from matplotlib import font_manager

    from linkwright.plot.svg.fonts import chinese_fonts, system_fonts

    for file in chinese_fonts(system_fonts()):
        try:
            font_manager.fontManager.addfont(str(file))
        except (OSError, RuntimeError):
            continue
        return font_manager.fontManager.ttflist[-1].name
    return None

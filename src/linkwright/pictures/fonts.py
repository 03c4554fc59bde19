"""Fonts: files in the system's folders, and those given in addition."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache
from pathlib import Path

from linkwright.errors import LinkwrightError, RequestError
from linkwright.words import _

_CHINESE_FILES = (
    "notosanscjk",
    "notosanssc",
    "notosanstc",
    "notoserifcjk",
    "sourcehan",
    "wqy",
    "droidsansfallback",
    "msyh",
    "simhei",
    "simsun",
    "deng",
    "pingfang",
    "hiragino",
    "stheiti",
    "arialunicode",
    "uming",
    "ukai",
)
#: What the names of files say that hold other faces than the regular one.
_SPECIAL = (
    "bold",
    "black",
    "heavy",
    "thin",
    "light",
    "medium",
    "italic",
    "oblique",
    "mono",
    "serif",
    "song",
    "ming",
    "kai",
    "simsun",
    "hk",
    "tc",
)
_SUFFIXES = (".ttf", ".ttc", ".otf", ".otc")


def font_folders() -> list[Path]:
    """Folders in which the system and the user keep fonts."""
    home = Path.home()
    if sys.platform == "win32":
        local = Path(os.environ.get("LOCALAPPDATA", home / "AppData" / "Local"))
        return [Path(os.environ.get("WINDIR", "C:/Windows")) / "Fonts", local / "Microsoft/Windows/Fonts"]
    if sys.platform == "darwin":
        return [Path("/System/Library/Fonts"), Path("/Library/Fonts"), home / "Library/Fonts"]
    shared = Path(os.environ.get("XDG_DATA_HOME", home / ".local/share")) / "fonts"
    return [Path("/usr/share/fonts"), Path("/usr/local/share/fonts"), shared, home / ".fonts"]


@lru_cache(maxsize=1)
def system_fonts() -> tuple[Path, ...]:
    """All font files of the system."""
    found = (file for folder in font_folders() if folder.is_dir() for file in folder.rglob("*"))
    return tuple(sorted(file for file in found if file.suffix.lower() in _SUFFIXES))


def chinese_fonts(files: Iterable[Path]) -> tuple[Path, ...]:
    """Those files that are known to hold Chinese characters, judged by their names."""

    def known(file: Path) -> bool:
        stem = file.stem.lower().replace("-", "").replace("_", "").replace(" ", "")
        return any(stem.startswith(each) for each in _CHINESE_FILES)

    return tuple(file for file in files if known(file))


def chinese_file(paths: Iterable[Path]) -> Path | None:
    """The font file that writes Chinese: of those that are given, else of the installed ones, the one whose name is
    most that of a sans serif of regular weight; None without one."""
    files = tuple(paths)
    found = chinese_fonts(files) or tuple(filter(_writes_chinese, files)) or installed_chinese()
    special = {file: sum(word in file.stem.lower() for word in _SPECIAL) for file in found}
    return min(found, key=lambda file: (special[file], len(file.stem)), default=None)


def _writes_chinese(file: Path) -> bool:
    try:
        from matplotlib.ft2font import FT2Font

        return ord("中") in FT2Font(str(file)).get_charmap()
    except (ImportError, OSError, RuntimeError):
        return False


def needs_chinese(text: str) -> bool:
    """Whether a text has Chinese characters."""
    return any("\u2e80" <= c <= "\u9fff" or "\uf900" <= c <= "\ufaff" for c in text)


def font_files(paths: Iterable[str | Path]) -> tuple[Path, ...]:
    """The font files that are given, of folders all in them; raises RequestError for what is neither."""
    found: list[Path] = []
    for each in map(Path, paths):
        files = [each] if each.is_file() else sorted(each.rglob("*")) if each.is_dir() else []
        fonts = [file for file in files if file.suffix.lower() in _SUFFIXES]
        if not fonts:
            raise RequestError(
                _(
                    "there is no font at {file}; give a TTF, OTF or TTC file, or a folder that holds some",
                    code="picture.no_font_file",
                    file=each,
                )
            )
        found += fonts
    return tuple(found)


_own_fonts: ContextVar[tuple[Path, ...]] = ContextVar("fonts", default=())


@contextmanager
def more_fonts(paths: Iterable[str | Path]) -> Iterator[None]:
    """Texts inside are drawn with these font files, and those in these folders, before the system's.

    Raises RequestError for a path without fonts.
    """
    token = _own_fonts.set((*font_files(paths), *_own_fonts.get()))
    try:
        yield
    finally:
        _own_fonts.reset(token)


def own_fonts() -> tuple[Path, ...]:
    """The files of :func:`more_fonts`."""
    return _own_fonts.get()


def installed_chinese() -> tuple[Path, ...]:
    """Fonts with Chinese characters, also those that were installed since the system's were looked through."""
    found = chinese_fonts(system_fonts())
    if not found:
        system_fonts.cache_clear()
        found = chinese_fonts(system_fonts())
    return found


def check_fonts(text: str, own: Sequence[Path] = ()) -> None:
    """Refuse to draw boxes: raise where no font is found, or none for the Chinese characters in the text."""
    remedy = _(
        "install one (Debian: fonts-noto-cjk), or name its file or folder: --fonts FOLDER on "
        "the command line, fonts=['NotoSansSC-Regular.ttf'] in Python"
    )
    if own or own_fonts():
        return
    if needs_chinese(text) and not installed_chinese():
        raise RequestError(
            _(
                "the picture has Chinese text, and no font that can write it was found; {remedy}",
                code="picture.no_chinese_font",
                remedy=remedy,
            )
        )
    if "<text" in text and not system_fonts():
        raise LinkwrightError(
            _("the picture has text, and no font was found; {remedy}", code="picture.no_font", remedy=remedy)
        )

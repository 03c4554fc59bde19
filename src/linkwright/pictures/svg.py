"""SVG as text: elements of a document as immutable values, and pictures made of it, PNG by resvg, PDF by Typst."""

from __future__ import annotations

import importlib
import math
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from linkwright.core.arrays import Floats
from linkwright.errors import LinkwrightError, RequestError
from linkwright.filesystem import atomic_write
from linkwright.pictures.fonts import (
    check_fonts,
    chinese_file,
    chinese_fonts,
    font_files,
    needs_chinese,
    own_fonts,
    system_fonts,
)
from linkwright.words import _
from linkwright.words.characters import pieces, printable

Attribute = str | float
_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})


def number(value: float) -> str:
    """Two decimals at most, without trailing zeros."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def escape(text: str) -> str:
    """Text that XML can carry: markup characters escaped, what XML cannot hold left out."""
    return printable(text).translate(_ESCAPES)


@dataclass(frozen=True)
class Element:
    """One element: tag, attributes in order, and content: text, and what writes itself as SVG."""

    tag: str
    attributes: tuple[tuple[str, str], ...]
    content: tuple[object, ...] = ()

    def __str__(self) -> str:
        head = "".join(f' {name}="{escape(value)}"' for name, value in self.attributes)
        if not self.content:
            return f"<{self.tag}{head}/>"
        inner = "".join(escape(each) if isinstance(each, str) else str(each) for each in self.content)
        return f"<{self.tag}{head}>{inner}</{self.tag}>"

    def holding(self, *content: object) -> Element:
        """The same element with more content."""
        return Element(self.tag, self.attributes, (*self.content, *content))


def element(tag: str, attributes: Mapping[str, Attribute | None] | None = None, *content: object) -> Element:
    """An element; attributes that are None are left out, numbers are rounded."""
    pairs = tuple(
        (name, value if isinstance(value, str) else number(value))
        for name, value in (attributes or {}).items()
        if value is not None
    )
    return Element(tag, pairs, content)


def group(content: Iterable[object], style: str | None = None, **attributes: Attribute | None) -> Element:
    """A ``g`` element of the class ``style``."""
    return element("g", {"class": style, **attributes}, *content)


def coordinates(points: Floats) -> str:
    """Points (k, 2) as the text of a ``points`` attribute."""
    return " ".join(f"{number(x)},{number(y)}" for x, y in points.tolist())


def path_data(points: Floats, *, closed: bool = False) -> str:
    """Points (k, 2) as the text of a ``d`` attribute; a row of NaN starts a new stroke."""
    parts: list[str] = []
    pen_down = False
    for x, y in points.tolist():
        if x != x or y != y:
            pen_down = False
            continue
        parts.append(f"{'L' if pen_down else 'M'}{number(x)} {number(y)}")
        pen_down = True
    return "".join(parts) + ("Z" if closed and parts else "")


def loop_data(corners: Floats, bulges: Floats) -> str:
    """A closed loop of lines and arcs as the text of a ``d`` attribute: corners (k, 2), and the tangents of a quarter
    of the angles of the edges that begin there, (k,)."""
    start, *others = corners.tolist()
    parts = [f"M{number(start[0])} {number(start[1])}"]
    here = start
    for (x, y), bulge in zip([*others, start], bulges.tolist(), strict=True):
        end = f"{number(x)} {number(y)}"
        if bulge:
            radius = number(math.hypot(x - here[0], y - here[1]) * (1.0 + bulge * bulge) / (4.0 * abs(bulge)))
            parts.append(f"A{radius} {radius} 0 {int(abs(bulge) > 1.0)} {int(bulge > 0.0)} {end}")
        else:
            parts.append(f"L{end}")
        here = [x, y]
    return "".join(parts) + "Z"


NARROW = frozenset("iljfI.,:;'|![]() ")
WIDE = frozenset("mwMW@%")
#: A space at which no line breaks.
_HELD = "\u2060"
_INDEX = re.compile(r"^(?P<stem>[^\W\d_]{1,2}'*)_?(?P<index>\d+'*)$")


def width(text: str, size: float) -> float:
    """Width of a line of text at a font size, estimated a little too large rather than too small."""
    return size * sum(_share(character) for character in text)


def _share(character: str) -> float:
    if unicodedata.east_asian_width(character) in "WF":
        return 1.02
    if character in NARROW:
        return 0.36
    if character in WIDE:
        return 0.98
    if character in "rt":
        return 0.42
    return 0.7 if character.isupper() else 0.64


def fold(text: str, widest: float, size: float) -> list[str]:
    """A text in lines that fit a width; a word that is wider is cut."""
    lines = [""]
    for piece in pieces(text.replace("\u00a0", _HELD)):
        rest = piece if lines[-1] else piece.lstrip()
        if lines[-1] and piece not in "？！" and width(lines[-1] + rest, size) > widest:
            lines.append("")
            rest = piece.lstrip()
        while width(rest, size) > widest:
            keep = next(k for k in range(len(rest), 0, -1) if k == 1 or width(rest[:k], size) <= widest)
            lines[-1:] = [lines[-1] + rest[:keep], ""]
            rest = rest[keep:]
        lines[-1] += rest
    return [line.replace(_HELD, "\u00a0") for line in lines]


def split_index(name: str) -> tuple[str, str]:
    """``O1`` is O with the index 1; other names have no index."""
    found = _INDEX.match(name)
    return (found["stem"], found["index"]) if found else (name, "")


FAMILIES = (
    "Noto Sans",
    "DejaVu Sans",
    "Segoe UI",
    "Helvetica Neue",
    "Arial",
    "Noto Sans SC",
    "Noto Sans CJK SC",
    "Source Han Sans SC",
    "Microsoft YaHei",
    "PingFang SC",
    "WenQuanYi Micro Hei",
    "sans-serif",
)
FAMILY_LIST = ", ".join(f"'{name}'" if " " in name else name for name in FAMILIES)


Paths = Sequence[str | Path]
#: Most pixels of one picture, and smallest width.
MOST_PIXELS, MIN_WIDTH = 100_000_000, 8


def png(svg: str, *, width: int | None = None, zoom: float = 2.0, fonts: Paths = ()) -> bytes:
    """The picture in pixels: ``width`` of them across, or ``zoom`` for each unit of the SVG.

    ``fonts`` are files, or folders of them, used before the system's. Raises LinkwrightError where resvg-py is not
    installed, for a width below 8 or with more than a hundred million pixels, or where the text has Chinese
    characters and no font for them is found.
    """
    try:
        import resvg_py
    except ImportError:
        raise LinkwrightError(
            _('PNG pictures need resvg-py; install it with: pip install "linkwright[plot]"', code="picture.png_needs")
        ) from None
    files = _font_files(fonts)
    check_fonts(svg, files)
    check_width(width, *natural_size(svg), zoom)
    size: dict[str, Any] = {"width": int(width)} if width is not None else {"zoom": float(zoom)}
    if needs_chinese(svg):
        files = _for_chinese(files)
        size["skip_system_fonts"] = True
    try:
        return bytes(
            resvg_py.svg_to_bytes(
                svg_string=svg, font_files=[str(file) for file in files], sans_serif_family="DejaVu Sans", **size
            )
        )
    except ValueError as problem:
        raise RequestError(
            _(
                "the picture cannot be made: {problem}; give a smaller size",
                code="picture.cannot_be_made",
                problem=problem,
            )
        ) from None


def _for_chinese(fonts: list[Path]) -> list[Path]:
    """Fonts of which one writes Chinese, in its regular face; of several resvg takes whichever it meets first."""
    chosen, others = chinese_file(fonts), (*fonts, *system_fonts())
    rest = [file for file in others if file not in {*chinese_fonts(others), chosen}]
    return rest if chosen is None else [chosen, *rest]


def check_width(width: int | None, wide: float, tall: float, zoom: float = 1.0) -> None:
    """Raises LinkwrightError for a picture, ``wide`` × ``tall`` by nature, that is drawn too small or too large."""
    across = zoom * wide if width is None else float(width)
    most = math.floor(math.sqrt(MOST_PIXELS * wide / tall))
    if not MIN_WIDTH <= across <= most:
        raise RequestError(
            _(
                "a picture cannot be {across:.12g} pixels wide; give a width from {minimum} to {maximum}",
                code="picture.bad_width",
                across=across,
                minimum=MIN_WIDTH,
                maximum=most,
            )
        )


def natural_size(svg: str) -> tuple[float, float]:
    """Width and height that an SVG's first element gives itself."""
    head = re.search(r"<svg[^>]*>", svg)
    pairs = re.findall(r'\s(width|height)="([\d.]+)', head[0] if head else "")
    found = {name: float(value) for name, value in pairs}
    return max(found.get("width", 1.0), 1e-3), max(found.get("height", 1.0), 1e-3)


def pdf(svg: str, *, fonts: Paths = (), millimetres: tuple[float, float] | None = None) -> bytes:
    """The picture as one page of vector PDF, as large as the picture; needs the ``typst`` package.

    ``millimetres``: width and height of the page, which the picture fills.
    """
    try:
        typst: Any = importlib.import_module("typst")
    except ImportError:
        raise LinkwrightError(
            _('PDF pictures need typst; install it with: pip install "linkwright[plot]"', code="picture.pdf_needs")
        ) from None
    files = _font_files(fonts)
    check_fonts(svg, files)
    page, size = "width: auto, height: auto", ""
    if millimetres is not None:
        page = f"width: {millimetres[0]}mm, height: {millimetres[1]}mm"
        size = f", {page}"
    source = f'#set page({page}, margin: 0pt)\n#image(bytes(sys.inputs.svg), format: "svg"{size})\n'
    folders = [str(file.parent) for file in files]
    return bytes(typst.compile(source.encode(), sys_inputs={"svg": svg}, font_paths=folders, format="pdf"))


def save_picture(svg: str, path: str | Path, *, force: bool, **options: Any) -> Path:
    """Write a picture; the suffix of ``path`` says which kind: svg, png or pdf."""
    suffix = Path(path).suffix.lower()
    if suffix == ".svg":
        return atomic_write(path, svg.encode(), force=force)
    if suffix == ".png":
        return atomic_write(path, png(svg, **options), force=force)
    if suffix == ".pdf":
        return atomic_write(path, pdf(svg, **options), force=force)
    raise RequestError(
        _(
            '{path}: unknown picture format "{suffix}"; use .svg, .png or .pdf',
            code="picture.no_picture_suffix",
            path=path,
            suffix=suffix,
        )
    )


def _font_files(fonts: Paths) -> list[Path]:
    return [*font_files(fonts), *own_fonts()]

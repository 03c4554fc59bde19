"""PNG by resvg and PDF by Typst, both from the same SVG."""

from __future__ import annotations

import importlib
import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from linkwright.errors import LinkwrightError, RequestError
from linkwright.filesystem import atomic_write
from linkwright.pictures.svg.fonts import (
    check_fonts,
    chinese_file,
    chinese_fonts,
    font_files,
    needs_chinese,
    own_fonts,
    system_fonts,
)
from linkwright.words import _

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
            '{path}: the suffix "{suffix}" is no kind of picture; use .svg, .png or .pdf',
            code="picture.no_picture_suffix",
            path=path,
            suffix=suffix,
        )
    )


def _font_files(fonts: Paths) -> list[Path]:
    return [*font_files(fonts), *own_fonts()]

"""A sheet as SVG in millimetres."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from linkwright.pictures.picture import Item
from linkwright.pictures.svg.element import element, number
from linkwright.pictures.svg.text import FAMILY_LIST
from linkwright.sheets.paper import Paper

#: Dashes and gaps of the kinds of lines in widths of a thin line (GB/T 17450, shortened for small pictures).
DASHES = {
    "dashed": (12.0, 3.0),
    "chain": (24.0, 3.0, 0.5, 3.0),
    "double_chain": (24.0, 3.0, 0.5, 3.0, 0.5, 3.0),
}


def width_of(pen: str, paper: Paper) -> float:
    """Width of a line, mm."""
    return paper.thick if pen in ("frame", "thick") else paper.thick / 2


def svg(items: Iterable[Item], paper: Paper, title: str) -> str:
    """The document, one unit a millimetre."""
    root = element(
        "svg",
        {
            "xmlns": "http://www.w3.org/2000/svg",
            "viewBox": f"0 0 {number(paper.width)} {number(paper.height)}",
            "width": f"{number(paper.width)}mm",
            "height": f"{number(paper.height)}mm",
            "role": "img",
        },
        element("title", None, title),
        element("style", None, _style(paper)),
        element("rect", {"fill": "#fff", "x": 0, "y": 0, "width": paper.width, "height": paper.height}),
        *(item.placed(np.array([0.0, paper.height]), scale=(1.0, -1.0)) for item in items),
    )
    return str(root)


def _style(paper: Paper) -> str:
    rules = [
        f".{pen}{{stroke-width:{number(width_of(pen, paper))}" + _dash(pen, paper) + "}"
        for pen in ("frame", "thick", "thin", "dashed", "chain", "double_chain")
    ]
    shapes = "path,circle{fill:none;stroke:#000;stroke-linejoin:round;stroke-linecap:round}"
    chains = ".dashed,.chain,.double_chain{stroke-linecap:butt}"
    fills = ".paper{fill:#fff}.ink{fill:#000}"
    return f"{shapes}{''.join(rules)}{chains}{fills}text{{font-family:{FAMILY_LIST};fill:#000}}"


def _dash(pen: str, paper: Paper) -> str:
    """The dashes of a kind of line."""
    if pen not in DASHES:
        return ""
    unit = 0.25 if paper.thick < 0.6 else 0.3
    return ";stroke-dasharray:" + " ".join(number(max(each * unit, 0.3)) for each in DASHES[pen])

"""A sheet as SVG in millimetres."""

from __future__ import annotations

from collections.abc import Iterable

from linkwright.pictures.svg.element import Element, element, number, path
from linkwright.pictures.svg.text import FAMILY_LIST
from linkwright.sheets.paper import Paper
from linkwright.sheets.picture import INDEX, Circle, Item, Line, Text

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
        *(_element(item, paper.height) for item in items),
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


def _element(item: Item, height: float) -> Element:
    if isinstance(item, Line):
        return path(item.points * (1.0, -1.0) + (0.0, height), _class(item), closed=item.closed)
    if isinstance(item, Circle):
        return element(
            "circle", {"class": _class(item), "cx": item.at[0], "cy": height - item.at[1], "r": item.radius}
        )
    return _text(item, height)


def _class(item: Line | Circle) -> str:
    return f"{item.pen} {item.fill}".strip()


def _text(item: Text, height: float) -> Element:
    x, y = float(item.at[0]), height - float(item.at[1])
    turn = f"rotate({number(-item.turn)} {number(x)} {number(y)})" if item.turn else None
    if item.squeeze < 1.0:
        turn = f"translate({number(x)} {number(y)}) scale({item.squeeze:.3f} 1)"
        x = y = 0.0
    anchor = None if item.anchor == "start" else item.anchor
    style = "italic" if item.symbol else None
    root = element(
        "text",
        {"x": x, "y": y, "font-size": item.size, "text-anchor": anchor, "font-style": style,
         "transform": turn, "xml:space": "preserve"},
    )  # fmt: skip
    parts: list[Element | str] = []
    raised = 0.0
    for text, level in item.runs:
        wanted = {0: 0.0, -1: 0.25, 1: -0.38}[level] * item.size
        if level == 0 and raised == 0.0:
            parts.append(text)
            continue
        size = INDEX * item.size if level else item.size
        parts.append(element("tspan", {"dy": wanted - raised, "font-size": size}, text))
        raised = wanted
    return root.holding(*parts)

"""Drawings that are printed in their own size."""

from __future__ import annotations

from linkwright.pictures.drawing import PIXELS
from linkwright.pictures.svg import natural_size
from linkwright.reports.typst_pages import TEXT


def own_share(svg: str) -> float:
    """The share of the page's width in which a drawing has its own size."""
    return natural_size(svg)[0] / PIXELS / TEXT

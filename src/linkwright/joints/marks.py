"""What a joint shows of itself in drawings beside its links: wheels, racks, strands, cams and what touches them."""

from __future__ import annotations

from dataclasses import dataclass

Vec = tuple[float, float]


@dataclass(frozen=True)
class Wheels:
    """Two wheels on a carrier, for drawings whose dimensions may change.

    ``ratio`` i of their speeds on it; ``radii`` (m) where they do not follow from the distance of the centres, d i /
    (i - 1) and d / (i - 1); ``wrapped``: a belt or a chain runs around them; ``toothed``: with teeth.
    """

    carrier: str
    centres: tuple[str, str]
    links: tuple[str, str]
    ratio: float
    radii: tuple[float, float] | None
    wrapped: bool
    toothed: bool


@dataclass(frozen=True)
class Mark:
    """A ``symbol`` (``gear``, ``disc``, ``rack``, ``strand``, ``cam``, ``roller``, ``knife`` or ``face``) on a
    link, in its axes, m and rad.

    ``at``: centre, point of the pitch line, edge, or first end; ``to``: second end of a strand or a face; ``turned``:
    place of a tooth, or direction of a rack or of a knife; ``inside``: teeth inwards, or right of a rack;
    ``follows``: the link and point along whose way a rack reaches; ``outlines``: closed curves of a cam, its profile,
    a roller's pitch curve and the outer wall of a groove (each empty where there is none).
    """

    symbol: str
    link: str
    at: Vec
    radius: float = 0.0
    turned: float = 0.0
    inside: bool = False
    teeth: int | None = None
    to: Vec = (0.0, 0.0)
    follows: tuple[str, str] | None = None
    outlines: tuple[tuple[Vec, ...], ...] = ()

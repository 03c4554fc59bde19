"""What a joint shows of itself in drawings beside its links: wheels, racks, strands."""

from __future__ import annotations

from dataclasses import dataclass

Vec = tuple[float, float]


@dataclass(frozen=True)
class Mark:
    """A ``symbol`` (``gear``, ``disc``, ``rack`` or ``strand``) on a link, in its axes, m and rad.

    ``at``: centre, point of the pitch line, or first end; ``to``: second end of a strand; ``turned``: place of a
    tooth, or direction of a rack; ``inside``: teeth inwards, or right of a rack; ``follows``: the link and
    point along whose way a rack reaches.
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

"""What a joint shows of itself in drawings beside its links: wheels, racks, strands, cams and what touches them."""

from __future__ import annotations

from linkwright.core.dataclass import dataclass

Vec = tuple[float, float]


@dataclass(frozen=True)
class Amount:
    """A number of a drawing whose dimensions may change: ``factor`` times and over those with the given addresses;
    ``value`` as they are."""

    value: float
    times: tuple[str, ...] = ()
    over: tuple[str, ...] = ()
    factor: float = 1.0


@dataclass(frozen=True)
class Wheel:
    """A wheel on a link about ``centre``, a point of ``carrier``; ``nominal``: its pitch radius (m).

    ``radius`` where it does not follow from the distance of the centres; ``inside``: teeth inwards.
    """

    link: str
    carrier: str
    centre: str
    nominal: float
    radius: Amount | None = None
    toothed: bool = False
    teeth: int | None = None
    inside: bool = False


@dataclass(frozen=True)
class Wheels:
    """Two wheels on a carrier, for drawings whose dimensions may change.

    ``ratio`` i of their speeds on it: radii without an amount of their own are d i / (i - 1) and d / (i - 1), d the
    distance of the centres; ``wrapped``: a belt or a chain runs around them, else their teeth mesh.
    """

    pair: tuple[Wheel, Wheel]
    ratio: Amount
    wrapped: bool


@dataclass(frozen=True)
class WheelSizes:
    """What reports tell of a pair with wheels on its ``links``: ``teeth``, pitch ``radii`` (m), centre ``distance``
    (m), ``ratio`` on the carrier, ``module`` (m) and ``pressure_angle`` (rad), as far as it has them; ``involute``:
    whether these are two gears whose teeth follow from number and module."""

    links: tuple[str, ...]
    teeth: tuple[float, ...] | None
    radii: tuple[float, ...]
    distance: float | None = None
    ratio: float | None = None
    module: float | None = None
    pressure_angle: float | None = None
    involute: bool = False


@dataclass(frozen=True)
class RackWay:
    """A rack of the link ``rack``: its pitch line goes through ``through`` in the direction ``turn`` (rad, in its
    axes), the pinion on the left, or ``right``."""

    pinion: Wheel
    rack: str
    through: str
    turn: Amount
    right: bool


@dataclass(frozen=True)
class CamContact:
    """A cam, link ``cam`` about ``centre``, and point ``at`` of the follower, held on the carrier by a ``guide``
    (along which ``side`` tells the way out) or a ``pivot`` (``side`` 1 where the arm is on the left).

    ``base``, ``roller``: radii; ``groove``: with an outer wall.
    """

    cam: str
    centre: str
    follower: str
    at: str
    carrier: str
    touch: str
    base: Amount
    roller: Amount
    groove: bool
    guide: str
    pivot: str
    side: int


Following = Wheels | RackWay | CamContact


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

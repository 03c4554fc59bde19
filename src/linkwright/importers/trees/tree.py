"""A tree of bodies in its plane, as models of robots give it: joints to parents, pins that close loops, couplings."""

from __future__ import annotations

from dataclasses import dataclass, field

#: Name of the fixed part.
WORLD = "world"


@dataclass
class Part:
    """A body as it lies in the model's reference pose; places are complex numbers, m, in the plane.

    ``inertia``: about the mass ``centre``, kg·m². ``marks``: places that have a name. ``line``: in the file; 0:
    unknown. ``between``: it is put between others, and has no mass.
    """

    name: str
    mass: float = 0.0
    inertia: float = 0.0
    centre: complex = 0j
    colour: str = ""
    marks: dict[str, complex] = field(default_factory=dict)
    line: int = 0
    between: bool = False


@dataclass
class TreeJoint:
    """A hinge at a place, or a slide along a direction, of a ``child`` on its ``parent``; both None: one body.

    ``turns``: the hinge's place in the reference pose; ``sense``: -1 where a growing coordinate turns clockwise.
    ``slides``: unit vector along which it moves. ``moved``: coordinate at the start less that in the reference pose,
    rad or m; ``rest``, ``low``, ``high``: of its spring and its limits, likewise. ``stiffness`` and ``damping``:
    N·m/rad, N·m·s/rad or N/m, N·s/m.
    """

    name: str
    parent: str
    child: str
    turns: complex | None = None
    sense: float = 1.0
    slides: complex | None = None
    moved: float = 0.0
    low: float | None = None
    high: float | None = None
    rest: float = 0.0
    stiffness: float = 0.0
    damping: float = 0.0
    line: int = 0

    @property
    def moves(self) -> bool:
        """Whether it is a hinge or a slide."""
        return self.turns is not None or self.slides is not None


@dataclass
class Pin:
    """Two parts that are pinned: the place of the pin on each, where the parts lie in the reference pose."""

    name: str
    a: str
    b: str
    at_a: complex
    at_b: complex
    line: int = 0


@dataclass
class Weld:
    """Two parts that are one: ``turn`` and ``shift`` bring places of b, in the reference pose, to those on a."""

    a: str
    b: str
    turn: complex = 1 + 0j
    shift: complex = 0j


@dataclass
class Coupling:
    """Σ factor · (coordinate - coordinate in the reference pose) = rest, over joints by their names."""

    name: str
    factors: dict[str, float]
    rest: float = 0.0
    line: int = 0


@dataclass
class Motor:
    """What drives a joint: rad/s or m/s of its coordinate, or a table of times (s) and coordinates; neither: open."""

    name: str
    joint: str
    speed: float | None = None
    table: tuple[list[float], list[float]] | None = None


@dataclass
class Tether:
    """A spring and damper between places of two parts, in the reference pose."""

    name: str
    a: str
    b: str
    at_a: complex
    at_b: complex
    stiffness: float
    free_length: float
    damping: float


@dataclass
class Tree:
    """A planar model; ``parts`` and ``joints`` in an order in which parents come first; ``marks``: of the world."""

    name: str = ""
    parts: dict[str, Part] = field(default_factory=dict)
    joints: dict[str, TreeJoint] = field(default_factory=dict)
    pins: list[Pin] = field(default_factory=list)
    welds: list[Weld] = field(default_factory=list)
    couplings: list[Coupling] = field(default_factory=list)
    motors: list[Motor] = field(default_factory=list)
    tethers: list[Tether] = field(default_factory=list)
    gravity: complex = 0j
    marks: dict[str, complex] = field(default_factory=dict)

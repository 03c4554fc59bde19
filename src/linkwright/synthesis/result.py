"""What a synthesis gives: candidates with what a designer must know about each, ranked.

Linkages that meet a demand equally well are ranked by transmission, size and unequal links in one number:

    merit = sin μ · min(1, 3 D / L) · min(1, 10 / q),

μ the smallest transmission angle (sin μ is the share of the coupler's force that turns the output), L the longest
distance between two points of one link, D that between two demanded points, q the longest over the shortest link. Up
to three times the demand and a ratio of ten nothing is taken off; beyond, twice the size halves the merit.
Transmission angle, ratio of links and size are what designers choose by (Erdman and Sandor, Mechanism Design,
vol. 1); the product, the 3 and the 10 are this program's.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import repeat
from math import degrees
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkwright.core.arguments import real
from linkwright.core.arrays import Complexes, Flags, Floats, Integers
from linkwright.core.attached import PlotMixin, attached
from linkwright.core.quantity import length_text
from linkwright.core.table import Amount, Cell, Table, Tabular
from linkwright.equations.steps import Solution
from linkwright.errors import LinkwrightError, speaker
from linkwright.filesystem import atomic_write, refuse_target
from linkwright.mechanism.mechanism import Mechanism
from linkwright.synthesis.linkage import Linkage, peak_loads
from linkwright.synthesis.names import DEFECTS, ERRORS, TYPE_NAMES, display_name
from linkwright.words import Message, Translate, _, pgettext

#: Share of the longest length, or of a radian, below which a deviation is rounding.
ROUNDING = 1e-12
COLUMNS = (
    _("no."),
    _("type"),
    pgettext("synthesize", "error"),
    _("worst"),
    _("defects"),
    pgettext("synthesize", "input"),
    _("μ min"),
    _("l max/min"),
    _("l max"),
)
#: Share of its size within which a linkage does what another one does.
SAME = 0.01


@dataclass(frozen=True, eq=False)
class Candidate:
    """One linkage that answers a demand.

    Args:
        linkage: its points and links in one pose.
        error: the error that the task measures (see ``Synthesis.error_name``), 0 where the demand is met exactly.
        worst: the largest deviation at one position, in the unit of the target.
        grashof_type: ``crank_rocker``, ``double_crank`` … ``slider_crank``, or the linkage's kind.
        defects: ``circuit``, ``branch``, ``order`` where the demanded positions have them; empty: none over the
            full range.
        turns: the input link turns fully.
        transmission_angle: the smallest, over a turn of the input or between its first and last position, rad.
        link_ratio: longest to shortest link.
        curve: what it does, for the picture: complex (m,) for a path, or (2, m) input and output of a function.
        values: further numbers by name, SI.
        positions: moving points (n,), m, at the n demanded positions.
        deviations: what is off there (n,), in the unit of the target; empty: not measured.
    """

    linkage: Linkage
    error: float
    grashof_type: str
    defects: tuple[str, ...]
    turns: bool
    transmission_angle: float
    link_ratio: float
    worst: float = 0.0
    curve: NDArray[Any] | None = field(default=None, repr=False)
    values: Mapping[str, float] = field(default_factory=dict)
    positions: Mapping[str, Complexes] = field(default_factory=dict, repr=False)
    deviations: Floats = field(default_factory=lambda: np.empty(0), repr=False)

    def __repr__(self) -> str:
        lengths = ", ".join(f"{name} {length:.6g}" for name, length in self.linkage.lengths().items())
        return f"Candidate({self.grashof_type}: error {self.error:.3g}, {lengths})"

    def mechanism(self, name: str = "", *, speed: str | float = "60 rpm") -> Mechanism:
        """The candidate as a mechanism, its input link driven at constant speed: a text or rad/s."""
        return self.linkage.mechanism(name, speed=speed)

    def loads(self, mass_per_length: float, *, speed: str | float = "60 rpm", steps: int = 180) -> dict[str, float]:
        """Peak input torque (N·m) and peak reaction (N) where every link has ``mass_per_length`` (kg/m).

        Links are slender rods between their first two points, m l²/12 about their middle; gravity is left out.
        """
        return peak_loads(self.linkage, mass_per_length, speed, steps)

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        linkage = self.linkage
        return {
            "kind": linkage.kind,
            "type": self.grashof_type,
            "error": self.error,
            "worst": self.worst,
            "defects": list(self.defects),
            "input_turns": self.turns,
            "transmission_angle_min [rad]": self.transmission_angle,
            "link_ratio": self.link_ratio,
            "longest [m]": linkage.longest(),
            "lengths [m]": linkage.lengths(),
            "points [m]": {name: [place.real, place.imag] for name, place in linkage.points.items()},
            **self.values,
        }


class Derivation:
    """What a solver used on its way; one dataclass per way."""


@dataclass(frozen=True)
class WorkedSynthesis(Solution):
    """How the first candidate of a synthesis was found, as a textbook prints it.

    ``steps`` hold sentences, equations with their numbers, matrices and tables; lengths in mm, or in m where the
    linkage is large, angles in degrees. ``pictures``: kinds of diagrams of the result by the number of the step that
    they belong to.
    """

    pictures: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Synthesis(PlotMixin, Tabular):
    """The candidates of a task, best first: without defects before others, then by error, then by merit (``merit``).

    Args:
        task: ``path``, ``motion``, ``function``, ``slider_crank`` …
        candidates: ranked.
        error_name: what ``error`` of a candidate is: a key of `ERRORS` in `linkwright.synthesis.names`.
        target: what was demanded, for the picture: complex points, or (2, n) input and output.
        counts: how many solutions of which sort were found.
        notes: sentences that belong to the result.
        curves: further curves for the picture by name (circle- and centre-point curves).
        extent: largest distance between two demanded places, m; 0: no length is demanded.
        derivation: what the solver used on its way to the first candidate, for ``worked``.
        loads: peak torque and reaction of every candidate, where ``with_loads`` has found them.
    """

    task: str
    candidates: tuple[Candidate, ...]
    error_name: str = "none"
    target: NDArray[Any] | None = None
    counts: Mapping[str, int] = field(default_factory=dict)
    notes: tuple[Message, ...] = ()
    curves: Mapping[str, Complexes] = field(default_factory=dict)
    extent: float = 0.0
    derivation: Derivation | None = field(default=None, repr=False)
    loads: tuple[Mapping[str, float], ...] = ()

    def __repr__(self) -> str:
        best = f", the best {self.best!r}" if self.candidates else ""
        return f"Synthesis({self.task}: {len(self)} candidates{best})"

    @property
    def best(self) -> Candidate:
        """The first candidate."""
        return self.candidates[0]

    def __iter__(self) -> Iterator[Candidate]:
        return iter(self.candidates)

    def __len__(self) -> int:
        return len(self.candidates)

    def __getitem__(self, index: int) -> Candidate:
        return self.candidates[index]

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """The table of candidates, the dimensions of each, counts and notes."""
        tell = speaker(language)
        rows = [_row(number, each, self.extent, tell) for number, each in enumerate(self.candidates, 1)]
        below = [counts_text(self, tell)] if self.counts else []
        return (
            Table(title=title_text(self, tell), notes=[ERRORS[self.error_name]]),
            Table(COLUMNS, rows, "><>><<>>>"),
            Table(notes=_dimensions(self, tell)),
            Table(notes=[*below, *self.notes]),
            *self.load_tables(),
        )

    def load_tables(self) -> tuple[Table, ...]:
        """The table of loads, where they have been found."""
        rows: list[list[Cell]] = [
            [number, Amount(each["peak_input_torque"], "torque", 5), Amount(each["peak_reaction"], "force", 5)]
            for number, each in enumerate(self.loads, 1)
        ]
        head = (_("no."), _("peak torque"), pgettext("synthesize", "peak reaction"))
        return (Table(head, rows, ">>>"),) if rows else ()

    def with_loads(self, mass_per_length: float, *, speed: str | float = "60 rpm") -> Synthesis:
        """The same with the loads of every candidate, as :meth:`Candidate.loads` finds them."""
        return replace(self, loads=tuple(each.loads(mass_per_length, speed=speed) for each in self))

    @attached
    def worked(self, language: str = "en") -> WorkedSynthesis:
        """The way to the first candidate as a textbook prints it: given values, equations with their numbers, check,
        and the choice among the candidates."""
        raise NotImplementedError

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        return {
            "task": self.task,
            "error": self.error_name,
            "extent [m]": self.extent,
            "counts": dict(self.counts),
            "notes": [str(note) for note in self.notes],
            "candidates": [
                {**each.data(), **loads} for each, loads in zip(self, self.loads or repeat({}), strict=False)
            ],
        }

    def write(
        self, folder: str | Path, name: str = "", *, speed: str | float = "60 rpm", force: bool = False
    ) -> list[Path]:
        """Every candidate as a model file ``NAME_1.yaml`` … in a folder that exists; gives the paths.

        ``speed``: that of the input link, a text or rad/s.
        Raises LinkwrightError, and writes none, where one cannot be written or is there already unless ``force``.
        """
        stem = name or self.task
        paths = [Path(folder) / f"{stem}_{number + 1}.yaml" for number in range(len(self))]
        for path in paths:
            refuse_target(path, force=force)
        for number, path in enumerate(paths):
            atomic_write(path, self.model_text(number, f"{stem} {number + 1}", speed=speed).encode(), force=force)
        return paths

    def model_text(
        self, index: int = 0, name: str = "", *, language: str = "en", speed: str | float = "60 rpm"
    ) -> str:
        """The model file of one candidate: its purpose in a language, its input's speed a text or rad/s."""
        each = self.candidates[index]
        purpose = _purpose(self, each, language)
        return each.linkage.text(name or f"{self.task} {index + 1}", purpose=purpose, speed=speed)


def title_text(found: Synthesis, tell: Translate) -> str:
    """The task and how many candidates there are."""
    title = (
        _("Synthesis: {task}, {count} candidate") if len(found) == 1 else _("Synthesis: {task}, {count} candidates")
    )
    return tell(title.format(task=display_name(found.task, tell), count=len(found)))


def _dimensions(found: Synthesis, tell: Translate) -> list[str]:
    """A line with the lengths of every candidate, and one with its further numbers."""
    between, lines = tell(_(", ")), []
    for number, each in enumerate(found.candidates, 1):
        lengths = between.join(
            f"{display_name(name, tell)} {length_text(value, 7)}" for name, value in each.linkage.lengths().items()
        )
        lines.append(tell(_("Candidate {number}: {lengths}", number=number, lengths=lengths)))
        if each.values:
            values = between.join(f"{display_name(name, tell)} = {value:.7g}" for name, value in each.values.items())
            lines.append(tell(_("  {values}", values=values)))
    return lines


def counts_text(found: Synthesis, tell: Translate) -> str:
    """How many solutions of which sort were found."""
    counts = (f"{display_name(name, tell)} {value}" for name, value in found.counts.items())
    return tell(_("Found: {counts}", counts=tell(_(", ")).join(counts)))


def _purpose(found: Synthesis, each: Candidate, language: str) -> str:
    """What a candidate is, for its model file."""
    tell = speaker(language)
    defects = (
        tell(_("defects: {defects}", defects=defects_text(each, tell))) if each.defects else tell(_("no defects"))
    )
    return tell(
        _(
            "synthesis of {task}; error {error}, smallest transmission angle {transmission}, {defects}",
            task=display_name(found.task, tell).replace("_", " "),
            error=error_texts(each)[0],
            transmission=f"{degrees(each.transmission_angle):.4g} deg",
            defects=defects,
        )
    )


def defects_text(each: Candidate, tell: Translate) -> str:
    """The defects of a candidate, or that there are none."""
    words = [tell(DEFECTS[name]) for name in each.defects]
    return tell(_(", ")).join(words) or tell(_("none"))


def _row(number: int, each: Candidate, extent: float, tell: Translate) -> list[str]:
    return [
        str(number),
        tell(TYPE_NAMES[each.grashof_type]),
        *error_texts(each),
        defects_text(each, tell),
        tell(pgettext("synthesize", "turns") if each.turns else _("swings")),
        f"{degrees(each.transmission_angle):.2f}°",
        f"{each.link_ratio:.3g}",
        _longest(each.linkage.longest(), extent),
    ]


def _longest(longest: float, extent: float) -> str:
    """The longest distance on a link, and how many times the demand that is."""
    length = length_text(longest, 4)
    return f"{length} ({longest / extent:.3g}×)" if extent else length


def error_texts(each: Candidate) -> tuple[str, str]:
    """Error and worst deviation; zero where both are but rounding of the linkage's size."""
    rounding = ROUNDING * min(1.0, max(each.linkage.lengths().values()))
    exact = each.error <= rounding and each.worst <= rounding
    return ("0", "0") if exact else (f"{each.error:.4g}", f"{each.worst:.4g}")


class SynthesisError(LinkwrightError):
    """A demand that cannot be met: which, how closely it can be, and the ``nearest`` solution."""

    def __init__(self, sentence: Message, nearest: Synthesis | None = None) -> None:
        self.nearest = nearest
        super().__init__(sentence)

    def __reduce__(self) -> tuple[type[SynthesisError], tuple[Message, Synthesis | None]]:
        return SynthesisError, (self.args[0], self.nearest)


#: Longest distance on a link over that of the demand, longest over shortest link: up to these nothing is taken off.
USUAL_SIZE, USUAL_RATIO = 3.0, 10.0


def merit(transmission: ArrayLike, ratio: ArrayLike, longest: ArrayLike, extent: float) -> Floats:
    """The merit of linkages (N,): angles in rad, lengths in m; ``extent`` 0: no length is demanded."""
    size = np.maximum(np.asarray(longest, float) / extent / USUAL_SIZE, 1.0) if extent > 0 else 1.0
    unequal = np.maximum(np.asarray(ratio, float) / USUAL_RATIO, 1.0)
    return np.asarray(np.sin(np.nan_to_num(transmission)) / size / unequal)


def extent_of(points: Complexes) -> float:
    """The largest distance between two of the points, m."""
    return float(np.abs(points[:, None] - points).max())


def ranking(error: Floats, merits: Floats, sound: Flags, size: float) -> Integers:
    """Order of candidates: sound ones first, then by error, then by merit.

    Errors below 1e-9 of ``size`` (the target's own) count as equal; others are compared to about 0.25 %.
    """
    step = np.where(error <= 1e-9 * size, -1e9, np.round(1e3 * np.log10(np.maximum(error, 1e-300))))
    return np.asarray(np.lexsort((-merits, step, ~sound)))


def different(candidates: tuple[Candidate, ...], distance: float) -> tuple[Candidate, ...]:
    """Without candidates like a better one: all points within ``distance`` (m) of its, or within a hundredth of its
    size where no length differs by more than that share. With 0 all stay."""
    distinct: list[Candidate] = []
    for each in candidates:
        if not distance or not any(_same_dimensions(each.linkage, better.linkage, distance) for better in distinct):
            distinct.append(each)
    return tuple(distinct)


def _same_dimensions(a: Linkage, b: Linkage, distance: float) -> bool:
    places, others = (np.array(list(each.points.values())) for each in (a, b))
    if len(places) != len(others):
        return False
    off = float(np.abs(places - others).max())
    if off <= distance:
        return True
    lengths, other_lengths = (list(each.lengths().values()) for each in (a, b))
    same = len(lengths) == len(other_lengths) and np.allclose(lengths, other_lengths, rtol=SAME, atol=0.0)
    return bool(same and off <= SAME * np.abs(others - others[0]).max())


def ranked(candidates: Sequence[Candidate], size: float, extent: float = 0.0) -> tuple[Candidate, ...]:
    """The candidates in the order of :func:`ranking`; ``extent`` as in ``Synthesis``."""
    if not candidates:
        return ()
    error = np.array([each.error for each in candidates])
    sound = np.array([not each.defects for each in candidates])
    return tuple(candidates[i] for i in ranking(error, merits(candidates, extent), sound, size))


def merits(candidates: Sequence[Candidate], extent: float) -> Floats:
    """The merit of every candidate."""
    facts = [(each.transmission_angle, each.link_ratio, each.linkage.longest()) for each in candidates]
    transmission, ratio, longest = np.array(facts).T
    return merit(transmission, ratio, longest, extent)


def require_integers(*, minimum: int = 1, **values: float) -> None:
    """Raises SynthesisError for the first value that is not an integer of ``minimum`` or more."""
    for name, value in values.items():
        real(name, value, finite=False)
        if not (value == value and value >= minimum and float(value).is_integer()):
            raise SynthesisError(
                _(
                    "invalid {name} {value}; expected an integer of {minimum} or more",
                    code="synthesize.not_whole",
                    name=name,
                    value=f"{value:g}",
                    minimum=minimum,
                )
            )


def allowed_transmission(angle: float) -> None:
    """Raises SynthesisError for a smallest transmission angle (rad) outside [0, 90°)."""
    if not 0.0 <= angle < math.pi / 2 - 1e-6:
        raise SynthesisError(
            _(
                "invalid minimum transmission angle {value} deg; expected 0 deg or more, below 90 deg",
                code="synthesize.transmission",
                value=f"{math.degrees(angle):g}",
            )
        )

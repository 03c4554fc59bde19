"""Laws by name, with their parameters; and the laws that fit boundary conditions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from linkwright.core.arguments import require_pair
from linkwright.errors import RequestError, UnknownName
from linkwright.laws.base import END_KINDS, MOTION_LAWS, Ends, MotionLaw
from linkwright.laws.derived_laws import Backwards, Portion, Shifted
from linkwright.registry import no_such
from linkwright.words import _


def motion_law(
    name: str,
    *,
    crossover: float | None = None,
    portion: tuple[float, float] | None = None,
    backwards: bool = False,
    **values: Any,
) -> MotionLaw:
    """A motion law by its name: a rise from 0 to 1 over u from 0 to 1; ``values`` are its own keys.

    ``crossover``: where a symmetric law turns from acceleration to deceleration, by default 1/2; ``portion``: the
    part from u to u, as a law of its own; ``backwards``: its ends change places. Raises RequestError for a name that
    does not exist and values that do not fit.
    """
    if name not in MOTION_LAWS:
        raise UnknownName(no_such(_("motion law"), name, sorted(MOTION_LAWS)))
    kind = MOTION_LAWS[name]
    unknown = sorted(set(values) - set(kind.fields))
    missing = sorted(key for key, each in kind.fields.items() if each.required and key not in values)
    if unknown or missing:
        problem = (
            _("the law {law} has no {names}; it has: {known}", code="laws.unknown_value")
            if unknown
            else _("the law {law} needs {names}; it has: {known}", code="laws.missing_value")
        )
        names, known = ", ".join(unknown or missing), ", ".join(kind.fields) or "–"
        raise RequestError(problem.format(law=name, names=names, known=known))
    return altered(kind(**values), crossover, portion, backwards)


def altered(
    law: MotionLaw, crossover: float | None, portion: tuple[float, float] | None, backwards: bool
) -> MotionLaw:
    """The law with its turning point moved, then cut, then turned around."""
    if crossover is not None and crossover != 0.5:
        law = Shifted(law, crossover)
    if portion is not None:
        require_pair("portion", portion)
        law = Portion(law, *portion)
    return Backwards(law) if backwards else law


@dataclass(frozen=True)
class FittingLaw:
    """A law that fits boundary conditions: its name, and the portion or direction in which it does.

    ``any_ends``: it takes whatever velocities and accelerations the program asks for.
    """

    name: str
    portion: tuple[float, float] | None = None
    backwards: bool = False
    any_ends: bool = False

    @property
    def law(self) -> MotionLaw:
        """The law."""
        return motion_law(self.name, portion=self.portion, backwards=self.backwards)

    def __str__(self) -> str:
        """As written in a file."""
        extra = [f"portion: [{self.portion[0]:g}, {self.portion[1]:g}]"] if self.portion else []
        extra += ["backwards: true"] if self.backwards else []
        return f"{{kind: {self.name}, {', '.join(extra)}}}" if extra else self.name


def laws_for(start: str, end: str) -> tuple[FittingLaw, ...]:
    """The laws from a kind of end to another: ``rest``, ``velocity``, ``turn``, ``motion`` (R, G, U, B in VDI 2143).

    Laws with these ends, halves of laws and laws run backwards with them, and last the laws that meet any ends.
    Raises RequestError.
    """
    for each in (start, end):
        if each not in END_KINDS:
            raise RequestError(
                _(
                    'there is no kind of end called "{kind}"; give one of {known}',
                    code="laws.end_kind",
                    kind=each,
                    known=tuple(END_KINDS),
                )
            )
    own: dict[FittingLaw, None] = {}
    any_ends = []
    for name, kind in MOTION_LAWS.items():
        if kind.meeting(Ends(), 1.0) is not None:
            any_ends.append(FittingLaw(name, any_ends=True))
        elif not any(each.required for each in kind.fields.values()):
            forms = [FittingLaw(name), FittingLaw(name, backwards=True)]
            forms += [FittingLaw(name, half) for half in ((0.0, 0.5), (0.5, 1.0))]
            for form in forms:
                if form.law.ends.kinds == (start, end):
                    own[form] = None
                    break
    return (*own, *any_ends)

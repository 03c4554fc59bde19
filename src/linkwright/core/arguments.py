"""Checks of arguments: what type is needed, what was passed instead, and what to write."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from os import PathLike
from typing import Any, SupportsInt, TypeVar, overload

from linkwright.errors import RequestError
from linkwright.registry import listed
from linkwright.words import _

T = TypeVar("T")
#: Positions over a cycle where nobody says how many: of results, of curves that are drawn, of drawings; points of a
#: cam's profile.
STEPS, CURVE_STEPS, DRAWING_STEPS, PROFILE_POINTS = 360, 720, 120, 720
#: Longest text that a sentence repeats.
LONGEST = 80
#: Functions that make results of a mechanism, and examples of other types.
_SOLVING = {"Motion": "solve_motion", "Forces": "solve_forces"}
_KINDS = {
    "Mechanism": _("a mechanism"),
    "Motion": _("a motion"),
    "Forces": _("the forces of a machine"),
    "SteadyRunning": _("steady running"),
    "Run": _("a run under forces"),
    "Document": _("a document"),
    "str": _("the name of a file"),
    "PathLike": _("its path"),
    "Problem": _("a calculation of machine parts"),
    "Mapping": _("a mapping from names to values"),
    "Linkage": _("a linkage of a synthesis"),
}
_EXAMPLES = {
    "Mechanism": 'lw.load("machine.yaml")',
    "Motion": "lw.solve_motion(mechanism)",
    "Forces": "lw.solve_forces(mechanism)",
    "Linkage": "candidate.linkage",
    "Mapping": '{"crank.length": 0.1}',
}


def require(value: object, *kinds: type) -> None:
    """Raises RequestError, with what to write instead, where a value is of none of the types.

    The kinds are those of ``_KINDS``.
    """
    if isinstance(value, kinds):
        return
    names = [kind.__name__ for kind in kinds]
    *others, last = [_KINDS[name] for name in names]
    needed = _("{others} or {last}", others=tuple(others), last=last) if others else last
    raise RequestError(
        _(
            "{needed} is needed, not {found}; {hint}",
            code="given_instead.needed",
            needed=needed,
            found=describe(value),
            hint=_hint(value, names),
        )
    )


@overload
def one_or_more(value: Iterable[str] | str) -> tuple[str, ...]: ...
@overload
def one_or_more(value: Iterable[T]) -> tuple[T, ...]: ...
def one_or_more(value: Any) -> tuple[Any, ...]:
    """Names as a tuple; a text alone, and what holds none, is one name."""
    return tuple(value) if isinstance(value, Iterable) and not isinstance(value, str) else (value,)


def integer(option: str, value: object, minimum: int | None = None, maximum: int | None = None) -> int:
    """An integer of at least ``minimum`` and at most ``maximum``; raises RequestError for anything else."""
    number = value if isinstance(value, SupportsInt) and not isinstance(value, str) else None
    try:
        found = None if number is None else int(number)
    except (ValueError, OverflowError):
        found = None
    if found is None or found != value or (minimum is not None and found < minimum):
        problem = (
            _("{option} is {value}; give an integer", code="given_instead.no_whole")
            if minimum is None
            else _("{option} is {value}; give an integer of at least {minimum}", code="given_instead.no_whole_from")
        )
        raise RequestError(problem.format(option=option, value=repr(value)[:LONGEST], minimum=minimum))
    if maximum is not None and found > maximum:
        raise RequestError(
            _(
                "{option} is {value}; give at most {maximum}",
                code="given_instead.whole_beyond",
                option=option,
                value=repr(value)[:LONGEST],
                maximum=maximum,
            )
        )
    return found


def real(option: str, value: object, *, finite: bool = True) -> float:
    """A number, by default ``finite``; raises RequestError for anything else."""
    try:
        found = None if isinstance(value, str) else float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        found = None
    if found is None or (finite and not math.isfinite(found)):
        raise RequestError(
            _(
                "{option} is {value}; give a finite number in SI units",
                code="given_instead.no_real",
                option=option,
                value=repr(value)[:LONGEST],
            )
        )
    return found


def positive(option: str, value: object) -> float:
    """A finite number above zero; raises RequestError for anything else."""
    found = real(option, value)
    if found <= 0.0:
        raise RequestError(
            _(
                "{option} is {value}; give a number above zero, in SI units",
                code="given_instead.not_positive",
                option=option,
                value=found,
            )
        )
    return found


def require_pair(option: str, value: object) -> None:
    """Raises RequestError for anything but two numbers."""
    numbers = list(value) if isinstance(value, Iterable) and not isinstance(value, str) else []
    if len(numbers) != 2:
        raise RequestError(
            _(
                "{option} is {value}; give two numbers, as in {option}=(1, 2)",
                code="given_instead.no_pair",
                option=option,
                value=repr(value)[:LONGEST],
            )
        )
    for number in numbers:
        real(option, number)


def one_of(option: str, value: object, known: Sequence[str]) -> None:
    """Raises RequestError, with the nearest, where a word is none of those that are known."""
    if value not in known:
        hint = listed(str(value), known, "one_of")
        raise RequestError(
            _(
                "{option} is {value}; {hint}",
                code="given_instead.no_choice",
                option=option,
                value=repr(value)[:LONGEST],
                hint=hint,
            )
        )


def describe(value: object) -> str:
    """A description of a value for an error message."""
    if isinstance(value, str):
        short = len(value) <= LONGEST and "\n" not in value
        return _('the text "{text}"', text=value) if short else _("a long text")
    if isinstance(value, PathLike):
        return _("the path {path}", path=str(value))
    if value is None or isinstance(value, int | float):
        return repr(value)
    kind = value if isinstance(value, type) else type(value)
    return (_("the class {kind}") if kind is value else _("a value of the type {kind}")).format(kind=kind.__name__)


def _hint(value: object, names: list[str]) -> str:
    """What to write instead."""
    name = type(value).__name__.lower()
    own = next(
        (each.lower() for each in names if hasattr(value, each.lower()) and each not in ("Mechanism", "Run")), None
    )
    code = f"{name}.{own}" if own else _made(value, names)
    if code:
        return _("write {example}", example=code)
    return _("give one, such as {example}", example=_EXAMPLES[names[0]])


def _made(value: object, names: list[str]) -> str:
    """Code that makes what is needed of the value; empty where none is known."""
    if "Mechanism" in names:
        return _mechanism(value)
    function = next((_SOLVING[each] for each in reversed(names) if each in _SOLVING), "")
    name = type(value).__name__
    source = name.lower() if name in ("Mechanism", "Motion") else _mechanism(value)
    return source and function and f"lw.{function}({source})"


def _mechanism(value: object) -> str:
    """Code that makes a mechanism of the value; empty where none is known."""
    if isinstance(value, str | PathLike):
        text = str(value)
        return "lw.loads(text)" if "\n" in text else f'lw.load("{text}")'
    name = type(value).__name__
    if name == "Model":
        return "model.build()"
    own = getattr(value, "mechanism", None)
    return f"{name.lower()}.mechanism{'()' if callable(own) else ''}" if own is not None else ""

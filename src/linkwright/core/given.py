"""Arguments of the library: what is needed, what was given instead, and what to write."""

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
#: Calls that make results of a mechanism, and what is given as an example of other kinds.
_SOLVING = {"Motion": "solve_motion", "Forces": "solve_forces"}
_KINDS = {
    "Mechanism": _("a mechanism"),
    "Motion": _("a motion"),
    "Forces": _("the forces of a machine"),
    "SteadyRunning": _("steady running"),
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


def require(given: object, *kinds: type) -> None:
    """Raises RequestError, with what to write instead, where something is of none of the kinds.

    The kinds are those of ``_KINDS``.
    """
    if isinstance(given, kinds):
        return
    names = [kind.__name__ for kind in kinds]
    *others, last = [_KINDS[name] for name in names]
    needed = _("{others} or {last}", others=tuple(others), last=last) if others else last
    raise RequestError(
        _(
            "{needed} is needed, not {told}; {hint}",
            code="given_instead.needed",
            needed=needed,
            told=told(given),
            hint=_hint(given, names),
        )
    )


@overload
def one_or_more(given: Iterable[str] | str) -> tuple[str, ...]: ...
@overload
def one_or_more(given: Iterable[T]) -> tuple[T, ...]: ...
def one_or_more(given: Any) -> tuple[Any, ...]:
    """Names as a tuple; a text alone, and what holds none, is one name."""
    return tuple(given) if isinstance(given, Iterable) and not isinstance(given, str) else (given,)


def whole(option: str, given: object, least: int | None = None, most: int | None = None) -> int:
    """A whole number, ``least`` or more and at most ``most``; raises RequestError for anything else."""
    number = given if isinstance(given, SupportsInt) and not isinstance(given, str) else None
    try:
        found = None if number is None else int(number)
    except (ValueError, OverflowError):
        found = None
    if found is None or found != given or (least is not None and found < least):
        problem = (
            _("{option} is {given}; give a whole number", code="given_instead.no_whole")
            if least is None
            else _(
                "{option} is {given}; give a whole number, {least} or more",
                code="given_instead.no_whole_from",
            )
        )
        raise RequestError(problem.format(option=option, given=repr(given)[:LONGEST], least=least))
    if most is not None and found > most:
        raise RequestError(
            _(
                "{option} is {given}; give at most {most}",
                code="given_instead.whole_beyond",
                option=option,
                given=repr(given)[:LONGEST],
                most=most,
            )
        )
    return found


def real(option: str, given: object, *, finite: bool = True) -> float:
    """A number, ``finite`` unless told otherwise; raises RequestError for anything else."""
    try:
        found = None if isinstance(given, str) else float(given)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        found = None
    if found is None or (finite and not math.isfinite(found)):
        raise RequestError(
            _(
                "{option} is {given}; give a finite number in SI units",
                code="given_instead.no_real",
                option=option,
                given=repr(given)[:LONGEST],
            )
        )
    return found


def require_pair(option: str, given: object) -> None:
    """Raises RequestError for anything but two numbers."""
    numbers = list(given) if isinstance(given, Iterable) and not isinstance(given, str) else []
    if len(numbers) != 2:
        raise RequestError(
            _(
                "{option} is {given}; give two numbers, as in {option}=(1, 2)",
                code="given_instead.no_pair",
                option=option,
                given=repr(given)[:LONGEST],
            )
        )
    for number in numbers:
        real(option, number)


def one_of(option: str, given: object, known: Sequence[str]) -> None:
    """Raises RequestError, with the nearest, where a word is none of those that are known."""
    if given not in known:
        hint = listed(str(given), known, "one_of")
        raise RequestError(
            _(
                "{option} is {given}; {hint}",
                code="given_instead.no_choice",
                option=option,
                given=repr(given)[:LONGEST],
                hint=hint,
            )
        )


def told(given: object) -> str:
    """What was given, as a sentence names it."""
    if isinstance(given, str):
        short = len(given) <= LONGEST and "\n" not in given
        return _('the text "{text}"', text=given) if short else _("a long text")
    if isinstance(given, PathLike):
        return _("the path {path}", path=str(given))
    if given is None or isinstance(given, int | float):
        return repr(given)
    kind = given if isinstance(given, type) else type(given)
    return (_("the class {kind}") if kind is given else _("a value of the type {kind}")).format(
        kind=kind.__name__
    )


def _hint(given: object, names: list[str]) -> str:
    """What to write instead."""
    name = type(given).__name__.lower()
    own = next((each.lower() for each in names if hasattr(given, each.lower()) and each != "Mechanism"), None)
    code = f"{name}.{own}" if own else _made(given, names)
    if code:
        return _("write {example}", example=code)
    return _("give one, such as {example}", example=_EXAMPLES[names[0]])


def _made(given: object, names: list[str]) -> str:
    """How what was given becomes what is needed; empty where that is not known."""
    if "Mechanism" in names:
        return _mechanism(given)
    function = next((_SOLVING[each] for each in reversed(names) if each in _SOLVING), "")
    name = type(given).__name__
    source = name.lower() if name in ("Mechanism", "Motion") else _mechanism(given)
    return source and function and f"lw.{function}({source})"


def _mechanism(given: object) -> str:
    """How what was given becomes a mechanism; empty where that is not known."""
    if isinstance(given, str | PathLike):
        text = str(given)
        return "lw.loads(text)" if "\n" in text else f'lw.load("{text}")'
    name = type(given).__name__
    if name == "Model":
        return "model.build()"
    own = getattr(given, "mechanism", None)
    return f"{name.lower()}.mechanism{'()' if callable(own) else ''}" if own is not None else ""

"""What was given in place of a mechanism or a result, and how it becomes what is needed."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike

from linkwright.errors import RequestError
from linkwright.words.sentence import Sentence

#: Longest text that a sentence repeats.
LONGEST = 80
#: Calls that make results of a mechanism, and what is given as an example of other kinds.
_SOLVING = {"Motion": "solve_motion", "Forces": "solve_forces"}
_EXAMPLES = {
    "Mechanism": 'lw.load("machine.yaml")',
    "Motion": "lw.solve_motion(mechanism)",
    "Forces": "lw.solve_forces(mechanism)",
    "Linkage": "candidate.linkage",
    "Mapping": '{"crank.length": 0.1}',
}


def require(given: object, *kinds: type) -> None:
    """Raises RequestError, with what to write instead, where something is of none of the kinds.

    The kinds are those that have words under ``given_instead.kind_…``.
    """
    if isinstance(given, kinds):
        return
    names = [kind.__name__ for kind in kinds]
    *others, last = [Sentence(f"given_instead.kind_{name}") for name in names]
    needed = Sentence("given_instead.or", others=tuple(others), last=last) if others else last
    raise RequestError("given_instead.needed", needed=needed, told=told(given), hint=_hint(given, names))


def one_or_more(given: Iterable[str] | str) -> tuple[str, ...]:
    """Names as a tuple; a text alone is one name."""
    return (given,) if isinstance(given, str) else tuple(given)


def told(given: object) -> str:
    """What was given, as a sentence names it."""
    if isinstance(given, str):
        short = len(given) <= LONGEST and "\n" not in given
        return Sentence("given_instead.text", text=given) if short else Sentence("given_instead.long_text")
    if isinstance(given, PathLike):
        return Sentence("given_instead.path", path=str(given))
    if given is None or isinstance(given, int | float):
        return repr(given)
    kind = given if isinstance(given, type) else type(given)
    return Sentence("given_instead.class" if kind is given else "given_instead.object", kind=kind.__name__)


def _hint(given: object, names: list[str]) -> str:
    """What to write instead."""
    name = type(given).__name__.lower()
    own = next((each.lower() for each in names if hasattr(given, each.lower()) and each != "Mechanism"), None)
    code = f"{name}.{own}" if own else _made(given, names)
    if code:
        return Sentence("given_instead.write", code=code)
    return Sentence("given_instead.such_as", code=_EXAMPLES[names[0]])


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

"""Texts of goals, demands and expectations: numbers by name, or expressions of some."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass

from linkwright.analysis.base import METRICS
from linkwright.analysis.by_name import OWN
from linkwright.core.expressions import Expression, parse
from linkwright.designs.criteria import criterion
from linkwright.errors import RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: What is meant for one number, not for an expression.
_WORDS = re.compile(r"[^\W\d][\w.]*( [\w.]+)*")
#: What is meant for an expression, though it may begin as a metric with its subject does.
_FORMULA = re.compile(r"\s[-+*/^]|[-+*/^]\s|[()]")
_NO_NUMBER = _(
    'there is no number "{text}"; name a metric (linkwright metrics), flywheel, a summary '
    'such as "jaw.angle range", a dimension, or an expression of names given by define:',
    code="optimize.no_number",
)


def is_number(name: str, known: Collection[str]) -> bool:
    """Whether a text names a number: one of those that are ``known``, a metric, or a summary."""
    if name in known:
        return True
    if _FORMULA.search(name):
        return False
    try:
        criterion(name)
    except RequestError:
        return False
    return True


def is_one_name(text: str) -> bool:
    """Whether a text is meant for one number, not for an expression."""
    return _WORDS.fullmatch(text) is not None


def expression_of(
    text: str,
    mechanism: Mechanism,
    dimensions: Collection[str],
    *,
    define: Mapping[str, str] | None = None,
    paths: Collection[str] = (),
    names: Collection[str] | None = None,
) -> tuple[Expression | None, dict[str, str]]:
    """An expression with the numbers of its names; None for a number on its own, under no name.

    ``dimensions``: addresses of the mechanism's; ``define``: names for expressions; ``paths``: names of path errors;
    ``names``: what may be in an expression, by default what is defined and the parameters. Raises RequestError for
    what names no number, with the nearest names, and QuantityError for what cannot be read.
    """
    named, known = define or {}, [*dimensions, *paths]
    definition = text if text in paths else str(named.get(text, text))
    if is_number(definition, known):
        return None, {"": definition}
    defined = {name: name if name in paths else str(value) for name, value in named.items()}
    own = [*defined, *mechanism.parameters] if names is None else names
    if is_one_name(definition) and definition not in own:
        criterion(definition)  # raises, and offers the nearest
    found = parse(text, own)
    numbers = {name: defined.get(name, name) for name in found.names}
    for name in numbers.values():
        if not is_number(name, known):
            raise RequestError(_NO_NUMBER.format(text=name))
    if not numbers:
        raise RequestError(_NO_NUMBER.format(text=text))
    return found, numbers


@dataclass(frozen=True)
class NumberNames(Collection[str]):
    """Every name of a number that an expression may hold: dimensions, metrics, and summaries such as
    ``jaw.angle.range``; iterated are the first two."""

    dimensions: Collection[str]

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and is_number(name, self.dimensions)

    def __iter__(self) -> Iterator[str]:
        yield from (*self.dimensions, *OWN, *METRICS)

    def __len__(self) -> int:
        return sum(1 for _unused in self)

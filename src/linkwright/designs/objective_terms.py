"""What an objective is made of: numbers and path errors with their weights, checked."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from linkwright.analysis.by_name import NO_OUTPUTS, NO_TEXT, wanted
from linkwright.core.arguments import real
from linkwright.core.arrays import Floats
from linkwright.cycle.summary import Summary
from linkwright.errors import RequestError
from linkwright.words import _

_BAD_TARGET = _(
    "the target of a path error is a list of points [x, y] in m, and all targets have as many points",
    code="study.objective_target",
)


@dataclass(frozen=True, eq=False)
class PathError:
    """Mean square distance, m², of a point from target points (n, 2), m, position by position.

    ``point``: ``C`` or ``coupler.P``. There are as many positions as targets: over the cycle, or at the inputs that
    the objective is given.
    """

    point: str
    target: ArrayLike


Terms = str | PathError | Mapping[str | PathError, float] | Sequence[str | PathError]


def weighted(terms: Terms) -> dict[str | PathError, float]:
    """The terms with their weights, 1 where none is given; raises RequestError where there is none, or no number."""
    if isinstance(terms, Mapping):
        found = {term: real(f"weights[{term!r}]", weight) for term, weight in terms.items()}
    elif isinstance(terms, Sequence) and not isinstance(terms, str):
        found = dict.fromkeys(terms, 1.0)
    else:
        found = {terms: 1.0}
    if not found:
        raise RequestError(NO_OUTPUTS)
    for term in found:
        if not isinstance(term, str | PathError):
            raise RequestError(NO_TEXT.format(value=repr(term)[:60]))
    return found


def differentiable(asked: str | tuple[str, str]) -> Summary:
    """The summary, or design number, that is asked for; raises RequestError for a place."""
    found = wanted([asked])[0]
    if found.kind in ("argmin", "argmax"):
        raise RequestError(
            _(
                "{name!r} is a place, which has no derivative here; ask for its extreme",
                code="study.place_without_slope",
                name=found.name,
            )
        )
    return found


def number_of_points(terms: Iterable[str | PathError]) -> int | None:
    """How many points the targets of all path errors have, None without any; raises RequestError where they differ or
    are none."""
    targets = [_points(term.target) for term in terms if isinstance(term, PathError)]
    if any(target.ndim != 2 or target.shape[1] != 2 or not len(target) for target in targets):
        raise RequestError(_BAD_TARGET)
    if len({len(target) for target in targets}) > 1:
        raise RequestError(_BAD_TARGET)
    if not all(np.isfinite(target).all() for target in targets):
        raise RequestError(
            _(
                "the target of a path error has points that are not finite; leave them out, and give "
                "the inputs of the others by at",
                code="study.objective_gaps",
            )
        )
    return len(targets[0]) if targets else None


def _points(target: ArrayLike) -> Floats:
    try:
        return np.asarray(target, dtype=float)
    except (TypeError, ValueError):
        raise RequestError(_BAD_TARGET) from None

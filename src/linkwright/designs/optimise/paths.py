"""Path errors as quantities of a problem."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from linkwright.core.arrays import Floats, Indices
from linkwright.designs.objective import Part, of_path
from linkwright.designs.objective_terms import PathError
from linkwright.designs.optimise.path_curvature import path_curvature
from linkwright.formula.summaries import Backend
from linkwright.mechanism.mechanism import Mechanism

#: Designs that one thread takes.
ALONE = 512


def _threads(columns: Mapping[str, Floats]) -> int | None:
    """One where a second one costs more than it takes off."""
    return None if len(next(iter(columns.values()))) > ALONE else 1


def _shared(names: Sequence[str], by: Sequence[str]) -> tuple[Indices, Indices]:
    """Where the names that are in both stand, in the one and in the other."""
    both = [(k, by.index(name)) for k, name in enumerate(names) if name in by]
    own, places = np.array(both, dtype=np.intp).reshape(-1, 2).T
    return own, places


class PathErrors:
    """Values (designs,) of path errors by name, and their exact gradients."""

    def __init__(
        self, mechanism: Mechanism, addresses: tuple[str, ...], asked: Mapping[str, PathError], backend: Backend
    ) -> None:
        self.parts: dict[str, Part] = {
            name: of_path(mechanism, addresses, each, backend) for name, each in asked.items()
        }
        self._bends = {
            name: partial(path_curvature, mechanism, addresses, each.point, len(np.array(each.target)), backend)
            for name, each in asked.items()
        }

    def __contains__(self, name: str) -> bool:
        return name in self.parts

    def values(self, columns: Mapping[str, Floats]) -> dict[str, Floats]:
        """m²; NaN where a design does not pass its cycle."""
        with np.errstate(all="ignore"):
            return {name: part.values(columns, _threads(columns)) for name, part in self.parts.items()}

    def with_slopes(self, name: str, columns: Mapping[str, Floats], by: tuple[str, ...]) -> tuple[Floats, Floats]:
        """Values (designs,) and gradients (designs, k) by the addresses ``by``."""
        part = self.parts[name]
        with np.errstate(all="ignore"):
            values, found = part.many(columns, _threads(columns))
        slope = np.zeros((len(found), len(by)))
        own, places = _shared(part.names, by)
        slope[:, places] = found[:, own]
        return values, slope

    def curvatures(self, name: str, columns: Mapping[str, Floats], by: tuple[str, ...]) -> Floats:
        """Curvatures (designs, k, k) by the addresses ``by``, from the path's slopes; 0 where these have none."""
        bend = self._bends[name]()
        found = np.zeros((len(next(iter(columns.values()))), len(by), len(by)))
        if bend is not None:
            own, places = _shared(bend.names, by)
            with np.errstate(all="ignore"):
                found[:, places[:, None], places] = bend(columns)[:, own[:, None], own]
        return found

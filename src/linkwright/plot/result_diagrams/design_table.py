"""What diagrams of many designs show: what varies, in its units, and what was measured."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright import units
from linkwright.core.arrays import Flags, Floats
from linkwright.core.dataclass import dataclass
from linkwright.designs.ranges import dimension_of
from linkwright.errors import RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.plot.diagrams.axes import Unit, unit_of
from linkwright.registry import offered


@dataclass(frozen=True)
class Column:
    """A dimension that varies, or a metric: ``values`` (designs,) in the unit in which it is shown; ``best``: number
    of the design in which a metric is best."""

    name: str
    values: Floats
    unit: Unit
    best: int | None = None

    @property
    def label(self) -> str:
        """The label of its axis."""
        return self.unit.label(self.name)

    @property
    def steps(self) -> Floats:
        """The different values, rising."""
        return np.unique(self.values)


@dataclass(frozen=True)
class DesignTable:
    """Designs in rows: what varies, the metrics, and which designs pass the cycle; ``grid``: all combinations."""

    title: str
    varied: tuple[Column, ...]
    measures: tuple[Column, ...]
    ok: Flags

    @property
    def moving(self) -> tuple[Column, ...]:
        """The dimensions that have more than one value."""
        return tuple(each for each in self.varied if len(each.steps) > 1)

    @property
    def grid(self) -> bool:
        """Whether the designs are every combination of the values, each once."""
        places = np.column_stack([each.values for each in self.moving])
        return len(np.unique(places, axis=0)) == len(places) == np.prod([len(e.steps) for e in self.moving])


def varied(mechanism: Mechanism, name: str, values: Floats, written: str = "") -> Column:
    """A dimension in the unit that the user wrote, else in the usual one of its kind."""
    unit = _unit(mechanism, name, written)
    return Column(name, np.asarray(values * unit.factor), unit)


def measure(name: str, values: Floats, dimension: str, best: int | None = None) -> Column:
    """A metric in the unit for its size."""
    unit = unit_of(dimension, [values])
    return Column(name, np.asarray(values * unit.factor), unit, best)


def chosen(asked: tuple[str, ...], known: Mapping[str, object]) -> list[str]:
    """The metrics that are asked for, all by default; raises LinkwrightError for one that is not there."""
    for name in asked:
        if name not in known:
            raise RequestError("picture.no_metric", name=name, hint=offered(name, known))
    return list(asked or known)


def _unit(mechanism: Mechanism, name: str, written: str) -> Unit:
    if written:
        return Unit("°" if written == "deg" else written, 1.0 / units.unit(written)[0])
    found = dimension_of(mechanism, name)
    if found == units.DIMENSIONS["length"]:
        return unit_of("length")
    if found == units.DIMENSIONS["angle"]:
        return unit_of("angle")
    return Unit("SI" if found is None else units.si_symbol(found), 1.0)

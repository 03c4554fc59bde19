"""How large a load is over the cycle: a number, an expression, a ramp or a table, within its phase."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.core.expressions import Expression
from linkwright.engine.late import numpy as np
from linkwright.errors import LinkwrightError, with_remedy
from linkwright.loads.formulas import calculated
from linkwright.loads.phases import activity
from linkwright.loads.signals import Array, Mask, Signals, column
from linkwright.loads.tables import interpolated
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.loads.base import Load


def is_constant(load: Load) -> bool:
    """Whether the magnitude of a load is one number at all positions, which the traced formula can hold."""
    from linkwright.loads.base import Load as Base

    if type(load).from_cycle is not Base.from_cycle:
        return False
    return getattr(load, "phase", None) is None and isinstance(getattr(load, "magnitude", None), float)


def evaluate(load: Load, signals: Signals) -> Array:
    """Magnitude of a load at every position, (n,), in SI; zero outside its phase.

    A load with a phase but without any magnitude (a force by its components) gives 1 within the phase.

    Raises:
        LinkwrightError: an expression that has no finite value, a table that does not cover the positions, or
            a phase whose limit positions do not exist; the sentence names the load.
    """
    try:
        found = load.from_cycle(signals)
        return _evaluated(load, signals) if found is None else found
    except LinkwrightError as error:
        raise LinkwrightError(Sentence("loads.of_load", name=load.name, cause=error)) from None


def _evaluated(load: Load, signals: Signals) -> Array:
    ramp: tuple[float, float] | None = getattr(load, "ramp", None)
    active = activity(getattr(load, "phase", None), signals, ramp=ramp is not None)
    where = active.where & signals.ok
    if ramp is None:
        return np.where(where, _values(load, signals, where), 0.0)
    if active.share is None:
        raise LinkwrightError(with_remedy(Sentence("loads.ramp_without_phase"), Sentence("loads.add_phase")))
    return np.where(where, ramp[0] + (ramp[1] - ramp[0]) * active.share, 0.0)


def _values(load: Load, signals: Signals, where: Mask) -> Array:
    magnitude = getattr(load, "magnitude", None)
    table = getattr(load, "table", None)
    if isinstance(magnitude, Expression):
        return calculated(magnitude, signals, where)
    if table is not None:
        return interpolated(table, signals, where)
    return column(1.0 if magnitude is None else magnitude, len(signals.time))

"""The limits between which a driver rocks: its range, a margin left at both ends."""

from __future__ import annotations

from linkwright.drivers.base import Driver
from linkwright.drivers.rocking import Rocking
from linkwright.kinematics.input_range import InputRange, input_range
from linkwright.kinematics.positions import CycleError
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _


def drawn_range(machine: Mechanism) -> InputRange:
    """The range of the only driver, of constant speed, from where the drawing has it; from the start of its law where
    the file gives one, or nothing is drawn."""
    (driver,) = machine.drivers.values()
    drawn = None if driver.law.own.at(0.0) else Drawing(machine).driver(driver.name)
    return input_range(machine if drawn is None else _from(machine, driver, drawn))


def _from(machine: Mechanism, driver: Driver, start: float) -> Mechanism:
    return machine.with_dimensions({f"{driver.name}.start": start})


def limits(law: Rocking) -> tuple[float, float] | None:
    """Between which coordinates a driver rocks (rad or m), margins left; None where it turns fully.

    Raises:
        CycleError: the driver finds no limit in one direction.
        LinkwrightError: as :func:`input_range`.
    """
    (driver,) = law.machine.drivers.values()
    if driver.cylinder is not None and driver.cylinder.stroke is not None:
        return _within_stroke(law, driver.cylinder.stroke)
    found = drawn_range(law.machine)
    if found.full and found.rotary:
        return None
    if found.start is None or found.end is None:
        raise CycleError(
            _(
                "driver {name!r} finds no limit to rock to ({range}); give two coordinates, as in "
                "cycle: {{rock: [{low}, {high}]}}",
                code="motion.no_limit",
                name=found.driver,
                range=found.explain(),
                low="-30 deg" if found.rotary else "0 mm",
                high="30 deg" if found.rotary else "50 mm",
            )
        )
    free = law.rock.share * (found.end - found.start)
    return found.start + free, found.end - free


def _within_stroke(law: Rocking, stroke: tuple[float, float]) -> tuple[float, float]:
    """The full stroke of a cylinder, as far as the machine lets it move, with a margin at limits of the machine."""
    found = drawn_range(law.machine)
    low, high = stroke
    start = low if found.start is None else found.start
    end = high if found.end is None else found.end
    free = law.rock.share * (end - start)
    return max(low, start + free), min(high, end - free)

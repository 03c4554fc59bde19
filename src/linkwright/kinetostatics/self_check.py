"""The check that every analysis of forces makes of its own numbers before it gives them away."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NoReturn

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output, kind_of
from linkwright.core.quantity import shown
from linkwright.errors import SelfCheckError
from linkwright.kinematics.reach_messages import input_at
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion, Rows
    from linkwright.kinematics.trace import MotionOutputs
    from linkwright.kinetostatics.trace import ForceOutputs

#: What a balance may be off, as share of the largest force of the machine at that position, and a power, as share of
#: that force times the largest speed. Rounding leaves some 1e-15 of them, near singular positions as well, where the
#: forces grow with it.
LIMIT = 1e-9
#: A share that is below the limit whatever the machine's size.
PLAINLY = 1e-3 * LIMIT


_AWAY = _(
    "Next to a singular position the numbers may have no digits left: ask for positions "
    "away from it. Elsewhere this is an error of the program, and no result may be used: "
    "please report it with the model file"
)


@dataclass(frozen=True)
class ForceChecks:
    """Which rows of forces and of their motion are checked, and what they are measured by.

    ``size``: what turns moments into forces, m.
    """

    forces: ForceOutputs
    motion: MotionOutputs
    size: float

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Forces, what no joint supplies, and the two powers: rows that lie behind each other."""
        return (*self.forces.standard, *self.forces.checks)

    @cached_property
    def _measures(self) -> Floats:
        """Factors (rows, 1) that make a force of each row but those of the powers."""
        turning = (self._turning(Output.of_row(name)) for name in self.names[:-2])
        return np.array([[1.0 / self.size if each else 1.0] for each in turning]).reshape(-1, 1)

    def _turning(self, output: Output) -> bool:
        """Whether a row is a moment."""
        if output.kind in ("reaction", "couple"):
            return output.kind == "couple"
        joints, drivers = self.forces.mechanism.joints, self.forces.mechanism.drivers
        joint = drivers[output.owner].joint if output.kind == "effort" else output.owner
        return joints[joint].coordinate == "turn"

    @cached_property
    def _speeds(self) -> tuple[tuple[str, ...], Floats]:
        """Rows of the motion that are speeds, and the factors (rows, 1) that make them m/s."""
        names = tuple(name for name in self.motion.standard if kind_of(name) in ("velocity", "angular_velocity"))
        turning = (kind_of(name) == "angular_velocity" for name in names)
        return names, np.array([[self.size if each else 1.0] for each in turning]).reshape(-1, 1)

    def require(self, rows: Rows, motion: Motion) -> None:
        """Raises SelfCheckError at the position where a check is off most, if one is by more than rounding."""
        forces, left, (driving, needed) = self._parts(rows)
        with np.errstate(all="ignore"):
            difference = np.abs(driving - needed)
            balanced = _squares(left) <= PLAINLY**2 * _squares(forces)
            if balanced.all() and (difference <= LIMIT * np.abs(needed)).all():
                return
            largest = self._largest(forces)
            left = np.abs(left) * self._measures[len(forces) :]
            if (left > LIMIT * largest).any():
                self._unbalanced(left, largest, motion)
            names, factors = self._speeds
            speed = (np.abs(motion.rows.fetch(names, motion.evaluate)) * factors).max(axis=0, initial=0.0)
            if (difference > LIMIT * largest * speed).any():
                _differ(
                    _(
                        "the forces of {name!r} do not pass their own check at {where}: the power of the "
                        "drivers and that of all other forces differ by {gap}, compared with the {size} that forces "
                        "and speeds of this size make. {check_failed}",
                        code="forces.powers_differ",
                    ),
                    "W",
                    difference,
                    largest * speed,
                    motion,
                )

    def require_balance(self, gap: Floats, rows: Rows, motion: Motion, applied: Floats | float = 0.0) -> None:
        """Raises SelfCheckError where the gap of the links' balance, (n,) N, is more than rounding; ``applied``: the
        largest of the loads, (n,) N, where no driver has to supply what they need."""
        largest = np.maximum(self._largest(self._parts(rows)[0]), applied)
        with np.errstate(all="ignore"):
            if (gap > LIMIT * largest).any():
                _differ(
                    _(
                        "the forces of {name!r} do not pass their own check at {where}: forces, loads and "
                        "inertia put together leave a link out of balance by {gap}, compared with forces of up to "
                        "{size}. {check_failed}",
                        code="forces.results_unbalanced",
                    ),
                    "N",
                    gap,
                    largest,
                    motion,
                )

    def _parts(self, rows: Rows) -> tuple[Floats, Floats, Floats]:
        """The rows of forces, of what no joint supplies, and of the two powers."""
        first, count = rows.index[self.names[0]], len(self.forces.standard)
        block = rows.values[first : first + len(self.names)]
        return block[:count], block[count:-2], block[-2:]

    def _largest(self, forces: Floats) -> Floats:
        """The largest force of every position, (n,) N."""
        return np.asarray((np.abs(forces) * self._measures[: len(forces)]).max(axis=0, initial=0.0))

    def _unbalanced(self, left: Floats, largest: Floats, motion: Motion) -> NoReturn:
        row, place = _worst(left, largest)
        at = Output.of_row(self.forces.checks[row])
        raise SelfCheckError(
            _(
                "the forces of {name!r} do not pass their own check at {where}: link {link!r} is out "
                "of balance at joint {joint!r} by {gap}, compared with forces of up to {size}. "
                "{check_failed}",
                code="forces.unbalanced",
                name=motion.mechanism.name,
                where=input_at(motion, place),
                joint=at.owner,
                link=at.on,
                gap=shown(left[row, place], "force", 3),
                size=shown(largest[place], "force", 3),
                check_failed=_AWAY,
            )
        )


def _differ(problem: Message, unit: str, gaps: Floats, sizes: Floats, motion: Motion) -> NoReturn:
    _unused, place = _worst(gaps[None], sizes)
    raise SelfCheckError(
        problem.format(
            name=motion.mechanism.name,
            where=input_at(motion, place),
            gap=f"{gaps[place]:.3g} {unit}",
            size=f"{sizes[place]:.3g} {unit}",
            check_failed=_AWAY,
        )
    )


def _squares(rows: Floats) -> Floats:
    """Sum of the squares of rows (rows, n), (n,)."""
    return np.asarray(np.einsum("ij,ij->j", rows, rows))


def _worst(gaps: Floats, sizes: Floats) -> tuple[int, int]:
    """Row and position of the gap (rows, n) that is the largest share of the sizes (n,)."""
    shares = np.where(gaps > LIMIT * sizes, gaps / np.maximum(sizes, np.finfo(float).tiny), 0.0)
    row, place = np.unravel_index(int(shares.argmax()), shares.shape)
    return int(row), int(place)

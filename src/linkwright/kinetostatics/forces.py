"""The result of a force analysis, and names of joint forces by number: F₁₂ is what link 1 exerts on link 2."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.attached import PlotMixin, attached
from linkwright.core.data import locked
from linkwright.core.outputs import kind_of, row_name, row_names
from linkwright.errors import RequestError
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar
from linkwright.kinematics.motion import Motion, Rows
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import no_such
from linkwright.words import _

if TYPE_CHECKING:
    import pandas


#: Share of the largest joint force below which another one is rounding.
ROUNDING = 1e-12


@dataclass(frozen=True)
class LoadForce:
    """What a load did: resultant ``force`` (n, 2) N on moving links, ``moment`` (n,) N·m about the frame's origin,
    ``place`` (n, 2) m where its first force acts, ``magnitude`` (n,) N of the resultant."""

    name: str
    force: Floats
    moment: Floats
    place: Floats

    @property
    def magnitude(self) -> Floats:
        """Size of the resultant, (n,) N."""
        return np.hypot(self.force[:, 0], self.force[:, 1])


@dataclass(eq=False)
class Forces(PlotMixin):
    """Joint reactions and driver efforts at every position of a motion.

    Arrays have the position first; NaN where the motion was not solved. The driver effort is found from the
    joint forces and, independently, from the powers of all forces; ``power_residual`` is the difference.
    """

    motion: Motion
    solver: ForceSolver
    fields: Mapping[str, Floats]
    static: bool
    rows: Rows
    notes: tuple[str, ...] = ()

    @property
    def mechanism(self) -> Mechanism:
        """What was solved."""
        return self.motion.mechanism

    @property
    def steps(self) -> int:
        """Number of positions n."""
        return self.motion.steps

    @cached_property
    def roundings(self) -> Floats:
        """Sizes (n,), N, below which a joint force is a rounding error of the largest of the machine there."""
        rows = self.rows
        found = rows.values[[place for name, place in rows.index.items() if kind_of(name) == "reaction"]]
        return np.asarray(ROUNDING * np.where(np.isfinite(found), np.abs(found), 0.0).max(axis=0, initial=0.0))

    @cached_property
    def rounding(self) -> float:
        """The largest of them."""
        return float(self.roundings.max(initial=0.0))

    def in_order(self) -> Forces:
        """The forces of ``motion.in_order()``."""
        order = self.motion.order
        if order is None:
            return self
        fields = {name: row[order] for name, row in self.fields.items()}
        rows = self.rows.taken(order)
        return Forces(self.motion.in_order(), self.solver, fields, self.static, rows, self.notes)

    def reaction(self, joint: str, *, on: str | None = None, axes: str = "frame") -> Floats:
        """Force (n, 2), N, that a joint exerts on link ``on``, in frame axes or in the axes of a link.

        For a pin of several links it is the link's own share; for a guide what presses its parts together, without
        its friction, μ times that along the guide. ``on`` may be left out where the joint joins the
        frame with one other link. Raises LinkwrightError for unknown names.
        """
        link = self._link_at(joint, on)
        force = self._reaction(joint, link)
        if axes == "frame":
            return force
        e = self.motion.link(axes if axes in self.mechanism.links else self._unknown_link(axes)).direction
        return locked(np.stack([(e * force).sum(axis=1), e[:, 0] * force[:, 1] - e[:, 1] * force[:, 0]], axis=1))

    def direction(self, joint: str, *, on: str | None = None) -> Floats:
        """Direction (n,), rad from the x axis of the frame, of the force that a joint exerts on link ``on``.

        Above -π up to π; NaN where there is no force but for rounding. Raises as :meth:`reaction`.
        """
        force = self.reaction(joint, on=on)
        known = np.where(np.abs(force) > self.roundings[:, None], force, 0.0 * force)
        x, y = known.T + 0.0
        return locked(np.where((x == 0.0) & (y == 0.0), np.nan, np.arctan2(y, x)))

    def couple(self, joint: str, *, on: str | None = None) -> Floats:
        """Couple (n,), N·m, that a guide (about the block's point) or a weld exerts on a link; zero for a pin."""
        link = self._link_at(joint, on)
        first = self.mechanism.joints[joint].joined[0]
        if not self.mechanism.joints[joint].couples:
            return np.zeros(self.steps)
        other = self.mechanism.joints[joint].joined[1]
        row = self.rows.row(row_name("couple", joint, on=other), self.evaluate)
        return locked(-row) if link == first else row

    def resultant_offset(self, joint: str) -> Floats:
        """Where along the guide the resultant acts, (n,) m from the block's point, positive along the guide."""
        joined = self.mechanism.joints[joint].joined
        n = self.guide_direction(joint)
        force = self._reaction(joint, joined[1])
        normal = n[:, 0] * force[:, 1] - n[:, 1] * force[:, 0]
        with np.errstate(all="ignore"):
            return locked(self.couple(joint, on=joined[1]) / normal)

    def driver_effort(self, name: str) -> Floats:
        """Torque (N·m) or force (N) that a driver must supply, (n,), positive along its coordinate."""
        drivers = self.motion.design.base.drivers
        if name not in drivers:
            raise RequestError(no_such(_("driver"), name, drivers))
        return self.rows.row(row_name("effort", name), self.evaluate)

    @property
    def input_torque(self) -> Floats:
        """Effort of the first driver, (n,): N·m for a turning driver, N for a sliding one."""
        return self.driver_effort(self._first_driver())

    @cached_property
    def input_torque_from_power(self) -> Floats:
        """The same from the powers of all forces, (n,); for one driver; NaN where it is at rest."""
        if len(self.mechanism.drivers) != 1:
            raise RequestError(
                _("with several drivers the powers give one sum, not the effort of one driver", code="forces.one_sum")
            )
        rate = self.motion.positions.coordinates[self._first_driver()][1]
        with np.errstate(all="ignore"):
            return locked(np.where(rate == 0.0, np.nan, self.power / rate))

    @cached_property
    def power(self) -> Floats:
        """Power that the drivers must supply, from the powers of all forces, (n,) W."""
        return self.rows.row(row_name("power_of_forces"), self.evaluate)

    @property
    def friction_power(self) -> Floats:
        """Power that the friction of joints takes, (n,) W, not negative."""
        return locked(self.rows.row(row_name("friction_power"), self.evaluate))

    @cached_property
    def power_residual(self) -> Floats:
        """Power of the driver efforts minus the power of all forces, (n,) W: zero but for rounding."""
        if not self.mechanism.drivers:
            return np.zeros(self.steps)
        return locked(self.rows.row(row_name("power"), self.evaluate) - self.power)

    @cached_property
    @attached
    def balance_residual(self) -> Floats:
        """Largest gap in the balance of any link, (n,) N, put together from the results; see ``link_balance``."""
        raise NotImplementedError

    @cached_property
    def shaking_force(self) -> Floats:
        """Resultant of the inertia forces on the frame, (n, 2) N."""
        return locked(np.stack(self.fetch(row_names("shaking_force")), axis=1))

    @cached_property
    def shaking_moment(self) -> Floats:
        """Its moment about the frame's origin, (n,) N·m."""
        return self.rows.row(row_name("shaking_moment"), self.evaluate)

    def load(self, name: str) -> LoadForce:
        """What one of the file's loads did."""
        if name not in self.mechanism.loads:
            raise RequestError(no_such(_("load"), name, self.mechanism.loads))
        names = (*row_names("load", name), row_name("load_moment", name), *row_names("load_place", name))
        fx, fy, moment, px, py = self.fetch(names)
        return LoadForce(name, locked(np.stack([fx, fy], axis=1)), moment, locked(np.stack([px, py], axis=1)))

    @attached
    def columns(self) -> dict[str, Floats]:
        """All results as named columns (n,), names with units."""
        raise NotImplementedError

    @attached
    def to_dataframe(self) -> pandas.DataFrame:
        """All results as a table over the first driver's coordinate, its index; needs pandas."""
        raise NotImplementedError

    def _reaction(self, joint: str, link: str) -> Floats:
        links = self.motion.design.base.joints[joint].joined
        if link != links[0]:
            return self.rows.pair(row_name("reaction", joint, on=link), self.evaluate)
        total = np.zeros((self.steps, 2))
        for other in links[1:]:
            total -= self._reaction(joint, other)
        return total

    def _link_at(self, joint: str, on: str | None) -> str:
        joints = self.motion.design.base.joints
        if joint not in joints:
            raise RequestError(no_such(_("joint"), joint, joints))
        links = joints[joint].joined
        if on is None:
            others = [link for link in links if link != "frame"]
            if len(others) != 1:
                raise RequestError(
                    _(
                        "joint {joint!r} joins {links}; say on which link: on={first!r}",
                        code="forces.say_link",
                        joint=joint,
                        links=tuple(links),
                        first=others[0],
                    )
                )
            return others[0]
        if on not in links:
            raise RequestError(
                _(
                    "joint {joint!r} does not touch link {link!r}; it joins {links}",
                    code="forces.not_touching",
                    joint=joint,
                    link=on,
                    links=tuple(links),
                )
            )
        return on

    def guide_direction(self, joint: str) -> Floats:
        """Unit vector along a guide, (n, 2)."""
        guide = self.mechanism.guides[joint]
        angle = guide.direction
        e = self.motion.link(guide.guide).direction
        c, s = np.cos(angle), np.sin(angle)
        return np.stack([c * e[:, 0] - s * e[:, 1], s * e[:, 0] + c * e[:, 1]], axis=1)

    def _unknown_link(self, name: str) -> str:
        self.mechanism.link(name)
        return name

    def _first_driver(self) -> str:
        drivers = self.motion.design.base.drivers
        if not drivers:
            raise RequestError(
                _(
                    "{name!r} has no driver, so it has no input torque",
                    code="forces.no_driver",
                    name=self.mechanism.name,
                )
            )
        return next(iter(drivers))

    def fetch(self, names: tuple[str, ...]) -> list[Floats]:
        """Outputs by name, (n,) each."""
        return self.rows.fetch(names, self.evaluate)

    def evaluate(self, names: tuple[str, ...]) -> Floats:
        """Outputs of the program by name, (names, n); NaN where the position is not solved."""
        values = self.solver.evaluate(names, self.motion, self.fields)
        if not self.motion.ok.all():
            values[:, ~self.motion.ok] = np.nan
        return values

    def evaluate_traced(self, outputs: Callable[[ForceSolver], dict[str, Scalar]]) -> Floats:
        """Values of the trace of motion and forces, by any names, at all positions, (outputs, n); ``outputs`` names
        those of a solver, of which a run through dead points has several."""
        motion = self.motion
        program = NumpyProgram(Program.of(motion.solver.motion.trace, outputs(self.solver)))
        inner = program.program
        parameters = [motion.design.parameters[name] for name in inner.parameters]
        arrays, fields = {**motion.positions.arrays, **motion.modes}, {**motion.states, **self.fields}
        return np.asarray(program.run(parameters, arrays, fields, length=motion.steps))

    @attached
    def _repr_svg_(self) -> str | None:
        """The drawing, as notebooks show it; None where it cannot be put together."""
        raise NotImplementedError

    def __repr__(self) -> str:
        joints = ", ".join(self.mechanism.joints)
        kind = "static" if self.static else "kinetostatic"
        return f"Forces({self.mechanism.name!r}: {kind}, {self.steps} positions; joints {joints})"


#: A letter and its index.
Symbol = tuple[str, str]


def link_numbers(mechanism: Mechanism) -> Mapping[str, int]:
    """The frame is 0, the moving links count from 1 in the order of the model."""
    return {name: number for number, name in enumerate(("frame", *mechanism.links))}


def reaction_pairs(mechanism: Mechanism) -> list[tuple[str, str]]:
    """Joint and link of every joint force that is not merely the reverse of another one."""
    found: list[tuple[str, str]] = []
    for name, joint in mechanism.joints.items():
        links = [link for link in joint.joined if link != "frame"]
        found += [(name, link) for link in (links if len(joint.joined) > 2 else links[-1:])]
    return found


def chosen_pairs(mechanism: Mechanism, names: Sequence[str]) -> list[tuple[str, str]]:
    """The pairs of the joints that are named, else all; raises RequestError for a joint without any."""
    pairs = reaction_pairs(mechanism)
    known = list(dict.fromkeys(joint for joint, _unused in pairs))
    for name in names:
        if name not in known:
            raise RequestError(no_such(_("joint"), name, known))
    return [pair for pair in pairs if pair[0] in names] if names else pairs


def reaction_index(mechanism: Mechanism, joint: str, on: str) -> str:
    """The index of a joint force: 12 from link 1 on link 2; B,3 from a pin of several links on link 3.

    Where two links meet in several joints the joint's name follows the numbers: 01,guide.
    """
    numbers = link_numbers(mechanism)
    joined = mechanism.joints[joint].joined
    if len(joined) > 2:
        return f"{joint},{numbers[on]}"
    other = joined[0] if on == joined[1] else joined[1]
    comma = "," if len(numbers) > 10 else ""
    shared = [name for name, each in mechanism.joints.items() if set(each.joined) == set(joined)]
    return f"{numbers[other]}{comma}{numbers[on]}" + (f",{joint}" if len(shared) > 1 else "")


def rubbing_guides(mechanism: Mechanism) -> list[str]:
    """Guides with friction, whose joint force is only what presses their parts together."""
    joints = mechanism.joints.items()
    return [name for name, joint in joints if joint.coordinate == "slide" and joint.friction_arm]

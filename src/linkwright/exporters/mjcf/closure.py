"""How exact the loops of an exported MuJoCo model are: the gaps that couplings leave, and those found by MuJoCo."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.core.arguments import STEPS
from linkwright.core.table import Amount, Cell, Table, Tabular
from linkwright.elements import Connection
from linkwright.exporters.mjcf.bodies import Chains
from linkwright.exporters.mjcf.document import mjcf_content
from linkwright.exporters.mjcf.loops import CLOSURE, Loop, closed_loops, cut_name
from linkwright.exporters.mjcf.simulation import MujocoCycle, Worst, one_cycle
from linkwright.exporters.results import Results
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Digits of gaps.
DIGITS = 2


@dataclass(frozen=True)
class ClosedJoint:
    """A joint at which a loop is cut, and what closes it in a MuJoCo model.

    ``name``: that of its element in the file, JOINT.LINK. ``closed_by``: ``joint`` with the ``degree`` of its
    polynomials, where the loop is coupled; else ``connect``, ``weld`` or, of wheels and racks, ``joint`` (degree 1)
    or ``tendon``. ``coupling_gap``: by how much couplings leave it open, m, largest over the motion; None without.
    ``simulated``: the same as MuJoCo finds it; None where nothing was simulated.
    """

    name: str
    links: tuple[str, str]
    closed_by: str
    degree: int | None
    coupling_gap: float | None
    simulated: Worst | None


@dataclass(frozen=True)
class MujocoLoops(Tabular):
    """The loops of a machine's MuJoCo model; ``cycle``: what a simulation found, None without one."""

    name: str
    joints: tuple[ClosedJoint, ...]
    rotary: bool
    cycle: MujocoCycle | None = None

    @property
    def coupling_gap(self) -> float:
        """The largest gap that couplings leave, m; 0 without couplings."""
        return max((each.coupling_gap or 0.0 for each in self.joints), default=0.0)

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """A row per cut joint, and below what a simulation found."""
        title = _("Loops of {name!r} in MuJoCo", name=self.name)
        if not self.joints:
            return (Table(title=title, notes=[_("No joint is cut: all links hang in open chains.")]),)
        head: list[str] = [_("joint"), _("links"), _("closed by"), _("gap of couplings")]
        rows = [self._row(each) for each in self.joints]
        if self.cycle is not None:
            head += [_("gap in MuJoCo"), _("at input")]
        return (Table(head, rows, "<<<>>>", title, self._notes()),)

    def data(self) -> Mapping[str, Any]:
        """Plain data, SI."""
        return {
            "loops": [
                {
                    "name": each.name,
                    "links": list(each.links),
                    "closed_by": each.closed_by,
                    "degree": each.degree,
                    "coupling_gap": each.coupling_gap,
                    "simulated_gap": each.simulated and each.simulated.distance,
                    "at_input": each.simulated and each.simulated.at,
                }
                for each in self.joints
            ],
            "cycle": self.cycle
            and {
                "steps": self.cycle.steps,
                "timestep": self.cycle.timestep,
                "gap": self.cycle.gap.distance,
                "distance": self.cycle.off.distance,
                "point": self.cycle.off.name,
                "at_input": self.cycle.off.at,
            },
        }

    def _row(self, each: ClosedJoint) -> list[Cell]:
        closed = each.closed_by if each.degree is None else _("joint, degree {degree}", degree=each.degree)
        row: list[Cell] = [each.name, " – ".join(each.links), closed, _length(each.coupling_gap)]
        if each.simulated is not None:
            row += [_length(each.simulated.distance), self._input(each.simulated.at)]
        return row

    def _notes(self) -> list[str]:
        if self.cycle is None:
            if all(each.coupling_gap is not None for each in self.joints):
                return []
            return [
                _("`connect` and `weld` are soft: their gaps come from the simulation, and grow with its time step.")
            ]
        off = self.cycle.off
        return [
            _(
                "One cycle of {steps} steps of {timestep} in MuJoCo: largest gap {gap}, all points within {distance} "
                "of the exact ones ({point} at input {at}).",
                steps=self.cycle.steps,
                timestep=Amount(self.cycle.timestep, "time", 4).text,
                gap=Amount(self.cycle.gap.distance, "length", DIGITS).text,
                distance=Amount(off.distance, "length", DIGITS).text,
                point=off.name,
                at=self._input(off.at).text,
            )
        ]

    def _input(self, value: float) -> Amount:
        return Amount(value, "angle" if self.rotary else "length", 4)


def mujoco_loops(
    result: Mechanism | Motion | Forces,
    *,
    loops: str = "auto",
    closure: float = CLOSURE,
    timestep: float | None = None,
    simulate: bool = False,
    steps: int = STEPS,
) -> MujocoLoops:
    """How the loops of a machine's MuJoCo model are closed, and how far they open.

    Args:
        result: a mechanism, which is solved over ``steps`` positions of its cycle, or a motion or forces.
        loops: ``auto`` couples the joints of a loop to the input, by polynomials of at most fourth degree, where that
            leaves gaps of at most ``closure``, and else holds its cut joint by a stiff constraint; ``joint`` demands
            couplings; ``connect`` takes none.
        closure: largest gap that couplings may leave, m.
        timestep: of the simulation, s; default a 20 000th of the cycle.
        simulate: run one cycle in MuJoCo, which must be installed, and compare all points with the motion.
        steps: positions over the cycle, for a mechanism.

    Returns:
        The cut joints with their gaps, m: those of couplings over the positions of the motion, found without MuJoCo.

    Raises:
        LinkwrightError: ``joint`` where no polynomial is exact enough; a simulation of what nothing drives, of a
            motion that is not complete, or without MuJoCo.

    Example:
        >>> import linkwright as lw
        >>> found = lw.mujoco_loops(lw.load("gallery:parallelogram"))
        >>> [(each.name, each.closed_by, each.degree) for each in found.joints]
        [('B.rocker', 'joint', 1)]
        >>> found.coupling_gap < 1e-12
        True
    """
    results = Results.of(result, steps)
    return loops_of(results, loops=loops, closure=closure, timestep=timestep, simulate=simulate)


def loops_of(
    results: Results,
    *,
    loops: str = "auto",
    closure: float = CLOSURE,
    timestep: float | None = None,
    simulate: bool = False,
) -> MujocoLoops:
    """The same of results that are solved."""
    chains = Chains(results.motion, results.first_ok())
    closed = closed_loops(chains, loops, closure)
    cycle = None
    if simulate:
        cycle = one_cycle(mjcf_content(results, timestep=timestep, loops=loops, closure=closure), chains)
    joints = tuple(_joint(chains, loop, cut, cycle) for loop in closed for cut in loop.cuts)
    rotary = next(iter(results.motion.positions.rotary.values()), True)
    return MujocoLoops(results.mechanism.name, joints, rotary, cycle)


def _joint(chains: Chains, loop: Loop, cut: Connection, cycle: MujocoCycle | None) -> ClosedJoint:
    """One cut joint of a loop."""
    name, degree = cut_name(cut), None
    if loop.couplings or (cut.higher and len(chains.factors(cut)) == 2):
        closed_by, degree = "joint", loop.degree or 1
    else:
        closed_by = "connect" if cut.turns else "tendon" if cut.higher else "weld"
    coupling_gap = loop.gaps[name] if loop.gaps else 0.0 if cut.higher else None
    simulated = None if cycle is None else cycle.gaps[name]
    return ClosedJoint(name, (cut.a, cut.b), closed_by, degree, coupling_gap, simulated)


def _length(metres: float | None) -> Cell:
    return None if metres is None else Amount(metres, "length", DIGITS)

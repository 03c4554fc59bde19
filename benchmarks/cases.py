"""The reference work: two mechanisms of the gallery, and random designs of them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

import linkwright as lw
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.positions import Positions
from linkwright.kinematics.programs import Manner
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinematics.trace import MotionOutputs
from linkwright.kinetostatics.solver import ForceSolver
from linkwright.mechanism.mechanism import Mechanism

Floats = NDArray[np.float64]


def _vectors(kind: str, keys: str) -> tuple[str, ...]:
    return tuple(f"{kind}:{key}.{axis}" for key in keys.split() for axis in "xy")


def _motion(points: str, links: str) -> tuple[str, ...]:
    vectors = tuple(name for kind in "pva" for name in _vectors(kind, points))
    return (*vectors, *(f"{kind}:{link}" for kind in "wg" for link in links.split()))


#: Kinds of outputs that the motion has; the others are of the forces.
MOTION_KINDS = ("p", "v", "a", "e", "w", "g", "s", "sv", "sa", "outcome")

#: Outputs in the order in which the C kernels store them.
FOURBAR_OUTPUTS = _motion("A B coupler.P", "coupler rocker")
_PINS = "O1|crank A|pitman B|pitman B|toggle C|toggle O3|rocker O5|jaw"
SIXBAR_OUTPUTS = (*_motion("A B C", "pitman rocker toggle jaw"), *_vectors("r", _PINS), "effort:driver")

#: Columns of the C kernels' tables of designs, by the package's names.
FOURBAR_COLUMNS = (
    *("crank.length", "driver.speed", "frame.O2.x", "coupler.length", "rocker.length"),
    *("mode:coupler+rocker", "coupler.P.x", "coupler.P.y"),
)
SIXBAR_COLUMNS = (
    *("crank.length", "driver.speed", "frame.O3.x", "frame.O3.y", "pitman.length", "rocker.length"),
    *("mode:pitman+rocker", "frame.O5.x", "frame.O5.y", "toggle.length", "jaw.length", "mode:toggle+jaw"),
    *(f"{link}.mass" for link in ("pitman", "rocker", "toggle", "jaw")),
    *(f"{link}.inertia" for link in ("pitman", "rocker", "toggle", "jaw")),
    "gravity.y",
)
#: The column whose sign is the other way round in the C kernels: gravity is downward there.
TURNED = frozenset({"gravity.y"})


@dataclass(frozen=True)
class Work:
    """A mechanism with its outputs, positions, and what the package has traced for it."""

    mechanism: Mechanism
    outputs: tuple[str, ...]
    columns: tuple[str, ...]
    positions: Positions
    solver: MotionSolver
    forces: ForceSolver

    @property
    def cosine(self) -> Floats:
        """Cosine of the crank's angle, (n,)."""
        return self.positions.arrays["cos:driver"]

    @property
    def sine(self) -> Floats:
        """Sine of the crank's angle, (n,)."""
        return self.positions.arrays["sin:driver"]

    def value(self, name: str) -> Scalar:
        """An output as the package traces it."""
        if name.split(":", 1)[0] in MOTION_KINDS:
            return self.solver.outputs.value(name)
        return self.forces.outputs.value(name)

    def program(self) -> Program:
        """All outputs and the outcome of every position in one program."""
        values = {name: self.value(name) for name in self.outputs}
        return Program.of(self.solver.motion.trace, {**values, "outcome": self.solver.motion.outcome})

    def reduced(self, metrics: dict[str, Scalar]) -> Program:
        """Metrics with the truth output that says which positions count."""
        return Program.of(self.solver.motion.trace, {**metrics, "valid": self.solver.motion.valid})

    def nominal(self) -> Floats:
        """The mechanism as it is, one row for the C kernels."""
        known = self.solver.nominal.parameters
        return np.array([-known[name] if name in TURNED else known[name] for name in self.columns])

    def table(self, program: Program, designs: Floats) -> Floats:
        """Rows of the C kernels' table as the parameters of a program, (designs, parameters)."""
        known = self.solver.nominal.parameters
        table = np.empty((len(designs), len(program.parameters)))
        for place, name in enumerate(program.parameters):
            column = designs[:, self.columns.index(name)] if name in self.columns else known[name]
            table[:, place] = -column if name in TURNED else column
        return table


def _work(mechanism: Mechanism, outputs: tuple[str, ...], columns: tuple[str, ...], steps: int) -> Work:
    free = frozenset(name for name in columns if not name.startswith("mode:"))
    solver = MotionSolver(mechanism, Manner(free=free))
    return Work(mechanism, outputs, columns, over_cycle(mechanism, steps), solver, ForceSolver(solver))


def fourbar(steps: int = 360) -> Work:
    """Crank-rocker 1, 3.5, 2.5, 4 with the coupler point (1.5, 1)."""
    return _work(lw.load("gallery:crank_rocker"), FOURBAR_OUTPUTS, FOURBAR_COLUMNS, steps)


def sixbar(steps: int = 360) -> Work:
    """Six-bar jaw crusher without its process load."""
    crusher = replace(lw.load("gallery:jaw_crusher_sixbar"), loads={})
    return _work(crusher, SIXBAR_OUTPUTS, SIXBAR_COLUMNS, steps)


def fourbar_metrics(outputs: MotionOutputs) -> dict[str, Scalar]:
    """Squares of: the parallelogram of coupler and rocker, v and a of P, the rocker's ω and α."""
    a, b, p = (outputs.point(key) for key in ("A", "B", "coupler.P"))
    fixed = outputs.point("O2")[0]
    cross = (b[0] - a[0]).cross(b[0] - fixed)
    w, g = outputs.value("w:rocker"), outputs.value("g:rocker")
    return {
        "transmission": cross * cross,
        "velocity": p[1].square,
        "acceleration": p[2].square,
        "omega": w * w,
        "alpha": g * g,
    }


def sixbar_metrics(work: Work) -> dict[str, Scalar]:
    """Squares of: torque, forces at O1, O3, O5 and C, acceleration of C."""
    torque = work.value("effort:driver")
    reaction = work.forces.forces.reaction
    pins = {"F O1": ("O1", "crank"), "F O3": ("O3", "rocker"), "F O5": ("O5", "jaw"), "F C": ("C", "toggle")}
    squares = {name: reaction(*pin).square for name, pin in pins.items()}
    return {"torque": torque * torque, **squares, "acceleration": work.solver.outputs.point("C")[2].square}


def fourbar_designs(count: int) -> Floats:
    """Random crank-rockers, (count, 8)."""
    random = np.random.default_rng(0)
    found: list[Floats] = []
    while sum(map(len, found)) < count:
        sides = random.uniform(0.2, 4.0, (4 * count + 16, 4))
        crank, coupler, rocker, ground = sides.T
        longest, total = sides.max(1), sides.sum(1)
        others = np.minimum(np.minimum(coupler, rocker), ground)
        found.append(sides[(crank < others) & (crank + longest < 0.98 * (total - crank - longest))])
    crank, coupler, rocker, ground = np.concatenate(found)[:count].T
    side = np.where(random.random(count) < 0.5, 1.0, -1.0)
    u, v = random.uniform(-2.0, 2.0, (2, count))
    return np.stack([crank, np.full(count, 10.0), ground, coupler, rocker, side, u, v], axis=1)


def sixbar_designs(work: Work, count: int) -> Floats:
    """The crusher with its lengths and pivots changed at random by a few per cent, (count, 21)."""
    random = np.random.default_rng(0)
    designs = np.repeat(work.nominal()[None, :], count, axis=0)
    designs[:, 0] *= random.uniform(0.9, 1.1, count)
    for column in (4, 5, 9, 10):
        designs[:, column] *= random.uniform(0.97, 1.03, count)
    for column in (2, 3, 7, 8):
        designs[:, column] *= random.uniform(0.99, 1.01, count)
    return designs

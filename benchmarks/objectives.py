"""Value and gradient of objectives: one design against NumPy by hand, many against the value alone."""

from __future__ import annotations

from functools import partial

import numpy as np

import linkwright as lw
from benchmarks.cases import Floats
from benchmarks.timing import Candidate
from linkwright.formula.llvm_backend import available

OURS, HAND = "lw.objective, value and gradient", "NumPy by hand, complex step"
ALONE, BOTH = "value alone", "lw.objective, value and gradient of many"
#: Dimensions of the four-bar in the order of the function by hand.
PATH = ("crank.length", "coupler.length", "rocker.length", "frame.O2.x", "coupler.P.x", "coupler.P.y")
_PIVOTS = tuple(f"frame.{pivot}.{axis}" for pivot in ("O3", "O5") for axis in "xy")
#: Dimensions of the six-bar.
VARIED = (*(f"{link}.length" for link in ("crank", "pitman", "rocker", "toggle", "jaw")), *_PIVOTS)
TORQUE = "driver.effort rms"
_STEP = 1e-30


class PathWork:
    """Mean square distance of the crank-rocker's coupler point from the points of a path."""

    def __init__(self, points: int = 60) -> None:
        turn = np.linspace(0.0, 2.0 * np.pi, points, endpoint=False)
        self.cosine, self.sine = np.cos(turn), np.sin(turn)
        self.target = np.stack([1.0 + 0.8 * self.cosine, 1.5 + 0.4 * self.sine], axis=1)
        error = lw.PathError("coupler.P", self.target)
        self.ours = lw.objective(lw.load("gallery:crank_rocker"), error, vary=PATH)
        self.start = self.ours.start

    def error(self, design: Floats) -> complex | float:
        """The error by the same formulas as the kernels in C, positions only."""
        crank, coupler, rocker, ground, u, v = design
        ax, ay = crank * self.cosine, crank * self.sine
        dx, dy = ground - ax, -ay
        square = dx * dx + dy * dy
        t = square + coupler * coupler - rocker * rocker
        root = np.sqrt(4.0 * coupler * coupler * square - t * t)
        share = 0.5 / (coupler * square)
        cx, cy = (dx * t - dy * root) * share, (dy * t + dx * root) * share
        px, py = ax + u * cx - v * cy, ay + u * cy + v * cx
        return (  # type: ignore[no-any-return]
            (px - self.target[:, 0]) ** 2 + (py - self.target[:, 1]) ** 2
        ).mean()

    def by_hand(self) -> tuple[float, Floats]:
        """Value and derivatives, one evaluation each (Squire and Trapp, SIAM Review 40, 1998)."""
        gradient = np.empty(len(self.start))
        for place in range(len(self.start)):
            design = self.start.astype(complex)
            design[place] += 1j * _STEP
            gradient[place] = np.imag(self.error(design)) / _STEP
        return float(np.real(self.error(self.start))), gradient

    def candidates(self) -> list[Candidate]:
        """One design."""
        return [Candidate(OURS, partial(self.ours, self.start)), Candidate(HAND, self.by_hand)]

    def disagreement(self) -> float:
        """Largest difference, as a share of the gradient's size."""
        (value, gradient), (wanted, slopes) = self.ours(self.start), self.by_hand()
        return float(max(abs(value - wanted) / wanted, np.abs(gradient - slopes).max() / np.abs(slopes).max()))


class TorqueWork:
    """Root mean square of the crusher's torque with its process load, between limits found on the way."""

    def __init__(self, designs: int, steps: int) -> None:
        self.mechanism, self.steps = lw.load("gallery:jaw_crusher_sixbar"), steps
        self.backend = "llvm" if available() else "numpy"
        self.both = lw.objective(
            self.mechanism,
            TORQUE,
            vary=VARIED,
            steps=steps,
            backend=self.backend,  # type: ignore[arg-type]
        )
        random = np.random.default_rng(0)
        self.table = self.both.start * random.uniform(0.995, 1.005, (designs, len(VARIED)))

    def value(self) -> Floats:
        """The value of every design, by the stages that it needs."""
        return self.both.values(self.table)

    def swept(self) -> Floats:
        """The same by a sweep."""
        columns = dict(zip(VARIED, self.table.T, strict=True))
        found = lw.sweep(self.mechanism, columns, outputs=[TORQUE], steps=self.steps, threads=1)
        return np.asarray(found[TORQUE])

    def candidates(self) -> list[Candidate]:
        """Many designs."""
        return [Candidate(ALONE, self.value), Candidate(BOTH, partial(self.both.many, self.table))]

    def disagreement(self) -> float:
        """Largest relative difference of the values from those of a sweep."""
        return float(np.nanmax(np.abs(self.both.many(self.table)[0] / self.swept() - 1.0)))

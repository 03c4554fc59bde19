"""What a student writes: scipy's ``fsolve`` for the angles of every position, then dense linear systems."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from scipy.optimize import fsolve

from benchmarks import by_numpy
from benchmarks.cases import Floats, Work
from benchmarks.peers import Peer


def _unit(angle: float) -> Floats:
    return np.array([math.cos(angle), math.sin(angle)])


def _perp(angle: float) -> Floats:
    return np.array([-math.sin(angle), math.cos(angle)])


def _angle(x: Floats, y: Floats) -> float:
    return math.atan2(float(y[0]), float(x[0]))


def fourbar(work: Work) -> list[Peer]:
    """W2: angles and their rates."""
    crank, speed, ground, coupler, rocker = work.nominal().tolist()[:5]
    angles = next(iter(work.positions.coordinates.values()))[0].tolist()
    first = by_numpy.fourbar(work.cosine, work.sine, work.nominal())
    begin = [_angle(first[2] - first[0], first[3] - first[1]), _angle(first[2] - ground, first[3])]

    def gap(x: Floats, angle: float) -> list[float]:
        across = crank * math.cos(angle) + coupler * math.cos(x[0]) - rocker * math.cos(x[1]) - ground
        return [across, crank * math.sin(angle) + coupler * math.sin(x[0]) - rocker * math.sin(x[1])]

    def run() -> Floats:
        x, rows = begin, []
        for angle in angles:
            x = fsolve(gap, x, args=(angle,), xtol=1e-12)
            jacobian = np.stack([coupler * _perp(x[0]), -rocker * _perp(x[1])], axis=1)
            w = np.linalg.solve(jacobian, -speed * crank * _perp(angle))
            bend = speed**2 * crank * _unit(angle) + w[0] ** 2 * coupler * _unit(x[0])
            g = np.linalg.solve(jacobian, bend - w[1] ** 2 * rocker * _unit(x[1]))
            rows.append((*x, *w, *g))
        return np.array(rows)

    def results() -> Mapping[str, Floats]:
        names = ("w:coupler", "w:rocker", "g:coupler", "g:rocker")
        return dict(zip(names, run()[:, 2:].T, strict=True))

    return [Peer("fsolve per angle", run, results, note="rates of the links only")]


class _Crusher:
    """Closure, rates and the balance of all links of the six-bar at one position."""

    def __init__(self, row: list[float]) -> None:
        self.crank, self.speed = row[:2]
        self.o3, self.o5 = np.array(row[2:4]), np.array(row[7:9])
        self.lengths = [row[4], row[5], row[9], row[10]]
        self.masses, self.inertias, self.gravity = row[12:16], row[16:20], row[20]

    def gap(self, x: Floats, angle: float) -> Floats:
        a, b, c, d = self.lengths
        pin = self.crank * _unit(angle) + a * _unit(x[0])
        return np.concatenate([pin - self.o3 - b * _unit(x[1]), pin + c * _unit(x[2]) - self.o5 - d * _unit(x[3])])

    def rates(self, x: Floats, angle: float) -> tuple[Floats, Floats]:
        a, b, c, d = self.lengths
        jacobian = np.zeros((4, 4))
        jacobian[:2, 0] = jacobian[2:, 0] = a * _perp(x[0])
        jacobian[:2, 1], jacobian[2:, 2], jacobian[2:, 3] = (-b * _perp(x[1]), c * _perp(x[2]), -d * _perp(x[3]))
        w = np.linalg.solve(jacobian, np.tile(-self.speed * self.crank * _perp(angle), 2))
        pull = self.speed**2 * self.crank * _unit(angle) + w[0] ** 2 * a * _unit(x[0])
        first = pull - w[1] ** 2 * b * _unit(x[1])
        second = pull + w[2] ** 2 * c * _unit(x[2]) - w[3] ** 2 * d * _unit(x[3])
        g = np.linalg.solve(jacobian, np.concatenate([first, second]))
        return np.asarray(w, dtype=float), np.asarray(g, dtype=float)

    def forces(self, x: Floats, w: Floats, g: Floats, angle: float) -> Floats:
        """Unknowns: O1, A, B (pitman), B (toggle), C, O3, O5, torque."""
        _, b, _, d = self.lengths
        pins = [self.crank * _unit(angle), self.o3 + b * _unit(x[1]), self.o5 + d * _unit(x[3])]
        pin_a = -(self.speed**2) * pins[0]
        pin_b = b * (g[1] * _perp(x[1]) - w[1] ** 2 * _unit(x[1]))
        pin_c = d * (g[3] * _perp(x[3]) - w[3] ** 2 * _unit(x[3]))
        matrix, right = np.zeros((15, 15)), np.zeros(15)
        centres = [
            0.5 * (p + q) for p, q in ((pins[0], pins[1]), (pins[1], self.o3), (pins[1], pins[2]), (pins[2], self.o5))
        ]
        accelerations = [0.5 * (pin_a + pin_b), 0.5 * pin_b, 0.5 * (pin_b + pin_c), 0.5 * pin_c]
        acting = (
            (0, 0, 1, pins[0] * 0),
            (0, 1, -1, pins[0]),
            (1, 1, 1, pins[0]),
            (1, 2, 1, pins[1]),
            (2, 2, -1, pins[1]),
            (2, 3, -1, pins[1]),
            (2, 5, 1, self.o3),
            (3, 3, 1, pins[1]),
            (3, 4, 1, pins[2]),
            (4, 4, -1, pins[2]),
            (4, 6, 1, self.o5),
        )
        for link, force, sign, place in acting:
            arm = place - (centres[link - 1] if link else 0.0)
            row, column = 3 * link, 2 * force
            matrix[row, column] += sign
            matrix[row + 1, column + 1] += sign
            matrix[row + 2, column : column + 2] += sign * np.array([-arm[1], arm[0]])
        matrix[2, 14] = 1.0
        for link in range(4):
            m, row = self.masses[link], 3 * link + 3
            right[row : row + 2] = m * (accelerations[link] + np.array([0.0, self.gravity]))
            right[row + 2] = self.inertias[link] * g[link]
        return np.asarray(np.linalg.solve(matrix, right), dtype=float)


def sixbar(work: Work) -> list[Peer]:
    """W3."""
    crusher = _Crusher(work.nominal().tolist())
    angles = next(iter(work.positions.coordinates.values()))[0].tolist()
    f = by_numpy.sixbar(work.cosine, work.sine, work.nominal())
    begin = [
        *(_angle(f[2] - f[0], f[3] - f[1]), _angle(f[2] - crusher.o3[0], f[3] - crusher.o3[1])),
        *(_angle(f[4] - f[2], f[5] - f[3]), _angle(f[4] - crusher.o5[0], f[5] - crusher.o5[1])),
    ]

    def run() -> Floats:
        x, rows = begin, []
        for angle in angles:
            x = fsolve(crusher.gap, x, args=(angle,), xtol=1e-12)
            w, g = crusher.rates(x, angle)
            rows.append(crusher.forces(x, w, g, angle))
        return np.array(rows)

    def results() -> Mapping[str, Floats]:
        rows = run().T
        named = {"effort:driver": rows[14], "r:O5|jaw.x": rows[12], "r:O5|jaw.y": rows[13]}
        return {**named, "r:O3|rocker.x": rows[10], "r:O3|rocker.y": rows[11]}

    return [Peer("fsolve per angle", run, results)]

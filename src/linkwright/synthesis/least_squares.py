"""Least squares from many starts at once: Levenberg–Marquardt, every start a row.

Source: Marquardt 1963, J. SIAM 11(2); Moré 1978, "The Levenberg–Marquardt algorithm: implementation and theory".
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from linkwright.core.arrays import Floats, Integers
from linkwright.core.progress import Progress

#: Residuals (K, r) and their Jacobian (K, r, m) at parameters (K, m) of the starts numbered ``who`` (K,).
System = Callable[[Floats, Integers], tuple[Floats, Floats]]

SHRINK, GROW, LARGEST, ENOUGH = 0.2, 6.0, 1e12, 1e-13


def minimise(
    system: System, start: Floats, *, steps: int = 80, keep: int = 6, halve: int = 8, progress: Progress | None = None
) -> tuple[Floats, Floats, Integers]:
    """Local minima of Σ r² from the rows of ``start`` (K, m): parameters, sums (both best first) and start numbers.

    Every ``halve`` steps the worse half of the starts is dropped, down to ``keep``. Ends when no start gains more
    than ``ENOUGH`` of its sum in a step.
    """
    x, who = start.copy(), np.arange(len(start))
    damping = np.full(len(x), 1e-3)
    r, jacobian = system(x, who)
    f = _sums(r)
    for step in range(1, steps + 1):
        trial = x - _step(jacobian, r, damping)
        r2, j2 = system(trial, who)
        f2 = _sums(r2)
        better = f2 < f
        gain = np.where(better, f - f2, 0.0)
        done = (gain <= ENOUGH * f) & better | (damping > LARGEST) | (f <= 1e-32)
        x, f = np.where(better[:, None], trial, x), np.where(better, f2, f)
        r, jacobian = np.where(better[:, None], r2, r), np.where(better[:, None, None], j2, jacobian)
        damping = np.where(better, np.maximum(damping * SHRINK, 1e-15), damping * GROW)
        if progress is not None:
            progress(step, steps)
        if done.all():
            break
        if step % halve == 0 and len(x) > keep:
            chosen = np.argsort(f)[: max(keep, len(x) // 2)]
            x, f, r, jacobian = x[chosen], f[chosen], r[chosen], jacobian[chosen]
            damping, who = damping[chosen], who[chosen]
    order = np.argsort(f)
    return x[order], f[order], who[order]


def with_differences(residual: Callable[[Floats, Integers], Floats]) -> System:
    """The system of a residual function, its Jacobian by forward differences, all parameters and rows at once."""

    def system(x: Floats, who: Integers) -> tuple[Floats, Floats]:
        count, m = x.shape
        h = 1e-7 * np.maximum(1.0, np.abs(x))
        moved = (x[:, None] + h[:, :, None] * np.eye(m)).reshape(-1, m)
        both = residual(np.concatenate([x, moved]), np.concatenate([who, np.repeat(who, m)]))
        r, shifted = both[:count], both[count:].reshape(count, m, -1)
        return r, ((shifted - r[:, None]) / h[:, :, None]).swapaxes(1, 2)

    return system


def _sums(r: Floats) -> Floats:
    f = np.einsum("ki,ki->k", r, r)
    return np.where(np.isfinite(f), f, np.inf)


def _step(jacobian: Floats, r: Floats, damping: Floats) -> Floats:
    normal = jacobian.swapaxes(1, 2) @ jacobian
    gradient = jacobian.swapaxes(1, 2) @ r[:, :, None]
    diagonal = np.einsum("kii->ki", normal)
    floor = 1e-14 * diagonal.max(1, keepdims=True) + 1e-300
    weight = damping[:, None] * (diagonal + floor) + floor
    normal = normal + weight[:, :, None] * np.eye(normal.shape[1])
    good = np.isfinite(normal).all((1, 2))
    normal = np.where(good[:, None, None], normal, np.eye(normal.shape[1]))
    return np.asarray(np.linalg.solve(normal, np.where(good[:, None, None], gradient, 0.0))[:, :, 0])

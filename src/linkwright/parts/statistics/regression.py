"""Linear least squares of one sample on powers of another, or on several others."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass


@dataclass(frozen=True)
class Regression:
    """y = Σ b_j f_j(x): coefficients with standard errors, t and p of b_j = 0, intervals; R², residual deviation s.

    b = (FᵀF)⁻¹Fᵀy by QR; s² = Σ e²/(n − p); var b = s²(FᵀF)⁻¹ (Draper and Smith, Applied Regression Analysis).
    """

    terms: tuple[str, ...]
    coefficients: Floats
    errors: Floats
    t: Floats
    p: Floats
    low: Floats
    high: Floats
    determination: float
    deviation: float
    freedom: int
    fitted: Floats


def regression(y: Floats, columns: Floats, terms: tuple[str, ...], confidence: float) -> Regression | None:
    """The least squares of y (n,) on columns (n, p); None where the columns depend on each other."""
    from scipy import stats

    n, count = columns.shape
    scale = np.linalg.norm(columns, axis=0)
    scale[scale == 0.0] = 1.0
    q, r = np.linalg.qr(columns / scale)
    if np.abs(np.diag(r)).min() < 1e-12 * np.abs(np.diag(r)).max():
        return None
    coefficients = np.linalg.solve(r, q.T @ y) / scale
    left = y - columns @ coefficients
    freedom = n - count
    variance = float(left @ left) / freedom
    errors = np.sqrt(variance * (np.linalg.inv(r) ** 2).sum(axis=1)) / scale
    centred = y - y.mean()
    total = float(centred @ centred)
    with np.errstate(all="ignore"):
        t = coefficients / errors
    half = float(stats.t.ppf(0.5 + confidence / 2, freedom)) * errors
    return Regression(
        terms, coefficients, errors, t, 2 * stats.t.sf(np.abs(t), freedom), coefficients - half, coefficients + half,
        1.0 - float(left @ left) / total if total else 1.0, variance**0.5, freedom, columns @ coefficients,
    )  # fmt: skip

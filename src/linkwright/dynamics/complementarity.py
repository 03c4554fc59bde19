"""What holds and what slips where forces jump with the sign of a rate, and where stops touch."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats

#: Sweeps at most, and the change that ends them.
SWEEPS, CHANGE = 20_000, 1e-15
#: A sum of vectors of length 1, their shares one together, that is zero but for rounding.
CANCEL = 1e-9


def shares(first: Floats, gains: Floats, most: Floats) -> Floats:
    """Shares s (k,) with 0 <= s <= ``most`` for which each entry of r = ``first`` + ``gains`` s is zero, or pushes
    against the end at which its share is.

    ``gains`` (k, k): what unit shares change. Of friction (an entry is the rate of a sliding velocity, its share goes
    from the side below zero, 0, to that above, 1; gains are negative) r <= 0 at 0 and r >= 0 at 1; of stops (the
    share is the force; gains are positive, ``most`` infinite) r >= 0 at 0. By Gauss-Seidel sweeps with projection,
    which for forces that take power converge to the one solution (Jourdan, Alart, Jean 1998).
    """
    found = np.zeros(len(first))
    for _sweep in range(SWEEPS):
        change = 0.0
        for k in range(len(first)):
            own = gains[k, k]
            rest = first[k] + gains[k] @ found - own * found[k]
            new = found[k] if own == 0.0 else min(max(-rest / own, 0.0), most[k])
            change = max(change, abs(new - found[k]) / max(1.0, abs(new)))
            found[k] = new
        if change <= CHANGE:
            break
    return found


def one_way(rows: Floats) -> bool:
    """Whether some vector (n,) has a positive product with each of the ``rows`` (k, n): none does where rows with
    shares of which none is negative cancel (Gordan's theorem)."""
    from scipy.optimize import nnls

    units = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    sums = np.vstack([units.T, np.ones(len(rows))])
    return bool(nnls(sums, np.append(np.zeros(rows.shape[1]), 1.0))[1] > CANCEL)

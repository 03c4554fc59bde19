"""Designs between the ends of ranges: every combination, or a Sobol sequence."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from linkwright.core.arguments import integer
from linkwright.core.arrays import Floats
from linkwright.designs.ranges import Range
from linkwright.errors import LinkwrightError, RequestError
from linkwright.words import _

#: Designs of one study, at most.
MOST = 1_000_000


BAD_SEED = _("invalid seed {seed}; expected an integer of 0 or more", code="study.bad_seed")


def grid(ranges: Sequence[Range]) -> dict[str, Floats]:
    """Every combination of the values; the last range varies fastest."""
    count = 1
    for each in ranges:
        count *= len(each.values)
    if count > MOST:
        raise RequestError(
            _(
                "the grid has {count} designs; give {most} or fewer, or sample it: sampling='sobol'",
                code="study.grid_large",
                count=count,
                most=MOST,
            )
        )
    mesh = np.meshgrid(*(each.values for each in ranges), indexing="ij")
    return {each.address: rows.ravel() for each, rows in zip(ranges, mesh, strict=True)}


def sobol(ranges: Sequence[Range], samples: int, seed: int, sampling: str) -> dict[str, Floats]:
    """``samples`` designs between the ends, by a scrambled Sobol sequence (Owen 1998); the same for the same seed.

    Raises LinkwrightError for another sampling, fewer than one sample, and where scipy is missing.
    """
    if sampling != "sobol":
        raise RequestError(
            _("there is no sampling {sampling!r}; use grid or sobol", code="study.no_sampling", sampling=sampling)
        )
    samples, seed = integer("samples", samples), integer("seed", seed)
    if not 1 <= samples <= MOST:
        raise RequestError(
            _(
                "{samples} samples are asked for; give 1 to {most}",
                code="study.bad_samples",
                samples=samples,
                most=MOST,
            )
        )
    if seed < 0:
        raise RequestError(BAD_SEED.format(seed=seed))
    try:
        from scipy.stats import qmc
    except ImportError as error:
        raise LinkwrightError(
            _("a Sobol sequence needs scipy; install it with: pip install scipy", code="study.needs_scipy")
        ) from error
    power = max(0, (samples - 1).bit_length())
    unit = qmc.Sobol(len(ranges), seed=seed).random_base2(power)[:samples]
    return {each.address: each.low + unit[:, i] * (each.high - each.low) for i, each in enumerate(ranges)}

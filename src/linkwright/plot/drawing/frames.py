"""Which positions an animation shows, and how fast."""

from __future__ import annotations

import numpy as np

from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion


def frame_indices(motion: Motion, frames: int) -> list[int]:
    """Positions of one cycle on the screen, the first repeated at the end.

    A closed cycle goes round; an open one, or one with positions that were not reached, goes to and fro over the
    longest stretch that was.
    """
    start, stop = _longest_stretch(motion.ok)
    count = stop - start
    if motion.positions.closed and count == motion.steps:
        chosen = np.unique(np.linspace(0, count, min(frames, count) + 1).round().astype(int)) % count
        return [int(k) for k in chosen]
    way = np.unique(
        np.linspace(start, stop - 1, min(max(frames // 2, 2), count)).round().astype(int)
    ).tolist()
    there_and_back = [*way, *way[-2::-1]]
    return there_and_back if len(there_and_back) > 1 else [start, start]


def usual_seconds(motion: Motion) -> float:
    """The true time of a cycle where an eye can follow it, else the nearest such time, within 2 to 6 s."""
    times = motion.time
    span = motion.positions.period or 2.0 * abs(float(times[-1] - times[0]))
    return float(np.clip(span, 2.0, 6.0))


def _longest_stretch(ok: np.ndarray) -> tuple[int, int]:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], ok.astype(int), [0]])))
    runs = [(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2], strict=True)]
    if not runs:
        raise LinkwrightError("no position of the motion was reached, so there is nothing to show")
    return max(runs, key=lambda run: run[1] - run[0])

"""sympy: the closed form differentiated symbolically, then ``lambdify``."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import sympy as sp

from benchmarks.cases import Floats, Work
from benchmarks.peers import Peer


def fourbar(work: Work) -> list[Peer]:
    """W2: B and both angles with their rates."""
    crank, speed, ground, coupler, rocker, side = (sp.Float(v) for v in work.nominal().tolist()[:6])
    turn, rate = sp.Symbol("turn"), sp.Symbol("rate")
    ax, ay = crank * sp.cos(turn), crank * sp.sin(turn)
    dx, dy = ground - ax, -ay
    square = dx**2 + dy**2
    along = (square + coupler**2 - rocker**2) / (2 * square)
    across = side * sp.sqrt(coupler**2 / square - along**2)
    bx, by = ax + along * dx - across * dy, ay + along * dy + across * dx
    places = [bx, by, sp.atan2(by - ay, bx - ax), sp.atan2(by, bx - ground)]
    rates = [sp.diff(each, turn) * rate for each in places]
    seconds = [sp.diff(each, turn) * rate for each in rates]
    function = sp.lambdify((turn, rate), places + rates + seconds, "numpy", cse=True)
    angles, value = next(iter(work.positions.coordinates.values()))[0], float(speed)
    names = (
        "p:B.x",
        "p:B.y",
        "",
        "",
        "v:B.x",
        "v:B.y",
        "w:coupler",
        "w:rocker",
        "a:B.x",
        "a:B.y",
        "g:coupler",
        "g:rocker",
    )

    def run() -> list[Floats]:
        return function(angles, value)  # type: ignore[no-any-return]

    def results() -> Mapping[str, Floats]:
        return {name: np.asarray(array) for name, array in zip(names, run(), strict=True) if name}

    return [Peer("sympy lambdify", run, results, note="without A and P")]

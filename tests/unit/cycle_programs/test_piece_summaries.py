"""Means, extremes and excess of signals at Gauss points: by arrays, compiled, and against thousands of samples."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from tests.every import every

from linkwright.core.piecewise import NODES, POINTS, WEIGHTS
from linkwright.cycle.summary import Summary
from linkwright.cycle_programs.piece_summaries import PieceSummaries, Reduced
from linkwright.engine.program import Program
from linkwright.engine.stage import Run
from linkwright.engine.trace import Trace, absolute, cos, exp, select, sin, sqrt

TURN = 2.0 * np.pi
SHARE, VALID = "share", "valid"
DESIGNS = np.array([[1.0, 0.3], [0.2, -1.4], [-2.0, 0.9], [0.7, 0.7], [1e3, -20.0]])
KINDS = {
    "wave": ("max", "min", "mean", "rms", "excess"),
    "saw": ("max", "min", "excess"),
    "root": ("peak", "rms", "max"),
    "bump": ("max",),
    "low": ("min", "range"),
    "kink": ("max", "mean"),
}


def signals(t: Trace, a: object, b: object, x: object) -> Mapping[str, object]:
    """Smooth ones, one that jumps where the turn ends, roots of sums, one high in a few pieces only, one that is
    not met."""
    wave = a * sin(x) + b * cos(3.0 * x + 0.4) + 0.2 * a
    square = (a * cos(x)) * (a * cos(x)) + 2.0 + b * b * sin(x) * sin(x)
    far = x - 4.1 - 0.1 * b / (1.0 + absolute(b))
    return {
        "wave": wave,
        "saw": a * x - b * cos(x),
        "root": sqrt(square),
        "bump": exp(-3.0 * far * far) * (1.0 + a * a) + 0.1 * sin(x),
        "low": select(a > 0.0, wave, -wave),
        "kink": absolute(sin(x + 0.31)) * (1.0 + a * a),
    }


def summaries(pieces: int) -> tuple[PieceSummaries, Run, np.ndarray]:
    t = Trace()
    a, b, x = t.parameter("a"), t.parameter("b"), t.position("x")
    outputs = {**signals(t, a, b, x), SHARE: t.position(SHARE), VALID: select(a > -1.5, 1.0, 0.0)}
    edges = TURN * np.arange(pieces + 1) / pieces
    places = (0.5 * (edges[:-1] + edges[1:]) + 0.5 * np.diff(edges) * NODES[:, None]).ravel()
    widths = np.repeat(0.5 * WEIGHTS / pieces, pieces)
    asked = [Summary(name, kind) for name, kinds in KINDS.items() for kind in kinds]
    found = PieceSummaries(Program.of(t, outputs), asked, pieces, SHARE, [VALID])
    return found, Run({"x": places, SHARE: widths}, POINTS * pieces, None, 1, "numpy"), edges


def place_of(peak: tuple[np.ndarray, ...], edges: np.ndarray) -> np.ndarray:
    piece, place = peak[0], peak[1]
    return edges[piece] + 0.5 * (1.0 + place) * np.diff(edges)[piece]


def reduced(pieces: int, backend: str) -> tuple[Reduced, np.ndarray]:
    found, run, edges = summaries(pieces)
    return found.reduced(DESIGNS, {}, Run(run.positions, run.length, None, 1, backend)), edges


@pytest.mark.parametrize("backend", ["numpy", "llvm"])
@pytest.mark.parametrize("pieces", [12, 29])
def test_against_samples(pieces: int, backend: str) -> None:
    """2 · 10⁵ samples of a turn: values to 1e-9, places to what a flat extreme shows."""
    found, edges = reduced(pieces, backend)
    x = (np.arange(200_000) + 0.5) * TURN / 200_000
    for d, (a, b) in enumerate(DESIGNS):
        t = Trace()
        program = Program.of(t, signals(t, float(a), float(b), t.position("x")))
        exact = dict(zip(program.output_names, sampled(program, x), strict=True))
        for name in ("wave", "saw", "root", "bump", "low"):
            size = np.abs(exact[name]).max()
            for side in ("max", "min"):
                if (name, side) not in found.peaks:
                    continue
                peak = tuple(row[d] for row in found.peaks[name, side])
                value = exact[name].max() if side == "max" else -exact[name].min()
                close = {"saw": 3e-5, "root": 1e-8}.get(name, 1e-9)
                assert peak[2] == pytest.approx(value, abs=close * size), (name, side)
                where = place_of(tuple(np.atleast_1d(each) for each in peak), edges)[0]
                there = np.interp(where, x, exact[name]) * (1.0 if side == "max" else -1.0)
                assert there == pytest.approx(value, abs=max(close, 1e-8) * size), (name, side)
                assert peak[3] <= 1e-10 * size
        for name in ("wave", "root"):
            mean, square = (row[d] for row in found.powers[name])
            assert square == pytest.approx((exact[name] ** 2).mean(), rel=1e-9)
            if name == "wave":
                assert mean == pytest.approx(exact[name].mean(), abs=1e-9 * abs(a))
        for name in ("wave", "saw"):
            lack = np.cumsum(exact[name].mean() - exact[name]) / len(x)
            for side, value in (("gained", lack.max()), ("lost", -lack.min())):
                assert found.peaks[name, side][2][d] == pytest.approx(max(value, 0.0), abs=2e-5 * abs(a))
        top, bottom, _ = (row[d] for row in found.bounds["wave"])
        assert bottom <= exact["wave"].mean() <= top <= exact["wave"].max() + 1e-12 * abs(a)
        kinked = found.bounds["kink"][2][d]
        assert 1e-3 < kinked / (1 + a * a) < 1.0
    assert found.bounds[VALID][1].tolist() == [1.0, 1.0, 0.0, 1.0, 1.0]


def sampled(program: Program, x: np.ndarray) -> np.ndarray:
    from linkwright.engine.numpy_backend import numpy_program

    return numpy_program(program).run_designs(np.empty((1, 0)), {"x": x}, {}, length=len(x))[0]


@pytest.mark.parametrize("pieces", [5, 8, 9, 12, 29, 41])
def test_compiled_is_as_by_arrays(pieces: int) -> None:
    """Pieces are taken eight at a time: numbers of them that are multiples of eight, and others."""
    pytest.importorskip("llvmlite")
    (compiled, edges), (arrays, _) = (reduced(pieces, each) for each in ("llvm", "numpy"))
    assert compiled.bounds.keys() == arrays.bounds.keys() and compiled.peaks.keys() == arrays.peaks.keys()
    for name, rows in every(arrays.bounds.items()):
        size = np.maximum(np.abs(rows[0]), np.abs(rows[1])) + 1.0
        for mine, other in zip(compiled.bounds[name], rows, strict=True):
            assert np.abs(mine - other) / size == pytest.approx(0.0, abs=2e-14), name
    for name, rows in arrays.powers.items():
        for mine, other in zip(compiled.powers[name], rows, strict=True):
            size = np.abs(rows[1]) + 1.0
            np.testing.assert_allclose(mine / size, other / size, rtol=0, atol=2e-14, err_msg=name)
    for (name, side), rows in every(arrays.peaks.items()):
        size = np.maximum(*np.abs(arrays.bounds[name][:2])) + 1.0
        mine = compiled.peaks[name, side]
        assert np.abs(mine[2] - rows[2]) / size == pytest.approx(0.0, abs=3e-13), (name, side)
        if name not in ("kink", "root") and side not in ("gained", "lost"):
            assert place_of(mine, edges) == pytest.approx(place_of(rows, edges), abs=1e-6), (name, side)
            assert np.abs(mine[3] - rows[3]) / size == pytest.approx(0.0, abs=1e-12), (name, side)


def test_a_signal_without_a_number_somewhere_has_no_bounds() -> None:
    for backend in ("numpy", "llvm"):
        t = Trace()
        a, x = t.parameter("a"), t.position("x")
        outputs = {"signal": sqrt(a - x) + 1.0, SHARE: t.position(SHARE)}
        _, run, _ = summaries(12)
        found = PieceSummaries(Program.of(t, outputs), [Summary("signal", "max")], 12, SHARE, [])
        kept = found.reduced(np.array([[7.0], [3.0]]), {}, Run(run.positions, run.length, None, 1, backend))
        finite = np.isfinite(kept.bounds["signal"][2])
        assert finite.tolist() == [True, False], backend

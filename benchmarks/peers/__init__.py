"""Other programs on the same work. Each module gives :class:`Peer` objects, or raises ImportError."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from benchmarks.cases import Floats, Work

MODULES = ("pylinkage", "kinepy", "exudyn", "sympy", "fsolve")


@dataclass(frozen=True)
class Peer:
    """``run`` does the work ``share`` of the whole; ``results`` gives arrays (n,) by our outputs' names."""

    name: str
    run: Callable[[], object]
    results: Callable[[], Mapping[str, Floats]] = field(default=dict)
    share: float = 1.0
    note: str = ""


def found(kind: str, *inputs: object) -> tuple[list[Peer], list[str]]:
    """Peers for ``fourbar(work)``, ``sixbar(work)``, ``fourbar_sweep(work, designs, count)``; which are missing."""
    peers: list[Peer] = []
    missing: list[str] = []
    for name in MODULES:
        try:
            module = importlib.import_module(f"benchmarks.peers.with_{name}")
        except ImportError as error:
            missing.append(f"{name}: skipped, {error}")
            continue
        make = getattr(module, kind, None)
        if make is not None:
            peers += make(*inputs)
    return peers, missing


def error(peer: Peer, work: Work, truth: Mapping[str, Floats]) -> float:
    """Largest difference from ``truth``, as a share of each output's largest value; NaN where nothing is given."""
    results = peer.results()
    gaps = [float(np.max(abs(array - truth[name])) / abs(truth[name]).max()) for name, array in results.items()]
    return max(gaps, default=float("nan"))

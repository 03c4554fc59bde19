"""The names in which `corpus/calls.txt` is written: machines, and calls with what is the same in all of them."""

from __future__ import annotations

from functools import partial
from typing import Any

from tests import store

import linkwright as lw

NAN, INF = float("nan"), float("inf")
CORNERS = [(0, 0), (1, 0), (1, 1), (0, 1)]
POSES = [(0.0, 0.0, 0.0), (0.1, 0.1, 0.3), (0.2, 0.1, 0.5)]
FOURBAR = """
format: 1
name: linkage
frame: {{points: {{O1: [0 m, 0 m], O2: [4 m, 0 m]}}}}
links:
  crank: {{points: [O1, A], length: {crank} m}}
  coupler: {{points: [A, B], length: {coupler} m}}
  rocker: {{points: [O2, B], length: {rocker} m}}
assembly: {{B: left}}
driver: {{turn: crank, about: O1, speed: 1 rad/s, start: 20.5 deg}}
"""
#: Its last line.
DRIVER = FOURBAR.strip().splitlines()[-1].replace("{{", "{").replace("}}", "}")
machine, motion, forces = store.machine, store.motion, store.forces


def four_bar(crank: float, coupler: float = 2.0, rocker: float = 2.5) -> lw.Mechanism:
    """A four-bar on a frame of 4 m."""
    return lw.loads(FOURBAR.format(crank=crank, coupler=coupler, rocker=rocker))


def linkage(*changes: tuple[str, str]) -> lw.Mechanism:
    """The four-bar with changes of its text: each first one of a pair is replaced by the second."""
    text = FOURBAR.format(crank=1, coupler=3.5, rocker=2.5)
    for old, new in changes:
        assert old in text, f"no {old!r} in {text}"
        text = text.replace(old, new)
    return lw.loads(text)


def crusher(**lengths: float) -> lw.Mechanism:
    """The crusher with other lengths of some links."""
    return machine("jaw_crusher_sixbar").with_dimensions({f"{name}.length": x for name, x in lengths.items()})


def loaded(load: str) -> lw.Forces:
    """The forces of a four-bar with a torque on its rocker that a text describes."""
    text = FOURBAR.format(crank=1, coupler=3, rocker=2.5) + f"loads: {{push: {{kind: torque, on: rocker, {load}}}}}\n"
    return lw.solve_forces(lw.solve_motion(lw.loads(text), steps=24))


def solve(**options: Any) -> lw.Motion:
    """The motion of the crank-rocker."""
    return lw.solve_motion(machine("crank_rocker"), **options)


def sweep(**options: Any) -> Any:
    """A sweep of two designs of the crank-rocker."""
    return lw.sweep(machine("crank_rocker"), {"crank.length": [0.9, 1.0]}, steps=12, **options)


def sweep_crusher(output: str) -> Any:
    """The greatest value of an output of the crusher."""
    return lw.sweep(machine("jaw_crusher_sixbar"), {"crank.length": [0.1]}, outputs=[f"{output} max"], steps=12)


def study(vary: dict[str, Any], **options: Any) -> lw.Study:
    """A study of the crank-rocker."""
    return lw.study(machine("crank_rocker"), vary, **{"metrics": "swing_angle", "steps": 12, **options})


def compare(**options: Any) -> lw.Comparison:
    """A comparison of the two crushers."""
    return lw.compare([machine("jaw_crusher_sixbar"), machine("jaw_crusher_fourbar")], steps=12, **options)


def slopes(**options: Any) -> Any:
    """Derivatives of the crank-rocker."""
    return lw.sensitivity(machine("crank_rocker"), steps=12, **options)


def aim(of: Any, **options: Any) -> Any:
    """An objective of the crank-rocker."""
    return lw.objective(machine("crank_rocker"), of, steps=12, **options)


optimize = partial(lw.optimize, machine("crank_rocker"), steps=12, evaluations=12)

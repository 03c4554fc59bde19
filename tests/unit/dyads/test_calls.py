"""The call table: its calls, carried out by subprograms written from their meaning, give the solver's points.

The subprograms here know points and links by number only, as those of the teaching texts, and positions alone.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests import store
from tests.reference.random_mechanisms import random_mechanism

import linkwright as lw
from linkwright.dyads.calls import FORMAL, calls
from linkwright.dyads.plan import line_of, plan
from linkwright.kinetostatics.forces import link_numbers

STEPS = 12


class Subprograms:
    """Positions ``p`` (complex) by point number and directions ``t`` by link number, at all positions at once."""

    def __init__(self) -> None:
        self.p: dict[int, np.ndarray] = {}
        self.t: dict[int, np.ndarray] = {}

    def call(self, name: str, actual: tuple[str, ...]) -> None:
        given = {}
        for formal, text in zip(FORMAL[name], actual, strict=True):
            try:
                given[formal] = int(text) if formal[0] in "mnk" else float(text)
            except ValueError:
                continue  # an array, or a result
        getattr(self, name)(**given)

    def bark(self, n1, n2, n3, k, r1, r2, gam):
        if n2:
            self.p[n2] = self.p[n1] + r1 * np.exp(1j * self.t[k])
        if n3:
            self.p[n3] = self.p[n1] + r2 * np.exp(1j * (self.t[k] + gam))

    def rrrk(self, m, n1, n2, n3, k1, k2, r1, r2):
        d = self.p[n2] - self.p[n1]
        beside = np.arccos((r1**2 + np.abs(d) ** 2 - r2**2) / (2 * r1 * np.abs(d)))
        self.t[k1] = np.angle(d) + m * beside
        self.p[n3] = self.p[n1] + r1 * np.exp(1j * self.t[k1])
        self.t[k2] = np.angle(self.p[n3] - self.p[n2])

    def rrpk(self, m, n1, n2, n3, k1, k2, k3, r1):
        away = (self.p[n1] - self.p[n2]) * np.exp(-1j * self.t[k3])
        slide = away.real + m * np.sqrt(r1**2 - away.imag**2)
        self.p[n3] = self.p[n2] + slide * np.exp(1j * self.t[k3])
        self.t[k1], self.t[k2] = np.angle(self.p[n3] - self.p[n1]), self.t[k3]

    def rprk(self, m, n1, n2, k1, k2, r1):
        d = self.p[n2] - self.p[n1]
        self.t[k1] = self.t[k2] = np.angle(d) + m * np.arctan2(r1, np.sqrt(np.abs(d) ** 2 - r1**2))

    def prpk(self, n1, n2, n3, k1, k2, k3, k4):
        d, across = self.p[n2] - self.p[n1], np.sin(self.t[k4] - self.t[k3])
        slide = (d * np.exp(-1j * self.t[k4])).imag / -across
        self.p[n3] = self.p[n1] + slide * np.exp(1j * self.t[k3])
        self.t[k1], self.t[k2] = self.t[k3], self.t[k4]

    def rppk(self, n1, n2, n3, n4, k1, k2, k3, r1, gam1, gam2):
        self.t[k1], self.t[k2] = self.t[k3] + gam2 + gam1 - np.pi, self.t[k3] + gam2
        self.p[n3] = self.p[n1] + r1 * np.exp(1j * self.t[k1])
        slide = ((self.p[n3] - self.p[n2]) * np.exp(-1j * self.t[k2])).imag / -np.sin(gam2)
        self.p[n4] = self.p[n2] + slide * np.exp(1j * self.t[k3])


def carried_out(motion: lw.Motion):
    """The calls of a machine carried out: points by name and the subprograms."""
    rows = [int(i) for i in np.flatnonzero(motion.ok)]
    made_plan = plan(motion)
    made = calls(made_plan, link_numbers(motion.mechanism), forces=motion.mechanism.has_loads)
    run = Subprograms()
    run.p |= {each.number: np.full(len(rows), each.place) for each in made.points if each.place is not None}
    known = {
        link for step in made_plan.steps if step.kind in ("", "bar", "slider", "weld") for link in step.group.links
    }
    others = {link for step in made.others for link in step.group.links}
    for link in made.links:
        if link.name in known:
            axes = made_plan.axes[link.name]
            run.t[link.number] = line_of(motion, link.name, axes.origin, rows).angle + axes.lean
    guides = [link for link in made.links if link.name in motion.mechanism.guides]
    for point in made.points:
        if others & set(point.links) and str(point.name) in motion.point_names():
            run.p[point.number] = _complex(motion.point(str(point.name)).position[rows])
    for call in made.motion:
        for guide in guides:
            base = 0.0 if not guide.against else run.t.get(guide.against)
            if base is not None:
                run.t[guide.number] = base + guide.angle + np.zeros(len(rows))
        run.call(call.name, call.actual)
    return made, run, rows


def _complex(pairs: np.ndarray) -> np.ndarray:
    return pairs[:, 0] + 1j * pairs[:, 1]


def check(machine: lw.Mechanism, within: float = 1e-5) -> None:
    """``within``: share of the machine's size; the calls have lengths of six digits, which long chains magnify."""
    motion = lw.solve_motion(machine, steps=STEPS, failures="mark")
    made, run, rows = carried_out(motion)
    size = motion.mechanism.size
    numbers = [point.number for point in made.points]
    assert numbers == list(range(1, len(numbers) + 1))
    for point in made.points:
        text = str(point.name)
        if text in motion.point_names():
            assert np.abs(run.p[point.number] - _complex(motion.point(text).position[rows])).max() < within * size, (
                text
            )
        elif text.startswith("mass centre of "):
            centre = motion.link(text.removeprefix("mass centre of ")).centre.position[rows]
            assert np.abs(run.p[point.number] - _complex(centre)).max() < within * size, text
    for call in made.motion + made.forces:
        assert len(call.actual) == len(call.formal)
        points = {int(text) for formal, text in zip(call.formal, call.actual, strict=True) if formal[0] == "n"}
        assert points <= {0, *numbers}
    moved = {call.step.number for call in made.motion if call.step}
    dyads = {step.number for step in plan(motion).steps if step.kind.isupper()}
    assert moved == dyads
    if motion.mechanism.has_loads:
        loaded = {call.step.number for call in made.forces}
        assert loaded == dyads | {step.number for step in plan(motion).steps if step.kind == "bar"}


CORE = ("shaper_quick_return", "dyad_rpp", "dyad_prp", "dyad_rpr", "swing_conveyor", "jaw_crusher_sixbar", "truss")


@pytest.mark.parametrize("name", CORE)
def test_calls_give_the_points_of_the_solver(name: str):
    check(store.machine(name))


@pytest.mark.rotating
@pytest.mark.parametrize("name", [name for name in store.names() if name not in CORE])
def test_calls_of_the_whole_gallery(name: str):
    check(store.machine(name))


#: Both modes of every dyad, offsets, guides that move and that the moving link carries.
SEEDS = (3, 8, 19, 31, 75)


@pytest.mark.parametrize("seed", SEEDS)
def test_calls_of_random_machines(seed: int):
    check(lw.loads(random_mechanism(seed)), within=1e-3)


@pytest.mark.rotating
@pytest.mark.parametrize("seed", range(2000, 2060))
def test_calls_of_more_random_machines(seed: int):
    check(lw.loads(random_mechanism(seed)), within=1e-3)

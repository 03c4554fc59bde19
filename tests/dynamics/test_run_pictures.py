"""Curves and moving drawings of runs: over time, in true time."""

import re

import pytest

import linkwright as lw

ROD = """
format: 1
name: Rod
frame: {points: {O: [0 m, 0 m]}}
links: {rod: {points: [O, A], length: 1 m, mass: 3 kg, inertia: 0.25 kg·m²}}
driver: {turn: rod, about: O, speed: 1 rad/s}
gravity: [0, -9.81 m/s²]
"""


@pytest.fixture(scope="module")
def swing() -> lw.Run:
    return lw.run(lw.loads(ROD), duration=1.5)


@pytest.mark.parametrize("kind", ["sva", "angles", "paths", "reactions"])
def test_diagrams_are_over_time(swing: lw.Run, kind: str) -> None:
    diagram = swing.plot(kind).svg()
    assert ("time" in re.sub(r"\s", " ", diagram)) or kind == "paths"


def test_words_are_read_from_the_run(swing: lw.Run) -> None:
    assert swing.plot("sva", of=["A.velocity", "reaction O on rod"]).svg()


def test_moving_drawings_go_forth_in_true_time(swing: lw.Run) -> None:
    moving = lw.animate(swing, curves=["rod.angle"])
    assert moving.seconds == pytest.approx(1.5)
    assert list(moving.run) == sorted(moving.run)
    assert moving.run[-1] == moving.scene.machine.motion.steps - 1
    assert moving.svg

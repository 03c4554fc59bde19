"""Keyframes of animations: as many as keep the pins together."""

import pytest
from tests import store

from linkwright.plotting.animation import animate
from linkwright.plotting.drawing.scene import parting


@pytest.mark.parametrize("name", ["crank_rocker", "peaucellier", "oldham_coupling", "dyad_rpp"])
def test_few_frames_do_not_part_the_pins(name: str) -> None:
    animation = animate(store.machine(name), frames=6)
    machine = animation.scene.machine
    assert parting(machine, list(animation.run)) > 2.6 > 1.31 > parting(machine, list(animation.keys))

"""Pins in the traced outputs of a machine."""

import pytest
from tests import store
from tests.every import every

from linkwright.kinematics.solver import MotionSolver


@pytest.mark.parametrize("name", ["watt_sixbar", "theo_jansen_leg"])
def test_a_pin_is_placed_once_whichever_link_it_is_asked_of(name: str) -> None:
    """All names of a pin are one traced value: programs hold its position and its rates once."""
    mechanism = store.machine(name)
    outputs = MotionSolver(mechanism).outputs
    for pin in every(mechanism.pins, least=6):
        links = [link for link in mechanism.pin_links(pin) if link != "frame"]
        for kind in "pva":
            assert len({str(outputs.value(f"{kind}:{link}.{pin}.x")) for link in links}) == 1, pin

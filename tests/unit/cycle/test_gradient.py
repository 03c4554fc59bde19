"""Gradients of summaries over the cycle against differences of fourth order, with everything that moves."""

import numpy as np
import pytest
from tests.every import every

import linkwright as lw
from linkwright.cycle.cycle import Cycle
from linkwright.cycle.gradient import Backward
from linkwright.cycle.machine import Machine
from linkwright.cycle.solved import Solved
from linkwright.cycle.summaries import Summary

PARTS = ["driver.effort mean", "driver.effort rms", "driver.effort peak", "power max", "driver.effort excess"]
#: Machines with parts, what varies (the speed, the ends of phases, cams and lengths), outputs with limits.
CASES = {
    "ramp between limits": (
        "jaw_crusher_sixbar",
        "jaw.angle",
        ["pitman.length", "loads.crushing.ramp.1", "driver.speed"],
    ),
    "part of a stroke": ("shaper_quick_return", "guide.displacement", ["link.length", "driver.speed"]),
    "between inputs": ("swing_conveyor", "guide.displacement", ["rod.length", "driver.speed"]),
    "wheels and chains": ("chain_drive", "way.displacement", ["rod.length", "crank.length"]),
}


@pytest.mark.parametrize("name", CASES)
def test_gradients_are_differences_of_fourth_order(name: str) -> None:
    model, output, varied = CASES[name]
    mechanism = lw.load(f"gallery:{model}")
    motion = lw.solve_motion(mechanism)
    swung = lw.metrics(lw.solve_forces(motion))
    assert len(swung)
    limited = [each for each in _outputs(mechanism) if str(each) == output.partition(".")[0]]
    parts = [*PARTS, f"{output} range", f"{output} argmax"]
    cycle = Cycle(Machine(mechanism, motion, varied), map(Summary.of, parts), limited)
    nominal = {each: mechanism.dimension(each) for each in varied}
    solved = Solved(cycle, {each: np.array([value]) for each, value in nominal.items()})
    steps = {each: 2e-4 * abs(value) for each, value in nominal.items()}
    for address in varied:
        columns = {each: np.full(4, value) for each, value in nominal.items()}
        columns[address] = columns[address] + steps[address] * np.array([-2.0, -1.0, 1.0, 2.0])
        beside = Solved(cycle, columns).values
        for part in every(parts, least=3):
            far = beside[part]
            expected = (far[0] - 8.0 * far[1] + 8.0 * far[2] - far[3]) / (12.0 * steps[address])
            gradient = Backward(solved).gradient({part: np.ones(1)})[address][0]
            scale = max(abs(solved.values[part][0]), 0.1) / abs(nominal[address])
            assert gradient == pytest.approx(expected, rel=1e-7, abs=1e-8 * scale), (address, part)


def _outputs(mechanism: lw.Mechanism) -> tuple[object, ...]:
    from linkwright.analysis.outputs import mechanism_outputs

    return mechanism_outputs(mechanism)

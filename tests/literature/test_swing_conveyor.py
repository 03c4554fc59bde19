"""Swinging conveyor (course design report, 2007): positions as printed, rates and torques as corrected."""

import numpy as np
import pytest

import linkwright as lw

PRINTED_POSITIONS = {
    0.0: (347.053, 1.85923, 8.21421, 1.22361),
    60.0: (355.646, 32.8448, 346.64, 1.14343),
    120.0: (12.0076, 63.8067, 330.57, 0.90679),
    180.0: (33.2035, 85.5745, 325.634, 0.71922),
    240.0: (53.9931, 92.6593, 325.537, 0.664279),
    300.0: (45.9895, 62.4684, 331.078, 0.918551),
}


def last_digit(value: float) -> float:
    text = f"{value:.6g}"
    return 10.0 ** -(len(text.partition(".")[2])) if "." in text else 1.0


@pytest.fixture(scope="module")
def conveyor() -> lw.Mechanism:
    return lw.load("gallery:swing_conveyor")


@pytest.mark.parametrize("crank", PRINTED_POSITIONS)
def test_printed_positions(conveyor: lw.Mechanism, crank: float) -> None:
    motion = lw.solve_motion(conveyor, at=np.radians(crank))
    *angles, x = PRINTED_POSITIONS[crank]
    for link, angle in zip(("coupler", "rocker", "rod"), angles, strict=True):
        turned = float(np.degrees(motion.link(link).angle[0])) - angle
        assert abs((turned + 180) % 360 - 180) <= 0.51 * last_digit(angle) + 0.0005
    assert motion.point("F").position[0, 0] == pytest.approx(x, abs=0.51e-5)


def test_corrected_rates_at_0_degrees(conveyor: lw.Mechanism) -> None:
    motion = lw.solve_motion(conveyor, at=0.0)
    links = [motion.link(name) for name in ("coupler", "rocker", "rod")]
    assert [link.angular_velocity[0] for link in links] == pytest.approx(
        [-1.834732, 15.837381, -11.728288], abs=1e-6
    )
    accelerations = [link.angular_acceleration[0] for link in links]
    assert accelerations == pytest.approx([1950.2000, 2386.1162, -1741.1396], abs=1e-4)
    assert motion.point("F").velocity[0, 0] == pytest.approx(0.779319, abs=1e-6)
    assert motion.point("F").acceleration[0, 0] == pytest.approx(-76.79288, abs=1e-5)


@pytest.mark.parametrize(
    ("crank", "torque"), [(0, 2102.0), (60, 7011.6), (120, -3827.1), (180, -3811.9), (300, 176231.8)]
)
def test_balancing_torque(conveyor: lw.Mechanism, crank: float, torque: float) -> None:
    forces = lw.solve_forces(lw.solve_motion(conveyor, at=np.radians(crank)))
    assert forces.input_torque[0] == pytest.approx(torque, abs=0.051)
    assert forces.input_torque_from_power[0] == pytest.approx(forces.input_torque[0], rel=1e-9)

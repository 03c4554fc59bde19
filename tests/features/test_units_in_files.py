"""Parameters of laws and lengths that change and are written, tables that begin elsewhere, names that cannot be."""

import math
import re

import numpy as np
import pytest
from tests.refusals import findings, refused, said

import linkwright as lw
from linkwright import units

LENGTH, FORCE, NONE = units.DIMENSIONS["length"], units.DIMENSIONS["force"], units.NONE


FOUR_BAR = """\
format: 1
parameters: {amplitude: 30 deg, period: 2 s, l: 1 m}
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: l}
  coupler: {points: [A, B], length: 3.5 m}
  rocker: {points: [O2, B], length: 3 m}
assembly: {B: left}
driver: {turn: crank, about: O1, position: amplitude*sin(2*pi*t/period)}
cycle: {duration: 2 s}
"""


def test_parameters_of_a_law_follow_their_changes() -> None:
    model = lw.loads(FOUR_BAR)
    for amplitude, period in ((math.radians(30), 2.0), (0.2, 5.0)):
        changed = model.with_dimensions({"amplitude": amplitude, "period": period})
        motion = lw.solve_motion(changed, times=np.linspace(0.0, 1.9, 20))
        phase = 2 * np.pi * motion.time / period
        crank = motion.link("crank")
        np.testing.assert_allclose(crank.angle, amplitude * np.sin(phase), atol=1e-14)
        rate = amplitude * 2 * np.pi / period
        np.testing.assert_allclose(crank.angular_velocity, rate * np.cos(phase), atol=1e-13)
        np.testing.assert_allclose(
            crank.angular_acceleration, -rate * 2 * np.pi / period * np.sin(phase), atol=1e-12
        )
    again = lw.loads(lw.dump(model))
    assert again.drivers == model.drivers


def test_a_changed_length_is_written_in_place_of_its_expression() -> None:
    """What was an expression of a parameter becomes the number; what still follows the parameter stays one."""
    model = lw.loads(FOUR_BAR)
    kept = lw.dump(model.with_dimensions({"l": 1.1}))
    assert re.search(r"l: 1\.1 m", kept) and re.search(r"crank: \{points: \[O1, A\], length: l", kept)
    loose = lw.dump(model.with_dimensions({"crank.length": 0.75}))
    assert re.search(r"crank: \{points: \[O1, A\], length: 0\.75 m", loose)
    assert lw.loads(loose).dimension("crank.length") == 0.75
    assert lw.loads(loose).with_dimensions({"l": 2.0}).dimension("crank.length") == 0.75
    assert lw.loads(kept).with_dimensions({"l": 2.0}).dimension("crank.length") == 2.0


def test_a_changed_bent_link_is_written_with_its_lengths_and_angle() -> None:
    text = FOUR_BAR.replace(
        "coupler: {points: [A, B], length: 3.5 m}",
        "coupler: {points: [A, B, P], lengths: [3.5 m, 1 m], angle: 30 deg, mass: 2 kg, inertia: 1 kg·m²}",
    )
    changed = lw.loads(text).with_dimensions(
        {"coupler.lengths.1": 1.25, "coupler.angle": -0.5, "coupler.mass": 3.0, "coupler.inertia": 2.5}
    )
    again = lw.loads(lw.dump(changed)).links["coupler"]
    assert (again.lengths, again.angle, again.mass, again.inertia) == ((3.5, 1.25), -0.5, 3.0, 2.5)
    assert again.points["P"] == pytest.approx((1.25 * math.cos(-0.5), 1.25 * math.sin(-0.5)), rel=1e-15)


@pytest.mark.parametrize("start", [0.0, 0.4, -1.3, 7.0])
def test_a_torque_table_may_begin_anywhere(start: float) -> None:
    """Straight lines between (start + 0, 1, 3) rad: mean and work by trapezes, values by hand, periodic in 4 rad."""
    angles = [start, start + 1.0, start + 3.0]
    curve = lw.TorqueCurve.from_table(angles, [10.0, 30.0, -10.0], period=4.0)
    np.testing.assert_allclose(curve(np.array(angles)), [10.0, 30.0, -10.0], atol=1e-12)
    np.testing.assert_allclose(curve(np.array([0.5, 2.0, 3.5]) + start), [20.0, 10.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(curve(np.array([0.5, 2.0, 3.5]) + start + 8.0), [20.0, 10.0, 0.0], atol=1e-12)
    assert curve.mean == pytest.approx((20.0 + 20.0 + 0.0) / 4.0, abs=1e-12)
    (low, at_low), (high, at_high) = sorted((value, place) for place, value in curve.extremes())
    assert (low, high) == (pytest.approx(-10.0), pytest.approx(30.0))
    for place, expected in ((at_low, start + 3.0), (at_high, start + 1.0)):
        assert math.cos(2 * math.pi * (place - expected) / 4.0) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize(
    ("pivot", "coupler", "missing", "least"), [(7.0, 2.0, 1.0, False), (0.4, 5.0, 1.4, True)]
)
def test_what_is_missing_is_said_as_a_positive_length(
    pivot: float, coupler: float, missing: float, least: bool
) -> None:
    """The pins A (1, 0) and O2 are |pivot - 1| apart; the bars reach coupler + 3 m and need |coupler - 3| m."""
    text = FOUR_BAR.replace("O2: [4 m, 0 m]", f"O2: [{pivot} m, 0 m]").replace("3.5 m", f"{coupler} m")
    motion = lw.solve_motion(lw.loads(text), times=[0.0], failures="mark")
    sentence = str(motion.outcomes[0].sentence)
    assert not motion.ok[0]
    reach = abs(coupler - 3.0) if least else coupler + 3.0
    told = [float(each) for each in re.findall(r"(-?[\d.]+) m\b", sentence)]
    assert told == pytest.approx([abs(pivot - 1.0), coupler, 3.0, reach, missing], rel=1e-6)


def test_a_name_with_control_characters_is_a_finding_from_files_and_from_code() -> None:
    text = 'name: "a\\e[31m"\n' + FOUR_BAR
    said(findings(text), "control-character", "name", shown="U+001B")
    with refused("control-character", lw.ModelError, shown="U+001B"):
        lw.loads(text)

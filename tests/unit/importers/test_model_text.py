"""The text of a model file for a layout, read back: places, drivers, guides, own lengths."""

import math

import numpy as np
import pytest

import linkwright as lw
from linkwright.importers.layout import Body, Drive, Force, Layout, Slide, Wheels, free_name
from linkwright.importers.model_text import model_text, shortest


def slider_crank(length: float | None = None) -> Layout:
    layout = Layout(name="Pump", unit="mm", precision=1e-9)
    layout.frame.places |= {"O": (0.0, 0.0), "G": (0.1, 0.01)}
    layout.add(Body("crank", {"O": (0.0, 0.0), "A": (0.0, 0.035)}, colour="#aa0000"))
    layout.add(Body("rod", {"A": (0.0, 0.035), "B": (0.1, 0.01)}, length=length, mass=0.5, centre=(0.05, 0.0225)))
    layout.add(Body("piston", {"B": (0.1, 0.01)}))
    layout.slides.append(Slide("guide", "frame", "G", 0.0, "piston", "B"))
    layout.drives.append(Drive(turn="crank", about="O", speed=-math.pi))
    layout.forces.append(Force("push", "piston", "B", (-5.0, 0.0)))
    return layout


def test_reads_back_where_it_lies() -> None:
    text = model_text(slider_crank())
    mechanism = lw.loads(text)
    motion = lw.solve_motion(mechanism, times=[0.0, 0.5])
    assert motion.point("B").position[0] == pytest.approx([0.1, 0.01], abs=1e-12)
    assert motion.point("A").position[0] == pytest.approx([0.0, 0.035], abs=1e-12)
    assert motion.point("A").position[1] == pytest.approx([0.035, 0.0], abs=1e-12)  # clockwise quarter turn
    assert "speed: -30 rpm" in text and "start: 90 deg" in text and 'colour: "#aa0000"' in text
    assert mechanism.links["rod"].mass == 0.5


def test_a_length_of_its_own_goes_before_the_drawing() -> None:
    motion = lw.solve_motion(lw.loads(model_text(slider_crank(length=0.12))), times=[0.0])
    a, b = motion.point("A").position[0], motion.point("B").position[0]
    assert np.hypot(*(b - a)) == pytest.approx(0.12, abs=1e-12) and b[1] == pytest.approx(0.01, abs=1e-12)


def test_a_body_that_disagrees_keeps_its_own_dimensions() -> None:
    layout = slider_crank()
    layout.bodies["rod"].places["A"] = (0.0, 0.03)
    motion = lw.solve_motion(lw.loads(model_text(layout)), times=[0.0])
    assert np.hypot(*(motion.point("B").position[0] - motion.point("A").position[0])) == pytest.approx(
        math.dist((0.0, 0.03), (0.1, 0.01)), abs=2e-9
    )


def test_a_wheel_of_its_centre_only_has_no_direction_but_its_partners_do() -> None:
    layout = Layout()
    layout.frame.places |= {"O": (0.0, 0.0), "Q": (0.06, 0.0)}
    layout.add(Body("arm", {"O": (0.0, 0.0), "A": (0.03, 0.0), "B": (0.05, 0.02)}))
    layout.add(Body("idler", {"A": (0.03, 0.0)}))
    layout.add(Body("planet", {"B": (0.05, 0.02), "P": (0.05, 0.03)}))
    sizes = {"carrier": "arm", "radii": ["10 mm", "10 mm"]}
    layout.wheels.append(Wheels("one", "chain", {"links": ["frame", "idler"], **sizes}))
    layout.wheels.append(Wheels("two", "gear", {"links": ["idler", "planet"], "carrier": "arm", "ratio": -2}))
    layout.drives.append(Drive(turn="arm", about="O", speed=1.0))
    motion = lw.solve_motion(lw.loads(model_text(layout)), times=[0.0, 0.5])
    assert motion.point("P").position[0] == pytest.approx([0.05, 0.03], abs=1e-12)
    b, p = motion.point("B").position[1], motion.point("P").position[1]
    assert math.atan2(*(p - b)[::-1]) == pytest.approx(math.pi / 2 + 0.5 + 2 * 0.5, abs=1e-12)


def test_short_numbers_and_names() -> None:
    assert shortest(35.00000012, 1e-6) == "35" and float(shortest(0.1 + 0.2)) == 0.1 + 0.2
    assert free_name("A 1", {"A_1"}) == "A_1_2"
    assert free_name("12", set()) == "p12" and free_name("", set(), "pin") == "pin"


def test_further_points_of_a_link_with_a_length_are_written_in_its_axes() -> None:
    layout = slider_crank(length=0.12)
    layout.bodies["rod"].places["P"] = (0.0, 0.045)
    text = model_text(layout)
    assert "points: [A, B], length: 120 mm, also: {P: [" in text and "  P:" not in text
    motion = lw.solve_motion(lw.loads(text), times=[0.0, 0.3])
    away = motion.point("P").position - motion.point("A").position
    assert np.hypot(*away.T) == pytest.approx(0.01, abs=1e-9)

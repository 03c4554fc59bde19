"""Which joint forces and driver forces a diagram draws, against numbers of an independent solution in the gallery."""

from __future__ import annotations

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright import Diagram, plot

EXCAVATOR = store.machine("excavator")
#: Times, and what stands in the gallery's file, solved there with Lagrange multipliers; N.
TIMES = np.array([0.0, 1.2, 5.0])
EFFORTS = {
    "boom_lift": [108927.38, 83526.988, 127402.40],
    "stick_swing": [-8191.8528, -8445.2477, -9792.3855],
    "bucket_curl": [-2122.1586, 949.98441, 344.08347],
}
AT_O = np.hypot([65909.070, 34299.578, 94896.049], [67616.295, 56976.583, 64883.495])
AT_S = np.hypot([7546.0331, 8547.0293, 9963.5364], [11733.034, 12509.407, 10844.110])
NEWTONS = {"(N)": 1.0, "(kN)": 1e3}


@pytest.fixture(scope="module")
def forces() -> lw.Forces:
    return store.forces("excavator", 120)


def drawn(axes: object) -> list[tuple[tuple[object, object], np.ndarray]]:
    """Look (colour, dashes) and values in N at :data:`TIMES` of every curve of a panel."""
    factor = next(value for unit, value in NEWTONS.items() if axes.get_ylabel().endswith(unit))
    return [
        ((line.get_color(), line.get_linestyle()), factor * np.interp(TIMES, line.get_xdata(), line.get_ydata()))
        for line in axes.lines
        if len(line.get_xdata()) > 100
    ]


def by_name(diagram: Diagram) -> dict[str, np.ndarray]:
    """Curves by the name that the legend gives to their look."""
    (axes,) = diagram.figure.axes
    (legend,) = diagram.figure.legends
    looks = [(each.get_color(), each.get_linestyle()) for each in legend.legend_handles]
    names = dict(zip(looks, [text.get_text() for text in legend.get_texts()], strict=True))
    assert len(names) == len(looks), "every curve has a look of its own"
    return {names[look]: values for look, values in drawn(axes)}


def test_every_driver_has_a_panel_with_its_own_force(forces: lw.Forces) -> None:
    panels = plot(forces, "torque").figure.axes
    assert len(panels) == len(EFFORTS)
    for axes, (name, expected) in zip(panels, EFFORTS.items(), strict=True):
        assert name in axes.get_ylabel()
        ((_, values),) = drawn(axes)
        assert values == pytest.approx(expected, rel=1e-4)


def test_a_turning_driver_has_a_torque() -> None:
    shaper = store.machine("shaper_quick_return")
    (axes,) = plot(shaper, "torque").figure.axes
    assert axes.get_ylabel().endswith("(N·m)")
    curve = max(axes.lines, key=lambda line: len(line.get_xdata()))
    at = np.interp([0.0, 100.0, 250.0], curve.get_xdata(), curve.get_ydata())
    assert at == pytest.approx([17.089477, -5.0211377, 95.677099], rel=2e-4)


def test_every_joint_is_drawn_once_and_pins_of_several_links_once_for_each(forces: lw.Forces) -> None:
    curves = by_name(plot(forces, "reactions"))
    assert set(curves) == {
        "O",
        "U",
        "S",
        "K1",
        "K2",
        "B",
        "K3",
        "K4",
        "W",
        "L",
        "J (bucket_curl_rod)",
        "J (rocker)",
        "J (tie)",
        "boom_lift",
        "stick_swing",
        "bucket_curl",
    }
    assert curves["O"] == pytest.approx(AT_O, rel=1e-4)
    assert curves["S"] == pytest.approx(AT_S, rel=1e-4)


def test_the_components_of_one_joint_are_those_of_the_force_on_the_link_asked_for(forces: lw.Forces) -> None:
    size, parts = plot(forces, "reactions", joint="O", on="boom").figure.axes
    ((_, values),) = drawn(size)
    assert values == pytest.approx(AT_O, rel=1e-4)
    (_, x), (_, y) = drawn(parts)
    assert x == pytest.approx([-65909.070, -34299.578, -94896.049], rel=1e-4)
    assert y == pytest.approx([-67616.295, -56976.583, -64883.495], rel=1e-4)
    (_, x), (_, y) = drawn(plot(forces, "reactions", joint="O", on="frame").figure.axes[1])
    assert x[0] == pytest.approx(65909.070, rel=1e-4) and y[0] == pytest.approx(67616.295, rel=1e-4)


def test_without_inertia_the_efforts_do_the_work_of_the_weights() -> None:
    """Static: what the cylinders do in a second lifts the weights, Σ F·ds/dt = Σ m·g·dy/dt."""
    motion = lw.solve_motion(EXCAVATOR, times=TIMES)
    lifted = np.zeros(len(TIMES))
    for name, link in every((n, each) for n, each in EXCAVATOR.links.items() if each.mass):
        lifted += link.mass * 9.81 * motion.point(f"{name}.centre").velocity[:, 1]
    done = np.zeros(len(TIMES))
    for axes, name in zip(plot(EXCAVATOR, "torque", static=True).figure.axes, EFFORTS, strict=True):
        ((_, effort),) = drawn(axes)
        done += effort * motion.positions.coordinates[name][1]
    assert done == pytest.approx(lifted, rel=1e-3)

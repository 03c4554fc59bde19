"""Results cannot be changed by accident, are copied and pickled, and show themselves as tables."""

import copy
import pickle
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
import pytest

import linkwright as lw
from linkwright.core.read_only import FrozenDict

CRUSHER = "gallery:jaw_crusher_sixbar"
MECHANISM = lw.load(CRUSHER)
MOTION = lw.solve_motion(MECHANISM, steps=24)
FORCES = lw.solve_forces(MOTION)
ARRAYS: dict[str, Callable[[], Any]] = {
    "angle": lambda: MOTION.link("jaw").angle,
    "direction": lambda: MOTION.link("jaw").direction,
    "angular velocity": lambda: MOTION.link("jaw").angular_velocity,
    "position": lambda: MOTION.point("C").position,
    "velocity": lambda: MOTION.point("jaw.D").velocity,
    "centre": lambda: MOTION.link("jaw").centre.acceleration,
    "joint": lambda: MOTION.joint("A").displacement,
    "time": lambda: MOTION.time,
    "input": lambda: MOTION.input,
    "ok": lambda: MOTION.ok,
    "reaction": lambda: FORCES.reaction("O5", on="jaw"),
    "reaction in axes": lambda: FORCES.reaction("O5", on="jaw", axes="jaw"),
    "torque": lambda: FORCES.input_torque,
    "torque from power": lambda: FORCES.input_torque_from_power,
    "power": lambda: FORCES.power,
    "power residual": lambda: FORCES.power_residual,
    "balance residual": lambda: FORCES.balance_residual,
    "shaking force": lambda: FORCES.shaking_force,
    "shaking moment": lambda: FORCES.shaking_moment,
    "load": lambda: FORCES.load("crushing").force,
}


@pytest.mark.parametrize("name", ARRAYS)
def test_arrays_of_results_are_read_only(name: str) -> None:
    found = ARRAYS[name]()
    before = found.copy()
    with pytest.raises(ValueError, match="read-only"):
        found[0] = 1.0
    np.testing.assert_array_equal(ARRAYS[name](), before)


def results() -> Iterator[tuple[str, Any]]:
    yield "mechanism", MECHANISM
    yield "study", lw.study(MECHANISM, {"crank.length": "90..110 mm:3"}, metrics=["travel"], steps=36)
    yield (
        "sweep",
        lw.sweep(MECHANISM, {"crank.length": np.array([0.09, 0.1])}, outputs=["driver.effort rms"], steps=36),
    )
    yield (
        "sensitivity",
        lw.sensitivity(MECHANISM, of=["driver.effort rms"], by=["jaw.mass", "crank.length"], steps=36),
    )


RESULTS = dict(results())


@pytest.mark.parametrize("name", RESULTS)
def test_mappings_of_results_are_read_only(name: str) -> None:
    result = RESULTS[name]
    mappings = [value for value in vars(result).values() if isinstance(value, Mapping)]
    assert mappings
    for mapping in mappings:
        if not isinstance(mapping, FrozenDict):
            continue
        with pytest.raises(TypeError, match="cannot be changed"):
            mapping["x"] = 1  # type: ignore[index]
        with pytest.raises(TypeError):
            mapping.update(x=1)
    public = [
        each for key, each in vars(result).items() if isinstance(each, Mapping) and not key.startswith("_")
    ]
    assert all(isinstance(each, FrozenDict) for each in public)
    arrays = [each for mapping in public for each in mapping.values() if isinstance(each, np.ndarray)]
    assert not any(array.flags.writeable for array in arrays)


@pytest.mark.parametrize("name", RESULTS)
def test_results_are_copied_and_pickled(name: str) -> None:
    for again in (copy.deepcopy(RESULTS[name]), pickle.loads(pickle.dumps(RESULTS[name]))):
        assert type(again) is type(RESULTS[name])
    if name == "mechanism":
        assert pickle.loads(pickle.dumps(MECHANISM)) == MECHANISM


def test_tables_have_the_input_as_their_index() -> None:
    pytest.importorskip("pandas")
    for result in (MOTION, FORCES):
        frame = result.to_dataframe()
        assert frame.index.name == "driver [rad]"
        np.testing.assert_array_equal(frame.index, MOTION.input)
        assert "jaw.angle [rad]" in frame and "driver [rad]" not in frame


def test_gradients_are_arrays_in_the_order_of_the_dimensions() -> None:
    """Mass and load numbers scale the torque: T = Σ m ∂T/∂m; one at a time against a doubled mass."""
    found = RESULTS["sensitivity"]
    assert found.by == ("jaw.mass", "crank.length")
    gradient = found.gradient("driver.effort rms")
    assert gradient.shape == (2,) and not gradient.flags.writeable
    for place, by in enumerate(found.by):
        size = MECHANISM.dimension(by)
        up, down = (
            lw.sensitivity(
                MECHANISM.with_dimensions({by: size * f}), of=["driver.effort rms"], by=[by], steps=36
            )
            for f in (1 + 1e-5, 1 - 1e-5)
        )
        difference = (up.value("driver.effort rms") - down.value("driver.effort rms")) / (2e-5 * size)
        assert gradient[place] == pytest.approx(difference, rel=1e-6)
        assert found.relative("driver.effort rms")[place] == pytest.approx(
            gradient[place] * size / found.value("driver.effort rms"), rel=1e-12
        )


def test_notebooks_show_tables() -> None:
    shown = {
        "transmission": lw.metrics(MOTION)._repr_html_(),
        "best": lw.compare([CRUSHER, "gallery:jaw_crusher_fourbar"], steps=72)._repr_html_(),
        **{name: RESULTS[name]._repr_html_() for name in ("study", "sweep", "sensitivity")},
    }
    for name, html in shown.items():
        assert html.startswith("<table>") and "</table>" in html and html.count("<tr>") > 1, name
    assert "transmission angle" in shown["transmission"]
    assert "jaw.mass" in shown["sensitivity"]
    hostile = MECHANISM.with_dimensions({})
    object.__setattr__(hostile, "name", "<script>")
    assert "<script>" not in lw.metrics(lw.solve_motion(hostile, steps=36))._repr_html_()


def test_pictures_are_public() -> None:
    assert lw.draw(MOTION).svg.startswith("<svg")
    assert lw.plot(MOTION) is not None
    assert lw.animate(MOTION, frames=4) is not None

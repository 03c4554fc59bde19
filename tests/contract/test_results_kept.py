"""Results cannot be changed by accident, are copied and pickled, and show themselves as tables."""

import copy
import pickle
from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw

CRUSHER = "gallery:jaw_crusher_sixbar"
machine = partial(store.machine, "jaw_crusher_sixbar")
motion = partial(store.motion, "jaw_crusher_sixbar", 24)
forces = partial(store.forces, "jaw_crusher_sixbar", 24)
ARRAYS: dict[str, Callable[[], Any]] = {
    "angle": lambda: motion().link("jaw").angle,
    "direction": lambda: motion().link("jaw").direction,
    "angular velocity": lambda: motion().link("jaw").angular_velocity,
    "position": lambda: motion().point("C").position,
    "velocity": lambda: motion().point("jaw.D").velocity,
    "centre": lambda: motion().link("jaw").centre.acceleration,
    "joint": lambda: motion().joint("A").displacement,
    "time": lambda: motion().time,
    "input": lambda: motion().input,
    "ok": lambda: motion().ok,
    "reaction": lambda: forces().reaction("O5", on="jaw"),
    "reaction in axes": lambda: forces().reaction("O5", on="jaw", axes="jaw"),
    "torque": lambda: forces().input_torque,
    "torque from power": lambda: forces().input_torque_from_power,
    "power": lambda: forces().power,
    "power residual": lambda: forces().power_residual,
    "balance residual": lambda: forces().balance_residual,
    "shaking force": lambda: forces().shaking_force,
    "shaking moment": lambda: forces().shaking_moment,
    "load": lambda: forces().load("crushing").force,
}


@pytest.mark.parametrize("name", ARRAYS)
def test_arrays_of_results_are_read_only(name: str) -> None:
    found = ARRAYS[name]()
    before = found.copy()
    with pytest.raises(ValueError, match="read-only"):
        found[0] = 1.0
    np.testing.assert_array_equal(ARRAYS[name](), before)


RESULTS: dict[str, Callable[[], Any]] = {
    "mechanism": machine,
    "study": lambda: lw.study(machine(), {"crank.length": "90..110 mm:3"}, metrics=["travel"], steps=36),
    "sweep": lambda: lw.sweep(
        machine(), {"crank.length": np.array([0.09, 0.1])}, outputs=["driver.effort rms"], steps=36
    ),
    "sensitivity": lambda: lw.sensitivity(
        machine(), of=["driver.effort rms"], by=["jaw.mass", "crank.length"], steps=36
    ),
}


@cache
def kept(name: str) -> Any:
    return RESULTS[name]()


@pytest.mark.parametrize("name", RESULTS)
def test_mappings_of_results_are_read_only(name: str) -> None:
    result = kept(name)
    public = {key: each for key, each in vars(result).items() if not key.startswith("_")}
    mappings = every(each for each in public.values() if isinstance(each, Mapping))
    for mapping in mappings:
        with pytest.raises(TypeError):
            mapping["x"] = 1  # type: ignore[index]
        for change in ("update", "pop", "clear", "setdefault"):
            with pytest.raises((TypeError, AttributeError)):
                getattr(mapping, change)("x")
    arrays = [each for mapping in mappings for each in mapping.values() if isinstance(each, np.ndarray)]
    assert name in ("mechanism", "sensitivity") or every(arrays)
    assert not any(array.flags.writeable for array in arrays)


@pytest.mark.parametrize("name", RESULTS)
def test_results_are_copied_and_pickled(name: str) -> None:
    for again in (copy.deepcopy(kept(name)), pickle.loads(pickle.dumps(kept(name)))):
        assert type(again) is type(kept(name))
    if name == "mechanism":
        assert pickle.loads(pickle.dumps(machine())) == machine()


def test_tables_have_the_input_as_their_index() -> None:
    pytest.importorskip("pandas")
    for result in (motion(), forces()):
        frame = result.to_dataframe()
        assert frame.index.name == "driver [rad]"
        np.testing.assert_array_equal(frame.index, motion().input)
        assert "jaw.angle [rad]" in frame and "driver [rad]" not in frame


def test_gradients_are_arrays_in_the_order_of_the_dimensions() -> None:
    """Mass and load numbers scale the torque: T = Σ m ∂T/∂m; one at a time against a doubled mass."""
    found = kept("sensitivity")
    assert found.by == ("jaw.mass", "crank.length")
    gradient = found.gradient("driver.effort rms")
    assert gradient.shape == (2,) and not gradient.flags.writeable
    for place, by in enumerate(found.by):
        size = machine().dimension(by)
        up, down = (
            lw.sensitivity(machine().with_dimensions({by: size * f}), of=["driver.effort rms"], by=[by], steps=36)
            for f in (1 + 1e-5, 1 - 1e-5)
        )
        difference = (up.value("driver.effort rms") - down.value("driver.effort rms")) / (2e-5 * size)
        assert gradient[place] == pytest.approx(difference, rel=1e-6)
        assert found.relative("driver.effort rms")[place] == pytest.approx(
            gradient[place] * size / found.value("driver.effort rms"), rel=1e-12
        )


def test_notebooks_show_tables() -> None:
    shown = {
        "transmission": lw.metrics(motion())._repr_html_(),
        "best": lw.compare([CRUSHER, "gallery:jaw_crusher_fourbar"], steps=72)._repr_html_(),
        **{name: kept(name)._repr_html_() for name in ("study", "sweep", "sensitivity")},
    }
    for name, html in shown.items():
        assert html.startswith("<table>") and "</table>" in html and html.count("<tr>") > 1, name
    assert "coupler" in shown["transmission"] or "pitman" in shown["transmission"]
    assert "jaw.mass" in shown["sensitivity"]
    hostile = machine().with_dimensions({})
    object.__setattr__(hostile, "name", "<script>")
    assert "<script>" not in lw.metrics(lw.solve_motion(hostile, steps=36))._repr_html_()


def test_pictures_are_public() -> None:
    assert lw.draw(motion()).svg.startswith("<svg")
    assert lw.plot(motion()) is not None
    assert lw.animate(motion(), frames=4) is not None

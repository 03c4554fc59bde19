"""Diagrams of comparisons, studies, sweeps, sensitivities, tables of numbers, torque curves, balancings, paths."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.text import Text
from numpy.typing import NDArray
from tests import store
from tests.every import every
from tests.features.chinese import drawn_in_chinese
from tests.refusals import refused

import linkwright as lw
from linkwright import Comparison, Diagram, Study, compare, sensitivity, study, sweep
from linkwright.analysis import coupler_curve, metrics
from linkwright.cli import main
from linkwright.errors import RequestError
from linkwright.machine import Balancing, TorqueCurve, balance

Floats = NDArray[np.float64]

SIX, FOUR = "gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"
ROCKER = store.machine("crank_rocker")


@pytest.fixture(scope="module")
def comparison() -> Comparison:
    return compare([SIX, FOUR], metrics=["travel", "peak_input_torque"], steps=90)


@pytest.fixture(scope="module")
def one() -> Study:
    return study(
        ROCKER, {"coupler.length": "1.013..7 m:20"}, metrics=["transmission_angle", "B.velocity max"], steps=36
    )


@pytest.fixture(scope="module")
def two() -> Study:
    vary = {"coupler.length": "1..5 m:6", "rocker.length": "1500..4000 mm:5"}
    return study(ROCKER, vary, metrics=["travel"], steps=36)


@pytest.fixture(scope="module")
def balanced() -> Balancing:
    return balance(store.machine("slider_crank_inline"), radius=0.1, steps=72)


def words_of(diagram: Diagram) -> set[str]:
    return {text.get_text() for text in diagram.figure.findobj(Text) if text.get_text()}


def named_in_legend(diagram: Diagram) -> set[str]:
    """What the legends of a diagram name."""
    legends = [*diagram.figure.legends, *(axes.get_legend() for axes in diagram.figure.axes)]
    return {text.get_text() for each in legends if each is not None for text in each.get_texts()}


def drawn(axes: Axes, count: int | None = None) -> list[tuple[Floats, Floats]]:
    """Abscissas and ordinates of the lines, or of those that have so many points."""
    found = [(np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)) for line in axes.lines]
    return [(x, y) for x, y in found if count in (None, len(x))]


def test_a_comparison_lays_its_curves_over_each_other(comparison: Comparison) -> None:
    diagram = comparison.plot()
    overlays = [each for each in comparison.curves if each.name != "hodograph"]
    assert diagram.kind == "comparison" and len(diagram.figure.axes) == len(overlays) == 5
    factors = (180 / np.pi, 1.0, 1.0, 1e-3, 1.0)
    for axes, overlay, factor in zip(diagram.figure.axes, overlays, factors, strict=True):
        curves = drawn(axes, 91)
        assert len(curves) == 2
        for (x, y), (passed, values) in every(zip(curves, overlay.lines.values(), strict=True)):
            assert x[:-1] == pytest.approx(np.degrees(passed)) and y[:-1] == pytest.approx(values * factor)
            assert x[-1] == pytest.approx(360.0) and y[-1] == pytest.approx(y[0])  # the curves close
    labels = [axes.get_ylabel() for axes in diagram.figure.axes]
    assert [label.rpartition("\n")[2] for label in labels] == ["(°)", "(rad/s)", "(rad/s²)", "(kN)", "(N·m)"]
    assert diagram.figure.axes[-1].get_xlabel().endswith(" φ (°)")
    assert set(comparison.labels) <= words_of(diagram)


def test_curves_of_a_comparison_are_chosen_by_name(comparison: Comparison) -> None:
    (axes,) = comparison.plot(of="input_torque").figure.axes
    assert len(drawn(axes, 91)) == 2
    with refused("picture.no_curve", RequestError, name="torque", offer="input_torque"):
        comparison.plot(of="torque")
    with refused("picture.not_of_this", RequestError, kind="sva", names=("comparison", "pivot_hodograph")):
        comparison.plot("sva")


def test_the_pivots_hodographs_have_one_scale(comparison: Comparison) -> None:
    (axes,) = comparison.plot("pivot_hodograph").figure.axes
    assert axes.get_aspect() == 1.0 and axes.get_xlabel() == "Fx (kN)"
    forces = next(each for each in comparison.curves if each.name == "hodograph").lines.values()
    for (x, y), (fx, fy) in every(zip(drawn(axes, 91), forces, strict=True), least=2):
        assert x[:-1] == pytest.approx(fx / 1e3) and y[:-1] == pytest.approx(fy / 1e3)
        assert (x[-1], y[-1]) == (x[0], y[0])


def test_outputs_that_turn_and_that_slide_have_panels_of_their_own() -> None:
    found = compare([SIX, "gallery:slider_crank_inline"], metrics=["travel"], output=["jaw", "cylinder"], steps=36)
    figure = found.plot(of=["travel", "velocity"]).figure
    assert [len(drawn(axes, 37)) for axes in figure.axes] == [1, 1, 1, 1]
    assert [axes.get_ylabel().split()[-2:] for axes in figure.axes] == [
        ["θ", "(°)"],
        ["s", "(mm)"],
        ["ω", "(rad/s)"],
        ["v", "(m/s)"],
    ]


def test_a_study_over_one_dimension_is_a_curve_with_its_failures(one: Study) -> None:
    diagram = one.plot()
    angle, speed = diagram.figure.axes
    b = one["coupler.length"]
    for axes, values in ((angle, np.degrees(one["transmission_angle"])), (speed, one["B.velocity max"])):
        x, y = drawn(axes, 20)[0]
        assert x == pytest.approx(b) and y == pytest.approx(values, nan_ok=True)
        crosses = drawn(axes, int((~one.ok).sum()))
        assert len(crosses) == 1 and crosses[0][0] == pytest.approx(b[~one.ok])
    ((x, y),) = drawn(angle, 1)
    best = one.best("transmission_angle")
    assert (x[0], y[0]) == pytest.approx((b[best], np.degrees(one["transmission_angle"][best])))
    assert angle.get_ylabel().endswith("\n(°)") and speed.get_xlabel() == "coupler.length (m)"
    assert len(named_in_legend(diagram)) == 2  # designs that fail, and the best one


def test_a_study_over_two_dimensions_is_a_map(two: Study) -> None:
    figure = two.plot().figure
    axes, bar = figure.axes
    mesh: Any = axes.collections[0]
    values = np.ma.masked_invalid(mesh.get_array()).filled(np.nan)
    expected = np.degrees(two["travel"]).reshape(6, 5).T
    assert values == pytest.approx(expected, nan_ok=True)
    (crosses,) = drawn(axes, int((~two.ok).sum()))
    assert {*zip(*crosses, strict=True)} == {
        *zip(two["coupler.length"][~two.ok], two["rocker.length"][~two.ok] * 1e3, strict=True)
    }
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("coupler.length (m)", "rocker.length (mm)")
    assert bar.get_ylabel().endswith("(°)")


def test_a_sobol_study_is_a_cloud_over_every_dimension() -> None:
    vary = {"coupler.length": "3..3.6 m", "rocker.length": "2.4..2.8 m"}
    found = study(ROCKER, vary, metrics=["travel"], sampling="sobol", samples=16, steps=36)
    axes = found.plot().figure.axes
    assert len(axes) == 2 and found.ok.all()
    for each, name in zip(axes, vary, strict=True):
        ((x, y),) = drawn(each, 16)
        assert x == pytest.approx(found[name]) and y == pytest.approx(np.degrees(found["travel"]))
        assert each.get_xlabel() == f"{name} (m)"


def test_a_study_refuses_what_it_cannot_draw(one: Study) -> None:
    with refused("picture.no_metric", RequestError, name="transmision_angle", offer="transmission_angle"):
        one.plot(of="transmision_angle")
    with refused("picture.same_designs", RequestError):
        study(ROCKER, {"coupler.length": "3 m"}, metrics=["travel"], steps=12).plot()


def test_a_sweep_is_drawn_by_what_varies() -> None:
    lengths = np.linspace(2.8, 3.4, 7)
    found = sweep(ROCKER, {"coupler.length": lengths[::-1]}, outputs=["rocker.angle range"], steps=36)
    (axes,) = found.plot().figure.axes
    ((x, y),) = drawn(axes, 7)
    assert x == pytest.approx(lengths * 1e3)
    assert y == pytest.approx(np.degrees(found["rocker.angle range"])[::-1])
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("coupler.length (mm)", "rocker.angle range\n(°)")


def test_many_designs_are_shown_by_their_number() -> None:
    at = np.random.default_rng(0).uniform(0.0, 1.0, (2, 6000))
    vary = {"coupler.length": 3.0 + 0.5 * at[0], "rocker.length": 2.4 + 0.4 * at[1]}
    found = sweep(ROCKER, vary, outputs=["rocker.angle range"], steps=12)
    for axes in every(found.plot().figure.axes, least=2):
        (cells,) = axes.collections
        assert np.asarray(cells.get_array()).sum() == found.ok.sum() == 6000
    assert len(found.plot().svg()) < 2_000_000


def test_relative_sensitivities_are_bars() -> None:
    by = ["crank.length", "jaw.mass"]
    found = sensitivity(
        store.machine("jaw_crusher_sixbar"), of=["driver.effort rms", "jaw.angle range"], by=by, steps=36
    )
    (axes,) = found.plot().figure.axes
    for bars, name in zip(axes.containers, ("driver.effort rms", "jaw.angle range"), strict=True):
        lengths = [bar.get_width() for bar in bars]
        assert lengths == pytest.approx(found.relative(name))
    assert [text.get_text() for text in axes.get_yticklabels()] == by
    assert axes.get_xlabel().endswith("(%)")
    with refused("picture.not_of_this", RequestError, kind="sensitivity_curves", names=("sensitivity",)):
        found.plot("sensitivity_curves")


def test_sensitivity_curves_are_changes_for_one_per_cent() -> None:
    machine = store.machine("jaw_crusher_sixbar")
    found = sensitivity(machine, of=["jaw.angle", "driver.effort"], by=["crank.length"], steps=36)
    diagram = found.plot()
    angle, effort = diagram.figure.axes
    step = 0.01 * machine.dimension("crank.length")
    for axes, name, factor in ((angle, "jaw.angle", 180 / np.pi), (effort, "driver.effort", 1.0)):
        ((x, y),) = drawn(axes, 36)
        assert x == pytest.approx(np.degrees(found.input))
        assert y == pytest.approx(found.slope(name, "crank.length") * step * factor)
    assert angle.get_ylabel().endswith("jaw.angle\n(°)") and "crank.length + 1 %" in words_of(diagram)


def test_numbers_stand_against_their_limits() -> None:
    table = metrics(store.motion("crank_rocker", 72))
    diagram = table.plot(of="transmission_angle")
    (axes,) = diagram.figure.axes
    rows = table["transmission_angle"]
    (x, _), (limit, _) = drawn(axes)[-1], drawn(axes)[0]
    assert x == pytest.approx(np.degrees([row.value for row in rows]))
    assert limit == pytest.approx([40.0, 40.0])
    assert axes.get_xlabel().endswith("(°)") and len(named_in_legend(diagram)) >= 1
    bare = metrics(store.motion("crank_rocker", 72), "coupler_curve_length")
    with refused("picture.no_limit", RequestError, name="coupler_curve_length"):
        bare.plot()


def test_a_torque_curve_jumps_upright_and_shows_its_mean() -> None:
    """Mean of a trapezium of 100…800 N·m over a quarter, −300 over the rest: 112.5 − 225 N·m."""
    curve = TorqueCurve.from_table(np.radians([0, 90, 90, 360]), [100.0, 800.0, -300.0, -300.0])
    diagram = curve.plot()
    (axes,) = diagram.figure.axes
    x, y = max(drawn(axes), key=lambda each: len(each[0]))
    assert (np.min(y), np.max(y)) == pytest.approx((-300.0, 800.0))
    jump = int(np.argmin(np.diff(y)))
    assert (x[jump], x[jump + 1]) == pytest.approx((90.0, 90.0), abs=1e-6)
    assert (y[jump], y[jump + 1]) == pytest.approx((800.0, -300.0), abs=1e-3)
    assert [text for text in words_of(diagram) if text.endswith(" −112.5 N·m")]
    assert axes.get_ylabel().endswith(" T\n(N·m)")


def test_a_balancing_shows_before_and_after(balanced: Balancing) -> None:
    diagram = balanced.plot()
    force, moment, torque = diagram.figure.axes
    loops = drawn(force, 73)
    assert len(loops) == 2 and np.abs(loops[1]).max() < 1e-6 * np.abs(loops[0]).max()
    assert np.column_stack(loops[0])[:-1] == pytest.approx(balanced.before.shaking_force)
    for axes, name in ((moment, "shaking_moment"), (torque, "input_torque")):
        for (_, y), forces in zip(drawn(axes, 73), (balanced.before, balanced.after), strict=True):
            assert y[:-1] == pytest.approx(getattr(forces, name)) and y[-1] == pytest.approx(y[0])
    assert force.get_xlabel() == "Fx (N)" and moment.get_ylabel().endswith(" M\n(N·m)")
    assert len(named_in_legend(diagram)) == 2


def test_a_coupler_curve_is_closed_and_holds_its_area() -> None:
    motion = store.motion("crank_rocker", 120)
    found = coupler_curve(motion, "coupler.P")
    (axes,) = found.plot().figure.axes
    ((x, y),) = drawn(axes)
    assert np.column_stack([x, y])[:-1] == pytest.approx(motion.point("coupler.P").position * 1e3)
    assert (x[0], y[0]) == (x[-1], y[-1]) and axes.get_xlabel() == "x (mm)"
    shoelace = 0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])
    assert shoelace * 1e-6 == pytest.approx(found.area, rel=2e-3)


def test_double_points_are_ringed() -> None:
    machine = ROCKER.with_dimensions({"coupler.P.x": 4.0, "coupler.P.y": 2.5})
    found = coupler_curve(lw.solve_motion(machine, steps=180), "coupler.P")
    diagram = found.plot()
    (ring,) = drawn(diagram.figure.axes[0], len(found.double_points))
    assert np.column_stack(ring) == pytest.approx(np.array([spot for spot, _ in found.double_points]) * 1e3)
    assert words_of(diagram) > words_of(found.plot(marks=False))


def test_chinese_diagrams_have_no_boxes(comparison: Comparison, two: Study, balanced: Balancing) -> None:
    for result in (comparison, two, balanced):
        diagram = drawn_in_chinese(result)
        assert any("\u4e00" <= letter <= "\u9fff" for letter in "".join(words_of(diagram)))
        assert "<image" not in diagram.svg()


def test_the_commands_draw_what_they_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    curves, map_ = tmp_path / "curves.svg", tmp_path / "map.pdf"
    options = ["--metrics", "travel", "--steps", "36"]
    assert main(["compare", SIX, FOUR, *options, "--plot", str(curves)]) == 0
    assert curves.read_bytes().startswith(b"<?xml") and str(curves) in capsys.readouterr().out
    vary = ["--vary", "coupler.length=3..3.4 m:3", "rocker.length=2.4..2.8 m:3"]
    assert main(["study", "gallery:crank_rocker", *vary, *options, "--plot", str(map_)]) == 0
    assert map_.read_bytes().startswith(b"%PDF") and str(map_) in capsys.readouterr().out
    assert main(["compare", SIX, FOUR, *options, "--plot", str(curves)]) == 2
    assert main(["study", "gallery:crank_rocker", *vary, "--plot", "map.txt"]) == 2

"""Metrics of many designs at once: those of each machine alone, and their derivatives those of differences."""

import numpy as np
import pytest
from tests.invariants.numbers_alone import numbers_alone
from tests.store import machine as stored
from tests.store import motion as moved

import linkwright as lw
from linkwright.analysis import METRICS, metrics
from linkwright.analysis.base import METRICS as REGISTRY
from linkwright.analysis.base import Metric, Number

NAMES = [name for name, metric in METRICS.items() if not metric.on_request and name != "limit_position"]
#: Numbers that are found of each design by itself.
ALONE = ("double_point", "range_of_motion", "singularity")


@pytest.mark.parametrize(
    ("model", "by"),
    [
        ("jaw_crusher_sixbar", "pitman.length"),
        ("swing_conveyor", "rod.length"),
        ("toggle_press", "lower.length"),
        ("shaper_quick_return", "link.length"),
        ("slider_crank_offset", "rod.length"),
    ],
)
def test_every_number_is_that_of_the_machine_alone(model: str, by: str) -> None:
    mechanism = stored(model)
    columns = {by: mechanism.dimension(by) * np.array([1.0, 0.9993, 1.0007])}
    alone = [numbers_alone(mechanism, columns, index, NAMES) for index in (0, 2)]
    assert len(alone[0]) >= 10
    found = lw.sweep(mechanism, columns, outputs=list(alone[0]))
    for index, expected in zip((0, 2), alone, strict=True):
        for name, value in expected.items():
            near = {"rel": 1e-8} if name == "swept_area" else {"rel": 1e-11, "abs": 1e-9}
            assert found[name][index] == pytest.approx(value, **near), name


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("model", "by"),
    [
        ("jaw_crusher_sixbar", "toggle.length"),
        ("swing_conveyor", "rod.length"),
        ("slider_crank_inline", "rod.length"),
    ],
)
def test_numbers_by_arrays_and_compiled_are_equal(model: str, by: str) -> None:
    """Design by design and in blocks, with a design that cannot be assembled among them. Sizes: two extremes of equal
    size and unlike signs govern in turn where the mechanism is symmetrical."""
    mechanism = stored(model)
    columns = {by: mechanism.dimension(by) * np.array([1.0, 0.99, 0.01, 1.01])}
    names = [name for name in numbers_alone(mechanism, {}, 0, NAMES) if name not in ALONE]
    assert len(names) >= 10
    compiled, arrays = (lw.sweep(mechanism, columns, outputs=names, backend=each) for each in ("llvm", "numpy"))
    assert compiled.ok.tolist() == arrays.ok.tolist() == [True, True, False, True]
    for name in names:
        one, other = (np.abs(each[name]) for each in (compiled, arrays))
        assert one == pytest.approx(other, rel=2e-12, abs=1e-12, nan_ok=True), name


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("name", "by"),
    [
        ("peak_reaction O5", ["pitman.length", "jaw.mass"]),
        ("rms_input_torque", ["pitman.length", "jaw.mass"]),
        ("mean_power", ["pitman.length"]),
        ("quick_return_ratio", ["pitman.length"]),
        ("peak_jerk", ["pitman.length"]),
        ("swing_angle", ["pitman.length"]),
        ("peak_input_torque", ["pitman.length"]),
        ("peak_shaking_moment", ["pitman.length"]),
        ("energy_fluctuation", ["pitman.length", "jaw.mass"]),
        ("transmission_angle", ["pitman.length"]),
        ("velocity_ratio", ["pitman.length"]),
    ],
)
def test_gradients_are_those_of_differences_of_machines_alone(name: str, by: list[str]) -> None:
    """The crusher's load jumps at limit positions, which move with the dimensions."""
    mechanism = stored("jaw_crusher_sixbar")
    objective = lw.objective(mechanism, name, vary=by)
    value, gradient = objective(objective.start)
    for place, address in enumerate(by):
        step = 1e-4 * mechanism.dimension(address)
        around = []
        for k in (-2, -1, 1, 2):
            design = mechanism.with_dimensions({address: mechanism.dimension(address) + k * step})
            table = metrics(lw.solve_forces(design), name.split(maxsplit=1)[0])
            around.append(table.value(*name.split()))
        difference = (around[0] - 8 * around[1] + 8 * around[2] - around[3]) / (12 * step)
        assert gradient[place] == pytest.approx(difference, rel=1e-6, abs=1e-8 * abs(value))


def test_a_study_of_many_designs_equals_the_design_alone() -> None:
    """Numbers of the shared output and the flywheel among them; a design that cannot move is left out."""
    mechanism = stored("jaw_crusher_sixbar")
    names = ["travel", "output_acceleration", "pivot_reaction", "flywheel", "energy_fluctuation", "peak_reaction"]
    lengths = mechanism.dimension("rocker.length") * np.array([*np.linspace(0.99, 1.01, 11), 30.0])
    many = lw.study(mechanism, {"rocker.length": lengths}, metrics=names, fluctuation=0.05)
    assert many.ok.tolist() == [True] * 11 + [False]
    one = lw.study(many.design(3), {"jaw.mass": "200 kg"}, metrics=names, fluctuation=0.05)
    same = lw.study(many.design(3), {"gravity.x": [0.0]}, metrics=names, fluctuation=0.05)
    for name in names:
        assert many[name][3] == pytest.approx(same[name][0], rel=1e-11), name
        assert np.isnan(many[name][11])
    assert one["flywheel"][0] != same["flywheel"][0]
    running = lw.steady_running(lw.solve_forces(many.design(3)), fluctuation=0.05)
    assert many["flywheel"][3] == pytest.approx(running.flywheel, rel=1e-9)


def test_a_metric_of_another_package_goes_the_same_way() -> None:
    """Mean force on a joint times the swing of the jaw, registered as anybody may."""

    @REGISTRY.register("pin_work")
    class PinWork(Metric):
        """A number made of two summaries."""

        dimension = "energy"
        source = "a test"
        better = "lower"
        needs_forces = True

        def numbers(self, analysis):
            yield Number("O5", ("reaction O5 on jaw mean", "jaw.angle range"), lambda force, swing: force * swing)

    try:
        mechanism = stored("jaw_crusher_sixbar")
        objective = lw.objective(mechanism, {"pin_work": 2.0, "peak_power": 1e-3}, vary=["toggle.length"])
        value, gradient = objective(objective.start)
        table = metrics(lw.solve_forces(mechanism), ["pin_work", "peak_power"])
        assert value == pytest.approx(2 * table.value("pin_work") + 1e-3 * table.value("peak_power"), rel=1e-12)
        step = 1e-5
        more, less = (objective(objective.start + sign * step)[0] for sign in (1, -1))
        assert gradient[0] == pytest.approx((more - less) / (2 * step), rel=1e-6)
    finally:
        del REGISTRY._elements["pin_work"]


def test_sweeps_and_sensitivities_take_design_numbers() -> None:
    """A mechanism whose designs go side by side, and one with friction."""
    crusher = stored("jaw_crusher_sixbar")
    toggles = crusher.dimension("toggle.length") * np.array([1.0, 1.002, 40.0])
    found = lw.sweep(crusher, {"toggle.length": toggles}, outputs=["peak_reaction O5", "driver.effort max"])
    assert found.ok.tolist() == [True, True, False]
    alone = metrics(lw.solve_forces(crusher.with_dimensions({"toggle.length": float(toggles[1])})))
    assert found["peak_reaction O5"][1] == pytest.approx(alone.value("peak_reaction", "O5"), rel=1e-11)
    assert np.isnan(found["peak_reaction O5"][2])
    assert "peak_reaction O5" in found.columns()
    number = next(iter(found.summaries))
    assert found.dimension(number) == "force"

    slopes = lw.sensitivity(crusher, of=["peak_reaction O5", "driver.effort rms"], by=["toggle.length", "jaw.mass"])
    objective = lw.objective(crusher, "peak_reaction O5", vary=["toggle.length", "jaw.mass"])
    value, gradient = objective(objective.start)
    assert slopes.value("peak_reaction O5") == pytest.approx(value, rel=1e-13)
    assert slopes.gradient("peak_reaction O5") == pytest.approx(gradient, rel=1e-11)


def test_gradients_of_sums_are_sums_of_gradients() -> None:
    crusher, by = stored("jaw_crusher_sixbar"), ["toggle.length", "crank.length"]
    names = ["peak_reaction O5", "peak_input_torque", "transmission_angle"]
    draw = np.random.default_rng(0)
    columns = {each: crusher.dimension(each) * draw.uniform(0.99, 1.01, 5) for each in by}
    designs = np.stack(list(columns.values()), axis=1)
    sums = [*({name: 1.0} for name in names), {names[0]: 2.0, names[1]: -3.0}]
    known = [lw.objective(crusher, each, vary=by).many(designs) for each in sums]
    assert known[3][0] == pytest.approx(2 * known[0][0] - 3 * known[1][0], rel=1e-12)
    assert known[3][1] == pytest.approx(2 * known[0][1] - 3 * known[1][1], rel=1e-9)
    # against differences of the values alone
    step = 1e-6 * crusher.dimension("toggle.length")
    ends = [
        lw.sweep(crusher, {**columns, "toggle.length": columns["toggle.length"] + sign * step}, outputs=names)
        for sign in (1, -1)
    ]
    for (values, slopes), name in zip(known, names, strict=False):
        rate = (ends[0][name] - ends[1][name]) / (2 * step)
        assert values == pytest.approx(0.5 * (ends[0][name] + ends[1][name]), rel=1e-7)
        rounding = 1e-15 * np.max(np.abs(values)) / step
        assert slopes[:, 0] == pytest.approx(rate, rel=1e-5, abs=rounding)


def test_a_slider_that_its_guide_presses_from_both_sides_has_the_numbers_of_the_machine_alone() -> None:
    rubbing = lw.loads(
        """
format: 1
name: rubbing slider-crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.2 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.7 m, mass: 2 kg, inertia: 0.05 kg·m²}
  piston: {points: [B], mass: 3 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B, friction: 0.1}}
driver: {turn: crank, about: O, speed: 120 rpm}
"""
    )
    found = lw.sweep(rubbing, {"rod.length": [0.7, 0.71]}, outputs=["rms_input_torque", "stroke"])
    alone = metrics(lw.solve_forces(rubbing.with_dimensions({"rod.length": 0.71})))
    for name in ("rms_input_torque", "stroke"):
        assert found[name][1] == pytest.approx(alone.value(name), rel=1e-12)


@pytest.mark.parametrize("name", ["stephenson_sixbar", "whitworth", "double_slider"])
def test_masses_alone_take_no_work_in_a_cycle(name: str) -> None:
    """What is left of the mean power by rounding is shown as zero."""
    forces = lw.solve_forces(moved(name, 72))
    assert np.abs(forces.input_torque).max() > 0.1
    assert lw.metrics(forces, ["mean_power"]).value("mean_power") == 0.0


ROTOR = """
format: 1
name: Rotor on an eccentric, without load
frame: {points: {O: [0 mm, 0 mm]}}
links:
  shaft: {points: [O, C], length: 15 mm}
  rotor: {points: {C: [0 mm, 0 mm], T: [105 mm, 0 mm]}, mass: 4 kg, inertia: 0.012 kg·m², mass_centre: [0 mm, 0 mm]}
joints: {teeth: {kind: gear, links: [frame, rotor], teeth: [30, 45], mesh: internal, module: 2 mm}}
driver: {turn: shaft, about: O, speed: 3000 rpm}
cycle: {turns: 3}
"""


@pytest.mark.parametrize("asked", [None, ["peak_input_torque", "peak_power", "energy_fluctuation"]])
def test_torques_and_powers_that_are_nothing_beside_the_forces_are_zero(asked: list[str] | None) -> None:
    """A rotor that turns steadily on an eccentric at a third of the shaft's speed needs no torque."""
    forces = lw.solve_forces(lw.loads(ROTOR))
    table = metrics(forces, asked)
    for name in ("peak_input_torque", "peak_power", "energy_fluctuation"):
        assert table.value(name) == 0.0
    assert metrics(forces).value("peak_reaction", "C") == pytest.approx(4 * 0.015 * (100 * np.pi) ** 2)


def test_a_constant_power_is_its_mean_over_inputs_of_ones_own() -> None:
    """40 N·m on the wheel of twice the teeth at 600 rpm: 20 · 20 π W at the motor, however uneven the inputs."""
    motion = lw.solve_motion(stored("external_gear_pair"), at=[0.0, 0.1, 0.9, 1.0, 3.0])
    assert lw.metrics(lw.solve_forces(motion), ["mean_power"]).value("mean_power") == pytest.approx(400 * np.pi)

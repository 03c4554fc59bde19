"""What is found of all designs at once: nothing is found one by one, and every design is certain."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from tests.invariants.fourbars import four_bars
from tests.invariants.loaded_presses import GEARED, LOADS, MODEL, OTHER_WAY
from tests.invariants.loaded_presses import machine as press
from tests.invariants.loaded_sliders import (
    BETWEEN_LIMITS,
    ON_THE_PLATE,
    ONE_WAY,
    SEVERAL_TURNS,
    TO_AND_FRO,
    TWO_DRIVERS,
    UNEVEN,
    pushed_triad,
)
from tests.invariants.loaded_sliders import LOADS as SLIDER_LOADS
from tests.invariants.loaded_sliders import machine as slider
from tests.invariants.pendulum import PENDULUM
from tests.invariants.rams import BETWEEN, COURSES, INWARDS, RAM, ram
from tests.invariants.rubbing import PAIR, YOKE, rubbing
from tests.invariants.turned_cams import GEARED as CAM_BEHIND_GEARS
from tests.invariants.turned_cams import ROCKING
from tests.invariants.turned_cams import UNEVEN as CAM_ON_A_LINKAGE
from tests.store import machine as stored

import linkwright as lw
from linkwright.analysis import METRICS
from linkwright.analysis.of_designs import NumbersOfDesigns, numbers_of_designs
from linkwright.cycle.solved import Solved
from linkwright.designs.metrics_of_designs import side_by_side
from linkwright.designs.prepared import Prepared
from linkwright.designs.sweep_run import SweepRun

NAMES = [name for name, metric in METRICS.items() if not metric.on_request]
#: What sweeps find of the positions of all designs at once: machines with a dimension and an output.
SWEPT: dict[str, tuple[Callable[[], lw.Mechanism], str, str]] = {
    **{
        f"friction, {name}": (lambda name=name: rubbing(stored(name), 0.05), address, "input_torque rms")
        for name, address in (
            ("jaw_crusher_sixbar", "toggle.length"),
            ("swing_conveyor", "crank.length"),
            ("shaper_quick_return", "crank.length"),
            ("slider_crank_inline", "rod.length"),
            ("triad", "plate.R.x"),
            ("stephenson_sixbar_triad", "bar.length"),
            ("planetary_two_inputs", "O.friction"),
            ("chain_drive", "O.friction"),
            ("printing_press", "A.friction"),
        )
    },
    "friction, four-bars": (lambda: rubbing(four_bars(7), 0.05, 0.005), "P1.friction", "input_torque rms"),
    "friction, yoke": (lambda: lw.loads(YOKE), "yoke.mass", "input_torque rms"),
    **{
        f"{law}, {load}": (
            lambda law=law, load=load: slider(law, SLIDER_LOADS[load]),
            "rod.length",
            "driver.effort rms",
        )
        for law in (TO_AND_FRO, UNEVEN, SEVERAL_TURNS)
        for load in SLIDER_LOADS
    },
    **{
        f"{law}, {load}": (
            lambda law=law, load=load: slider(law, BETWEEN_LIMITS[load]),
            "rod.length",
            "driver.effort rms",
        )
        for law in ONE_WAY
        for load in BETWEEN_LIMITS
    },
    "two drivers": (lambda: lw.loads(TWO_DRIVERS), "arm.length", "second.effort rms"),
    **{
        f"triad, {load}": (lambda load=load: pushed_triad(load), "plate.R.x", "driver.effort rms")
        for load in ON_THE_PLATE
    },
}


@pytest.mark.rotating
@pytest.mark.parametrize("name", SWEPT)
def test_a_sweep_solves_no_design_by_itself(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    make, address, output = SWEPT[name]
    machine = make()
    monkeypatch.setattr(SweepRun, "_alone", lambda *_, **__: pytest.fail("found one by one"))
    values = machine.dimension(address) * np.array([1.0, 0.998])
    assert lw.sweep(machine, {address: values}, outputs=[output], steps=24).ok.all()


@pytest.mark.parametrize(
    ("name", "address"), [("jaw_crusher_sixbar", "toggle.length"), ("shaper_quick_return", "slot.friction")]
)
def test_a_prepared_machine_with_friction_is_not_solved_by_itself(
    name: str, address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = rubbing(stored(name), 0.05)
    prepared = lw.prepare(machine, vary=[address])
    monkeypatch.setattr(Prepared, "_solve_alone", lambda *_: pytest.fail("solved by itself"))
    found = prepared.solve({address: 0.995 * machine.dimension(address)})
    assert np.isfinite(found.input_torque).all()


def found(machine: lw.Mechanism, by: list[str], names: list[str]) -> NumbersOfDesigns:
    cycle = numbers_of_designs(machine, by, names)
    assert cycle is not None
    return cycle


def ram_between(course: str, load: str) -> lw.Mechanism:
    law, cycle, *_ = INWARDS[course]
    return lw.loads(RAM.replace("LAW", law).replace("CYCLE", cycle).replace("LOAD", f"direction: 0 deg, {load}"))


#: Metrics of which every design is certain, all of them of one formula: machines, dimensions, numbers.
CERTAIN: dict[str, tuple[Callable[[], lw.Mechanism], list[str], list[str]]] = {
    **{
        f"ram, {course}, {load}": (
            lambda course=course, load=load: ram_between(course, load),
            ["crank.length", "rod.length"],
            ["mean_power"],
        )
        for course in INWARDS
        for load in BETWEEN
    },
    **{
        f"dry ram, {course}": (
            lambda course=course: rubbing(ram(course, "opposes: velocity, magnitude: 100 N")),
            ["rod.length", "crank.length"],
            ["rms_input_torque", "mean_power", "peak_power", "peak_reaction"],
        )
        for course in ("to and fro", "part of a turn", "program")
    },
    **{
        f"press, {load}": (lambda load=load: press(load), ["rod.length"], ["rms_input_torque", "peak_reaction"])
        for load in LOADS
        if load != "table of output"
    },
    **{
        f"press backwards, {load}": (
            lambda load=load: lw.loads(MODEL.replace("LOAD", OTHER_WAY[load]).replace("120 rpm", "-120 rpm")),
            ["rod.length"],
            ["rms_input_torque", "peak_reaction"],
        )
        for load in OTHER_WAY
    },
    **{
        f"press behind wheels, {load}": (
            lambda load=load: lw.loads(GEARED.replace("LOAD", LOADS[load])),
            ["rod.length"],
            ["rms_input_torque", "peak_reaction A"],
        )
        for load in ("ramp while moving", "last share", "free ends", "input", "table")
    },
    "cam behind gears": (
        lambda: lw.loads(CAM_BEHIND_GEARS),
        ["lobe.phase", "lobe.base_radius", "slide.mass"],
        ["rms_input_torque", "peak_reaction", "mean_power", "peak_jerk", "stroke"],
    ),
    "cam on a linkage": (
        lambda: lw.loads(CAM_ON_A_LINKAGE),
        ["coupler.length", "slide.mass", "lobe.phase"],
        ["rms_input_torque", "peak_input_torque"],
    ),
    "rocking cam": (lambda: lw.loads(ROCKING), ["lobe.phase", "slide.mass"], ["rms_input_torque", "peak_reaction"]),
    "printing press": (
        lambda: stored("printing_press"),
        ["rod.length"],
        ["peak_reaction", "rms_reaction", "rms_input_torque", "mean_power"],
    ),
    "dry crusher": (
        lambda: rubbing(stored("jaw_crusher_sixbar"), 0.05),
        ["toggle.length", "jaw.mass"],
        ["rms_input_torque", "mean_power", "energy_fluctuation", "peak_reaction O5"],
    ),
    "dry shaper": (
        lambda: rubbing(stored("shaper_quick_return"), 0.05),
        ["crank.length", "ram.mass"],
        ["rms_input_torque", "mean_power", "energy_fluctuation", "peak_reaction O3"],
    ),
    "wheels one above the other": (lambda: lw.loads(PAIR), ["wheel.mass"], ["rms_reaction Q"]),
    "true speed of a dry crusher": (
        lambda: rubbing(stored("jaw_crusher_sixbar").with_dimensions({"crank.inertia": 20.0}), 0.05),
        ["toggle.length"],
        ["speed_fluctuation", "exact_flywheel"],
    ),
}


@pytest.mark.rotating
@pytest.mark.parametrize("name", CERTAIN)
def test_every_design_is_certain(name: str) -> None:
    make, by, names = CERTAIN[name]
    machine = make()
    cycle = found(machine, by, names)
    assert set(cycle.kinds) == set(names)
    columns = {address: machine.dimension(address) * np.array([1.0, 1.001]) for address in by}
    _, certain = cycle.evaluate(columns, backend="numpy")
    assert certain.all()


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("model", "by", "many"),
    [
        ("jaw_crusher_sixbar", "pitman.length", 10),
        ("swing_conveyor", "rod.length", 10),
        ("toggle_press", "lower.length", 10),
        ("shaper_quick_return", "link.length", 10),
        ("slider_crank_offset", "rod.length", 10),
        ("excavator", "rocker.length", 5),
        ("kite", "crank.length", 5),
        ("dyad_rrr", "crank_1.length", 5),
        ("double_slider", "bar.length", 5),
    ],
)
def test_most_numbers_of_the_gallery_are_formulas(model: str, by: str, many: int) -> None:
    machine = stored(model)
    cycle = found(machine, [by], NAMES)
    assert len(cycle.kinds) >= many
    _, certain = cycle.evaluate({by: machine.dimension(by) * np.array([1.0, 0.9993, 1.0007])})
    assert certain.all() if many == 10 else certain.any()


@pytest.mark.rotating
def test_numbers_of_a_followed_group_are_formulas() -> None:
    machine = stored("triad")
    first, *_ = side_by_side(machine, ["crank.A.x"], NAMES)
    assert len(first.kinds) >= 18
    lengths = np.array([machine.dimension("crank.A.x"), 0.09])
    assert first.evaluate({"crank.A.x": lengths})[1].tolist() == [True, False]


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
    machine = stored(model)
    cycle, factors = found(machine, [by], NAMES), np.linspace(0.98, 1.02, 300)
    factors[7] = 0.01
    columns = {by: machine.dimension(by) * factors}
    (compiled, certain), (arrays, sure) = (cycle.evaluate(columns, backend=each) for each in ("llvm", "numpy"))
    assert not certain[7]
    assert (certain == sure).all()
    assert certain.sum() > 290
    for name, values in arrays.items():
        assert np.abs(compiled[name][sure]) == pytest.approx(np.abs(values[sure]), rel=2e-12, abs=1e-12), name


def test_gradients_of_several_numbers_from_one_evaluation_are_those_of_each() -> None:
    crusher, by = stored("jaw_crusher_sixbar"), ["toggle.length", "jaw.mass", "crank.length"]
    names = ["peak_reaction O5", "peak_input_torque", "transmission_angle"]
    cycle, draw = found(crusher, by, names), np.random.default_rng(0)
    columns = {each: crusher.dimension(each) * draw.uniform(0.99, 1.01, 5) for each in by}
    sums = [*({name: 1.0} for name in names), {names[0]: 2.0, names[1]: -3.0}]
    values, slopes = cycle.gradients(sums, columns, by)
    for k, name in enumerate(names):
        (value,), (slope,) = cycle.gradients([{name: 1.0}], columns, by)
        assert values[k] == pytest.approx(value, rel=1e-13) and slopes[k] == pytest.approx(slope, rel=1e-11)
    assert values[3] == pytest.approx(2 * values[0] - 3 * values[1], rel=1e-12)
    assert slopes[3] == pytest.approx(2 * slopes[0] - 3 * slopes[1], rel=1e-9)


def test_what_moves_the_inputs_is_left_out() -> None:
    assert numbers_of_designs(stored("kite"), ["driver.speed"], ["transmission_angle"]) is None


def test_designs_may_have_more_limits_than_the_machine_itself() -> None:
    law, cycle, *_ = INWARDS["program"]
    load = "direction: 0 deg, magnitude: 100 N, phase: {of: guide, from: max, to: min}"
    text = RAM.replace("LAW", law.replace("2.6 rad", "2.93 rad")).replace("CYCLE", cycle).replace("LOAD", load)
    machine, names = lw.loads(text), ["mean_power", "rms_input_torque"]
    cycle = found(machine, ["crank.length"], names)
    together, certain = cycle.evaluate({"crank.length": np.array([0.05, 0.09])})
    assert certain.all()
    for k, length in enumerate((0.05, 0.09)):
        alone = lw.metrics(lw.solve_forces(machine.with_dimensions({"crank.length": length})), names)
        for each in alone:
            assert together[each.metric][k] == pytest.approx(each.value, rel=1e-8)


@pytest.mark.parametrize(("speed", "certain"), [(20, False), (45, False), (120, True), (200, True)])
def test_a_pendulum_that_hardly_gets_over_is_not_certain(speed: int, certain: bool) -> None:
    """Where one almost stands still, pieces of its turn are halved, as those of designs side by side are not."""
    machine = lw.loads(PENDULUM.format(speed=speed, torque=-7))
    cycle = found(machine, ["crank.inertia"], ["speed_fluctuation", "slowest_speed", "fastest_speed"])
    assert cycle.evaluate({"crank.inertia": np.array([0.05, 30.0])})[1].tolist() == [certain, True]


@pytest.mark.parametrize("course", COURSES)
def test_a_load_against_a_velocity_is_certain(course: str) -> None:
    machine = ram(course, "opposes: velocity, magnitude: 100 N")
    cycle = found(machine, ["crank.length"], ["mean_power"])
    assert cycle.evaluate({"crank.length": np.array([0.05, 0.051])})[1].all()


def test_bends_of_a_lift_are_passed_on_the_way_to_and_again_on_the_way_back() -> None:
    machine = lw.loads(ROCKING)
    cycle = found(machine, ["lobe.phase", "slide.mass"], ["rms_input_torque", "peak_reaction"])
    kinks = machine.joints["lobe"].kinks
    angle = lw.solve_motion(machine).link("cam").angle
    assert kinks is not None
    there = np.array(kinks.angles) + machine.dimension("lobe.phase")
    passed = np.mod(there - angle.min(), 2.0 * np.pi) < np.ptp(angle)
    solved = Solved(cycle.cycle, {by: np.array([machine.dimension(by)]) for by in cycle.machine.varied})
    assert sum(len(each.time) for each in solved.kinks) == 2 * passed.sum() > 0


def test_a_cam_behind_wheels_takes_no_more_pieces_than_its_bends_ask_for() -> None:
    """Over five turns of the shaft every stretch between bends is as short as those of the cam itself."""
    machine = lw.loads(CAM_BEHIND_GEARS.replace("teeth: [30, 60]", "teeth: [15, 75]"))
    cycle, kinks = found(machine, ["slide.mass"], ["rms_input_torque"]), machine.joints["lobe"].kinks
    assert kinks is not None
    solved = Solved(cycle.cycle, {"slide.mass": np.array([0.5])})
    assert sum(len(each.time) for each in solved.kinks) == len(kinks.angles)
    assert len(solved.pieces.stretch) <= 24 * len(kinks.angles)
    values, _ = cycle.evaluate({"slide.mass": np.array([0.5])})
    (known,) = lw.metrics(lw.solve_forces(machine), "rms_input_torque")
    assert values["rms_input_torque"][0] == pytest.approx(known.value, rel=1e-11)

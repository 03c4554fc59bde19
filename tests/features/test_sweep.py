"""Sweeps against formulas of the textbooks and against solving each design for itself."""

from __future__ import annotations

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.features.scaled import SCALED

import linkwright as lw
from linkwright import sweep

CRANK = np.array([20.0, 35.0, 50.0, 65.0]) / 1000
ROD = np.array([150.0, 400.0, 170.0, 220.0]) / 1000


def test_the_stroke_of_an_in_line_slider_crank_is_twice_the_crank() -> None:
    found = sweep(
        store.machine("slider_crank_inline"),
        {"crank.length": CRANK, "rod.length": ROD},
        outputs=["cylinder.displacement range", "cylinder.displacement argmax", "cylinder.acceleration peak"],
    )
    omega = 1500 * 2 * np.pi / 60
    assert found["cylinder.displacement range"] == pytest.approx(2 * CRANK, rel=1e-13)
    assert np.all(found["cylinder.displacement argmax"] == 0.0)
    # at the outer dead point: r ω² (1 + r/l)
    assert found["cylinder.acceleration", "peak"] == pytest.approx(CRANK * omega**2 * (1 + CRANK / ROD), rel=1e-12)
    assert np.all(found.assembled == 360)
    assert found.failures() == ()


def test_the_smallest_transmission_angle_of_a_crank_rocker() -> None:
    """cos μ = (b² + c² - (d ∓ a)²)/(2 b c) where the crank lies on the frame line."""
    mechanism = store.machine("crank_rocker")
    a, d, c = (mechanism.dimension(name) for name in ("crank.length", "frame.O2.x", "rocker.length"))
    b = np.linspace(3.0, 3.9, 7)
    found = sweep(mechanism, {"coupler.length": b}, outputs=[("transmission_angle B", "min")])
    ends = np.array([np.arccos((b**2 + c**2 - (d + s * a) ** 2) / (2 * b * c)) for s in (1, -1)])
    acute = np.minimum(ends, np.pi - ends).min(axis=0)
    assert found["transmission_angle B min"] == pytest.approx(acute, rel=1e-11)


SWINGING = """
format: 1
name: rocker that swings about 180 degrees
frame: {points: {O: [0 m, 0 m], C: [1.36808057330 m, 3.75877048314 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  coupler: {points: [A, B], length: 4 m}
  rocker: {points: [C, B], length: 2.5 m}
assembly: {B: left}
driver: {turn: crank, about: O, speed: 60 rpm}
"""


def test_the_angles_of_a_rocker_that_swings_about_half_a_turn() -> None:
    """Its limits by the law of cosines, in one swing however the angle is counted."""
    crank = np.array([1.0, 0.9])
    found = sweep(lw.loads(SWINGING), {"crank.length": crank}, outputs=["rocker.angle max", "rocker.angle min"])
    at_pivot = np.array([np.arccos((16 + 6.25 - (4 + side * crank) ** 2) / 20) for side in (1, -1)])
    expected = np.radians(250 - 360) - at_pivot
    assert found["rocker.angle min"] == pytest.approx(expected[0], abs=3e-5)
    assert found["rocker.angle max"] == pytest.approx(expected[1], abs=3e-5)


def test_designs_that_cannot_turn_are_those_that_grashof_excludes() -> None:
    mechanism = store.machine("crank_rocker")
    a, c, d = (mechanism.dimension(name) for name in ("crank.length", "rocker.length", "frame.O2.x"))
    b = np.linspace(1.013, 7.0, 101)
    found = sweep(mechanism, {"coupler.length": b}, outputs=["rocker.angle range", "B.velocity max"])
    turns = (b + c > d + a) & (np.abs(b - c) < d - a)
    assert np.array_equal(found.ok, turns)
    assert np.array_equal(np.isfinite(found["rocker.angle range"]), turns)
    assert np.isfinite(found["B.velocity max"][turns]).all()
    assert sum(failure.count for failure in found.failures()) == int((~turns).sum())
    for failure in every(found.failures()):
        assert (failure.kind, failure.group) == ("unreachable", "coupler+rocker")


def test_partial_summaries_are_those_of_the_reached_positions() -> None:
    mechanism = store.machine("crank_rocker")
    found = sweep(mechanism, {"coupler.length": [2.3]}, outputs=["B.y max"], steps=360, partial=True)
    motion = lw.solve_motion(mechanism.with_dimensions({"coupler.length": 2.3}), failures="mark")
    assert 0 < found.assembled[0] == motion.ok.sum() < 360
    assert found["B.y max"][0] == pytest.approx(np.nanmax(motion.point("B").position[:, 1]), rel=1e-12)


OPEN_AT_180 = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: NOMINAL m}
  coupler: {points: [A, B], length: 3 m, mass: 2 kg}
  rocker: {points: [O2, B], length: 2 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 1 rad/s, start: START deg}
gravity: [0, -9.81 m/s²]
"""


@pytest.mark.parametrize("nominal", ["0.8", "1"])
@pytest.mark.parametrize("start", ["20.5", "0"])
@pytest.mark.parametrize("steps", [12, 36])
def test_designs_barred_at_a_change_point_have_their_reached_positions(steps: int, start: str, nominal: str) -> None:
    """Crank 1 m passes 180° with the other sign, 10 µm more does not, though it can be assembled on both sides; 1.2 m
    is barred for longer. A position on the change point itself has no numbers."""
    mechanism = lw.loads(OPEN_AT_180.replace("START", start).replace("NOMINAL", nominal))
    cranks = [0.8, 1.0, 1.0 + 1e-5, 0.9, 1.2]
    outputs = ["rocker.angular_velocity max", "B.y min", "driver.effort peak"]
    whole, part = (
        sweep(mechanism, {"crank.length": cranks}, outputs=outputs, steps=steps, partial=partial)
        for partial in (False, True)
    )
    for k, crank in enumerate(cranks):
        motion = lw.solve_motion(mechanism.with_dimensions({"crank.length": crank}), steps=steps, failures="mark")
        count = int(motion.ok.sum())
        assert whole.assembled[k] == part.assembled[k] == count
        expected = [
            np.nanmax(motion.link("rocker").angular_velocity),
            np.nanmin(motion.point("B").position[:, 1]),
            np.nanmax(np.abs(lw.solve_forces(motion).input_torque)),
        ]
        for name, value in zip(outputs, expected, strict=True):
            assert part[name][k] == pytest.approx(value, rel=1e-6)
            passes = k in (0, 1, 3) and count == steps
            assert whole[name][k] == (part[name][k] if passes else pytest.approx(np.nan, nan_ok=True))
    assert not whole.ok[2] and not part.ok[2]


def _reductions(values: np.ndarray) -> dict[str, float]:
    return {
        "min": values.min(),
        "max": values.max(),
        "mean": values.mean(),
        "rms": np.sqrt((values**2).mean()),
        "peak": np.abs(values).max(),
        "range": np.ptp(values),
    }


@pytest.mark.parametrize(
    ("name", "varied"),
    [
        ("jaw_crusher_sixbar", {"pitman.length": (1.2, 1.3), "jaw.mass": (500.0, 1200.0)}),
        ("shaper_quick_return", {"crank.length": (0.08, 0.12)}),
        ("triad", {"crank.A.x": (0.026, 0.034), "bar_1.mass": (0.5, 2.0)}),
    ],
)
def test_summaries_are_those_of_every_design_solved_alone(name: str, varied: dict[str, tuple[float, float]]) -> None:
    mechanism = store.machine(name)
    rng = np.random.default_rng(3)
    columns = {a: rng.uniform(*r, 6) for a, r in varied.items()}
    last = list(mechanism.links)[-1]
    joint = next(j for j in mechanism.joints if last in mechanism.joints[j].joined)
    reaction = f"reaction {joint} on {last}"
    kinds = ("min", "max", "mean", "rms", "peak", "range")
    asked = [(output, kind) for output in ("input_torque", reaction, f"{last}.centre.acceleration") for kind in kinds]
    found = sweep(mechanism, columns, outputs=asked, steps=360)
    for index in range(6):
        design = mechanism.with_dimensions({a: float(c[index]) for a, c in columns.items()})
        forces = lw.solve_forces(design)
        curves = {
            "input_torque": forces.input_torque,
            reaction: np.hypot(*forces.reaction(joint, on=last).T),
            f"{last}.centre.acceleration": np.hypot(*forces.motion.link(last).centre.acceleration.T),
        }
        for output, kind in asked:
            expected = _reductions(curves[output])[kind]
            scale = np.abs(curves[output]).max()
            assert abs(found[output, kind][index] - expected) <= 1e-9 * scale, (index, output, kind)


def test_both_back_ends_and_any_number_of_threads_agree() -> None:
    mechanism = store.machine("crank_rocker")
    b = np.linspace(2.0, 4.5, 97)
    outputs = ["B.velocity rms", "coupler.P.x max", "rocker.angle argmax", "closeness min"]
    plain = sweep(mechanism, {"coupler.length": b}, outputs=outputs, backend="numpy")
    one = sweep(mechanism, {"coupler.length": b}, outputs=outputs, backend="llvm", threads=1)
    two = sweep(mechanism, {"coupler.length": b}, outputs=outputs, backend="llvm", threads=2)
    for name, column in every(plain.columns().items()):
        assert np.array_equal(one.columns()[name], two.columns()[name], equal_nan=True)
        assert np.allclose(column, one.columns()[name], rtol=1e-10, atol=1e-12, equal_nan=True)


def test_named_parameters_drive_their_expressions() -> None:
    found = sweep(lw.loads(SCALED), {"r": [0.04, 0.06], "ratio": [3.0, 5.0]}, outputs=["cylinder.displacement max"])
    assert found["cylinder.displacement max"] == pytest.approx([0.04 * 4, 0.06 * 6], rel=1e-13)


def test_progress_counts_designs_and_can_stop() -> None:
    mechanism = store.machine("crank_rocker")
    seen: list[tuple[int, int]] = []
    sweep(
        mechanism,
        {"coupler.length": np.linspace(3, 3.6, 70_000)},
        outputs=["B.x max"],
        steps=4,
        progress=lambda done, of: seen.append((done, of)),
    )
    assert seen[-1] == (70_000, 70_000)
    assert len(seen) > 1


def test_rockers_that_drive_a_rack_and_cannot_turn_are_those_that_grashof_excludes() -> None:
    """Turns of the rocker are counted, and the designs at the ends of the range have no first position."""
    mechanism = store.machine("rack_and_rocker")
    a, b, d = (mechanism.dimension(name) for name in ("crank.length", "coupler.length", "frame.O2.x"))
    c = np.array([0.04, 0.12, 0.25, 0.6, 0.7, 3.0])
    found = sweep(mechanism, {"rocker.length": c}, outputs=["rocker.angle range"], steps=60)
    turns = (b + c > d + a) & (np.abs(b - c) < d - a)
    assert found.ok.tolist() == turns.tolist() == [False, False, True, True, False, False]
    (failure,) = found.failures()
    assert failure.designs.tolist() == np.flatnonzero(~turns).tolist()
    assert failure.kind == "followed"


def test_a_group_followed_by_newton_that_cannot_pass_fails_with_a_sentence() -> None:
    mechanism = store.machine("triad")
    found = sweep(mechanism, {"crank.A.x": [0.03, 0.08]}, outputs=["plate.angle range"])
    assert found.ok.tolist() == [True, False]
    assert np.isnan(found["plate.angle range"][1])
    (failure,) = found.failures()
    assert (failure.kind, failure.designs.tolist()) == ("followed", [1])


PARALLELOGRAM = """
format: 1
name: parallelogram with one heavy link
frame: {points: {O1: [0 m, 0 m], O2: [0.4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.1 m}
  coupler: {points: [A, B], length: 0.4 m, mass: 2 kg}
  follower: {points: [O2, B], length: 0.1 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rad/s, start: 30.5 deg}
gravity: [0, -9.81 m/s²]
"""


def test_designs_that_pass_change_points_go_on_smoothly() -> None:
    """The coupler of a parallelogram only translates, so it needs the torque -m g r cos φ, negative for a gain."""
    mechanism = lw.loads(PARALLELOGRAM)
    masses = np.array([1.0, 2.0, 5.0])
    outputs = ["follower.angular_velocity min", "coupler.angular_velocity peak", "driver.effort peak"]
    found = sweep(mechanism, {"coupler.mass": masses}, outputs=outputs)
    assert found.ok.all()
    assert found["follower.angular_velocity min"] == pytest.approx(10.0, rel=1e-9)
    assert found["coupler.angular_velocity peak"] == pytest.approx(0.0, abs=1e-6)
    assert found["driver.effort peak"] == pytest.approx(masses * 9.81 * 0.1, rel=1e-7)
    lever = np.abs(np.cos(np.radians(30.5 + np.arange(360)))).max()
    sampled = sweep(mechanism, {"coupler.mass": masses}, outputs=outputs, steps=360)
    assert sampled["driver.effort peak"] == pytest.approx(masses * 9.81 * 0.1 * lever, rel=1e-7)


def test_one_design_among_others_that_passes_change_points_is_found() -> None:
    mechanism = lw.loads(PARALLELOGRAM).with_dimensions({"follower.length": 0.15})
    lengths = np.array([0.12, 0.1, 0.14])
    found = sweep(mechanism, {"follower.length": lengths}, outputs=["follower.angular_velocity min"])
    assert found["follower.angular_velocity min"][1] == pytest.approx(10.0, rel=1e-9)


@pytest.mark.parametrize(
    ("model", "load", "varied"),
    [
        (
            "crank_rocker",
            "{kind: force, on: rocker, at: B, direction: 20 deg, "
            "ramp: [10 N, 200 N], phase: {of: rocker, from: min, to: max}}",
            {"coupler.length": (3.0, 4.0), "loads.push.ramp.1": (100.0, 300.0)},
        ),
        (
            "crank_rocker",
            "{kind: force, on: rocker, at: B, direction: 20 deg, "
            "magnitude: 80 N, phase: {of: rocker, from: max, to: min}}",
            {"crank.length": (0.8, 1.2)},
        ),
        (  # the limits of an in-line slider-crank lie on positions, where the rate is zero but for rounding
            "slider_crank_inline",
            "{kind: force, on: piston, at: B, direction: 0 deg, "
            "ramp: [0 N, 9 kN], phase: {of: cylinder, from: max, to: min}}",
            {"rod.length": (0.15, 0.25)},
        ),
    ],
)
def test_loads_between_limit_positions(model: str, load: str, varied: dict[str, tuple[float, float]]) -> None:
    mechanism = lw.loads(f"{lw.dump(store.machine(model))}\nloads: {{push: {load}}}\n")
    columns = {address: np.linspace(*ends, 4) for address, ends in varied.items()}
    found = sweep(mechanism, columns, outputs=["driver.effort rms", "load push max"], steps=360)
    for index in range(4):
        forces = lw.solve_forces(mechanism.with_dimensions({a: float(c[index]) for a, c in columns.items()}))
        torque = forces.input_torque
        assert found["driver.effort rms"][index] == pytest.approx(np.sqrt((torque**2).mean()), rel=1e-9)
        assert found["load push max"][index] == pytest.approx(forces.load("push").magnitude.max(), rel=1e-9)


@pytest.mark.parametrize(("steps", "backend"), [(9, "numpy"), (40, "llvm"), (40, "numpy")])
def test_few_positions_of_groups_followed_by_newton_are_those_asked_for(steps: int, backend: str) -> None:
    """Between them the group is followed in smaller steps, which count for nothing."""
    mechanism = store.machine("triad").with_dimensions({"driver.speed": -6.0})
    bars = mechanism.dimension("plate.R.y") * np.array([1.0, 1.01, 0.99])
    kinds = ("min", "max", "mean", "rms", "range", "peak", "argmin", "argmax")
    outputs = ["plate.angular_velocity", "R.x"]
    asked = [(output, kind) for output in outputs for kind in kinds]
    found = sweep(mechanism, {"plate.R.y": bars}, outputs=asked, steps=steps, backend=backend)
    assert found.assembled.tolist() == [steps] * 3
    assert found.branch_margin is not None and (found.branch_margin > 0).all() and (found.branch_margin <= 1).all()
    for k, length in enumerate(bars):
        motion = lw.solve_motion(mechanism.with_dimensions({"plate.R.y": float(length)}), steps=steps)
        curves = (motion.link("plate").angular_velocity, motion.point("R").position[:, 0])
        for output, curve in zip(outputs, curves, strict=True):
            expected = {
                "min": curve.min(),
                "max": curve.max(),
                "mean": curve.mean(),
                "rms": np.sqrt((curve**2).mean()),
                "range": np.ptp(curve),
                "peak": np.abs(curve).max(),
                "argmin": motion.input[curve.argmin()],
                "argmax": motion.input[curve.argmax()],
            }
            for kind, value in expected.items():
                assert found[output, kind][k] == pytest.approx(value, rel=1e-9, abs=1e-12), (output, kind)


def test_designs_whose_table_is_too_short_are_named_in_every_number() -> None:
    """A force on the piston from 2 to 4 m: a crank of 1.1 m goes further; the others' torque is F ds/dφ."""
    machine = lw.loads(
        """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  rod: {points: [A, B], length: 3 m}
  piston: {points: [B]}
joints: {cylinder: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
driver: {turn: crank, about: O, speed: 10 rad/s}
loads:
  push:
    {kind: force, on: piston, at: B, direction: 180 deg, table: {over: cylinder, x: [2 m, 4 m], y: [5 N, 1 N]}}
"""
    )
    outputs = ["peak_input_torque", "driver.effort peak"]
    found = sweep(machine, {"crank.length": [0.9, 1.1, 1.0]}, outputs=outputs, steps=360)
    turn = np.linspace(0, 2 * np.pi, 36_001)
    for k, crank in ((0, 0.9), (2, 1.0)):
        place = crank * np.cos(turn) + np.sqrt(9 - (crank * np.sin(turn)) ** 2)
        torque = np.abs((9 - 2 * place) * np.gradient(place, turn)).max()
        assert found["peak_input_torque"][k] == pytest.approx(torque, rel=1e-6)
        assert found["driver.effort peak"][k] == pytest.approx(torque, rel=1e-4)
    assert all(np.isnan(found[name][1]) for name in outputs) and found.ok.tolist() == [True, False, True]
    (failure,) = found.failures()
    assert (failure.kind, failure.designs.tolist(), failure.example) == ("load", [1], found.unloaded[1])
    for part in ("loads.push", "cylinder", "2000 mm", "4000 mm", "1900 mm", "4100 mm"):
        assert part in failure.example


def test_positions_that_can_be_put_together_and_positions_that_are_reached() -> None:
    """A crank of 2 m on a frame of 4 m, coupler 3.6 m, rocker 1.5 m: 2.1 m ≤ |A Q| ≤ 5.1 m leaves two stretches of
    the turn, mirrored, of which one way reaches only one."""
    model = lw.Model("two stretches")
    model.frame(O1=(0, 0), O2=(4, 0))
    model.link("crank", ["O1", "A"], length=2)
    model.link("coupler", ["A", "B"], length=3.6)
    model.link("rocker", ["O2", "B"], length=1.5)
    model.drive("crank", about="O1", speed=1)
    model.assemble(B="left")
    mechanism, steps = model.build(), 360
    turn = 2 * np.pi * np.arange(steps) / steps
    away = np.hypot(4 - 2 * np.cos(turn), 2 * np.sin(turn))
    fits = int(((away > 2.1) & (away < 5.1)).sum())
    vary = {"coupler.length": np.array([3.6])}
    whole, part = (
        lw.sweep(mechanism, vary, outputs=["rocker.angular_velocity max"], steps=steps, partial=partial)
        for partial in (False, True)
    )
    assert whole.assembled.tolist() == [fits] and part.assembled.tolist() == [fits // 2]
    assert not whole.ok.any()
    assert lw.solve_motion(mechanism, steps=steps, failures="mark").ok.sum() == fits // 2


def test_an_angle_of_more_than_a_turn_is_taken_design_by_design() -> None:
    """A wheel turned by 7 rad to both sides against a torsion spring: T = (k - J ω²) q."""
    wheel = lw.loads("""
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {wheel: {points: [O, A], length: 1 m, mass: 0 kg, inertia: 0.02 kg·m²}}
driver: {turn: wheel, about: O, position: "7 rad*sin(2*pi*t/(1 s))"}
cycle: {duration: 1 s}
loads: {winding: {kind: torsion_spring, links: [wheel, frame], stiffness: 3 N·m/rad, free_angle: 0 deg}}
""")
    inertia = np.array([0.02, 0.03])
    found = lw.sweep(wheel, {"wheel.inertia": inertia}, outputs="peak_input_torque")
    assert found["peak_input_torque"] == pytest.approx(7.0 * np.abs(3.0 - inertia * 4.0 * np.pi**2), rel=1e-9)


def test_an_output_that_does_not_move_has_an_infinite_advantage() -> None:
    """Two links pinned to each other and to the frame stand still beside a crank."""
    still = lw.loads("""
format: 1
frame: {points: {O: [0 m, 0 m], P: [2 m, 0 m], Q: [3 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.5 m}
  one: {points: [P, B], length: 1 m}
  two: {points: [Q, B], length: 0.8 m}
assembly: {B: left}
driver: {turn: crank, about: O, speed: 2 rad/s}
""")
    found = lw.sweep(still, {"one.length": np.array([0.9, 1.0])}, outputs="mechanical_advantage")
    assert np.isinf(found["mechanical_advantage"]).all()


def test_a_follower_that_rests_all_the_time_has_an_infinite_advantage_beside_a_wheel_that_turns() -> None:
    """A crank rocks within the dwell of its cam; a belt takes a wheel of half its radius along."""
    resting = lw.loads("""
format: 1
frame: {points: {O: [0 m, 0 m], S: [-0.23 m, -0.03 m]}}
links:
  crank: {points: {O: [0 m, 0 m], A: [0.085 m, -0.018 m]}}
  slide: {points: {T: [0 m, 0 m]}}
  wheel: {points: {S: [0 m, 0 m], B: [0.04 m, 0 m]}}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 147.43 deg, block: slide, at: T}
  lobe: {kind: cam, cam: crank, touch: roller, roller_radius: 9 mm, base_radius: 48 mm, phase: 146 deg,
    follower: slide, at: T, program: [{rise: 11 mm, over: 121 deg}, {dwell: 112 deg}, {fall: 11 mm, over: 60 deg},
    {dwell: 67 deg}]}
  belt: {kind: belt, links: [crank, wheel], radii: [0.11 m, 0.055 m], carrier: frame, phase: 0 deg}
driver: {turn: crank, about: O, position: "-20 deg + 17 deg*sin(3.7*t/(1 s))"}
cycle: {duration: 1.698158191669375 s}
""")
    alone = lw.metrics(lw.solve_motion(resting, steps=48))
    swept = lw.sweep(
        resting, {"crank.A.x": np.array([0.085, 0.09])}, outputs=["mechanical_advantage", "velocity_ratio guide"]
    )
    assert np.isinf(alone["mechanical_advantage", "guide"].value)
    assert alone["velocity_ratio", "guide"].value == 0.0
    assert not alone["mechanical_advantage", "guide"].remarks
    assert alone.value("mechanical_advantage") == pytest.approx(0.5, rel=1e-12)
    assert swept["mechanical_advantage"] == pytest.approx(0.5, rel=1e-12)
    assert (swept["velocity_ratio guide"] == 0.0).all()

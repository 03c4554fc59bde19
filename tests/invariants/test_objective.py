"""Values of objectives are those of the machine solved alone, gradients the differences of such solutions."""

from dataclasses import replace

import numpy as np
import pytest
from tests.refusals import refused
from tests.store import forces as loaded
from tests.store import machine as stored
from tests.store import text as text_of

import linkwright as lw

SIXBAR = "jaw_crusher_sixbar"
LENGTHS = ["crank.length", "pitman.length", "rocker.length", "toggle.length", "jaw.length"]


def differences(function, x, share=1e-5):
    found = []
    for i, value in enumerate(x):
        ends = []
        for sign in (1, -1):
            moved = x.copy()
            moved[i] += sign * share * value
            ends.append(function(moved))
        found.append((ends[0] - ends[1]) / (2 * share * value))
    return np.array(found)


def torque_rms(forces):
    return np.sqrt((forces.input_torque**2).mean())


def pivot_peak(forces):
    return np.hypot(*forces.reaction("O5", on="jaw").T).max()


def swing(forces):
    return np.ptp(forces.motion.link("jaw").angle)


@pytest.mark.parametrize("backend", ["numpy", "auto"])
@pytest.mark.parametrize(
    ("term", "number", "names"),
    [
        ("driver.effort rms", torque_rms, [*LENGTHS, "loads.crushing.ramp.1", "jaw.mass", "frame.O3.x"]),
        ("reaction O5 on jaw max", pivot_peak, [*LENGTHS, "loads.crushing.ramp.1"]),
        ("jaw.angle range", swing, LENGTHS),
    ],
)
def test_value_and_gradient_through_the_load_between_limit_positions(term, number, names, backend):
    crusher = stored(SIXBAR)
    f = lw.objective(crusher, term, vary=names, steps=360, backend=backend)
    value, gradient = f(f.start)
    assert value == pytest.approx(number(loaded(SIXBAR)), rel=1e-12)

    def alone(x):
        return number(lw.solve_forces(crusher.with_dimensions(dict(zip(f.names, x, strict=True)))))

    assert gradient == pytest.approx(differences(alone, f.start), rel=2e-6, abs=1e-6 * np.abs(gradient).max())


@pytest.mark.parametrize("direction", ["0 deg", "180 deg"])
def test_a_peak_is_the_larger_side_whatever_its_sign(direction):
    """The farther dead centre of an in-line slider lies at crank plus rod."""
    engine = lw.loads(text_of("slider_crank_inline").replace("direction: 0 deg", f"direction: {direction}"))
    value, gradient = (f := lw.objective(engine, "B.x peak", vary=["crank.length", "rod.length"]))(f.start)
    assert value == pytest.approx(0.25, rel=1e-12) and gradient == pytest.approx([1.0, 1.0], rel=1e-9)


def test_a_load_over_an_interval_of_the_input():
    conveyor = stored("swing_conveyor")
    names = ["coupler.length", "loads.resistance.magnitude"]
    f = lw.objective(conveyor, "driver.effort rms", vary=names, steps=360)
    value, gradient = f(f.start)
    assert value == pytest.approx(torque_rms(lw.solve_forces(conveyor)), rel=1e-12)

    def alone(x):
        return torque_rms(lw.solve_forces(conveyor.with_dimensions(dict(zip(f.names, x, strict=True)))))

    assert gradient == pytest.approx(differences(alone, f.start), rel=2e-6)


def test_weighted_sum_and_many_designs():
    crusher = stored(SIXBAR)
    names = LENGTHS[:2]
    both = lw.objective(crusher, {"driver.effort rms": 2.0, "reaction O5 on jaw max": -0.1}, vary=names)
    one, other = (lw.objective(crusher, t, vary=names) for t in ("driver.effort rms", "reaction O5 on jaw max"))
    table = both.start * np.linspace(0.99, 1.01, 7)[:, None]
    values, gradients = both.many(table)
    assert both.values(table) == pytest.approx(values, rel=1e-13)
    for row, value, gradient in zip(table, values, gradients, strict=True):
        (a, da), (b, db) = one(row), other(row)
        assert value == pytest.approx(2 * a - 0.1 * b, rel=1e-12)
        assert gradient == pytest.approx(2 * da - 0.1 * db, rel=1e-9)


def test_path_error_is_the_mean_square_distance_and_vanishes_on_its_own_path():
    fourbar = stored("crank_rocker")
    names = ["crank.length", "coupler.length", "rocker.length", "coupler.P.x", "coupler.P.y"]
    track = lw.solve_motion(fourbar, steps=60).point("coupler.P").position
    away = np.array([0.01, -0.02])
    f = lw.objective(fourbar, lw.PathError("coupler.P", track + away), vary=names)
    value, gradient = f(f.start)
    assert value == pytest.approx(away @ away, rel=1e-12)
    assert f.values(f.start[None]) == pytest.approx([value], rel=1e-12)

    def alone(x):
        moved = lw.solve_motion(fourbar.with_dimensions(dict(zip(names, x, strict=True))), steps=60)
        return ((moved.point("coupler.P").position - track - away) ** 2).sum(axis=1).mean()

    assert gradient == pytest.approx(differences(alone, f.start), rel=1e-5, abs=1e-8)
    same = lw.objective(fourbar, lw.PathError("coupler.P", track), vary=names)
    assert same(same.start)[0] < 1e-28


def test_scipy_finds_the_dimensions_of_a_path():
    from scipy.optimize import minimize

    fourbar = stored("crank_rocker")
    names = ["crank.length", "coupler.length", "rocker.length", "coupler.P.x", "coupler.P.y"]
    hidden = np.array([fourbar.dimension(name) for name in names]) * [1.03, 0.98, 1.02, 1.05, 0.95]
    target = lw.solve_motion(fourbar.with_dimensions(dict(zip(names, hidden, strict=True))), steps=36)
    f = lw.objective(fourbar, lw.PathError("coupler.P", target.point("coupler.P").position), vary=names)
    found = minimize(f, f.start, jac=True, method="BFGS", options={"gtol": 1e-12})
    assert found.x == pytest.approx(hidden, rel=1e-5)


def test_a_design_that_cannot_turn_has_no_value():
    crusher = stored(SIXBAR)
    f = lw.objective(crusher, "driver.effort rms", vary=["crank.length"])
    value, gradient = f([2.5])
    assert np.isnan(value)
    assert np.isnan(gradient).all()


@pytest.mark.parametrize(
    ("model", "terms", "vary", "code", "values"),
    [
        ("triad", "driver.effort rms", ["A.length"], "study.no_dimension", {"address": "A.length"}),
        (
            "jaw_crusher_sixbar",
            "driver.efort rms",
            ["crank.length"],
            "study.no_such_output",
            {"name": "driver.efort", "offer": "driver.effort"},
        ),
        (
            "jaw_crusher_sixbar",
            "driver.effort argmax",
            ["crank.length"],
            "study.place_without_slope",
            {"name": "driver.effort argmax"},
        ),
        ("jaw_crusher_sixbar", "jaw.angle range", ["jaw.mass"], "study.objective_idle", {"names": ("jaw.mass",)}),
        (
            "jaw_crusher_sixbar",
            "jaw.angle range",
            ["driver.start"],
            "study.moves_positions",
            {"address": "driver.start"},
        ),
    ],
)
def test_refusals_say_why(model, terms, vary, code, values):
    with refused(code, **values):
        lw.objective(stored(model), terms, vary=vary)


def pushed_triad(phase: str, speed: float) -> lw.Mechanism:
    load = f"{{kind: force, on: plate, at: R, direction: 90 deg, ramp: [5 N, 20 N], phase: {{{phase}}}}}"
    text = lw.dump(stored("triad"))
    return lw.loads(f"{text}\nloads: {{push: {load}}}\n").with_dimensions({"driver.speed": speed})


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("phase", "speed", "steps"),
    [("of: plate, from: min, to: max", 6.0, 90), ("of: bar_1, from: max, to: min, last: 0.4", -6.0, 24)],
)
def test_groups_that_newton_solves_have_values_and_gradients(phase, speed, steps):
    """Against each design solved alone and differences of fourth order of these; one design cannot pass."""
    triad = pushed_triad(phase, speed)
    names, target = ["crank.A.x", "plate.R.y", "bar_1.mass"], np.full((steps, 2), 0.2)
    terms = {"driver.effort rms": 1.0, "plate.angular_velocity max": 0.1, lw.PathError("R", target): 40.0}
    f = lw.objective(triad, terms, vary=names, steps=steps)

    def alone(values):
        forces = lw.solve_forces(triad.with_dimensions(dict(zip(names, values, strict=True))), steps=steps)
        gaps = ((forces.motion.point("R").position - target) ** 2).sum(axis=1).mean()
        rms = np.sqrt((forces.input_torque**2).mean())
        return rms + 0.1 * forces.motion.link("plate").angular_velocity.max() + 40.0 * gaps

    far = f.start.copy()
    far[0] = 0.08
    values, gradients = f.many(np.stack([f.start, 1.002 * f.start, far]))
    assert values[:2] == pytest.approx([alone(f.start), alone(1.002 * f.start)], rel=1e-12)
    assert np.isnan(values[2]) and np.isnan(gradients[2]).all()
    assert f.values(np.stack([f.start, far])) == pytest.approx([values[0], np.nan], rel=1e-12, nan_ok=True)
    one = lw.sensitivity(triad, of=["driver.effort rms"], by=names, steps=steps)
    rms = lw.objective(triad, "driver.effort rms", vary=names, steps=steps)
    assert one.gradient("driver.effort rms") == pytest.approx(rms(rms.start)[1], rel=1e-9)
    for k, step in enumerate(1e-3 * f.start):
        a, b, c, d = (alone(f.start + j * step * np.eye(3)[k]) for j in (-2, -1, 1, 2))
        assert gradients[0, k] == pytest.approx((a - 8 * b + 8 * c - d) / (12 * step), rel=1e-7, abs=1e-7)


def test_groups_that_newton_solves_are_refused_at_inputs_and_loads_by_four_limits():
    pushed = pushed_triad("of: bar_2, from: max, to: min", 6.0)
    with refused("study.objective_iterates"):
        lw.objective(pushed, "driver.effort rms", vary=["plate.R.y"], steps=360)
    with refused("study.objective_iterates"):
        lw.objective(stored("triad"), "driver.effort rms", vary=["plate.R.y"], at=[0.0, 0.1])


CIRCLE = np.stack([np.cos(np.arange(9.0)), np.sin(np.arange(9.0))], axis=1)


@pytest.mark.parametrize(
    ("terms", "options", "code", "values"),
    [
        (lw.PathError("coupler.P", CIRCLE[:, :1]), {}, "study.objective_target", {}),
        (
            [lw.PathError("coupler.P", CIRCLE), lw.PathError("coupler.B", CIRCLE[:8])],
            {},
            "study.objective_target",
            {},
        ),
        (
            lw.PathError("coupler.P", CIRCLE),
            {"at": [0.0, 1.0]},
            "study.objective_count",
            {"points": 9, "positions": 2},
        ),
        ("hertz_pressure", {}, "study.no_such_output", {"name": "hertz_pressure"}),
    ],
)
def test_paths_and_numbers_that_cannot_be_a_goal_are_refused(terms, options, code, values):
    with refused(code, **values):
        lw.objective(stored("crank_rocker"), terms, vary=["coupler.length"], **options)


def test_terms_in_a_list_count_once_each_and_values_alone_are_those_of_the_gradient():
    crusher, names = stored(SIXBAR), ["peak_reaction", "rms_input_torque"]
    both = lw.objective(crusher, names, vary=LENGTHS)
    parts = [lw.objective(crusher, name, vary=LENGTHS) for name in names]
    designs = np.stack([both.start, both.start * 1.001])
    alone = [part.values(designs) for part in parts]
    assert both.values(designs) == pytest.approx(alone[0] + alone[1], rel=1e-12)
    assert both(both.start)[0] == pytest.approx(both.values(designs)[0], rel=1e-9)
    assert np.isnan(both.values(designs * [[1, 1, 1, 1, 1], [20, 1, 1, 1, 1]])).tolist() == [False, True]


#: A drag link: the driven crank, which a dyad places, turns fully; a wheel on it, and a rack on the wheel.
DRAG_LINK = """
format: 1
name: drag link with a gear and a rack
frame: {points: {A: [0 m, 0 m], B: [0.1 m, 0 m], C: [0.1 m, 0.3 m], G: [0.2 m, 0 m]}}
links:
  crank: {points: [A, P], length: 0.3 m, mass: 1 kg, inertia: 0.01 kg·m²}
  coupler: {points: [P, Q], length: 0.25 m, mass: 1 kg, inertia: 0.01 kg·m²}
  follower: {points: [B, Q], length: 0.35 m, mass: 2 kg, inertia: 0.03 kg·m²}
  wheel: {points: {C: [0 m, 0 m], W: [0.05 m, 0 m]}, mass: 1 kg, inertia: 0.01 kg·m²}
  rack: {points: {R: [0 m, 0 m]}, mass: 3 kg}
joints:
  mesh: {kind: gear, links: [follower, wheel], ratio: -0.7}
  guide: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: rack, at: R}
  teeth: {kind: rack, pinion: wheel, rack: rack, through: R, radius: 100 mm}
assembly: {Q: left}
driver: {turn: crank, about: A, speed: 30 rpm}
cycle: {turns: 2}
loads: {cut: {kind: force, on: rack, at: R, components: [0 N, 50 N]}}
"""


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("term", "number"),
    [
        ("driver.effort rms", torque_rms),
        ("guide.displacement max", lambda forces: forces.motion.joint("guide").displacement.max()),
    ],
)
def test_wheels_and_racks_on_a_link_that_a_dyad_places(term, number):
    machine = lw.loads(DRAG_LINK)
    names = ["follower.length", "mesh.ratio"]
    f = lw.objective(machine, term, vary=names, steps=36)
    value, gradient = f(f.start)

    def alone(x):
        changed = machine.with_dimensions(dict(zip(f.names, x, strict=True)))
        return number(lw.solve_forces(lw.solve_motion(changed, steps=36)))

    assert value == pytest.approx(alone(f.start), rel=1e-12)
    assert gradient == pytest.approx(differences(alone, f.start), rel=2e-6, abs=1e-6 * np.abs(gradient).max())
    far = f.start * np.array([0.97, 1.4])
    assert f(far)[0] == pytest.approx(alone(far), rel=1e-12)


def test_turns_that_cannot_be_counted_are_refused():
    with refused("study.objective_turns", links=("follower",)):
        lw.objective(lw.loads(DRAG_LINK), "driver.effort rms", vary=["crank.length"], steps=4)


def rack_cutting_one_way() -> lw.Mechanism:
    """The gallery's rack on a rocker, its cutting force between the rack's limit positions alone."""
    machine = stored("rack_and_rocker")
    text = lw.dump(replace(machine, loads={}))
    phase = "phase: {of: slide, from: min, to: max}"
    return lw.loads(
        f"{text}\nloads: {{cut: {{kind: force, on: rack, at: R, direction: 180 deg, magnitude: 200 N, {phase}}}}}\n"
    )


def drag_link_of_one_turn() -> lw.Mechanism:
    """The drag link with a wheel as large as its driven crank's, without the rack: all are back after a turn."""
    left_out = ("rack:", "guide:", "teeth:", "cycle:", "loads:")
    lines = [line for line in DRAG_LINK.splitlines() if not line.strip().startswith(left_out)]
    return lw.loads("\n".join(lines).replace("ratio: -0.7", "ratio: -1"))


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("machine", "names", "number"),
    [
        (rack_cutting_one_way, ["coupler.length", "frame.O2.x"], "rms_input_torque"),
        (rack_cutting_one_way, ["coupler.length", "rocker.length"], "peak_reaction mesh"),
        (rack_cutting_one_way, ["coupler.length", "rocker.length"], "quick_return_ratio slide"),
        (rack_cutting_one_way, ["rocker.length", "frame.O2.x"], "stroke slide"),
        (drag_link_of_one_turn, ["coupler.length", "wheel.mass"], "peak_input_torque"),
        (drag_link_of_one_turn, ["coupler.length", "wheel.inertia"], "peak_reaction B"),
    ],
)
def test_design_numbers_go_through_wheels_on_links_that_a_dyad_places(machine, names, number):
    """Against the numbers of each changed machine alone, and their differences."""
    mechanism = machine()
    f = lw.objective(mechanism, number, vary=names)
    value, gradient = f(f.start)
    name, _, subject = number.partition(" ")

    def alone(x):
        changed = mechanism.with_dimensions(dict(zip(f.names, x, strict=True)))
        found = lw.metrics(lw.solve_forces(changed), [name])
        return found.value(name, subject) if subject else found.value(name)

    assert value == pytest.approx(alone(f.start), rel=1e-10)
    assert gradient == pytest.approx(differences(alone, f.start), rel=2e-6, abs=2e-6 * np.abs(gradient).max())
    away = f.start * np.array([0.97, 1.03])
    assert f.values(away[None, :])[0] == pytest.approx(alone(away), rel=1e-9)


@pytest.mark.rotating
def test_a_force_between_limits_of_a_rack_on_a_rocker_has_its_gradient():
    mechanism = rack_cutting_one_way()
    f = lw.objective(mechanism, "driver.effort rms", vary=["coupler.length", "rocker.length"], steps=360)
    value, gradient = f(f.start)
    assert value == pytest.approx(torque_rms(lw.solve_forces(mechanism)), rel=1e-12)
    assert gradient == pytest.approx(differences(lambda x: f(x)[0], f.start), rel=1e-6)

"""Values that no machine has are findings at their place; masses without inertia get a remark; times of tables."""

import numpy as np
import pytest
from tests.refusals import findings, refused

import linkwright as lw

MODEL = """\
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m, mass: 1 kg, inertia: 1 kg·m²}
  coupler: {points: [A, B], length: 3.5 m, also: {P: [1 m, 1 m]}}
  rocker: {points: [O2, B], length: 3 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rpm}
gravity: [0, -9.81 m/s²]
loads:
  f: {kind: force, on: rocker, at: B, direction: 0 deg, magnitude: 1 N}
"""


def changed(old: str, new: str) -> str:
    assert MODEL.count(old) >= 1
    return MODEL.replace(old, new, 1)


@pytest.mark.parametrize(
    ("old", "new", "where", "key"),
    [
        ("10 rpm", "1e100 rad/s", "8:41", "driver.speed"),
        ("mass: 1 kg", "mass: 1e308 kg", "4:47", "links.crank.mass"),
        ("[4 m, 0 m]", "[1e150 m, 0 m]", "2:39", "frame.points.O2.x"),
        ("[4 m, 0 m]", "[4 m, -1e150 m]", "2:44", "frame.points.O2.y"),
        ("length: 1 m", "length: 1e150 m", "4:36", "links.crank.length"),
        ("length: 1 m", "length: 1e-150 m", "4:36", "links.crank.length"),
        ("P: [1 m, 1 m]", "P: [1 m, 1e99 m]", "5:60", "links.coupler.also.P.y"),
        ("-9.81 m/s²", "-1e200 m/s²", "9:14", "gravity.y"),
        ("inertia: 1 kg·m²", "inertia: 1e300 kg·m²", "4:62", "links.crank.inertia"),
        ("magnitude: 1 N", "magnitude: -1e300 N", "11:68", "loads.f.magnitude"),
        ("driver: {turn", "cycle: {duration: 1e-300 s}\ndriver: {turn", "8:19", "cycle.duration"),
        ("format: 1\n", "format: 1\nparameters: {l: 1e200 m}\n", "5:36", "links.crank.length"),
    ],
)
def test_a_size_that_no_machine_has_is_one_finding_at_its_place(old: str, new: str, where: str, key: str) -> None:
    text = changed(old, new)
    if "parameters" in new:
        text = text.replace("length: 1 m", "length: 2*l", 1)
    with refused("range", lw.ModelError) as caught:
        lw.loads(text, "m.yaml")
    (finding,) = caught.value.findings
    assert (finding.where, finding.key, finding.code) == (f"m.yaml:{where}", key, "range")
    assert finding.remedy


@pytest.mark.parametrize(
    ("address", "value"), [("crank.length", 1e150), ("rocker.mass", 1e308), ("driver.speed", -1e99)]
)
def test_a_changed_dimension_that_no_machine_has_is_refused(address: str, value: float) -> None:
    with refused("model.set_beyond", address=address, value=f"{value:g}"):
        lw.loads(MODEL).with_dimensions({address: value})


@pytest.mark.parametrize(
    "law", ["1e200 rad*t/(1 s)", "1 rad*exp(1e3*t/(1 s))", "1 rad*t/(1e-300 s)", "1 rad*sqrt(t/(1 s))"]
)
def test_a_law_without_a_sensible_value_is_refused_with_its_time(law: str) -> None:
    """The root has no rate where the cycle begins."""
    text = changed("speed: 10 rpm}", f"position: {law}}}\ncycle: {{duration: 1 s}}")
    with refused("motion.law_beyond", name="driver") as caught:
        lw.solve_motion(lw.loads(text), steps=24)
    assert 0.0 <= float(str(caught.value.values["time"])) <= 1.0


@pytest.mark.parametrize("magnitude", ["1 N*exp(1000*t/(1 s))", "1e300 N*cos(t/(1 s))", "1e300 N + 0 N*t/(1 s)"])
def test_a_load_without_a_sensible_value_is_refused(magnitude: str) -> None:
    model = lw.loads(changed("magnitude: 1 N", f"magnitude: {magnitude}"))
    with refused("loads.formula_not_finite", name="f"):
        lw.solve_forces(lw.solve_motion(model, steps=24))


def remarks(text: str) -> list[tuple[str, str, str]]:
    return [(each.severity, each.key, each.code) for each in findings(text)]


def test_a_mass_that_turns_without_an_inertia_gets_a_remark() -> None:
    text = changed(", mass: 1 kg, inertia: 1 kg·m²", ", mass: 1 kg")
    assert remarks(text) == [("warning", "links.crank.inertia", "no-inertia")]
    assert remarks(text.replace("mass: 1 kg", "mass: 1 kg, inertia: 0")) == []
    assert remarks(text.replace("mass: 1 kg", "mass: 0")) == []


def test_what_only_slides_or_never_moves_needs_no_inertia() -> None:
    slider = """\
format: 1
frame: {points: {O1: [0 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  rod: {points: [A, B], length: 3 m}
  piston: {points: [B], mass: 2 kg}
joints:
  bore: {kind: prismatic, guide: frame, through: O1, direction: 0 deg, block: piston, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O1, speed: 10 rpm}
"""
    assert [code for _, _, code in remarks(slider)] == []
    frame = "format: 1\nframe: {points: {O: [0 m, 0 m]}}\n"
    hanging = frame + "links:\n  bar: {points: [O, E], length: 1 m, mass: 1 kg}\n"
    assert "no-inertia" not in [code for _, _, code in remarks(hanging)]


TWO_DRIVERS = """\
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [0.2 m, 0.04 m]}}
links:
  crank_1: {points: [O1, A], length: 0.06 m}
  crank_2: {points: [O2, C], length: 0.05 m}
  bar_1: {points: [A, B], length: 0.22 m}
  bar_2: {points: [C, B], length: 0.18 m}
assembly: {B: left}
drivers:
  first: {turn: crank_1, about: O1, speed: 1 rad/s}
  second: {turn: crank_2, about: O2, table: {time: [0 s, 0.5 s, 1 s], position: [0 deg, 10 deg, 15 deg]}}
cycle: {duration: 1 s}
"""


def test_a_table_beside_a_constant_speed_is_taken_where_the_cycle_lies_in_it() -> None:
    motion = lw.solve_motion(lw.loads(TWO_DRIVERS), steps=20)
    assert motion.ok.all() and motion.time[-1] == 1.0
    np.testing.assert_allclose(motion.link("crank_1").angle, motion.time, atol=1e-14)
    t = motion.time
    parabola = (2 * (t - 0.5) * (t - 1) * 0 - 4 * t * (t - 1) * 10 + 2 * t * (t - 0.5) * 15) * np.pi / 180
    np.testing.assert_allclose(motion.link("crank_2").angle, parabola, atol=1e-13)  # through three points: a parabola


@pytest.mark.parametrize("duration", ["1.5 s", "6 s"])
def test_a_cycle_beyond_the_table_is_refused_with_both_ranges(duration: str) -> None:
    text = TWO_DRIVERS.replace("duration: 1 s", f"duration: {duration}")
    with refused("loads.table_range", first=0.0, last=1.0, begin=0.0, end=float(duration.split(maxsplit=1)[0])):
        lw.solve_motion(lw.loads(text), steps=20)


def test_a_load_of_time_alone_follows_the_time() -> None:
    model = lw.loads(
        changed("magnitude: 1 N", 'magnitude: "5 N + 5 N*sin(2*pi*t/(1 s))"').replace("10 rpm", "60 rpm")
    )
    forces = lw.solve_forces(lw.solve_motion(model, steps=24), static=True)
    t = forces.motion.time
    force = forces.load("f").force
    np.testing.assert_allclose(force[:, 0], 5 + 5 * np.sin(2 * np.pi * t), atol=1e-12)


@pytest.mark.parametrize(
    ("magnitude", "value"),
    [
        ("3 t*(9.81 m/s²)", 29430.0),
        ("2 t*9.81 m/s^2", 19620.0),
        ("3 m/s²*t", 3000.0),
        ("5 N", 5.0),
        ("-5 kN", -5000.0),
    ],
)
def test_a_tonne_stays_a_tonne_behind_a_number(magnitude: str, value: float) -> None:
    size = lw.loads(changed("magnitude: 1 N", f"magnitude: {magnitude}")).loads["f"].magnitude.size
    assert size.value == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    "magnitude", ["3 N/s*t", "t*(3 N/s)", "3 N*t/(1 s)", "exp(-t/(2 s))*5 N", "1 N*cos(3 rad/s*t)"]
)
def test_the_time_in_a_load_reads_and_writes_back(magnitude: str) -> None:
    model = lw.loads(changed("magnitude: 1 N", f"magnitude: {magnitude}"))
    size = model.loads["f"].magnitude.size
    assert size.expression.names == {"t"}
    assert lw.loads(lw.dump(model)).loads == model.loads

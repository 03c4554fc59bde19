"""``linkwright machine``: flywheels of textbooks, both crushers, what is refused.

Areas and curves: Khurmi and Gupta, Theory of Machines, ch. 16.
"""

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.cli.commands import data, finding_codes, is_refused, shown
from tests.cli.tables import numbers, rows

SIX, FOUR = "gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"
AREAS = ["--areas", "+295, -685, +40, -340, +960, -270"]
SCALE = ["--scale", "5 N·m/mm, 1 deg/mm"]
ENGINE = ["--torque", "20000 + 9500*sin(2*theta) - 5700*cos(2*theta)", "--speed", "180rpm"]

#: A crank of 500 kg·m² at 20 rad/s against 100 N along a stroke of 200 mm.
HEAVY = """\
format: 1
name: Heavy press
frame:
  points: {O: [0 mm, 0 mm]}
links:
  crank: {points: [O, A], length: 100 mm, mass: 6000 kg, inertia: 500 kg·m², mass_centre: [0 mm, 0 mm]}
  rod: {points: [A, B], length: 400 mm}
  slider: {points: [B]}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 20 rad/s}
loads:
  work: {kind: force, on: slider, at: B, direction: 180 deg, magnitude: 100 N, phase: {input: [180 deg, 360 deg]}}
"""


def laid_out(*arguments: str) -> dict[str, Any]:
    return dict(data("machine", *arguments))


def test_areas_of_a_torque_diagram() -> None:
    flywheel = ["--speed", "1800rpm", "--mass", "36kg", "--gyration", "150mm"]
    found = laid_out(*AREAS, *SCALE, *flywheel)
    assert found["energy_fluctuation"]["value"] == pytest.approx(85.957, abs=6e-4)
    assert found["formula_fluctuation"]["value"] == pytest.approx(0.2987e-2, abs=5e-7)
    assert (found["energy_lowest"]["after_area"], found["energy_highest"]["after_area"]) == (4, 1)
    table = rows(shown("machine", *AREAS, *SCALE, *flywheel))
    units = ["J", "J", "J", "kg·m²", "%"]
    assert [each[2] for each in table] == units
    assert [float(each[1]) for each in table] == [85.95747, -60.21386, 25.74361, 0.81, 0.29867]
    assert [numbers(each[3]) for each in table[1:3]] == [[4], [1]]


def test_an_engine_against_its_mean_torque() -> None:
    found = laid_out(*ENGINE, "--fluctuation", "0.01")
    assert found["mean_power"]["value"] == pytest.approx(376.99e3, abs=5)
    assert found["energy_fluctuation"]["value"] == pytest.approx(11078.81, abs=5e-3)
    assert found["flywheel"]["value"] == pytest.approx(3118.1, abs=5e-2)
    low, high = (found[f"energy_{end}est"]["at [rad]"] for end in ("low", "high"))
    assert 20000 + 9500 * np.sin(2 * low) - 5700 * np.cos(2 * low) == pytest.approx(20000)
    assert abs(high - low) % np.pi == pytest.approx(np.pi / 2)


def test_an_engine_against_a_load_that_varies() -> None:
    torques = ["--torque", "5000 + 600*sin(2*theta)", "--load", "5000 + 500*sin(theta)"]
    found = laid_out(*torques, "--speed", "150rpm", "--mass", "500kg", "--gyration", "0.4m")
    assert found["energy_fluctuation"]["value"] == pytest.approx(1204.1667, abs=5e-5)
    assert found["formula_fluctuation"]["value"] == pytest.approx(6.1004e-2, abs=5e-7)
    largest, smallest = found["acceleration_largest"], found["acceleration_smallest"]
    assert (largest["value"], smallest["value"]) == pytest.approx((12.203, -12.203), abs=5e-4)
    places = np.degrees([largest["at [rad]"], smallest["at [rad]"]])
    assert places == pytest.approx([232.37, 127.63], abs=5e-3)


def test_what_is_there_already_is_taken_off_the_flywheel() -> None:
    bare = laid_out(*ENGINE, "--fluctuation", "0.01")["flywheel"]["value"]
    eased = laid_out(*ENGINE, "--fluctuation", "0.01", "--inertia", "118.1 kg·m²", "--ratio", "2")
    assert eased["flywheel"]["value"] == pytest.approx(bare - 118.1)
    assert eased["shaft_flywheel"]["value"] == pytest.approx((bare - 118.1) / 4)


@pytest.mark.parametrize("model", [SIX, FOUR])
def test_both_crushers_by_one_command_each(model: str) -> None:
    found = laid_out(model, "--fluctuation", "0.03")
    speed = 170 * 2 * np.pi / 60
    assert found["speed"]["value"] == pytest.approx(speed)
    assert found["mean_power"]["value"] == pytest.approx(found["mean_torque"]["value"] * speed)
    spread = found["energy_highest"]["value"] - found["energy_lowest"]["value"]
    assert found["energy_fluctuation"]["value"] == pytest.approx(spread)
    assert found["exact_reached_fluctuation"]["value"] == pytest.approx(0.03, rel=1e-9)
    assert found["reached_fluctuation"]["value"] == pytest.approx(0.03, rel=0.01)
    slow, fast = found["exact_slowest"]["value"], found["exact_fastest"]["value"]
    assert (fast - slow) / speed == pytest.approx(0.03, rel=1e-9)


def test_motor_shaft_and_rim() -> None:
    options = ["--ratio", "5", "--efficiency", "0.9", "--margin", "1.2"]
    found = laid_out(SIX, *options, "--rim", "density=7850kg/m³, width=0.2, thickness=0.1")
    assert found["motor_power"]["value"] == pytest.approx(found["mean_power"]["value"] * 1.2 / 0.9)
    inertia = found["shaft_flywheel"]["value"]
    assert inertia == pytest.approx(found["exact_flywheel"]["value"] / 25)
    outer = found["rim_diameter"]["value"]
    inner = outer - 2 * found["thickness"]["value"]
    mass = 7850 * np.pi / 4 * (outer**2 - inner**2) * found["width"]["value"]
    assert found["mass"]["value"] == pytest.approx(mass)
    assert mass * (outer**2 + inner**2) / 8 == pytest.approx(inertia)
    assert found["width"]["value"] == pytest.approx(0.2 * outer)
    assert found["rim_speed"]["value"] == pytest.approx(outer / 2 * 5 * found["speed"]["value"])


def test_a_machine_with_inertia_enough_needs_no_flywheel(tmp_path: Path) -> None:
    path = tmp_path / "heavy.yaml"
    path.write_text(HEAVY)
    found = laid_out(str(path), "--fluctuation", "0.05", "--disk")
    assert found["flywheel"]["value"] <= 0
    assert found["reached_fluctuation"]["value"] < 0.05
    assert not [name for name in found if "diameter" in name or name == "mass"]


def test_the_curves_of_the_cycle_are_written(tmp_path: Path) -> None:
    path = tmp_path / "cycle.csv"
    found = laid_out(SIX, "--fluctuation", "0.03", "--output", str(path))
    rows = list(csv.DictReader(path.read_text().splitlines()))
    speeds = np.array([float(row["speed_with_exact_flywheel [rad/s]"]) for row in rows])
    inertia = np.array([float(row["equivalent_inertia [kg·m²]"]) for row in rows])
    assert speeds[0] == pytest.approx(speeds[-1], rel=1e-9)
    assert (speeds.max() - speeds.min()) / found["speed"]["value"] == pytest.approx(0.03, rel=1e-3)
    assert inertia.max() == pytest.approx(found["inertia_largest"]["value"], rel=1e-3)
    is_refused(["machine", SIX, "--output", str(path)], "file.exists", path=path, remedy="--force")


def test_closeness_to_a_singular_position_is_told() -> None:
    """At the input where the transmission angle of the dyad is smallest."""
    told = [line for line in shown("machine", "gallery:swing_conveyor").splitlines() if "coupler+rocker" in line]
    assert [numbers(line) for line in told] == [[332.241]]


@pytest.mark.parametrize(
    ("arguments", "code", "values"),
    [
        ([], "machine.nothing_given", {}),
        ([SIX, "--fluctuation", "0"], "range", {"shown": "0"}),
        ([FOUR, "--fluctuation", "30"], "range", {"shown": "30"}),
        ([SIX, "--fluctuation=-0.02"], "range", {"shown": "-0.02"}),
        ([SIX, "--fluctuation", "3%"], "type", {"text": "3%"}),
        ([SIX, "--ratio", "0"], "range", {"shown": "0"}),
        ([SIX, "--efficiency", "1.2"], "range", {"shown": "1.2"}),
        ([SIX, "--margin", "0.5"], "range", {"shown": "0.5"}),
        ([SIX, "--rim", "densty=3"], "unknown-key", {"key_": "densty", "offer": "density"}),
        ([SIX, "--disk", "thickness=0.1"], "unknown-key", {"names": {"density", "width"}}),
        ([SIX, "--rim", "density=7850 kg"], "wrong-dimension", {"text": "7850 kg"}),
        ([SIX, "--rim", "thickness=0.7"], "range", {"shown": "0.7"}),
        ([SIX, "--disk", "--rim"], "cli.not_together", {"name": "--rim", "other": "--disk"}),
        ([SIX, "--speed", "180rpm"], "machine.not_with_file", {"option": "--speed"}),
        ([SIX, *AREAS], "machine.not_with_file", {"option": "--areas"}),
        (AREAS, "machine.no_scale", {}),
        (["--areas", "+295, x", *SCALE], "machine.bad_area", {"text": "x"}),
        ([*AREAS, "--scale", "5 N/mm, 1 deg/mm"], "machine.bad_scale", {"text": "5 N/mm, 1 deg/mm"}),
        ([*AREAS, "--scale", "5 N·m/mm, 1 dgr/mm"], "unknown-unit", {"text": "dgr/mm", "offer": "deg/mm"}),
        ([*AREAS, *SCALE, "--fluctuation", "0.01"], "machine.needs_speed", {}),
        ([*AREAS, *SCALE, "--load", "3"], "cli.not_together", {"name": "--load", "other": "--areas"}),
        ([*AREAS, *SCALE, "--mass", "36kg"], "machine.mass_and_gyration", {}),
        ([*ENGINE, "--disk"], "machine.shape_needs_fluctuation", {}),
        (["--torque", "5 + sin(tehta)"], "unknown-name", {"offer": "theta"}),
        (["--torque", "5 + 1/sin(theta)"], "machine.not_finite", {"text": "5 + 1/sin(theta)"}),
        (["--torque", "5", "--period", "0 deg"], "range", {"shown": "0 deg"}),
        ([*ENGINE, "--output", "cycle.csv"], "machine.output_needs_file", {}),
    ],
)
def test_wrong_options_are_refused(arguments: list[str], code: str, values: dict[str, object]) -> None:
    is_refused(["machine", *arguments], code, **values)


def test_all_that_is_wrong_with_the_options_is_told_at_once() -> None:
    wrong = ["--ratio", "0", "--margin", "much", "--rim", "density=7850 kg, width=0.1, thicknes=0.1"]
    told = finding_codes("machine", SIX, *wrong, code=2)
    assert dict(told) == {
        "--ratio": "range",
        "--margin": "type",
        "--rim.density": "wrong-dimension",
        "--rim.thicknes": "unknown-key",
    }


def test_the_column_of_an_unknown_name_is_marked() -> None:
    lines = str(is_refused(["machine", "--torque", "5 + sin(tehta)"], "unknown-name")).splitlines()
    assert lines[-1].index("^") == lines[-2].index("tehta")


@pytest.mark.parametrize(
    ("arguments", "code", "values"),
    [
        (["--torque", "5000", "--load", "4000"], "running.speeds_up", {"total": 2000 * math.pi}),
        (["--areas", "1, 2, -4", *SCALE], "running.areas_sum", {"total": -1.0}),
        (["gallery:slider_crank_offset"], "running.no_work", {}),
        (["gallery:truss"], "running.one_driver", {}),
        (["gallery:excavator"], "running.one_driver", {}),
    ],
)
def test_what_gives_no_flywheel_is_refused(arguments: list[str], code: str, values: dict[str, object]) -> None:
    is_refused(["machine", *arguments], code, ends=1, **values)


@pytest.mark.parametrize(("torque", "mean"), [("100*sin(theta)", 0), ("-5000 + sin(theta)", -5000)])
def test_a_torque_that_does_no_work_is_refused_with_its_mean(torque: str, mean: float) -> None:
    asked = ["machine", "--torque", torque, "--speed", "180rpm", "--fluctuation", "0.01"]
    told = is_refused(asked, "machine.no_mean_torque", ends=1)
    assert numbers(str(told.values["mean"])) == [mean]


def test_an_even_torque_has_no_energy_fluctuation(tmp_path: Path) -> None:
    """A gear train against a constant torque: its rounding (1e-13 J) was told with a slowest and a fastest place."""
    file = tmp_path / "train.yaml"
    file.write_text(
        """
format: 1
name: Planetary train
frame: {points: {O: [0 mm, 0 mm]}}
links:
  arm: {points: [O, P], length: 60 mm, mass: 1 kg, inertia: 0.001 kg·m²}
  planet: {points: [P], mass: 0.5 kg, inertia: 0.0001 kg·m²}
  ring: {points: [O], mass: 5 kg, inertia: 0.05 kg·m²}
joints:
  inner: {kind: gear, links: [frame, planet], teeth: [40, 20], module: 2 mm, carrier: arm}
  outer: {kind: gear, links: [planet, ring], teeth: [20, 80], mesh: internal, module: 2 mm, carrier: arm}
driver: {turn: arm, about: O, speed: 100 rpm}
loads: {out: {kind: torque, on: ring, opposes: velocity, magnitude: 30 N·m}}
""",
        encoding="utf-8",
    )
    found = laid_out(str(file), "--fluctuation", "0.05")
    assert found["mean_torque"]["value"] == pytest.approx(45.0, rel=1e-12)  # 30 N·m · (1 + 40/80)
    assert found["energy_fluctuation"]["value"] == 0.0 and "energy_lowest" not in found
    assert found["reached_fluctuation"]["value"] == 0.0


@pytest.mark.parametrize(
    ("areas", "scale"),
    [
        ("+580 J, -320J, 390 J, -520 J, 190 J, −390 J, 260 J, -190 J", []),
        ("+29, -16, 19.5, -26, 9.5, -19.5, 13, -9.5", ["--scale", "20 J/mm²"]),
        ("+58, -32, 39, -52, 19, -39, 26, -19", ["--scale", "10 N*m/mm^2"]),
    ],
)
def test_areas_as_works_or_with_the_work_of_an_area(areas: str, scale: list[str]) -> None:
    """Running sums 580, 260, 650, 130, 320, -70, 190, 0 J; J = 720/(0.02 (2π 100/60)²)."""
    found = laid_out("--areas", areas, *scale, "--speed", "100 rpm", "--fluctuation", "0.02")
    assert found["energy_fluctuation"]["value"] == pytest.approx(720.0, rel=1e-12)
    assert found["flywheel"]["value"] == pytest.approx(720 / (0.02 * (math.pi * 10 / 3) ** 2), rel=1e-12)
    assert (found["energy_lowest"]["after_area"], found["energy_highest"]["after_area"]) == (6, 3)


@pytest.mark.parametrize(
    ("load", "least", "most"),
    [
        ("step(theta - pi)*400", -200.0, 200.0),
        ("400*pi*step(theta - 1)*step(2 - theta)", 200.0 - 400.0 * math.pi, 200.0),
        ("200*(1 + sign(sin(3*theta)))", -200.0, 200.0),
    ],
)
def test_torques_that_jump_accelerate_no_more_than_they_are(load: str, least: float, most: float) -> None:
    """Between the jumps the torques are constant; the polynomial through a jump swings beyond both its sides."""
    found = laid_out("--torque", "200", "--load", load, "--speed", "1000 rpm", "--fluctuation", "0.05")
    inertia = found["flywheel"]["value"]
    assert found["acceleration_smallest"]["value"] * inertia == pytest.approx(least, rel=1e-9)
    assert found["acceleration_largest"]["value"] * inertia == pytest.approx(most, rel=1e-9)


def test_a_motor_against_a_load_that_varies_says_what_it_must_have_without_a_flywheel() -> None:
    """(100 + 50) N·m · 10 rad/s · 1.2 / 0.8; an engine, whose own torque varies, is no motor."""
    words = ["--load", "100 + 50*sin(theta)", "--speed", "10 rad/s", "--margin", "1.2", "--efficiency", "0.8"]
    found = laid_out(*words, "--torque", "100")
    assert found["motor_power"]["value"] == pytest.approx(1500.0)
    assert found["motor_power_without_flywheel"]["value"] == pytest.approx(2250.0)
    assert "motor_power_without_flywheel" not in laid_out(*words, "--torque", "100 + 20*cos(theta)")

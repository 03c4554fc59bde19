"""Gears, racks, belts and chains against formulas of the textbooks, reckoned by hand here."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright import sensitivity
from linkwright.mechanism.wheels_and_cams import wheel_sizes

RPM = np.pi / 30.0
ALPHA = np.radians(20.0)


def solved(name: str, steps: int = 24) -> lw.Forces:
    return store.forces(name, steps)


def test_external_pair() -> None:
    """M = 40 N·m on r = 40 mm: F_t = 1000 N, F_r = F_t tan 20°, both in the bearings, reversed; motor M/2."""
    forces = solved("external_gear_pair")
    assert forces.motion.link("wheel").angular_velocity == pytest.approx(-300 * RPM, rel=1e-12)
    expected = (-1000 * np.tan(ALPHA), -1000.0)
    assert forces.reaction("mesh", on="pinion") == pytest.approx(np.tile(expected, (24, 1)), rel=1e-11)
    assert forces.reaction("O", on="pinion") == pytest.approx(-np.tile(expected, (24, 1)), rel=1e-11)
    assert forces.input_torque == pytest.approx(20.0, rel=1e-11)


def test_internal_pair() -> None:
    """The ring turns with the pinion; the teeth press the pinion towards the ring's centre."""
    forces = solved("internal_gear_pair")
    assert forces.motion.link("ring").angular_velocity == pytest.approx(200 * RPM, rel=1e-12)
    expected = (-1000 * np.tan(ALPHA), -1000.0)
    assert forces.reaction("mesh", on="pinion") == pytest.approx(np.tile(expected, (24, 1)), rel=1e-11)


def test_planetary_train_by_willis() -> None:
    """n_c = (z_s n_s + z_r n_r) / (z_s + z_r), M_s : M_r : M_c = z_s : z_r : -(z_s + z_r)."""
    forces = solved("planetary_two_inputs")
    assert forces.motion.link("carrier").angular_velocity == pytest.approx(450 * RPM, rel=1e-12)
    assert forces.motion.link("planet_1").angular_velocity == pytest.approx(-300 * RPM, rel=1e-12)
    assert forces.driver_effort("sun_motor") == pytest.approx(20.0, rel=1e-10)
    assert forces.driver_effort("ring_motor") == pytest.approx(60.0, rel=1e-10)
    found = lw.structure(forces.mechanism)
    assert (found.grubler, found.mobility, found.passive) == (0, 2, ("ring_2", "ring_3"))
    (train,) = found.trains
    assert train.ratios == pytest.approx({"sun": 1, "planet_1": -1, "planet_2": -1, "planet_3": -1, "ring": -1 / 3})


def test_differential() -> None:
    """n_1 + n_2 = 2 n_c, and both suns share the torque of the carrier evenly."""
    forces = solved("gear_differential")
    assert forces.motion.link("sun_2").angular_velocity == pytest.approx(60 * RPM, rel=1e-12)
    assert forces.driver_effort("left") == pytest.approx(-50.0, rel=1e-10)
    assert forces.driver_effort("shaft") == pytest.approx(100.0, rel=1e-10)


def test_rack_goes_as_far_as_its_sector_swings() -> None:
    motion = solved("rack_and_rocker", 90).motion
    rocker, slide = motion.link("rocker").angle, motion.joint("slide").displacement
    assert np.diff(slide) == pytest.approx(0.1 * np.diff(rocker), abs=1e-14)


def test_upper_rack_moves_twice_as_far_as_the_pinion() -> None:
    motion = solved("pinion_between_racks", 90).motion
    centre, rack = motion.point("C").position[:, 0], motion.joint("slide").displacement
    assert np.diff(rack) == pytest.approx(2.0 * np.diff(centre), abs=1e-13)
    assert np.ptp(rack) == pytest.approx(4 * 0.08, rel=1e-3)  # twice the stroke of the crank


def test_chain_pulls_along_its_taut_strand() -> None:
    """|F| = M / r of the motor's sprocket, r = z p / 2π, and the couple about the motor's centre balances it."""
    forces = solved("chain_drive", 60)
    radius = 17 * 0.0127 / (2 * np.pi)
    pull = np.hypot(*forces.reaction("chain", on="motor").T)
    weightless = forces.motion.link("motor").angular_acceleration
    assert np.abs(weightless).max() < 1e-9
    assert pull == pytest.approx(np.abs(forces.input_torque) / radius, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "turns"),
    [("geared_fivebar", 1), ("geared_fivebar_double", 1), ("geared_fivebar_third", 3), ("chain_drive", 3)],
)
def test_cycle_is_as_many_turns_as_it_takes(name: str, turns: int) -> None:
    mechanism = store.machine(name)
    motion = lw.solve_motion(mechanism, steps=24, endpoint=True)
    law = next(iter(mechanism.drivers.values())).law
    assert motion.positions.period == pytest.approx(turns * law.natural_duration())
    told = [note.values["turns"] for note in motion.notes if note.code == "cycle.turns"]
    assert told == ([turns] if turns > 1 else [])
    for link in mechanism.links:
        direction = motion.link(link).direction
        assert direction[0] == pytest.approx(direction[-1], abs=1e-12)


def test_coupler_curve_of_equal_gears_is_symmetric() -> None:
    """Ratio -1, equal cranks and bars, phase 180°: the pin stays on the middle line between the centres."""
    text = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [2 m, 0 m]}}
links:
  a: {points: [O1, A], length: 0.4 m}
  b: {points: [O2, B], length: 0.4 m}
  c: {points: [A, C], length: 1.5 m}
  d: {points: [B, C], length: 1.5 m}
joints: {mesh: {kind: gear, links: [a, b], ratio: -1, phase: 180 deg}}
assembly: {C: left}
driver: {turn: a, about: O1, speed: 1 rad/s}
"""
    motion = lw.solve_motion(lw.loads(text), steps=36)
    assert motion.point("C").position[:, 0] == pytest.approx(1.0, abs=1e-13)


@pytest.mark.parametrize("run", ["open", "crossed"])
@pytest.mark.parametrize("pretension", [0.0, 700.0])
def test_strands_of_a_belt_load_the_pins(pretension: float, run: str) -> None:
    """Two strands of F₀ ± Q/2, Q = M/r_b, along the common tangents; without pretension the slack strand carries
    nothing. Pulleys of 50 and 20 mm, 200 mm apart, 8 N·m on the smaller one."""
    a, b, d, moment = 0.05, 0.02, 0.2, 8.0
    given = f", run: {run}" + (f", pretension: {pretension} N" if pretension else "")
    motion = lw.solve_motion(
        lw.loads(f"""
format: 1
frame: {{points: {{O: [0 mm, 0 mm], Q: [200 mm, 0 mm]}}}}
links:
  a: {{points: {{O: [0 mm, 0 mm], P: [10 mm, 0 mm]}}}}
  b: {{points: {{Q: [0 mm, 0 mm], W: [10 mm, 0 mm]}}}}
joints: {{belt: {{kind: belt, links: [a, b], radii: [50 mm, 20 mm]{given}}}}}
driver: {{turn: a, about: O, speed: 1 rad/s}}
loads: {{work: {{kind: torque, on: b, magnitude: 8 N·m}}}}
"""),
        steps=12,
    )
    forces, pull = lw.solve_forces(motion), moment / b
    sine = ((a - b) if run == "open" else (a + b)) / d
    cosine = np.sqrt(1.0 - sine**2)
    below = pretension + pull / 2 if pretension else pull  # the strand that holds b against the moment
    above = below - pull
    # from a to b: the strand from a's upper side falls, the other rises; crossed, b's lower side holds the first one
    tight, slack = (below, above) if run == "open" else (above, below)
    on_b = -np.array([(tight + slack) * cosine, (tight - slack) * sine])
    assert np.abs(forces.reaction("Q", on="b") + on_b).max() < 1e-9
    assert np.abs(forces.reaction("O", on="a") - on_b).max() < 1e-9
    ratio = a / b if run == "open" else -a / b
    assert forces.input_torque == pytest.approx(np.full(12, -moment * ratio), rel=1e-12)


@pytest.mark.parametrize("run", ["open", "crossed"])
@pytest.mark.parametrize(("pretension", "loose"), [("", False), ("199 N", True), ("201 N", False)])
def test_a_belt_whose_slack_strand_would_push_is_told(pretension: str, loose: bool, run: str) -> None:
    """400 N on the rim take a pretension of 200 N in each strand."""
    given = f", pretension: {pretension}" if pretension else ""
    belt = lw.loads(f"""
format: 1
frame: {{points: {{O: [0 mm, 0 mm], Q: [200 mm, 0 mm]}}}}
links: {{a: {{points: [O]}}, b: {{points: [Q]}}}}
joints: {{belt: {{kind: belt, links: [a, b], radii: [50 mm, 20 mm], run: {run}{given}}}}}
driver: {{turn: a, about: O, speed: 1 rad/s}}
loads: {{work: {{kind: torque, on: b, magnitude: 8 N·m}}}}
""")
    notes = [(note.code, note.values["name"]) for note in lw.solve_forces(belt, steps=12).notes]
    assert notes == [("forces.contact_lost_belt", "belt")] * loose


@pytest.mark.parametrize("name", ["external_gear_pair", "internal_gear_pair"])
def test_teeth_off_their_distance_keep_the_ratio_and_press_under_the_working_angle(name: str) -> None:
    """cos α_w = d₀ cos α / d (ISO 21771); F_t = M / r_w at the working pitch circles, F_r = F_t tan α_w."""
    pair = store.machine(name)
    nominal = pair.frame.points["Q"][0]
    for off in (-2e-4, 3e-4):
        moved = pair.with_dimensions({"frame.Q.x": nominal + off})
        plain, forces = (lw.solve_forces(lw.solve_motion(each, at=[0.0])) for each in (pair, moved))
        link = "wheel" if "external" in name else "ring"
        for each in ("angle", "angular_velocity"):
            was, found = (getattr(f.motion.link(link), each) for f in (plain, forces))
            assert found == pytest.approx(was, rel=1e-14)
        working = np.arccos(nominal * np.cos(ALPHA) / (nominal + off))
        tangential = 1000.0 * nominal / (nominal + off)  # of the same couple
        expected = (-tangential * np.tan(working), -tangential)
        assert forces.reaction("mesh", on="pinion")[0] == pytest.approx(expected, rel=1e-12)
        assert forces.input_torque == pytest.approx(plain.input_torque, rel=1e-12)
        lines = {line.symbol: line.value for line in lw.worked(forces).equations}
        assert lines["F_mesh,1x"] == pytest.approx(expected[0], rel=1e-6)


def test_a_distance_as_a_file_rounds_it_has_the_given_angle_to_the_last_digit() -> None:
    """F_r = F_t tan 20° at nine digits of the distance; it changes with the distance as under the working angle."""
    pair = store.machine("external_gear_pair")
    nominal = pair.frame.points["Q"][0]
    rounded = pair.with_dimensions({"frame.Q.x": nominal * (1.0 + 4e-7)})
    force = lw.solve_forces(lw.solve_motion(rounded, at=[0.0])).reaction("mesh", on="pinion")[0]
    assert force[0] / force[1] == pytest.approx(np.tan(ALPHA), rel=1e-13)
    found = sensitivity(pair, of=["reaction mesh on pinion.x"], by=["frame.Q.x"], steps=4)
    steps = [pair.with_dimensions({"frame.Q.x": nominal + off}) for off in (-1e-6, 1e-6)]
    ends = [lw.solve_forces(lw.solve_motion(each, at=[0.0])).reaction("mesh", on="pinion")[0, 0] for each in steps]
    assert found.slope("reaction mesh on pinion.x", "frame.Q.x")[0] == pytest.approx(
        (ends[1] - ends[0]) / 2e-6, rel=1e-4
    )


@pytest.mark.parametrize("off", [6e-4, -6e-4])
def test_teeth_further_off_are_refused(off: float) -> None:
    pair = store.machine("external_gear_pair")
    with refused(
        "motion.refused", lw.PositionError, joint="mesh", distance=f"{60 + 1e3 * off:.4g} mm", wanted="60 mm"
    ):
        lw.solve_motion(pair.with_dimensions({"frame.Q.x": 0.06 + off}), steps=4)


def test_machines_of_one_shape_keep_their_own_teeth() -> None:
    """Racks of 20 teeth of 6 mm, 30 of 4 mm, 60 of 2 mm, and of 20 of 4 mm, one after the other."""
    text = """
format: 1
name: rack
frame: {points: {O: [0 m, 0 m], Q: [0 m, LOW m]}}
links:
  pinion: {points: {O: [0 m, 0 m], P: [0.02 m, 0 m]}, mass: 1 kg}
  rack: {points: {R: [0 m, 0 m]}, mass: 1 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: Q, direction: 0 deg, block: rack, at: R}
  mesh: {kind: rack, pinion: pinion, rack: rack, through: R, teeth: TEETH, module: MODULE mm}
driver: {turn: pinion, about: O, speed: 1 rad/s}
"""
    for teeth, module in ((30, 4.0), (20, 6.0), (60, 2.0), (26, 4.0)):
        radius = 0.5e-3 * teeth * module
        own = text.replace("LOW", f"{-radius}").replace("TEETH", str(teeth)).replace("MODULE", str(module))
        motion = lw.solve_motion(lw.loads(own), steps=4)
        assert motion.joint("guide").velocity == pytest.approx(radius, rel=1e-14)


def test_a_rack_of_a_module_may_be_off_its_distance_and_one_of_a_radius_may_not() -> None:
    """An involute pinion rolls on its own pitch circle wherever the rack is: same ratio, same pressure angle."""
    press = store.machine("rack_and_rocker")
    moved = press.with_dimensions({"slide.offset": press.dimensions()["slide.offset"] + 5e-4})
    plain, found = (lw.solve_forces(lw.solve_motion(each, steps=6)) for each in (press, moved))
    assert found.motion.joint("slide").velocity == pytest.approx(plain.motion.joint("slide").velocity, rel=1e-12)
    pinion = store.machine("pinion_between_racks")
    address = next(name for name in pinion.dimensions() if name.endswith(".offset"))
    off = pinion.with_dimensions({address: pinion.dimensions()[address] + 1e-4})
    with refused("motion.refused", lw.PositionError, joint="below", distance="40.1 mm", radius="40 mm"):
        lw.solve_motion(off, steps=4)


@pytest.mark.parametrize(
    ("name", "joint", "teeth", "radii", "distance", "ratio", "module"),
    [
        ("external_gear_pair", "mesh", (20, 40), (0.02, 0.04), 0.06, -1 / 2, 0.002),
        ("internal_gear_pair", "mesh", (20, 60), (0.02, 0.06), 0.04, 1 / 3, 0.002),
        ("planetary_two_inputs", "sun_2", (24, 24), (0.024, 0.024), 0.048, -1.0, 0.002),
        ("geared_fivebar", "mesh", None, (0.1, 0.1), 0.2, -1.0, None),
        ("chain_drive", "chain", (17, 51), (17 * 0.0127 / (2 * np.pi), 51 * 0.0127 / (2 * np.pi)), None, 1 / 3, None),
        ("rack_and_rocker", "mesh", (50,), (0.1,), None, None, 0.004),
        ("pinion_between_racks", "above", None, (0.04,), None, None, None),
    ],
)
def test_sizes_of_wheels(
    name: str,
    joint: str,
    teeth: tuple[int, ...] | None,
    radii: tuple[float, ...],
    distance: float | None,
    ratio: float | None,
    module: float | None,
) -> None:
    """r = m z / 2, of a chain z p / 2π; a = r_b ± r_a; i = ∓ z_a / z_b."""
    mechanism = store.machine(name)
    found = wheel_sizes(mechanism.joints[joint], mechanism)
    assert found is not None
    assert (found.teeth, found.module) == (teeth, module)
    assert found.radii == pytest.approx(radii, rel=1e-12)
    assert found.ratio == (None if ratio is None else pytest.approx(ratio))
    if distance is not None:
        assert found.distance == pytest.approx(distance)
    assert all(wheel_sizes(other, mechanism) is None for other in mechanism.joints.values() if not other.higher)
    chain = name == "chain_drive"
    assert found.pressure_angle == (None if chain else pytest.approx(ALPHA))
    assert found.involute == (module is not None and len(found.links) == len(radii))


def test_a_path_that_a_cycle_runs_three_times_counts_once() -> None:
    """z = 48 e^(3 i u) + 20 e^(-2 i u) mm, u from 0 to 2π: a trochoid of order 5 that winds thrice about the sun.

    Area by Green's theorem π (3·48² - 2·20²); (3 + 2)(3 - 1) nodes, as of every such curve without loops (Wunderlich,
    Ebene Kinematik); length by quadrature. A cycle, 24 turns of the sun, runs it three times.
    """
    found = lw.metrics(lw.solve_motion(store.machine("planetary_two_inputs"), steps=360))
    u = np.linspace(0.0, 2 * np.pi, 4000, endpoint=False)
    speed = np.abs(3 * 0.048 * np.exp(3j * u) - 2 * 0.020 * np.exp(-2j * u))
    wanted = {
        "coupler_curve_area": np.pi * (3 * 0.048**2 - 2 * 0.020**2),
        "coupler_curve_length": 2 * np.pi * float(speed.mean()),
        "double_point": 10.0,
        "cusp": 0.0,
    }
    for name, value in wanted.items():
        rows = [row.value for row in found if row.metric == name]
        assert rows == pytest.approx([value] * 3, rel=1e-9), name


BEHIND_GEARS = """
format: 1
name: four-bar behind gears
frame: {points: {M: [-0.3 m, 0 m], O: [0 m, 0 m], Q: [0.4 m, 0 m]}}
links:
  motor: {points: {M: [0 m, 0 m], N: [0.05 m, 0 m]}}
  crank: {points: {O: [0 m, 0 m], A: [0.1 m, 0 m]}}
  coupler: {points: {A: [0 m, 0 m], B: [0.35 m, 0 m], P: [0.17 m, 0.1 m]}}
  rocker: {points: {Q: [0 m, 0 m], B: [0.3 m, 0 m]}}
joints: {mesh: {kind: gear, links: [motor, crank], radii: [RADII], carrier: frame}}
assembly: {B: left}
driver: {turn: motor, about: M, speed: 2 rad/s}
"""


@pytest.mark.parametrize("radii", ["200 mm, 100 mm", "180 mm, 120 mm"])
@pytest.mark.parametrize("steps", [48, 97, 360])
def test_a_curve_that_a_cycle_runs_several_times_counts_once(radii: str, steps: int) -> None:
    bare = BEHIND_GEARS.replace("joints", "#").replace("  motor", "  #").replace("motor, about: M", "crank, about: O")
    once = lw.metrics(lw.solve_motion(lw.loads(bare), steps=360))
    table = lw.metrics(lw.solve_motion(lw.loads(BEHIND_GEARS.replace("RADII", radii)), steps=steps))
    assert table.value("coupler_curve_length") == pytest.approx(once.value("coupler_curve_length"), rel=1e-10)
    area = abs(once.value("coupler_curve_area"))
    assert abs(table.value("coupler_curve_area")) == pytest.approx(area, rel=1e-10)
    for name in ("double_point", "cusp"):
        assert table.value(name) == once.value(name)


@pytest.mark.parametrize(
    ("outer", "inner", "mesh", "carrier", "planet"),
    [
        ((20, 30), (30, 80), "internal", Fraction(1, 5), Fraction(-1, 3)),  # 1 + z3/z1 = 5; (1 - z3/z2)/5
        ((100, 101), (100, 99), "external", Fraction(10_000), Fraction(19_900)),  # 1/(1 - 101·99/(100·100))
        ((60, 20), (20, 100), "internal", Fraction(3, 8), Fraction(-3, 2)),
    ],
)
def test_a_train_with_a_fixed_wheel_says_the_speeds_of_all(
    outer: tuple[int, int], inner: tuple[int, int], mesh: str, carrier: Fraction, planet: Fraction
) -> None:
    """i_1H = 1 - i_13 with the carrier stopped, and as the motion has it."""
    model = lw.loads(
        "format: 1\nframe: {points: {O: [0, 0]}}\nlinks:\n  sun: {points: [O]}\n"
        "  arm: {points: [O, P], length: 100 mm}\n  planet: {points: [P]}\njoints:\n"
        f"  first: {{kind: gear, links: [sun, planet], teeth: {list(outer)}}}\n"
        f"  second: {{kind: gear, links: [planet, frame], teeth: {list(inner)}, mesh: {mesh}}}\n"
        "driver: {turn: sun, about: O, speed: 1 rad/s}\n"
    )
    structure = lw.structure(model)
    (train,) = structure.trains
    wanted = {"sun": 1.0, "planet": float(planet), "frame": 0.0, "arm": float(carrier)}
    assert train.speeds == pytest.approx(wanted, rel=1e-9)
    motion = lw.solve_motion(model, at=[0.0])
    for name in ("planet", "arm"):
        assert motion.link(name).angular_velocity[0] == pytest.approx(wanted[name], rel=1e-9)
    shown = [line.split()[-4:] for line in structure.text().splitlines()]
    assert ["1", str(planet), "0", str(carrier)] in shown


def test_a_train_with_two_inputs_says_no_speeds() -> None:
    (train,) = lw.structure(store.machine("planetary_two_inputs")).trains
    assert train.speeds == {}


RAVIGNEAUX = """
format: 1
frame: {points: {O: [0 mm, 0 mm]}}
links:
  small: {points: [O]}
  large: {points: [O]}
  ring: {points: [O]}
  carrier: {points: {O: [0 mm, 0 mm], P: [38 mm, 0 mm], Q: [45 mm, 30 mm]}}
  long: {points: [P]}
  short: {points: [Q]}
joints:
  m1: {kind: gear, links: [large, long], teeth: [38, 20]}
  m2: {kind: gear, links: [long, ring], teeth: [20, 78], mesh: internal}
  m3: {kind: gear, links: [small, short], teeth: [30, 20]}
  m4: {kind: gear, links: [short, long], teeth: [20, 20]}
drivers:
  shaft: {turn: small, about: O, speed: 100 rpm}
  brake: {turn: large, about: O, speed: 0 rpm}
"""


def test_a_braked_wheel_is_one_that_stands() -> None:
    """(n_s - n_c) / (n_l - n_c) = -38/30 and (n_r - n_c) / (n_l - n_c) = -38/78 with n_l = 0; all wheels are whole
    turns ahead after lcm(34, 221, 68) turns, from the planets' 87/68 and -27/68."""
    train = lw.loads(RAVIGNEAUX)
    motion = lw.solve_motion(train, steps=8)
    carrier = Fraction(1) / (1 + Fraction(38, 30))
    ring = carrier * (1 + Fraction(38, 78))
    assert (carrier, ring) == (Fraction(15, 34), Fraction(145, 221))
    assert motion.link("carrier").angular_velocity == pytest.approx(float(carrier) * 100 * RPM, rel=1e-12)
    assert motion.link("ring").angular_velocity == pytest.approx(float(ring) * 100 * RPM, rel=1e-12)
    assert motion.positions.period == pytest.approx(884 * 0.6, rel=1e-12)
    told = motion.notes[0].values
    assert (motion.notes[0].code, told["turns"], told["driver"]) == ("cycle.turns", 884, "shaft")


@pytest.mark.rotating
def test_no_wheel_of_a_train_swings() -> None:
    table = lw.metrics(lw.solve_forces(lw.loads(RAVIGNEAUX), steps=8))
    assert len(table) > 5 and "swing_angle" not in table

"""Every demand of every task is met by the linkages that are given, or refused: none is left unread."""

import math
from pathlib import Path

import numpy as np
import pytest
from tests.every import every
from tests.refusals import agrees, refused

import linkwright as lw

POSES = [(0, 0, 0), (0.04, 0.015, 0.35), (0.07, 0.045, 0.96), (0.08, 0.09, 1.66)]
PATH = [(0.020, 0.010), (0.01766, 0.015142), (0.011736, 0.017878), (0.005, 0.016928), (0.0006, 0.012736)]
LETTER = [(0.009, 0), (0.009, 0.017), (0, 0.006), (0.013, 0.006)]
X = np.linspace(1, 2, 13)
INPUTS, LOGARITHM = np.radians((X - 1) * 60), np.radians(np.log10(X) / np.log10(2) * 90)
THREE = {"inputs": [0.0, 0.35, 0.7], "outputs": [0.0, 0.26, 0.73]}
#: Tasks with demands that suffice.
SUFFICIENT: dict[str, dict[str, object]] = {
    "slider_crank": {"stroke": 0.3, "rod_ratio": 3.5, "offset_ratio": 0.2},
    "crank_rocker": {"swing_angle": 0.7, "quick_return_ratio": 1.2, "frame": 0.3},
    "quick_return": {"quick_return_ratio": 1.5, "frame": 0.43, "stroke": 0.42, "rod": 0.17},
    "drag_link": {"quick_return_ratio": 1.5, "frame": 0.1},
    "toggle": {"force_ratio": 5.0, "distance": 0.01, "stroke": 0.05},
    "dwell": {"crank_angle": math.radians(60), "swing_angle": math.radians(25)},
    "straight_line": {"length": 0.1},
    "function": {"inputs": THREE["inputs"], "outputs": THREE["outputs"]},
    "motion": {"poses": POSES},
    "path": {"points": PATH},
    "exact_path": {"points": PATH},
    "free_curve": {"points": LETTER, "joints": 5, "seconds": 0.05},
}


def sines(candidate: lw.Candidate, inputs: np.ndarray) -> np.ndarray:
    """|sin μ| of every pin between two moving links without a frame pivot, from the points of the solved motion."""
    motion = lw.solve_motion(candidate.mechanism(), at=candidate.linkage.start + inputs)
    places = {name: motion.point(name).position @ [1, 1j] for name in candidate.linkage.points}
    pairs = {"four_bar": "ABO2", "watt": "ABO2 CDO3", "stephenson": "ABO2 PQO3", "geared_five_bar": "ABC"}
    found = []
    for text in pairs[candidate.linkage.kind].split():
        a, b, c = (places[name] for name in (text[0], text[1], text[2:]))
        found.append(np.abs(np.sin(np.angle((a - b) / (c - b)))))
    return np.array(found)


def test_every_task_is_here() -> None:
    with refused("synthesize.task", lw.SynthesisError) as said:
        lw.synthesize("no such task")
    assert set(SUFFICIENT) == set(said.value.values["known"])


@pytest.mark.parametrize("task", SUFFICIENT)
def test_a_file_turns_at_the_speed_asked_for(task: str) -> None:
    found = lw.synthesize(task, **SUFFICIENT[task])
    for speed, asked in (("50 rpm", 5 * math.pi / 3), ("-7.5 rad/s", -7.5), (-7.5, -7.5)):
        motion = lw.solve_motion(lw.loads(found.model_text(speed=speed)), steps=12)
        turned = motion.link(found.best.linkage.driver[0]).angular_velocity
        assert turned == pytest.approx(np.full(len(turned), asked), rel=1e-12)


def test_a_geared_crank_turns_with_the_speed_asked_for(tmp_path: Path) -> None:
    demands = {**SUFFICIENT["function"], "linkage": "geared_five_bar", "gear_ratio": -2.0}
    first, *_ = lw.synthesize("function", **demands).write(tmp_path, speed=-20.0)
    motion = lw.solve_motion(lw.load(first), steps=12)
    assert motion.link("crank").angular_velocity == pytest.approx(np.full(13, -20.0))
    assert motion.link("geared_crank").angular_velocity == pytest.approx(np.full(13, 40.0))


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("linkage", "turning"), [("four_bar", False), ("four_bar", True), ("watt", False), ("geared_five_bar", True)]
)
def test_function_generators_have_the_transmission_angle(linkage: str, turning: bool) -> None:
    asked = math.radians(35 if turning else 60)
    found = lw.function_generation(INPUTS, LOGARITHM, linkage=linkage, transmission_angle=asked, turning=turning)
    for each in every(found):
        assert each.transmission_angle >= asked - 1e-9 and each.turns >= turning
        around = np.linspace(0, 2 * math.pi, 721) if each.turns else np.linspace(0, INPUTS[-1], 181)
        assert sines(each, around).min() >= math.sin(asked) - 1e-9
    assert found.best.error < (0.02 if linkage == "four_bar" else 2e-3)


@pytest.mark.rotating
def test_slider_cranks_have_the_transmission_angle() -> None:
    for turning, asked in ((True, 40.0), (False, 85.0)):
        found = lw.function_generation(
            INPUTS, 0.1 * LOGARITHM, linkage="slider_crank", turning=turning, transmission_angle=math.radians(asked)
        )
        for each in found:
            around = np.linspace(0, 2 * math.pi, 721) if each.turns else np.linspace(0, INPUTS[-1], 181)
            motion = lw.solve_motion(each.mechanism(), at=each.linkage.start + around)
            rod = (motion.point("B").position - motion.point("A").position) @ [1, 1j]
            assert np.abs(np.cos(np.angle(rod))).min() >= math.sin(math.radians(asked)) - 1e-9
            assert each.turns >= turning


@pytest.mark.rotating
def test_a_hidden_four_bar_is_found_with_the_angle_that_it_has() -> None:
    """Twelve pairs of a four-bar that does not turn fully, from its closed form: what is a degree less than its
    smallest transmission angle is met without an error, four degrees more only with one."""
    a, b, c, phi = 1.2, 1.1, 0.9, np.linspace(0.6, 1.3, 12)
    pin = a * np.exp(1j * phi)
    reach = np.abs(1 - pin)
    psi = np.angle(pin - 1) - np.arccos((reach**2 + c * c - b * b) / (2 * reach * c))
    least = float(np.arcsin(np.sin(np.arccos((b * b + c * c - reach**2) / (2 * b * c))).min()))
    exact = lw.function_generation(phi, psi, transmission_angle=least - math.radians(1))
    further = lw.function_generation(phi, psi, transmission_angle=least + math.radians(4))
    assert exact.best.error < 1e-8 < 1e-6 < further.best.error
    assert further.best.transmission_angle >= least + math.radians(4) - 1e-9


@pytest.mark.parametrize(
    ("demands", "code", "most"),
    [
        ({"transmission_angle": math.radians(88)}, "transmission", 85.55),
        ({"turning": True, "transmission_angle": math.radians(45)}, "transmission", 33.44),
        ({"input_zero": 0.5, "output_zero": 0.9, "turning": True}, "no_turn", 12.86),
    ],
)
def test_exact_pairs_refuse_what_they_cannot_have(demands: dict[str, float], code: str, most: float) -> None:
    with refused(f"synthesize.function.{code}", lw.SynthesisError, linkage="four-bar") as caught:
        lw.function_generation(**THREE, **demands)
    nearest, told = caught.value.nearest, float(str(caught.value.values["most"]))
    assert nearest is not None and not nearest.best.defects
    assert told == pytest.approx(most, abs=0.01)
    asked = demands.get("transmission_angle", 0.0)
    if not demands.get("turning"):
        best = nearest.best.transmission_angle
        assert best == pytest.approx(max(each.transmission_angle for each in nearest)) and best < asked
        again = lw.function_generation(**THREE, transmission_angle=math.radians(told))
        assert again.best.transmission_angle == pytest.approx(best)


def test_pairs_in_freudenstein_s_equation_refuse_what_they_do_not_have() -> None:
    given = {"input_zero": math.radians(30), "output_zero": math.radians(60), "equation_error": True}
    found = lw.function_generation(INPUTS, LOGARITHM, **given).best.transmission_angle
    told = f"{math.floor(100 * math.degrees(found)) / 100:g}"
    with refused("synthesize.function.transmission", lw.SynthesisError, most=told):
        lw.function_generation(INPUTS, LOGARITHM, **given, transmission_angle=found + 0.01)


@pytest.mark.rotating
def test_paths_have_what_is_demanded() -> None:
    asked, pivot, angle = math.radians(30), (0.01, -0.02), 0.4
    found = lw.path_generation(PATH, pivot=pivot, direction=angle, transmission_angle=asked)
    for each in every(found):
        points = each.linkage.points
        assert points["O1"] == pytest.approx(complex(*pivot), abs=1e-12)
        assert np.angle((points["O2"] - points["O1"]) * np.exp(-1j * angle)) == pytest.approx(0, abs=1e-9)
        assert sines(each, np.linspace(0, 2 * math.pi, 721)).min() >= math.sin(asked) - 1e-9
        assert each.turns
    for each in every(lw.path_generation(PATH, bound=0.03)):
        assert max(each.linkage.lengths().values()) <= 0.03 + 1e-12
    for each in every(lw.path_generation(PATH, turning=False, transmission_angle=asked, bound=0.05)):
        assert each.transmission_angle >= asked - 1e-9
        assert max(each.linkage.lengths().values()) <= 0.05 + 1e-12


def test_timed_points_are_passed_at_their_angles() -> None:
    angles = np.radians([20.0, 55.0, 90.0, 130.0, 160.0])
    best = lw.path_generation(PATH, angles=angles, phase=False, direction=0.3).best
    motion = lw.solve_motion(best.mechanism(), at=0.3 + angles)
    off = motion.point("P").position - np.array(PATH)
    assert (off**2).sum() == pytest.approx(best.error, rel=1e-6, abs=1e-15)


@pytest.mark.rotating
def test_links_of_a_demanded_ratio() -> None:
    """A family whose smallest ratio is 2.917: 3 is met, 2 is refused with that number."""
    demands = SUFFICIENT["crank_rocker"]
    for each in every(lw.synthesize("crank_rocker", **demands, link_ratio=3.0)):
        lengths = each.linkage.lengths().values()
        assert max(lengths) <= 3 * min(lengths) * (1 + 1e-9)
    with refused("synthesize.link_ratio_unmet", lw.SynthesisError, value="2", minimum="2.917") as caught:
        lw.synthesize("crank_rocker", **demands, link_ratio=2.0)
    assert caught.value.nearest is not None
    assert lw.synthesize("crank_rocker", **demands, link_ratio=2.917).best.link_ratio <= 2.917
    with refused("synthesize.link_ratio_unmet", lw.SynthesisError, value="3", minimum="4.443"):
        lw.synthesize(
            "crank_rocker", swing_angle=0.711, quick_return_ratio=1.5, frame=0.1, rocker=0.075, link_ratio=3.0
        )
    for each in every(lw.motion_generation(POSES, link_ratio=2.5)):
        assert each.link_ratio <= 2.5
    with refused("synthesize.link_ratio_unmet", lw.SynthesisError, value="1.01"):
        lw.motion_generation(POSES, link_ratio=1.01)


def test_pivots_lie_within_the_region_for_any_number_of_poses() -> None:
    """Six poses of a known crank-rocker: its pivots lie in one region, and not in a smaller one."""
    o1, o2, crank, coupler, rocker = 0j, 0.4 + 0j, 0.12, 0.35, 0.3
    pin = o1 + crank * np.exp(1j * np.linspace(0.3, 2.2, 6))
    reach = np.abs(o2 - pin)
    turned = np.arccos((reach**2 + coupler**2 - rocker**2) / (2 * reach * coupler))
    along = np.angle(o2 - pin) + turned
    poses = list(zip(pin.real, pin.imag, along, strict=True))
    found = lw.motion_generation(poses, within=[(-0.3, -0.3), (0.8, 0.8)])
    assert found.best.error < 1e-9
    for each in every(found):
        places = [each.linkage.points[name] for name in ("O1", "O2", "A", "B") if name in each.linkage.points]
        assert all(-0.3 <= place.real <= 0.8 and -0.3 <= place.imag <= 0.8 for place in places)
    with refused("synthesize.motion.no_pairs", lw.SynthesisError):
        lw.motion_generation(poses, within=[(0.05, -0.3), (0.8, 0.8)])


@pytest.mark.parametrize(
    ("task", "demands", "said"),
    [
        ("function", {"gear_ratio": 2.0}, ("gear_ratio", "linkage: geared_five_bar")),
        ("function", {"equation_error": True, "linkage": "watt"}, ("equation_error", "linkage: four_bar")),
        ("function", {"places": [0.0, 0.1, 0.2]}, ("places", '"outputs"')),
        ("function", {"frame": 0.2, "linkage": "slider_crank"}, ("frame", '"linkage: slider_crank"')),
        ("path", {"phase": False}, ("phase: false", "angles")),
        ("free_curve", {"file_unit": 0.001}, ("file_unit", "file")),
        ("quick_return", {"stroke": 0.0}, ("rod", "stroke")),
        ("motion", {"pivot_line": [(0, 0), (1, 0)], "fixed_pivots": [(0, 0)]}, ("pivot_line", '"fixed_pivots"')),
        (
            "motion",
            {"within": [(0, 0), (1, 1)], "fixed_pivots": [(0, 0), (1, 0)]},
            ("within", "two or more given pivots"),
        ),
        (
            "motion",
            {"poses": [*POSES, (0, 0.1, math.nan)], "within": [(0, 0), (1, 1)]},
            ("within", "poses whose angle is free"),
        ),
    ],
)
def test_demands_without_effect_are_refused(task: str, demands: dict[str, object], said: tuple[str, str]) -> None:
    with pytest.raises(lw.SynthesisError) as caught:
        lw.synthesize(task, **{**SUFFICIENT[task], **demands})
    other = {"synthesize.task.only_with": "needs", "synthesize.task.not_with": "other"}[caught.value.code]
    agrees(caught.value.values, {"demand": said[0], other: said[1]})

"""How a synthesis is done: every printed line, matrix and table reckoned again by another way."""

from __future__ import annotations

import math
from functools import cache
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from tests.every import every
from tests.refusals import refused
from tests.worked_reading import numeric_matrices, reckon_lines

import linkwright as lw

DEG = math.radians(1)
SVG = "{http://www.w3.org/2000/svg}"
POSES = [(0, 0, 0), (0.04, 0.015, 20 * DEG), (0.07, 0.045, 55 * DEG), (0.08, 0.09, 95 * DEG)]
FIVE = [(0, 0, 0), (1, 0.4, 0.3), (1.6, 1.2, 0.9), (1.7, 2.1, 1.5), (1.5, 2.6, 2.1)]
WINDOW = ((-0.1, -0.15), (0.2, 0.15))
PATH = [(0.02, 0.01), (0.01766, 0.015142), (0.011736, 0.017878), (0.005, 0.016928), (0.0006, 0.012736)]
ANGLES = [0, 20 * DEG, 40 * DEG, 60 * DEG, 80 * DEG]
OUTPUTS = [0, 35 * DEG, 64 * DEG, 90 * DEG, 110 * DEG]
CASES: dict[str, tuple[str, dict[str, Any]]] = {
    "ratios": ("slider_crank", {"stroke": 0.3975, "rod_ratio": 3.55, "offset_ratio": 0.305}),
    "in line": ("slider_crank", {"stroke": 0.3975, "rod_ratio": 3.55}),
    "slider K": ("slider_crank", {"stroke": 0.1, "quick_return_ratio": 1.1, "offset": 0.02}),
    "slider angle": ("slider_crank", {"stroke": 0.1, "transmission_angle": 45 * DEG, "offset": 0.02}),
    "slider angle in line": ("slider_crank", {"stroke": 0.1, "transmission_angle": 45 * DEG}),
    "crank-rocker": ("crank_rocker", {"swing_angle": 40 * DEG, "quick_return_ratio": 1.2, "frame": 0.3}),
    "crank-rocker, K 1": ("crank_rocker", {"swing_angle": 40 * DEG, "quick_return_ratio": 1, "rocker": 0.2}),
    "crank-rocker, both": (
        "crank_rocker",
        {"swing_angle": 40 * DEG, "quick_return_ratio": 1.2, "frame": 0.3, "rocker": 0.284},
    ),
    "shaper": ("quick_return", {"quick_return_ratio": 1.5, "frame": 0.43, "stroke": 0.4}),
    "lever": ("quick_return", {"quick_return_ratio": 1.5, "frame": 0.43}),
    "drag link": ("drag_link", {"quick_return_ratio": 1.5, "frame": 0.1}),
    "toggle": ("toggle", {"force_ratio": 10, "distance": 0.005, "stroke": 0.06}),
    "dwell": ("dwell", {"crank_angle": 90 * DEG, "swing_angle": 30 * DEG, "frame": 0.2}),
    "hoecken": ("straight_line", {"length": 0.1, "kind": "hoecken"}),
    "peaucellier": ("straight_line", {"length": 0.1, "kind": "peaucellier"}),
    "three pairs": (
        "function",
        {"inputs": [0.7, 1.5, 2.3], "outputs": [0.9, 1.4, 1.9], "input_zero": 0.05, "output_zero": 0, "frame": 0.05},
    ),
    "four pairs": ("function", {"inputs": ANGLES[:4], "outputs": OUTPUTS[:4], "input_zero": 0.5, "frame": 0.1}),
    "five pairs": ("function", {"inputs": ANGLES, "outputs": OUTPUTS, "frame": 0.1}),
    "equation": (
        "function",
        {"inputs": ANGLES, "outputs": OUTPUTS, "input_zero": 0.4, "output_zero": 0.7, "equation_error": True},
    ),
    "rounded": ("slider_crank", {"stroke": 0.3975, "rod_ratio": 3.55, "offset_ratio": 0.305, "rounding": 5e-4}),
    "rounded pairs": ("function", {"inputs": ANGLES, "outputs": OUTPUTS, "frame": 0.1, "rounding": 1e-3}),
    "places": (
        "function",
        {"inputs": ANGLES[:4], "places": [0, 0.035, 0.064, 0.09], "linkage": "slider_crank", "output_zero": 0.01},
    ),
    "two poses": ("motion", {"poses": POSES[:2]}),
    "three poses": ("motion", {"poses": POSES[:3]}),
    "four poses": ("motion", {"poses": POSES, "within": WINDOW}),
    "five poses": ("motion", {"poses": FIVE}),
    "six poses": ("motion", {"poses": [*FIVE, (1.2, 3.0, 2.5)]}),
    "mixed": ("motion", {"poses": [(0, 0, 0), (1, 0.4, math.nan), (1.6, 1.2, 0.9), (2, 2, math.nan)]}),
    "pivots on a line": ("motion", {"poses": POSES[:3], "pivot_line": [(-0.1, -0.2), (0.2, -0.2)]}),
    "path": ("path", {"points": PATH, "angles": [0.1, 0.6, 1.2, 1.9, 2.4]}),
    "exact path": ("exact_path", {"points": PATH}),
    "free curve": ("free_curve", {"points": [(9e-3, 0), (9e-3, 17e-3), (0, 6e-3)], "joints": 5, "seconds": 0.2}),
}
#: Those whose numbers stand in tables alone.
TABLES = ("peaucellier", "places")
#: Those that take longest.
LONG = (
    "mixed",
    "exact path",
    "dwell",
    "drag link",
    "free curve",
    "path",
    "pivots on a line",
    "six poses",
    "two poses",
)


@cache
def case(name: str) -> lw.Synthesis:
    """The result of a task, or the nearest where its demands cannot be met."""
    task, demands = CASES[name]
    try:
        return lw.synthesize(task, **demands)
    except lw.SynthesisError as error:
        if error.nearest is None:
            raise
        return error.nearest


def items(name: str, kind: str) -> list[dict[str, Any]]:
    """What a worked solution holds of a kind: ``relation``, ``table``."""
    data: Any = case(name).worked().data()
    return [item for step in data["steps"] for item in step["items"] if kind in item]


def matrices(name: str) -> list[list[np.ndarray]]:
    """The matrices of numbers of every equation of matrices that has any."""
    found = [numeric_matrices(item["latex"]) for item in items(name, "relation")]
    return [each for each in found if each]


def column(name: str, head: str) -> np.ndarray:
    """The last column of a worked solution's tables with this head, all of whose cells are numbers."""
    for table in reversed(items(name, "table")):
        if "–" in table["rows"][0] + table["rows"][-1]:  # of complex solutions
            continue
        if head in table["head"]:
            return np.array([float(row[table["head"].index(head)]) for row in table["rows"]])
    raise AssertionError(head)


@pytest.mark.parametrize("name", [name for name in CASES if name not in LONG + TABLES])
def test_every_line_comes_out_with_a_calculator(name: str) -> None:
    assert reckon_lines(case(name).worked()) == []


@pytest.mark.rotating
@pytest.mark.parametrize("name", LONG)
def test_every_line_of_a_long_search_comes_out(name: str) -> None:
    page = case(name).worked()
    if any(line.numbers for line in page.equations):
        assert reckon_lines(page) == []
    assert page.steps[-1].items


@pytest.mark.parametrize("name", ["ratios", "crank-rocker", "shaper", "three pairs", "four poses", "toggle"])
def test_the_same_numbers_in_chinese(name: str) -> None:
    english, chinese = (case(name).worked(language) for language in ("en", "zh"))
    assert [line.numbers for line in english.equations] == [line.numbers for line in chinese.equations]
    assert len(english.steps) == len(chinese.steps) and english.title != chinese.title


def output_of(lengths: dict[str, float], phi: float, near: float) -> float:
    """Output angle of a four-bar on whichever side is nearer, from the triangle A B O2."""
    a, b, c, d = (lengths[name] for name in ("a", "b", "c", "d"))
    x, y = a * math.cos(phi) - d, a * math.sin(phi)
    far = math.hypot(x, y)
    inside = math.acos((c * c + far * far - b * b) / (2 * c * far))
    both = [math.atan2(y, x) + side * inside for side in (1, -1)]
    return min((math.remainder(each - near, math.tau) for each in both), key=abs) + near


def test_three_pairs_from_the_printed_matrix() -> None:
    """The printed matrix solved anew gives the printed coefficients; its lengths, the pairs."""
    (rows, right), (solution,) = matrices("three pairs")
    p = np.linalg.solve(rows, right[:, 0])
    assert p == pytest.approx(solution[:, 0], abs=2e-4)
    c = -p[1] * 50
    a = c / p[0]
    b = math.sqrt(a * a + c * c + 50**2 - 2 * a * 50 * p[2])
    lengths = {"a": abs(a), "b": b, "c": abs(c), "d": 50.0}
    demands = CASES["three pairs"][1]
    turn = math.pi if a < 0 else 0.0
    back = math.pi if c < 0 else 0.0
    for x, y in zip(demands["inputs"], demands["outputs"], strict=True):
        psi = y + demands["output_zero"] + back
        assert output_of(lengths, x + demands["input_zero"] + turn, psi) == pytest.approx(psi, abs=2e-3)


def test_four_pairs_agree_for_the_printed_zero_angle() -> None:
    (rows, right), (solution,) = matrices("four pairs")
    for each in range(4):
        left = np.delete(np.arange(4), each)
        assert np.linalg.solve(rows[left], right[left, 0]) == pytest.approx(solution[:, 0], abs=5e-3)


def test_normal_equations_are_the_sums_over_the_pairs() -> None:
    (rows, right), (normal, moment), (solution,) = matrices("equation")
    assert normal == pytest.approx(rows.T @ rows, abs=5e-6)
    assert moment[:, 0] == pytest.approx(rows.T @ right[:, 0], abs=5e-6)
    best = np.linalg.lstsq(rows, right[:, 0], rcond=None)[0]
    assert solution[:, 0] == pytest.approx(best, abs=1e-2)
    off = column("equation", "residual")
    assert off == pytest.approx(rows @ solution[:, 0] - right[:, 0], abs=2e-5)
    phi = np.radians(column("equation", "φ / °"))
    assert phi == pytest.approx(CASES["equation"][1]["inputs"], abs=1e-6)


def circle_through(points: np.ndarray) -> complex:
    """Centre of the circle through three points, by the circumcentre's formula in complex numbers."""
    a, b, c = points
    b, c = b - a, c - a
    return complex(a + b * c * (b.conjugate() - c.conjugate()) / (b.conjugate() * c - b * c.conjugate()))


def positions(name: str, pin: str) -> np.ndarray:
    """Places of a pin as its table prints them, mm."""
    return np.asarray(column(name, f"x_{pin} / mm") + 1j * column(name, f"y_{pin} / mm"))


@pytest.mark.parametrize("name", ["three poses", "four poses", "five poses"])
def test_pivots_are_the_centres_of_the_printed_places(name: str) -> None:
    """The bisectors' matrix solved anew, and the circle through three places; the others lie on it too."""
    found = [each for each in matrices(name) if len(each) == 2]
    for (rows, right), pin, pivot in zip(found, "AB", ("O1", "O2"), strict=True):
        places = positions(name, pin)
        centre = circle_through(places[:3])
        solved = np.linalg.lstsq(rows, right[:, 0], rcond=None)[0]
        own = 1e3 * case(name).best.linkage.points[pivot]
        assert centre == pytest.approx(own, rel=1e-4)
        assert complex(*solved) == pytest.approx(own, rel=1e-4)
        assert np.abs(places - own) == pytest.approx(abs(places[0] - own), abs=2e-4)


def test_poses_turn_about_the_printed_poles() -> None:
    table = next(each for each in items("four poses", "table") if "φ_k − φ_j / °" in each["head"])
    pairs = [(j, k) for j in range(4) for k in range(j + 1, 4)]
    places = [1e3 * complex(x, y) for x, y, _ in POSES]
    for (j, k), (_, turn, x, y) in zip(pairs, table["rows"], strict=True):
        pole = complex(float(x), float(y))
        moved = pole + (places[j] - pole) * np.exp(1j * math.radians(float(turn)))
        assert moved == pytest.approx(places[k], abs=2e-3)


def test_points_of_the_printed_circle_curve_stay_on_circles() -> None:
    """Points of the cubic with the printed coefficients: four places on the circle through three of them."""
    table = next(each for each in items("four poses", "table") if each["head"][0] == "term")
    coefficients = {row[0]: float(row[1]) for row in table["rows"]}
    size = case("four poses").derivation.size * 1e3  # type: ignore[union-attr]
    seen = 0
    for u in (-0.6, -0.2, 0.3, 0.8):
        in_v = [
            coefficients["v³"],
            coefficients["v²"] + coefficients["uv²"] * u,
            coefficients["v"] + coefficients["uv"] * u + coefficients["u²v"] * u * u,
            coefficients["1"] + coefficients["u"] * u + coefficients["u²"] * u**2 + coefficients["u³"] * u**3,
        ]
        for v in (root.real for root in np.roots(in_v) if abs(root.imag) < 1e-9):
            z = size * complex(u, v)
            places = np.array([1e3 * complex(x, y) + z * np.exp(1j * t) for x, y, t in POSES])
            centre = circle_through(places[:3])
            radius = abs(places[0] - centre)
            assert abs(places[3] - centre) == pytest.approx(radius, abs=1e-4 * size)
            seen += 1
    assert seen >= 4


def test_coupler_point_of_a_path_from_the_printed_coordinates() -> None:
    """P is A + (ξ, η) turned with A B, and the distances are those to the demanded points."""
    best = case("path").best
    a, b, p = (positions("path", name) for name in "ABP")
    local = {line.symbol: line.value for line in case("path").worked().equations if line.symbol in "ξη"}
    unit = (b - a) / np.abs(b - a)
    assert a + complex(local["ξ"], local["η"]) * unit == pytest.approx(p, abs=1e-3)
    off = np.abs(p - 1e3 * np.array([complex(*each) for each in PATH]))
    assert column("path", "distance / mm") == pytest.approx(off, abs=2e-4)
    assert np.sum(off**2) * 1e-6 == pytest.approx(best.error, rel=1e-2)


def test_a_dwell_from_the_printed_coordinates() -> None:
    """The distance from the arc's centre, and the solver's own output of the whole rest."""
    values = {line.symbol: line.value for line in case("dwell").worked().equations}
    p = column("dwell", "x_P / mm") + 1j * column("dwell", "y_P / mm")
    far = np.abs(p - complex(values["x_C"], values["y_C"]))
    assert far - values["ρ"] == pytest.approx(column("dwell", "|CP| − ρ / mm"), abs=2e-4)
    best = case("dwell").best
    motion = lw.solve_motion(best.mechanism(), steps=720)
    angle = np.unwrap(motion.link("output").angle)[: 720 // 4 + 1]
    assert np.degrees(np.ptp(angle)) / 2 == pytest.approx(np.abs(column("dwell", "Δψ / °")).max(), abs=2e-3)


@pytest.mark.parametrize("name", ["crank-rocker", "crank-rocker, both"])
def test_a_crank_rocker_moves_as_its_lines_say(name: str) -> None:
    """Swing and quick return of the motion itself, from the lengths in the table."""
    lengths = {line.symbol: line.value for line in case(name).worked().equations if line.symbol in "abcd"}
    phi = np.linspace(0, math.tau, 20001)
    a, b, c, d = (lengths[each] for each in "abcd")
    far = np.hypot(a * np.cos(phi) - d, a * np.sin(phi))
    psi = np.arctan2(a * np.sin(phi), a * np.cos(phi) - d)
    psi = np.unwrap(psi - np.arccos((c * c + far**2 - b * b) / (2 * c * far)))
    assert np.degrees(np.ptp(psi)) == pytest.approx(40, abs=1e-3)
    turn = abs(phi[psi.argmax()] - phi[psi.argmin()])
    slow = max(turn, math.tau - turn)
    assert slow / (math.tau - slow) == pytest.approx(1.2, abs=2e-3)


def test_rounded_lengths_have_the_error_that_is_shown() -> None:
    """Multiples of a millimetre, and the output of the rounded four-bar from its own triangle."""
    best = case("rounded pairs").best
    points = best.linkage.points
    ends = {"a": ("O1", "A"), "b": ("A", "B"), "c": ("O2", "B"), "d": ("O1", "O2")}
    lengths = {name: 1e3 * abs(points[last] - points[first]) for name, (first, last) in ends.items()}
    assert [each - round(each) for each in lengths.values()] == pytest.approx([0] * 4, abs=1e-9)
    zeros = [case("five pairs").best.values[f"{name}_zero [rad]"] for name in ("input", "output")]
    off = [
        output_of(lengths, x + zeros[0], y + zeros[1]) - y - zeros[1] for x, y in zip(ANGLES, OUTPUTS, strict=True)
    ]
    assert best.deviations == pytest.approx(off, abs=1e-9) and 0 < best.error < 0.02
    assert best.error == pytest.approx(np.sqrt(np.mean(np.square(off))), rel=1e-6)


def test_rounding_that_loses_the_linkage_is_refused() -> None:
    with refused("synthesize.rounding", lw.SynthesisError, value="500") as caught:
        lw.synthesize("slider_crank", stroke=0.3975, rod_ratio=3.55, rounding=0.5)
    nearest = caught.value.nearest
    assert nearest.best.values["rod [m]"] == pytest.approx(3.55 * 0.3975 / 2)
    with refused("synthesize.task.only_with", lw.SynthesisError, demand="rounding"):
        lw.function_generation(ANGLES, OUTPUTS, linkage="watt", rounding=1e-3)
    with refused("synthesize.not_positive", lw.SynthesisError, name="rounding"):
        lw.function_generation(ANGLES, OUTPUTS, rounding=0.0)


def test_branch_defects_show_in_the_signs() -> None:
    """Of five poses the best linkage has a circuit defect: its transmission angle changes its sign."""
    signs = np.sign(column("five poses", "μ / °"))
    assert case("five poses").best.defects and set(every(signs)) == {-1.0, 1.0}
    assert set(np.sign(column("four poses", "μ / °"))) == {-1.0}


def test_cognates_have_no_way_of_their_own() -> None:
    with refused("synthesize.no_derivation", lw.SynthesisError, task="cognates"):
        lw.cognates(case("path").best.linkage).worked()


def drawn(name: str, language: str = "en") -> ElementTree.Element:
    """The SVG of a construction."""
    return ElementTree.fromstring(case(name).plot("construction", language=language).svg())


def test_the_crank_pivot_lies_on_the_drawn_circle() -> None:
    """Seen from the pivot the limit positions of the rocker enclose θ, and the dashed circle passes all three, to the
    scale of 10 mm on a mm of paper, four units."""
    svg = drawn("crank-rocker")
    (locus,) = [
        np.fromstring(path.get("d", "")[1:].replace("L", " "), sep=" ").reshape(-1, 2) @ (1, -1j)
        for path in svg.iterfind(f".//{SVG}path[@class='lw-locus-line']")
    ]
    centre, radius = locus[:-1].mean(), float(np.ptp(locus.real)) / 2
    pins = {
        complex(float(pin.get("cx", "")), -float(pin.get("cy", "")))
        for pin in svg.iterfind(f".//{SVG}circle[@class='lw-pin']")
    }
    *limits, pivot = sorted((pin for pin in pins if abs(abs(pin - centre) - radius) < 0.1), key=lambda z: z.real)
    assert abs(limits[0] - limits[1]) / 4 * 10 == pytest.approx(2 * 284.2078 * math.sin(20 * DEG), abs=0.1)
    values = {line.symbol: line.value for line in case("crank-rocker").worked().equations}
    o2 = min(
        pins, key=lambda pin: abs(abs(pin - limits[0]) - 4 * 28.42078) + abs(abs(pin - limits[1]) - 4 * 28.42078)
    )
    assert (pivot - o2) / 4 * 10 == pytest.approx(complex(values["x_O1"], values["y_O1"]), abs=0.1)
    seen = np.angle((limits[0] - pivot) / (limits[1] - pivot))
    assert abs(np.degrees(seen)) == pytest.approx(180 * 0.2 / 2.2, abs=0.02)


def test_the_error_curve_has_the_deviations() -> None:
    found = case("equation")
    (curve,) = [line for line in found.plot("structural_error").figure.axes[0].lines if line.get_marker() == "o"]
    assert curve.get_ydata() == pytest.approx(np.degrees(found.best.deviations))
    assert curve.get_xdata() == pytest.approx(np.degrees(CASES["equation"][1]["inputs"]))


@pytest.mark.parametrize(
    "name", ["ratios", "in line", "shaper", "lever", "two poses", "five poses", "crank-rocker, K 1"]
)
def test_every_construction_is_drawn(name: str) -> None:
    """With every limit position or place of a pin as a point."""
    names = {"".join(text.itertext()) for text in drawn(name, "zh").iterfind(f".//{SVG}text")}
    assert {"B1", "B2"} <= names or {"E1", "E2"} <= names or {"A1", "B1", "P1"} <= names


def test_what_is_exact_has_no_error_curve() -> None:
    with pytest.raises(lw.LinkwrightError):
        case("three pairs").plot("structural_error")

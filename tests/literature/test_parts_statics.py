"""Force systems, bodies, belts and wedges against closed forms; printed numbers are compared in test_published."""

import math
import re

import numpy as np
import pytest
from tests.contract.calculations import solved
from tests.refusals import refused

import linkwright as lw
from linkwright import parts


def test_wrench_carries_the_same_moments() -> None:
    forces = {
        "a": parts.Force(force=(3, -1, 2), at=(0.2, 1, -0.4)),
        "b": parts.Force(force=(-1, 4, 0.5), at=(1, 0.3, 2)),
    }
    found = parts.ForceSystem(forces, {"c": (0.1, 2, -1)}, about=(0.5, 0.5, 0.5)).solve()
    for place in np.random.default_rng(3).normal(size=(4, 3)):
        whole = sum(np.cross(f.place - place, f.vector) for f in forces.values()) + np.array([0.1, 2, -1])
        wrench = np.cross(found.axis_point - place, found.force) + found.pitch * found.force
        assert wrench == pytest.approx(whole, abs=1e-12)


def test_two_bars_as_structure() -> None:
    """Six reactions of the lecture's two bars, by moments about C."""
    found = parts.equilibrium(lw.load("gallery:two_bars_equilibrium"))
    a_y = (250 + 100 * math.sqrt(3)) / (1 + math.sqrt(3))
    assert found.reaction("A", "bar_1") == pytest.approx([250 - a_y, a_y], abs=1e-9)
    assert found.reaction("B", "bar_2") == pytest.approx([a_y - 250, 300 - a_y], abs=1e-9)
    assert found.reaction("C", "bar_2") == pytest.approx([250 - a_y, a_y - 200], abs=1e-9)


def printed_system(worked: str) -> tuple[np.ndarray, np.ndarray, dict[str, float]]:
    """A, B and the unknowns by name of A·X = B, and the reactions below it, as a worked text prints them."""
    lines = [line for line in worked.splitlines() if re.search(r"Σ[FM]\w*: .*[⎡⎢⎣].*[⎡⎢⎣]", line)]
    parts_of = [re.findall(r"[⎡⎢⎣]([^⎤⎥⎦]*)[⎤⎥⎦]", line) for line in lines]
    a = np.array([[float(c) for c in row[0].split()] for row in parts_of])
    names = [row[1].strip() for row in parts_of if row[1].strip()]
    b = np.array([float(row[-1]) for row in parts_of])
    found = np.linalg.solve(a, b)
    return a, b, dict(zip(names, found, strict=True))


@pytest.mark.parametrize("name", ["two_bars_equilibrium", "truss"])
def test_the_printed_matrix_gives_the_printed_reactions(name: str) -> None:
    """Solved from the text alone, to the digits that it prints."""
    found = parts.equilibrium(lw.load(f"gallery:{name}"))
    worked = found.worked()
    _, _, solved_by_hand = printed_system(worked)
    assert len(solved_by_hand) == (6 if name == "two_bars_equilibrium" else 12)
    for unknown, value in solved_by_hand.items():
        printed = re.findall(rf"(?m)^ +{re.escape(unknown)} +(?:\[|=) ?(-?[\d.e+-]+) N", worked)
        assert float(printed[-1]) == pytest.approx(value, abs=0.02)


def test_matrix_of_the_lectures_two_bars() -> None:
    """The 6 × 6 system of moments about A and B, put together by hand from lengths and angles."""
    c1, s1 = 2 * math.cos(math.radians(30)), 2 * math.sin(math.radians(30))
    by_hand = np.array(
        [
            [1, 0, 0, 0, -1, 0],
            [0, 1, 0, 0, 0, -1],
            [0, 0, 0, 0, s1, -c1],
            [0, 0, 1, 0, 1, 0],
            [0, 0, 0, 1, 0, 1],
            [0, 0, 0, 0, -1, -1],
        ]
    )
    balance = parts.equilibrium(lw.load("gallery:two_bars_equilibrium")).balance
    assert balance is not None and balance.names == ("Ax", "Ay", "Bx", "By", "Cx", "Cy")
    assert balance.on == ("bar_1", "bar_1", "bar_2", "bar_2", "bar_2", "bar_2")
    assert balance.a == pytest.approx(by_hand, abs=1e-12)
    assert balance.b == pytest.approx([0, 200, 200 * c1 / 2, 0, 100, -50], abs=1e-9)
    assert np.linalg.solve(balance.a, balance.b) == pytest.approx(balance.x, abs=1e-9)


STRUCTURES = [name for name in lw.gallery.names() if not lw.load(f"gallery:{name}").drivers]
AT_REST = (
    "shaper_quick_return",
    "swing_conveyor",
    "jaw_crusher_sixbar",
    "scotch_yoke",
    "excavator",
    "oldham_coupling",
)


@pytest.mark.parametrize("name", [*STRUCTURES, *AT_REST])
def test_the_matrix_gives_what_the_solver_of_mechanisms_found(name: str) -> None:
    balance = parts.equilibrium(lw.load(f"gallery:{name}")).balance
    assert balance is not None and balance.a.shape == (len(balance.rows), len(balance.names))
    size = max(float(np.abs(balance.x).max()), 1.0)
    assert np.linalg.solve(balance.a, balance.b) == pytest.approx(balance.x, abs=1e-9 * size)


def test_gears_have_no_matrix_form() -> None:
    assert parts.equilibrium(lw.load("gallery:external_gear_pair")).balance is None


def test_a_hook_on_two_bars() -> None:
    found = solved("hook_on_two_bars")
    assert found.magnitudes["S2"] == pytest.approx(-500 * math.sqrt(2), rel=1e-12)
    assert found.magnitudes["S1"] == pytest.approx(500, rel=1e-12)


def test_three_ropes_in_space() -> None:
    assert list(solved("mast_ropes").magnitudes.values()) == pytest.approx([300, 300, 260], rel=1e-12)


@pytest.mark.parametrize("space", [2, 3])
def test_points_are_in_equilibrium_with_what_is_found(space: int) -> None:
    """Sums of all forces, for random directions and loads; A·X = B likewise."""
    rng = np.random.default_rng(space)
    for _ in range(20):
        forces = {f"S{k}": parts.Force(along=tuple(rng.normal(size=space))) for k in range(space)}
        forces["W"] = parts.Force(force=tuple(rng.normal(size=space)))
        found = parts.ForceSystem(forces).solve()
        assert sum(found.vectors.values()) == pytest.approx(np.zeros(3), abs=1e-9)
        a, b = found.matrix
        assert a.shape == (space, space)
        assert a @ list(found.magnitudes.values()) == pytest.approx(b, abs=1e-9)


def test_dot_products() -> None:
    """F·e with e = (2, 3, 6)/7; the angle by its cosine; across it by Pythagoras."""
    data = solved("force_components").data()
    pole = data["component pole"]
    assert pole["along"]["value"] == pytest.approx(310, rel=1e-12)
    force = np.array([140.0, 210.0, 210.0])
    assert pole["across"]["value"] == pytest.approx(math.sqrt(force @ force - 310**2), rel=1e-12)
    angle = data["angles"]["between: F, P"]["value"]
    assert math.cos(angle) == pytest.approx(force @ (2, -1, 2) / (3 * np.linalg.norm(force)), rel=1e-12)


def test_a_rigid_body_as_a_linear_system() -> None:
    """By hand: x and y at A, the rope's 30°, moments about A."""
    a, b = solved("bracket").matrix
    h = math.sqrt(3) / 2
    assert a == pytest.approx(np.array([[1, 0, -h], [0, 1, 0.5], [0, 0, 1.5]]), abs=1e-12)
    assert b == pytest.approx([0, 600, 900])


def test_bracket() -> None:
    values = solved("bracket").values
    assert values["B.S"] == pytest.approx(600, abs=1e-9)
    assert values["A.Fx"] == pytest.approx(300 * math.sqrt(3), abs=1e-9)
    assert values["A.Fy"] == pytest.approx(300, abs=1e-9)


def test_body_in_space_on_three_feet_and_three_guides() -> None:
    """A table: each foot carries its share by the centroid's barycentric coordinates."""
    feet = {"A": (0.0, 0.0, 0.0), "B": (2.0, 0.0, 0.0), "C": (0.0, 1.0, 0.0)}
    supports = {name: parts.Support(at=at, along=(0, 0, 1)) for name, at in feet.items()}
    supports["guide"] = parts.Support(at=(0.0, 0.0, 0.0), holds=("x", "y", "turn_z"))
    body = parts.RigidBody(supports, {"W": parts.Force(force=(0, 0, -100), at=(0.5, 0.25, 1.0))})
    values = body.solve().values
    assert [values[f"{n}.S"] for n in "ABC"] == pytest.approx([50, 25, 25], abs=1e-9)


def test_belt_brake_and_v_belt() -> None:
    brake = solved("band_brake")
    ratio = math.exp(0.3 * math.radians(225))
    assert brake.tight / brake.slack == pytest.approx(ratio, rel=1e-12)
    assert brake.tight - brake.slack == pytest.approx(1500, rel=1e-12)
    vee = parts.Belt(friction=0.3, wrap=math.pi, groove=math.radians(38), tight=500, mass=0.2, speed=20).solve()
    assert (500 - 80) / (vee.slack - 80) == pytest.approx(math.exp(0.3 * math.pi / math.sin(math.radians(19))))


def test_wedge_without_friction_is_an_inclined_plane() -> None:
    found = parts.Wedge(load=1000, angle=0.2, friction=0.0).solve()
    assert found.raising == pytest.approx(1000 * math.tan(0.2), rel=1e-12)
    assert found.lowering == pytest.approx(found.raising, rel=1e-12)
    assert found.efficiency == pytest.approx(1.0)


@pytest.mark.parametrize("angle", [0.15, 0.3, 0.01, 0.6])
@pytest.mark.parametrize("sense", [1, -1])
def test_wedge_against_the_balance_of_forces(sense: int, angle: float) -> None:
    """Normal and friction forces on load and wedge as unknowns of one linear system, for either side of the guide.

    The side is the one that presses; its friction is against the way of the load, up while it sinks.
    """
    load, slope, floor, wall = 800.0, 0.2, 0.1, 0.25
    s, c = math.sin(angle), math.cos(angle)
    f1, f2 = sense * slope, sense * floor
    pushes = []
    for side in (1, -1):
        # unknowns: normal on the slope, on the floor, on this side of the guide, push on the wedge
        balance = [
            [-s - f1 * c, 0, side, 0],
            [c - f1 * s, 0, -sense * wall, 0],
            [s + f1 * c, f2, 0, -1],
            [-c + f1 * s, 1, 0, 0],
        ]
        on_slope, on_floor, on_side, push = np.linalg.solve(balance, [0, load, 0, 0])
        assert on_slope > 0 and on_floor > 0
        if on_side > 0:
            pushes.append(push)
    assert len(pushes) == 1
    assert parts.Wedge(load, angle, slope, floor, wall).push(sense) == pytest.approx(pushes[0], rel=1e-12)


def test_wedge_locks_where_the_angle_is_below_both_friction_angles() -> None:
    limit = 2 * math.atan(0.15)
    assert parts.Wedge(1.0, 0.99 * limit, 0.15).solve().locks
    assert not parts.Wedge(1.0, 1.01 * limit, 0.15).solve().locks


def test_a_rotor_balanced_in_two_planes_puts_neither_force_nor_couple_on_its_bearings() -> None:
    """By sums of m r and m r z over all masses and counterweights, for random rotors."""
    rng = np.random.default_rng(5)
    for _ in range(20):
        heavy = rng.uniform([0.1, 0.01, 0, -1], [20, 0.5, 2 * math.pi, 2], (rng.integers(1, 7), 4))
        places, radii = rng.permutation([-0.3, 0.2, 1.1])[:2], rng.uniform(0.05, 0.4, 2)
        rotor = parts.Rotor(
            masses={f"m{k}": parts.HeavyPoint(*row.tolist()) for k, row in enumerate(heavy)},
            planes={n: parts.BalancingPlane(r, z) for n, r, z in zip("ab", radii, places, strict=True)},
        )
        weights = rotor.solve().counterweights
        m, r, angle, z = heavy.T
        products = np.append(m * r * np.exp(1j * angle), radii * np.array([weights["a"], weights["b"]]))
        assert abs(products.sum()) < 1e-12 * np.abs(products).sum()
        assert abs((products * np.append(z, places)).sum()) < 1e-12 * np.abs(products).sum()


def test_four_masses_of_a_rotor_by_hand() -> None:
    """Shares of plane I 1, 2/3, 1/3, 0, of plane II 0, 1/3, 2/3, 1; cos 30° = √3/2."""
    h = math.sqrt(3) / 2
    first = complex(-2 - 1.5 + 2 / 3, 4 * h - 3 * h - 4 / 3 * h)
    second = complex(-0.75 + 4 / 3 + 3 * h, -1.5 * h - 8 / 3 * h + 1.5)
    found = solved("rotor_four_masses").data()
    for name, sum_ in (("I", first), ("II", second)):
        assert found[f"plane {name}"]["counterweight"]["value"] == pytest.approx(abs(sum_) / 0.5, rel=1e-12)
        seat = math.atan2(-sum_.imag, -sum_.real) % (2 * math.pi)
        assert found[f"plane {name}"]["seat"]["value"] == pytest.approx(seat, rel=1e-12)


ROTOR = """format: 1
kind: rotor
name: disc pair
masses:
  a: {mass: 2 kg, radius: 100 mm, angle: 0 deg, at: 0 mm}
  b: {mass: 2 kg, radius: 100 mm, angle: 180 deg, at: 250 mm}
planes: {P: {radius: 80 mm, at: 0 mm}}
speed: 100 rad/s
"""


def test_one_plane_balances_forces_and_says_the_couple_that_stays() -> None:
    """Two equal masses opposite each other: 0.2 kg·m and 0.25 m apart, so ω² · 0.05 kg·m² is left."""
    result = parts.loads(ROTOR).solve()
    data = result.data()
    assert data["plane P"]["counterweight"]["value"] == data["plane P"]["rotating_force"]["value"] == 0.0
    assert data["left"]["rotating_couple"]["value"] == pytest.approx(500.0, rel=1e-12)


HEAVY = "mass: 2 kg, radius: 100 mm, angle: 0 deg"


@pytest.mark.parametrize(
    ("old", "new", "key", "code", "values"),
    [
        ("planes: {P: {radius: 80 mm, at: 0 mm}}", "planes: {}", "planes", "rotor_planes", {"count": 0}),
        ("{P: {", "{Q: {radius: 1 m, at: 0 mm}, P: {", "planes.P.at", "rotor_place", {}),
        ("{P: {", "{Q: {radius: 1 m}, R: {radius: 1 m, at: 1 m}, P: {", "planes", "rotor_planes", {"count": 3}),
        (HEAVY, HEAVY.replace("2 kg", "0 kg"), "masses.a.mass", "range", {"shown": "0 kg"}),
    ],
)
def test_a_rotor_that_cannot_be_balanced_so_is_refused(
    old: str, new: str, key: str, code: str, values: dict[str, object]
) -> None:
    assert ROTOR.count(old) == 1
    with refused(code, lw.ModelError, **values) as caught:
        parts.loads(ROTOR.replace(old, new)).solve()
    (finding,) = caught.value.findings
    assert finding.key == key and finding.remedy


def test_a_rotor_in_balance_has_no_direction_of_its_unbalance() -> None:
    text = """
format: 1
kind: rotor
masses: {a: {mass: 2 kg, radius: 100 mm, angle: 0 deg}, b: {mass: 4 kg, radius: 50 mm, angle: 180 deg}}
planes: {P: {radius: 50 mm}}
"""
    found = parts.loads(text).solve()
    assert found.unbalances["P"] == 0 and "°" not in found.text() + found.worked()

"""Free curves: gradients, motion by the solver, demands, place and size, a linkage's own curve."""

import math
from itertools import count
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw
from linkwright.core.arrays import Integers
from linkwright.formula import machine_code
from linkwright.synthesis.free_curve import search
from linkwright.synthesis.free_curve.atlas import STEP, Atlas, M, Matches, _draws, parts, places
from linkwright.synthesis.free_curve.atlas_kernels import TURNS
from linkwright.synthesis.free_curve.linkages import Placed, drawing, linkage_of
from linkwright.synthesis.free_curve.local_search import DAMPING
from linkwright.synthesis.free_curve.placing import BLOCK, GUIDE, PIVOT, POINT, SLIDER
from linkwright.synthesis.free_curve.search import Search, polished
from linkwright.synthesis.free_curve.target import (
    FINE,
    MIDDLE,
    Target,
    even_points,
    normal,
    path_points,
    read_curve,
    symmetric_distance,
)
from linkwright.synthesis.free_curve.topology import (
    FOUR_BAR,
    ONE_DYAD,
    Design,
    Draw,
    Node,
    flat,
    kernels,
    node_paths,
    random_structure,
    turned_paths,
    with_dyad,
    with_joint,
)

pytestmark = [
    pytest.mark.skipif(not machine_code.available(), reason="llvmlite does not run here"),
    pytest.mark.rotating,
]
FOUR = np.array([0.9, 0.9 + 1.7j, 0.6j, 1.3 + 0.6j])  # a figure 4 in one stroke
#: The one dyad slides, and both ends of sliding dyads move.
SLIDING: tuple[list[Node], ...] = (
    [*ONE_DYAD[1], (PIVOT, 0, 0, 1), (BLOCK, 4, 5, -1), (POINT, 4, 6, 1)],
    [*ONE_DYAD[2], (GUIDE, 0, 0, 1), (SLIDER, 4, 5, -1), (POINT, 4, 6, 1)],
    [*FOUR_BAR, (BLOCK, 1, 3, 1), (POINT, 1, 4, 1)],
    [*FOUR_BAR[:3], (POINT, 0, 1, 1), (BLOCK, 2, 3, 1), (POINT, 2, 4, 1)],
)


def _some(joints: int, draw: Draw) -> Integers:
    """A structure with or without slides."""
    kind = int(draw.integers(2 * len(SLIDING)))
    return flat(SLIDING[kind]) if kind < len(SLIDING) else random_structure(2, joints, draw)


@pytest.mark.parametrize(("closed", "rest"), [(True, 0), (False, 48), (False, 0)])
def test_gradients_are_slopes(closed: bool, rest: int) -> None:
    draw = np.random.default_rng(4)
    target = Target(FOUR, closed, math.radians(50), 3.0)
    points = target._points[MIDDLE.points, False]
    room, options, checked = np.zeros(60000), np.array([math.sin(math.radians(50)) ** 2, 3.0, 1.0, 4e-6]), 0
    while checked < 10:
        nodes = _some(8, draw)
        joints = len(nodes) // 4
        x = np.concatenate([draw.normal(0.6, 0.7, 2 * (joints - 2)), [0.3, 0.4, 3.0]])

        def value(at: np.ndarray, slope: np.ndarray, nodes: np.ndarray = nodes, joints: int = joints) -> float:
            arrays = [each.ctypes.data for each in (options, room, slope)]
            found = kernels()(
                "deviation",
                nodes.ctypes.data,
                joints,
                96,
                96 + rest,
                int(closed),
                at.ctypes.data,
                points.ctypes.data,
                MIDDLE.points,
                *arrays,
            )
            return float(found)

        slope, unused = np.zeros(len(x)), np.zeros(len(x))
        if value(x, slope) > 1e3:
            continue
        numeric, longer = (
            np.array([(value(x + h, unused) - value(x - h, unused)) / (2 * step) for h in step * np.eye(len(x))])
            for step in (1e-7, 1e-6)
        )
        near_numeric = pytest.approx(numeric, abs=2e-6 * max(1.0, np.abs(numeric).max()))
        if longer == near_numeric:  # else a kink of the distances lies within a step
            assert slope == near_numeric
            checked += 1


def test_one_more_dyad_leaves_the_curve() -> None:
    draw = np.random.default_rng(8)
    target, turn = Target(FOUR, False, math.radians(20), 6.0), np.linspace(0, 2 * np.pi, 145)
    inserted = 0
    while inserted < 20:
        nodes = _some(8, draw)
        design = Design(nodes, np.concatenate([draw.normal(0.6, 0.7, len(nodes) // 2 - 4), [0.3, 0.4, 3.0]]), False)
        if target.descend(design, 0).value > 1e3:
            continue
        before, _ = node_paths(design.nodes, design.x, turn)
        for each in target.grown(design, draw.random((96, 9)), 12)[:6]:
            after, least = node_paths(each.nodes, each.x, turn)
            assert np.abs(after[-1] - before[-1]).max() < 1e-12
            assert each.links == design.links + 2 and each.joints - design.joints in (2, 3)
            own = node_paths(design.nodes, design.x, turn)[1]
            assert least >= 0.999 * min(own, 0.7 * math.sin(target.min_angle) ** 2)
            inserted += each.nodes[-4] != POINT or each.nodes[-3] != design.joints - 1


def test_a_dyad_at_the_drawing_point_leaves_the_curve_and_closes() -> None:
    draw = np.random.default_rng(9)
    target, turn, hung = Target(FOUR, False, math.radians(20), 6.0), np.linspace(0, 2 * np.pi, 145), 0
    while hung < 40:
        nodes = _some(7, draw)
        numbers = np.concatenate([draw.normal(0.6, 0.7, len(nodes) // 2 - 4), [0.3, 0.4, 3.0]])
        design = Design(nodes, numbers, False)
        if target.descend(design, 0).value > 1e3:
            continue
        each = with_dyad(design, draw, 10)
        if each is None:
            continue
        after, least = node_paths(each.nodes, each.x, turn)
        assert np.abs(after[-1] - node_paths(nodes, numbers, turn)[0][-1]).max() < 1e-12
        assert least > 0 and each.links == design.links + 2 and each.joints - design.joints in (2, 3)
        hung += 1


def test_the_paths_of_a_turn_are_those_of_the_formulas() -> None:
    draw, seen = np.random.default_rng(6), [0, 0]
    while min(seen) < 10:
        nodes = _some(8, draw)
        x = draw.normal(0.6, 0.7, len(nodes) // 2 - 4)
        paths, least = node_paths(nodes, x, np.linspace(0, 2 * np.pi, 145)[:-1])
        found = turned_paths(nodes, x, 144)
        if abs(least) < 1e-3:
            continue
        assert (found is None) == (least < 0)
        assert found is None or np.abs(found - paths).max() < 1e-9 * np.abs(paths).max()
        seen[least > 0] += 1


def _distances(design: Design, points: np.ndarray, crank: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distances from curve to target and back, point to polyline, and the shares of the curve's length."""
    z = node_paths(design.nodes, design.x, crank)[0][-1]
    step = np.abs(np.diff(z))
    share = (np.append(step, 0) + np.append(0, step)) / (2 * step.sum())
    z = z - share @ z
    z = z / np.sqrt(share @ np.abs(z) ** 2) * np.exp(1j * design.x[-3])

    def apart(p: np.ndarray, line: np.ndarray) -> np.ndarray:
        way = np.diff(line)
        along = np.clip(((p[:, None] - line[:-1]) * way.conj()).real / np.abs(way) ** 2, 0, 1)
        return np.asarray(np.abs(p[:, None] - line[:-1] - along * way).min(1))

    return np.concatenate([apart(z, points), apart(points, z)]), share


def test_the_objective_is_the_distance_of_the_two_lines() -> None:
    draw, target, seen = np.random.default_rng(3), Target(FOUR, False, math.radians(20), 6.0), 0
    while seen < 12:
        nodes = random_structure(2, 8, draw)
        x = np.concatenate([draw.normal(0.6, 0.7, len(nodes) // 2 - 4), [*draw.uniform(0, 6, 2), 4.0]])
        for fineness in (MIDDLE, FINE):
            found = target.descend(Design(nodes, x, False), 0, fineness, weight=0.0).value
            if found > 1e3:
                break
            crank = np.linspace(x[-2], x[-2] + x[-1], fineness.drawn)
            marks = even_points(target.points, fineness.points, False)
            far, share = _distances(Design(nodes, x, False), marks, crank)
            weight = np.append(share, np.full(len(marks), 1 / len(marks)))
            assert found == pytest.approx(weight @ np.hypot(far, fineness.soft), rel=1e-9)
            seen += 1


@pytest.mark.parametrize(("apart", "hidden"), [(1.5, False), (1.006, True), (0.994, False), (1.0001, True)])
def test_a_curve_is_judged_where_no_position_of_a_descent_sees_it(apart: float, hidden: bool) -> None:
    nodes, pivot = flat([*ONE_DYAD[2]]), apart * np.exp(1.7j)  # the crank's pin passes 1.7 rad at distance 1
    x = np.array([pivot.real, pivot.imag, 0.0, 0.0, 2.0, 0.1, 0.0, 0.4, 4.0])
    seen, whole = (node_paths(nodes, x, np.linspace(0.4, 4.4, n))[0][-1] for n in (FINE.drawn, 20001))
    target = Target(seen, False, math.radians(20), 6.0)
    design = target.descend(Design(nodes, x, False), 0, FINE, weight=0.0)
    true = symmetric_distance(normal(even_points(whole, 4000, False)), target.points)
    found = target.checked(design, 0.0).value
    assert found > 0.85 * true
    assert found < 1.2 * true or abs(apart - 1) < 1e-3
    assert (design.value < 0.75 * true) == hidden


def test_the_curvature_of_a_descent_is_that_of_the_distances() -> None:
    nodes = flat([*FOUR_BAR, (POINT, 1, 3, 1)])
    x = np.array([3.2, 0.3, math.log(2.6), math.log(2.4), 0.5, 0.8, 0.4, 0.7, 4.5])
    crank = np.linspace(x[-2], x[-2] + x[-1], MIDDLE.drawn)
    drawn = node_paths(nodes, x + np.array([0.3, 0, 0.1, 0, 0.1, 0, 0, 0, 0]), crank)[0][-1]
    target = Target(drawn * np.exp(0.6j), False, math.radians(20), 6.0)
    points = target._points[MIDDLE.points, False]
    marks = points[: MIDDLE.points] + 1j * points[MIDDLE.points : 2 * MIDDLE.points]
    inverse, room, soft = np.zeros((9, 9)), np.zeros(60000), 4e-4
    arrays = [each.ctypes.data for each in (x, points)]
    assert (
        kernels()(
            "curvature",
            nodes.ctypes.data,
            5,
            MIDDLE.drawn,
            0,
            *arrays,
            MIDDLE.points,
            soft,
            inverse.ctypes.data,
            9,
            room.ctypes.data,
        )
        == 1.0
    )

    def moved(h: np.ndarray) -> np.ndarray:
        turned = x + h
        crank = np.linspace(turned[-2], turned[-2] + turned[-1], MIDDLE.drawn)
        return _distances(Design(nodes, turned, False), marks, crank)[0]

    far, share = _distances(Design(nodes, x, False), marks, crank)
    weight = np.append(share, np.full(len(marks), 1 / len(marks))) / np.sqrt(far**2 + soft)
    slopes = np.array([(moved(h) - moved(-h)) / 2e-6 for h in 1e-6 * np.eye(9)])
    wanted = (slopes * weight) @ slopes.T
    damped = wanted + DAMPING * (np.diag(np.diag(wanted)) + 0.01 * np.eye(9))
    assert np.linalg.inv(inverse) == pytest.approx(damped, rel=1e-2, abs=1e-2 * np.abs(damped).max())


@pytest.mark.parametrize("closed", [True, False])
def test_a_descent_goes_down(closed: bool) -> None:
    draw, target, values = np.random.default_rng(12), Target(FOUR, closed, math.radians(20), 6.0), []
    while len(values) < 12:
        nodes = random_structure(2, 8, draw)
        x = np.concatenate([draw.normal(0.6, 0.7, len(nodes) // 2 - 4), [0.3, 0.4, 3.0]])
        near = target.descend(Design(nodes, x, False), 10)
        if near.value < 1e3:
            on = target.descend(near, 20)
            assert on.value == target.descend(on, 0).value <= near.value
            values.append(on.value / near.value)
    assert np.mean(values) < 0.95


def test_a_descent_goes_on_where_the_crank_has_its_whole_turn() -> None:
    nodes, draw = flat(list(ONE_DYAD[0])), np.random.default_rng(0)
    x = np.array([3.2, 0.3, math.log(2.6), math.log(2.4), 0.5, 0.8, 0.4, 0.7, 2 * math.pi])
    drawn = node_paths(nodes, x, np.linspace(0.7, 0.7 + 2 * math.pi, 400))[0][-1]
    target = Target(drawn * np.exp(0.4j), False, math.radians(20), 6.0)  # open, but its ends are one place
    least = target.descend(Design(nodes, x, False), 60).value
    for _ in range(5):
        begin = x + 0.05 * np.append(draw.normal(size=8), -1)
        assert target.descend(Design(nodes, begin, False), 60).value == pytest.approx(least, rel=0.01)


def test_polished_designs_keep_the_demands() -> None:
    draw, target = np.random.default_rng(1), Target(FOUR, False, math.radians(45), 2.5)
    crank, examined = np.linspace(0, 2 * np.pi, 1201), 0
    while examined < 8:
        nodes = random_structure(3, 8, draw)
        for numbers in _draws(nodes, 6, draw)[0]:
            x = np.append(numbers, (*draw.uniform(0, 6, 2), 3.0))
            design = target.checked(target.descend(Design(nodes, x, False), 60))
            if design.value > 0.35:
                continue
            end = polished(target, design)
            paths, least = node_paths(nodes, end.x, crank)
            z = node_paths(nodes, end.x, end.x[-2] + end.x[-1] * crank / crank[-1])[0][-1]
            middle, share = 0.5 * (z[1:] + z[:-1]), np.abs(np.diff(z))
            centre = np.average(middle, weights=share)
            radius = math.sqrt(np.average(np.abs(middle - centre) ** 2, weights=share))
            assert least >= 0.5 and np.abs(paths - centre).max() <= 2.5 * radius
            examined += 1


def test_one_more_joint_leaves_the_curve_and_moves_it() -> None:
    draw = np.random.default_rng(3)
    target, turn, parted = Target(FOUR, False, math.radians(20), 6.0), np.linspace(0, 2 * np.pi, 145), 0
    while parted < 60:
        nodes = _some(7, draw)
        numbers = np.concatenate([draw.normal(0.6, 0.7, len(nodes) // 2 - 4), [0.3, 0.4, 3.0]])
        design = Design(nodes, numbers, False)
        if target.descend(design, 0).value > 1e3:
            continue
        before, own = node_paths(design.nodes, design.x, turn)
        each = with_joint(design, draw)
        if each is design:
            continue
        after, least = node_paths(each.nodes, each.x, turn)
        assert np.abs(after[-1] - before[-1]).max() < 1e-12
        assert (each.joints, each.links) == (design.joints + 1, design.links)
        assert least == pytest.approx(own, abs=1e-12)
        linkage = linkage_of(Placed(each, target))  # a structure of the same kind: F = 1
        links = linkage.links.values()
        pins = {name for link in links for name in link}
        joints = len(linkage.guides) + sum(
            sum(name in link for link in links) - 1 + (name in linkage.frame) for name in pins
        )
        assert 3 * len(links) - 2 * joints == 1
        moved = [
            np.abs(node_paths(each.nodes, each.x + h, turn)[0][-1] - after[-1]).max()
            for h in 1e-4 * np.eye(len(each.x))[:-3]
        ]
        assert sum(shift > 1e-9 for shift in moved) > len(design.x) - 3
        parted += 1


def _some_curves(count: int) -> np.ndarray:
    """Curves of an atlas with random shares of nine turning vectors, as bytes."""
    draw, orders = np.random.default_rng(5), np.arange(-4, 5)
    turns = np.exp(1j * np.multiply.outer(np.linspace(0, 2 * np.pi, 301)[:-1], orders))
    shares = (draw.normal(size=(count, 9)) + 1j * draw.normal(size=(count, 9))) / (1 + orders**2)
    even = np.array([normal(even_points(curve, M, True)) for curve in shares @ turns.T])
    return np.clip(np.round(np.stack([even.real, even.imag], -1) / STEP), -127, 127).astype(np.int8)


@pytest.mark.parametrize("closed", [True, False])
def test_the_nearest_part_of_a_curve_is_laid_on_the_target(closed: bool) -> None:
    target = Target(np.array([0, 2j, 1 + 2j, 1 + 1j, 1j]), closed, math.radians(20), 6.0)
    curves = _some_curves(4)
    matches = Atlas((), (), np.zeros((0, 2), np.int32), curves).nearest(target)
    for row, curve in enumerate(STEP * (curves @ np.array([1, 1j]))):
        found = {
            (part, mirror, 2 * math.pi * k / TURNS): symmetric_distance(
                normal(curve[places(*part)]) * np.exp(2j * np.pi * k / TURNS), points[::40]
            )
            for part in parts(closed)
            for k in range(TURNS)
            for mirror, points in ((False, target.points), (True, target.points.conj()))
        }
        assert matches.distances[row] == pytest.approx(min(found.values()), abs=0.03)
        assert found[matches.laid(row)] < min(found.values()) + 0.03


def test_the_nearest_part_does_not_know_the_order_of_strokes() -> None:
    curves, found = _some_curves(40), []
    for strokes in ([0, 2 + 2j, 1 + 1j, 2j, 2], [0, 1 + 1j, 2j, 1 + 1j, 2 + 2j, 1 + 1j, 2]):
        target = Target(np.array(strokes), False, math.radians(20), 6.0)
        found.append(Atlas((), (), np.zeros((0, 2), np.int32), curves).nearest(target).distances)
    assert found[0] == pytest.approx(found[1], abs=0.02)


def test_starts_come_once_each_and_near_ones_early() -> None:
    count, structures = 3000, (flat(list(FOUR_BAR)), random_structure(2, 8, np.random.default_rng(2)))
    x = np.tile([3.0, 0.0, math.log(3.0), math.log(3.0)], (count, 1))
    x[:, 1] = np.arange(count) / count  # tells the rows apart
    which = np.column_stack([np.zeros(2 * count), np.tile(np.arange(count), 2)]).astype(np.int32)
    which[count:, 0] = 1  # never drawn, as it has 8 joints
    atlas = Atlas(structures, (x, x), which, np.zeros((2 * count, M, 2), np.int8))
    matches = Matches(atlas, np.tile(1.0 + x[::-1, 1], 2), lambda _: ((0, M // 2), False, 0.0))
    drawn = [matches.design(i) for i in matches.order(np.random.default_rng(1), 5)]
    rows = np.array([round(each.x[1] * count) for each in drawn])
    assert sorted(rows) == list(range(count))
    early, whole = rows[:300], range(count)
    assert np.sum(early >= whole[-1000]) > 1.5 * np.sum(early < whole[1000]) > 0
    assert (matches.order(np.random.default_rng(1), 5) == matches.order(np.random.default_rng(1), 5)).all()


def _apart(path: np.ndarray, curve: np.ndarray) -> float:
    """Mean nearest distance of two lines as they lie, there and back, in rms radii of the second."""
    a, b = (even_points(each, 20000, False) for each in (path, curve))
    return symmetric_distance(a, b) / float(np.sqrt(np.mean(np.abs(b - b.mean()) ** 2)))


@pytest.mark.parametrize(("closed", "mirror"), [(True, False), (True, True), (False, True)])
def test_a_curve_that_is_drawn_exactly_has_no_error_wherever_its_points_lie(closed: bool, mirror: bool) -> None:
    nodes, numbers, share = flat([*ONE_DYAD[0]]), [2.1, 0.3, 0.9, 0.8, 0.6, 0.9], np.linspace(0, 1, 40001)
    crank = 3.0 + 2 * np.pi * share[:-1] if closed else 0.4 + 4.0 * share**2
    drawn = node_paths(nodes, np.array(numbers), crank)[0][-1]
    drawn = drawn.conj() if mirror else drawn
    design = Design(nodes, np.array([*numbers, 0.0, 0.4, 4.0]), mirror, 0.0)
    mean, most = Target(drawn, closed, math.radians(5), 20.0).deviation(design)
    assert mean < most < 1e-6
    bent = Target(drawn + 0.01 * np.abs(drawn) ** 2, closed, math.radians(5), 20.0)
    assert bent.deviation(design)[0] > 0.003


def test_strokes_that_go_both_ways_tell_nothing_about_the_order_of_drawing() -> None:
    numbers, crank = [2.1, 0.3, 0.9, 0.8], np.linspace(0, 2 * np.pi, 401)[:-1]
    for nodes, tail in ((flat([*FOUR_BAR]), []), (flat([*ONE_DYAD[0]]), [0.6, 0.9])):  # a rocker's arc, a loop
        design = Design(nodes, np.array([*numbers, *tail, 0.0, 0.0, 0.0]), False, 0.0)
        drawn = node_paths(nodes, design.x, crank)[0][-1]
        found = [drawing(Placed(design, Target(each, True, 0.1, 20.0))).along for each in (drawn, drawn[::-1])]
        assert found == ([1.0, 0.0] if tail else [1.0, 1.0])
    open_one = Design(nodes, np.array([*numbers, *tail, 0.0, 0.4, 4.0]), False, 0.0)
    part = node_paths(nodes, open_one.x, np.linspace(0.4, 4.4, 301))[0][-1]
    retraced = np.concatenate([part, part[-2:200:-1], part[201:]])
    for given, along in ((retraced, 1.0), (retraced[::-1], 0.0)):
        assert drawing(Placed(open_one, Target(given, False, 0.1, 20.0))).along == pytest.approx(along, abs=0.02)


@pytest.mark.parametrize(("structure", "mirror"), [*zip((*ONE_DYAD[1:], *SLIDING), 3 * (False, True), strict=True)])
def test_slides_become_prismatic_joints(structure: list[Node], mirror: bool, tmp_path: Path) -> None:
    draw, target, nodes = np.random.default_rng(5), Target(3 * FOUR + 2, False, 0.3, 6.0), flat([*structure])
    while True:
        x = np.append(draw.normal(0.6, 0.8, len(nodes) // 2 - 4), (0.4, 1.2, 4.0))
        design = Design(nodes, x, mirror)
        least = node_paths(nodes, x, np.linspace(0, 2 * np.pi, 3601))[1]
        if least > 0.02 and target.descend(design, 0).value < 1e3:
            break
    placed = Placed(design, target)
    linkage = linkage_of(placed)
    file = tmp_path / "made.yaml"
    file.write_text(linkage.text("made"))
    path = lw.solve_motion(lw.load(file), steps=60).point("P").position @ [1, 1j]
    assert np.abs(path - placed.curve(61)).max() < 1e-9 * np.abs(path).max()
    turning = lw.loads(linkage.text("made").split("cycle:")[0])
    angle = lw.metrics(lw.solve_motion(turning), "transmission_angle").value("transmission_angle")
    assert math.sin(angle) ** 2 == pytest.approx(least, rel=1e-3)
    pins = sum(len(joint.joined) - 1 for joint in turning.joints.values())
    assert 3 * (len(turning.links)) - 2 * pins == 1


@pytest.mark.parametrize("joints", [8, 11])
def test_a_search_has_every_kind_of_linkage_that_its_joints_allow(
    joints: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By a clock that every look at it moves by 40 ms, however busy the machine is."""
    looks = count()
    monkeypatch.setattr(search, "time", SimpleNamespace(perf_counter=lambda: 0.04 * next(looks)))
    target = Target(FOUR, False, math.radians(20), 6.0)
    found = Search(target, joints, 1.2, 3).run()
    assert max(each.joints for each in found) <= joints
    assert {each.links for each in found} >= {4, 6, 8}
    for each in found:
        least = node_paths(each.nodes, each.x, np.linspace(0, 2 * np.pi, 721))[1]
        assert least > math.sin(math.radians(10)) ** 2


def test_curves_from_files(tmp_path: Path) -> None:
    arc = path_points("M 1 0 A 1 1 0 0 1 -1 0 a1,1 0 0,1 2,0z", Path("x.svg"))
    assert np.abs(arc) == pytest.approx(np.ones(len(arc)))
    assert abs(arc[0] - arc[-1]) < 1e-12
    bezier = path_points("m0,0 c0,1 1,1 1,0 s1-1 1 0", Path("x.svg"))
    assert bezier[24] == pytest.approx(1)
    assert bezier[12] == pytest.approx(0.5 + 0.75j)
    assert bezier[36] == pytest.approx(1.5 - 0.75j)
    quadratic = path_points("M0 0Q1 2 2 0T4 0H5V1", Path("x.svg"))
    assert quadratic[12] == pytest.approx(1 + 1j)
    assert quadratic[36] == pytest.approx(3 - 1j)
    assert quadratic[-1] == 5 + 1j
    svg = tmp_path / "a.svg"
    svg.write_text('<svg xmlns="http://www.w3.org/2000/svg"><g><polygon points="0,0 2,0 2,1"/></g></svg>')
    assert list(read_curve(svg)) == [0, 2, 2 - 1j, 0]
    svg.write_text('<svg><polyline points="0-1-2.5.5 1e1 0"/></svg>')
    assert list(read_curve(svg)) == [1j, -2.5 - 0.5j, 10]
    table = tmp_path / "a.csv"
    table.write_text("x;y\n1;2\n\n3.5; 4e0\n")
    assert list(read_curve(table)) == [1 + 2j, 3.5 + 4j]
    for text in ("x;y\n1,5;-2,25\n3;4,0", "1,5\t-2,25\n3\t4,0", '"1.5","-2.25"\n"3","4"', "1.5 -2.25 0\n3 4 0"):
        table.write_text(text)
        assert list(read_curve(table)) == [1.5 - 2.25j, 3 + 4j], text
    for text in (
        "1,2\n1,5 2,5\n",
        "1,5 2,5\n3,5 4,5\n",
        "0,1\nnan,2\n3,4",
        "0,1\n1e400,2\n3,4",
        "1 mm, 2 mm\n3 mm, 4 mm",
    ):
        table.write_text(text)
        with refused("synthesize.free_curve.line", path=table):
            read_curve(table)

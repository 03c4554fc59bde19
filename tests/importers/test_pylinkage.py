"""pylinkage's files: positions over the cycle against an independent reading, findings, what is kept."""

import json
import math
import shutil
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.importers.planar import FRAME, Place, Planar

import linkwright as lw

FILES = Path(__file__).parent / "pylinkage"
TEXTS = {path.stem: path.read_text("utf-8") for path in sorted(FILES.glob("*.json"))}
MECHANISMS = [name for name, text in TEXTS.items() if '"joints"' in text]
GRAPHS = [name for name, text in TEXTS.items() if '"nodes"' in text]
#: What a step takes where no speed is asked for, s.
STEP = 0.01
#: Time in which the independent reading is led from the drawing to where the driver begins.
LED = 1.0


class Pins:
    """Joints that do not turn, at distances from each other: in the file's numbers, led to the start in a second."""

    def __init__(self, at: dict[str, Place], fixed: set[str]) -> None:
        self.machine, self.at = Planar(), at
        for key, place in at.items():
            if key in fixed:
                self.machine.pin(FRAME, key, place)
            self.machine.parallel(key, FRAME)

    def apart(self, a: str, b: str, length: float | None = None) -> None:
        drawn = math.dist(self.at[a], self.at[b])
        end = drawn if length is None else length
        law = lambda t: drawn + min(t / LED, 1.0) * (end - drawn)  # noqa: E731
        self.machine.distance(a, self.at[a], b, self.at[b], law)

    def turn(self, motor: str, pin: str, rate: float, initial: float | None, arc: list[float] | None = None) -> None:
        angle = math.atan2(self.at[pin][1] - self.at[motor][1], self.at[pin][0] - self.at[motor][0])
        begin = angle if initial is None else initial

        def law(time: float) -> float:
            if time < LED:
                return math.remainder(begin - angle, math.tau) * time / LED
            turned = begin + rate * (time - LED) / STEP
            if arc:  # to and fro: a triangle of twice the width
                low, width = arc[0], arc[1] - arc[0]
                turned = low + width - abs((turned - low) % (2 * width) - width)
            return turned - begin + math.remainder(begin - angle, math.tau)

        body = f"crank {pin}"
        self.machine.pin(body, motor, self.at[motor])
        self.machine.slide(body, pin, self.at[pin], angle)
        self.machine.turn(body, FRAME, law)

    def positions(self, times: np.ndarray) -> dict[str, np.ndarray]:
        points = {key: (key, place) for key, place in self.at.items()}
        return self.machine.positions([LED, *(times + LED + 1e-15)[1:]], points, 6)


def mechanism(data: dict[str, Any]) -> Pins:
    """An independent reading of the mechanism dialect."""
    links = data["links"]
    fixed = {each["id"] for each in data["joints"] if each["type"] == "ground"}
    fixed |= {each["motor_joint"] for each in links if "motor_joint" in each}
    fixed |= {joint for each in links if each["type"] == "ground" for joint in each["joints"]}
    joints = {each["id"]: each for each in data["joints"] if each["type"] != "tracker"}
    found = Pins({key: tuple(each["position"]) for key, each in joints.items()}, fixed)
    for each in links:
        for a, b in combinations(each["joints"], 2) if each["type"] != "ground" else ():
            found.apart(a, b)
        if "motor_joint" in each:
            (pin,) = set(each["joints"]) - {each["motor_joint"]}
            arc = [each["arc_start"], each["arc_end"]] if "arc_start" in each else None
            initial = each.get("initial_angle", arc[0] if arc else 0.0)
            found.turn(each["motor_joint"], pin, each["angular_velocity"], initial, arc)
    for key, each in joints.items():
        if each["type"] == "prismatic":
            dx, dy = each.get("axis", (1.0, 0.0))
            through = tuple(each.get("line_point", (0.0, 0.0)))
            found.machine.slide(FRAME, key, found.at[key], math.atan2(dy, dx), through)
    return found


def graph(data: dict[str, Any], sizes: dict[str, Any]) -> Pins:
    """An independent reading of the dialects that are graphs."""
    parts = [(f"{name}.", each["topology"]) for name, each in data.get("instances", {}).items()] or [("", data)]
    same = {}
    for each in data.get("connections", []):
        ends = [
            f"{each[f'{side}_instance']}.{data['instances'][each[f'{side}_instance']]['ports'][each[f'{side}_port']]}"
            for side in ("from", "to")
        ]
        same[ends[1]] = ends[0]
    nodes = {same.get(p + each["id"], p + each["id"]): each for p, part in reversed(parts) for each in part["nodes"]}
    at = {key: tuple(place) for key, place in sizes["node_positions"].items()}
    found = Pins(at, {key for key, each in nodes.items() if each["role"] == "GROUND"})
    bodies: dict[str, list[str]] = {}
    for p, part in parts:
        for edge in part["edges"]:
            ends = [same.get(p + edge[side], p + edge[side]) for side in ("source", "target")]
            if nodes[ends[0]]["joint_type"] == "PRISMATIC":  # its edges lead to the line, those of others to it
                continue
            found.apart(*ends, sizes.get("edge_distances", {}).get(p + edge["id"]))
            bodies.setdefault(edge.get("body_id") or edge["id"], []).extend(ends)
    for body in (*bodies.values(), *(each["nodes"] for each in data.get("hyperedges", []))):
        given = [row for rows in sizes.get("hyperedge_constraints", {}).values() for row in rows if len(row) == 3]
        lengths = {frozenset(row[:2]): row[2] for row in given}
        for a, b in combinations(sorted(set(body)), 2) if len(set(body)) > 2 else ():
            found.apart(a, b, lengths.get(frozenset((a, b))))
    for key, node in nodes.items():
        if node["role"] == "DRIVER":
            motor = next(e["source"] for _p, part in parts for e in part["edges"] if key.endswith(e["target"]))
            motor = next(each for each in at if each.endswith(motor))
            found.turn(motor, key, sizes["driver_angles"][key]["angular_velocity"], None)
        if node["joint_type"] == "PRISMATIC":
            one, other = (edge["target"] for edge in data["edges"] if edge["source"] == key)
            angle = math.atan2(at[other][1] - at[one][1], at[other][0] - at[one][0])
            found.machine.slide(FRAME, key, at[key], angle, at[one])
    return found


def agrees(foreign: lw.Foreign, pins: Pins, steps: int) -> None:
    assert foreign.ok, foreign.findings
    times = np.linspace(0.0, steps * STEP, 6)
    motion = lw.solve_motion(foreign.mechanism, times=times)
    for joint, places in pins.positions(times).items():
        found = motion.point(joint.replace(".", "_")).position
        assert 1000 * found == pytest.approx(places, abs=5e-9), joint  # numbers of the file are mm


@pytest.mark.parametrize("name", MECHANISMS)
def test_mechanisms_move_as_an_independent_reading_says(name: str) -> None:
    agrees(lw.read_foreign(FILES / f"{name}.json"), mechanism(json.loads(TEXTS[name])), 39)


@pytest.mark.rotating
@pytest.mark.parametrize("name", GRAPHS)
def test_graphs_move_as_an_independent_reading_says(name: str) -> None:
    data = json.loads(TEXTS[name])
    sizes = data.get("dimensions") or json.loads(TEXTS[f"{name}.dimensions"])
    agrees(lw.read_foreign(FILES / f"{name}.json"), graph(data, sizes), 50)


def codes(foreign: lw.Foreign) -> list[tuple[str, str]]:
    return [(each.severity, each.code) for each in foreign.findings if each.code.startswith("import.")]


def changed(name: str, part: str, key: str, **values: Any) -> str:
    """A file in which one joint or link has other values; None: without the key."""
    data = json.loads(TEXTS[name])
    for each in data[part]:
        if each["id"] == key:
            each |= values
            for gone in [value for value in values if values[value] is None]:
                del each[gone]
    return json.dumps(data)


def test_a_tracker_is_a_point_of_the_link_of_both_joints() -> None:
    foreign = lw.read_foreign(FILES / "tracker.json")
    motion = lw.solve_motion(foreign.mechanism, times=np.linspace(0.0, 0.3, 7))
    a, b, t = (motion.point(name).position @ [1, 1j] for name in "ABT")
    assert t - a == pytest.approx((b - a) / abs(b - a) * 0.0035 * np.exp(-0.4j), abs=1e-12)
    assert foreign.traced == ("coupler.T",) and foreign.mechanism.links["coupler"].points.keys() == {"A", "B", "T"}


def test_the_angle_of_the_driver_goes_before_its_place_and_rounding_does_not() -> None:
    text = lw.read_foreign(FILES / "four_bar_other_angle.json").text
    assert "start: 114.59155903 deg" in text  # 2 rad; drawn at 0.8
    rounded = lw.read_foreign(changed("slider_on_the_x_axis", "links", "crank", initial_angle=1.5707963)).text
    assert "start: 90 deg" in rounded and "A: [0 mm, 3 mm]" in rounded


def test_units_and_the_time_of_a_step_are_asked_for() -> None:
    assert codes(lw.read_foreign(FILES / "four_bar.json")) == [("note", "import.speed"), ("note", "import.unit")]
    answered = lw.read_foreign(FILES / "five_bar.json", unit="in", speed=-math.pi)
    assert codes(answered) == [] and "[7 in, 1 in]" in answered.text
    assert "speed: -30 rpm" in answered.text and "speed: 60 rpm" in answered.text  # at rates of 1 to -2


def test_findings_give_line_and_column() -> None:
    found = lw.read_foreign(FILES / "four_bar.json").findings[0]
    assert (found.where, found.key) == ("four_bar.json:11:5", "links.1")


def test_dimensions_lie_beside_or_within(tmp_path: Path) -> None:
    shutil.copy(FILES / "assur_four_bar.json", tmp_path / "alone.json")
    alone = lw.read_foreign(tmp_path / "alone.json")
    assert codes(alone) == [("error", "import.no_sizes")]
    assert "3 moving links, 4 pins, mobility 1" in str(alone.findings[0])
    shutil.copy(FILES / "assur_four_bar.dimensions.json", tmp_path / "alone_dimensions.json")
    assert "length: 6 mm" in lw.read_foreign(tmp_path / "alone.json").text
    shutil.copy(FILES / "assur_four_bar.dimensions.json", tmp_path / "sizes.json")
    assert codes(lw.read_foreign(tmp_path / "sizes.json")) == [("error", "import.no_structure")]


def test_a_mistake_in_the_dimensions_is_found_there(tmp_path: Path) -> None:
    shutil.copy(FILES / "assur_four_bar.json", tmp_path / "a.json")
    wrong = TEXTS["assur_four_bar.dimensions"].replace("4.0", '"four"')
    (tmp_path / "a.dimensions.json").write_text(wrong, "utf-8")
    found = lw.read_foreign(tmp_path / "a.json")
    assert not found.ok and found.findings[0].where.startswith("a.dimensions.json:4:")


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (changed("four_bar", "joints", "B", position=[None, None]), "import.no_place"),
        (changed("four_bar", "joints", "B", position=[50, 4], type="ground"), "import.driver"),
        (
            changed("slider_crank", "links", "crank", initial_angle=0.3).replace("[1, -1]", "[1, -30]"),
            "import.assembly",
        ),
        (changed("tracker", "joints", "T", ref_joint1_id="gone"), "import.missing"),
        (changed("arc_driver", "links", "rocker", arc_end=1.5), "import.value"),
        ('{"version": "1.0", "topologies": [{"id": "four-bar"}]}', "import.no_sizes"),
        ('{"name": "old", "joints": [{"type": "Static", "name": "A"}], "links": []}', "import.old_version"),
        ('{"name": "", "nodes": [], "edges": []}', "import.empty"),
    ],
)
def test_what_cannot_be_read_is_an_error(text: str, code: str) -> None:
    assert ("error", code) in codes(lw.read_foreign(text, format="pylinkage"))


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (changed("four_bar", "links", "crank", motor_joint=None), "import.driver"),
        (changed("four_bar", "links", "coupler", joints=["A", "B", "Z"]), "import.skipped"),
        (changed("four_bar", "joints", "B", type="ball"), "import.kind"),
        (changed("tracker", "joints", "T", ref_joint1_id="O"), "import.skipped"),
        (changed("four_bar", "links", "crank", type="link", motor_joint=None), "import.driver"),
        (changed("assur_slider", "edges", "g2", target="Z"), "import.skipped"),
        (changed("assur_slider", "edges", "g2", target="Z"), "import.line"),
    ],
)
def test_what_is_assumed_is_said(text: str, code: str) -> None:
    assert ("warning", code) in codes(lw.read_foreign(text))

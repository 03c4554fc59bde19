"""OpenLinkage projects: positions over the cycle against an independent reading, findings, what is kept."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.importers.planar import FRAME, Place, Planar

import linkwright as lw

FILES = Path(__file__).parent / "open_linkage"
PROJECTS = sorted(path.stem for path in FILES.glob("*.json") if '"joints"' in path.read_text("utf-8"))
#: The designer plays 42° of the phase a second.
RATE = math.radians(42)


class Project:
    """A designer's project as joints that do not turn, at distances from each other: mm, y turned up."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data, self.machine = data, Planar()
        self.at: dict[str, Place] = {each["id"]: (each["x"], -each["y"]) for each in data["joints"]}
        self.bars = {each["id"]: each for each in data["bars"]}
        self.mode = data.get("driverMode", "rotation")
        for each in data["joints"]:
            if each["fixed"]:
                self.machine.pin(FRAME, each["id"], self.at[each["id"]])
            self.machine.parallel(each["id"], FRAME)
        self.lengths()
        self.guides()
        self.dimensions()
        if self.mode in ("rotation", "oscillation"):
            self.turn(self.bars[data["driverId"]])

    def apart(self, a: str, b: str, law: Callable[[float], float]) -> None:
        self.machine.distance(a, self.at[a], b, self.at[b], law)

    def bar(self, each: dict[str, Any]) -> str:
        """A body that lies along a bar."""
        name = "bar " + each["id"]
        if name not in self.machine.bodies:
            self.machine.pin(name, each["a"], self.at[each["a"]])
            self.machine.slide(name, each["b"], self.at[each["b"]], self.angle(each["a"], each["b"]))
        return name

    def angle(self, a: str, b: str) -> float:
        return math.atan2(self.at[b][1] - self.at[a][1], self.at[b][0] - self.at[a][0])

    def lengths(self) -> None:
        for each in self.bars.values():
            self.apart(each["a"], each["b"], self.law(each))
        for body in self.data.get("bodies", []):
            joints = body["jointIds"]
            pairs = body["pairs"] or [
                {"a": a, "b": b, "length": math.dist(self.at[a], self.at[b])}
                for k, a in enumerate(joints)
                for b in joints[:k]
            ]
            for pair in pairs:
                self.apart(pair["a"], pair["b"], lambda _t, length=pair["length"]: length)

    def law(self, bar: dict[str, Any]) -> Callable[[float], float]:
        phase, ratio = None, 1.0
        if self.mode == "length" and bar["id"] == self.data["driverId"]:
            phase = math.acos(1 - 2 * (bar["length"] - bar["minLength"]) / (bar["maxLength"] - bar["minLength"]))
        for each in self.data.get("hydraulicActuators", []) if self.mode == "hydraulic" else []:
            if each["barId"] == bar["id"] and each.get("enabled", True):
                phase, ratio = each["phaseOffset"], each.get("cycleRatio", 1)
        if phase is None:
            return lambda _t: bar["length"]
        low, high = bar["minLength"], bar["maxLength"]
        return lambda t: low + (high - low) * (0.5 - 0.5 * math.cos(RATE * t * ratio + phase))

    def guides(self) -> None:
        for each in self.data["joints"]:
            if "slider" not in each:
                continue
            slider, key = each["slider"], each["id"]
            if "referenceBarId" not in slider:
                through = (slider["originX"], -slider["originY"])
                self.machine.slide(FRAME, key, self.at[key], -slider["angle"], through)
                continue
            bar = self.bars[slider["referenceBarId"]]
            angle, (x, y) = self.angle(bar["a"], bar["b"]), self.at[bar["a"]]
            through = (x + slider["offset"] * math.sin(angle), y - slider["offset"] * math.cos(angle))
            self.machine.slide(self.bar(bar), key, self.at[key], angle - slider["angle"], through)

    def dimensions(self) -> None:
        for each in self.data.get("dimensions", []):
            a, b, value = each["a"], each["b"], each["value"]
            x, y = self.at[a]
            if each["type"] == "distance":
                self.apart(a, b, lambda _t, value=value: value)
            elif each["type"] == "horizontal":
                self.machine.slide(a, b, self.at[b], 0.0, (x, y - value))
            else:
                self.machine.slide(a, b, self.at[b], math.pi / 2, (x + value, y))

    def turn(self, bar: dict[str, Any]) -> None:
        fixed = {each["id"] for each in self.data["joints"] if each["fixed"]}
        pivot, pin = (bar["a"], bar["b"]) if bar["a"] in fixed else (bar["b"], bar["a"])
        drawn = self.angle(pivot, pin)

        def law(t: float) -> float:
            if self.mode == "rotation":
                return -RATE * t
            low, high = bar["minAngle"], bar["maxAngle"]
            return -(low + (high - low) * (0.5 + 0.5 * math.cos(RATE * t))) - drawn

        self.machine.pin("crank", pivot, self.at[pivot])
        self.machine.slide("crank", pin, self.at[pin], drawn)
        self.machine.turn("crank", FRAME, law)

    def positions(self, times: np.ndarray) -> dict[str, np.ndarray]:
        """Places of joints, m."""
        found = self.machine.positions(list(times), {key: (key, place) for key, place in self.at.items()}, 4)
        return {key: each / 1000 for key, each in found.items()}


@pytest.mark.parametrize("name", PROJECTS)
def test_projects_move_as_an_independent_reading_says(name: str) -> None:
    path = FILES / f"{name}.json"
    foreign = lw.read_foreign(path)
    assert foreign.ok, foreign.findings
    times = np.linspace(0.0, 2 * math.pi / RATE, 8)[:7]
    motion = lw.solve_motion(foreign.mechanism, times=times)
    for joint, places in Project(json.loads(path.read_text("utf-8"))).positions(times).items():
        assert motion.point(joint).position == pytest.approx(places, abs=1e-9), joint


def project(name: str, **changes: Any) -> str:
    return json.dumps(json.loads((FILES / f"{name}.json").read_text("utf-8")) | changes, indent=1)


def codes(foreign: lw.Foreign) -> list[tuple[str, str]]:
    return [(each.severity, each.code) for each in foreign.findings if each.code.startswith("import.")]


@pytest.mark.parametrize(("name", "left"), [("four_bar_open", 1), ("four_bar_crossed", -1)])
def test_four_bars_by_parameters(name: str, left: int) -> None:
    data = json.loads((FILES / f"{name}.json").read_text("utf-8"))
    given = {key: each / 1000 for key, each in data["parameters"].items()}
    mechanism, times = lw.read_foreign(FILES / f"{name}.json").mechanism, np.linspace(0.0, 3.0, 20)
    angle = math.radians(data["inputAngle"]) + data["speed"] * math.pi / 30 * times
    a = given["input"] * np.exp(1j * angle)
    away = given["ground"] - a  # from the crank pin to the output's pivot
    share = (given["coupler"] ** 2 - given["output"] ** 2 + abs(away) ** 2) / (2 * abs(away) ** 2)
    height = np.sqrt(given["coupler"] ** 2 / abs(away) ** 2 - share**2)
    coupler = away * (share + left * 1j * height)
    traced = a + coupler * (1000 * given["couplerPointRatio"] + 1j * given["couplerPointOffset"] / given["coupler"])
    motion = lw.solve_motion(mechanism, times=times)
    for point, places in {"A": a, "B": a + coupler, "P": traced}.items():
        found = motion.point(point).position
        assert found[:, 0] + 1j * found[:, 1] == pytest.approx(places, abs=1e-12), point


def test_the_leg_by_parameters() -> None:
    given = {
        key: each / 1000 for key, each in json.loads((FILES / "six_bar_leg.json").read_text())["parameters"].items()
    }
    foreign = lw.read_foreign(FILES / "six_bar_leg.json")
    motion = lw.solve_motion(foreign.mechanism, times=np.linspace(0.0, 4.0, 20))
    a, b, c, p = (motion.point(name).position @ [1, 1j] for name in "ABCP")
    front, rear = given["groundPivot"], given["rearPivotX"] + 1j * given["rearPivotY"]
    assert abs(b - a) == pytest.approx(given["firstCoupler"]) and abs(b - front) == pytest.approx(
        given["firstRocker"]
    )
    assert abs(c - b) == pytest.approx(given["secondCoupler"]) and abs(c - rear) == pytest.approx(
        given["secondRocker"]
    )
    assert np.all(np.imag((front - a).conj() * (b - a)) > 0)  # open: to the left of the line of centres
    assert np.all(np.imag((rear - b).conj() * (c - b)) < 0)  # crossed
    offset = 1j * given["footOffset"] / given["secondCoupler"]
    assert p == pytest.approx(b + (c - b) * (1000 * given["footRatio"] + offset), abs=1e-12)
    assert foreign.traced == ("second_coupler.P",)


def test_eleven_bars_of_the_leg_become_seven_links() -> None:
    foreign = lw.read_foreign(FILES / "jansen_leg.json")
    mechanism = foreign.mechanism
    assert codes(foreign).count(("note", "import.joined")) == 4
    assert len(mechanism.links) == 7
    assert sum(len(link.points) == 3 for link in mechanism.links.values()) == 2


def test_lengths_go_before_coordinates_and_are_written_as_given() -> None:
    foreign = lw.read_foreign(FILES / "coordinates_off.json")
    assert "length: 25 mm" in foreign.text and "length: 68 mm" in foreign.text
    assert "also: {T1: [30 mm, -12 mm]}" in foreign.text  # y down in the file
    assert foreign.traced == ("L2.T1",)


def test_a_bar_that_is_drawn_far_from_its_length_is_said() -> None:
    bars = json.loads(project("four_bar_version_1"))["bars"]
    bars[2]["length"] = 75
    found = lw.read_foreign(project("four_bar_version_1", bars=bars))
    assert ("warning", "import.length") in codes(found) and "length: 75 mm" in found.text


def test_loads_are_turned_up_and_in_newtons() -> None:
    assert "components: [500 N, -3000 N]" in lw.read_foreign(FILES / "hydraulic.json").text


def test_speed_is_asked_for() -> None:
    assert codes(lw.read_foreign(FILES / "four_bar_version_1.json")) == [("note", "import.speed")]
    answered = lw.read_foreign(FILES / "four_bar_version_1.json", speed=math.pi)
    assert codes(answered) == [] and "speed: 30 rpm" in answered.text


def test_dimensions_say_what_holds_them() -> None:
    found = [
        each for each in lw.read_foreign(FILES / "scissor_lift.json").findings if each.code == "import.dimension"
    ]
    assert [each.where for each in found] == ["scissor_lift.json:17:5", "scissor_lift.json:18:5"]
    assert "carriage_D1" in str(found[0]) and "guide_D2" in str(found[1])


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (project("four_bar_version_1", joints=[]), "import.empty"),
        (project("four_bar_version_1", joints=[{"id": "J1", "x": "left", "y": 0, "fixed": True}]), "import.value"),
        (project("four_bar_version_1", joints=[{"id": "J1", "y": 0, "fixed": True}]), "import.missing"),
        (project("four_bar_open", mechanismType="variable-geometry-leg"), "import.kind"),
        (
            project("four_bar_open", parameters={"ground": 500, "input": 3, "coupler": 9, "output": 6}),
            "import.assembly",
        ),
        ('{"version": 3, "joints": [}', "import.json"),
    ],
)
def test_what_cannot_be_read_is_an_error(text: str, code: str) -> None:
    foreign = lw.read_foreign(text, format="open_linkage")
    assert not foreign.ok and ("error", code) in codes(foreign)
    assert all(":" in each.where for each in foreign.findings)


def test_what_is_left_out_is_said() -> None:
    bars = json.loads(project("four_bar_version_1"))["bars"] + [{"id": "L9", "a": "J1", "b": "J9", "length": 3}]
    foreign = lw.read_foreign(project("four_bar_version_1", bars=bars, driverId=None, tracerId="J9"))
    assert [code for severity, code in codes(foreign) if severity == "warning"] == [
        "import.skipped",
        "import.driver",
        "import.skipped",
    ]
    assert lw.read_foreign(project("four_bar_version_1", driverId=None), driver="L1").ok


def test_a_guide_on_a_bar_that_is_not_there_is_fixed_where_it_is_drawn() -> None:
    joints = json.loads(project("guide_on_a_still_bar"))["joints"]
    joints[2]["slider"] |= {"referenceBarId": "L8", "originX": joints[2]["x"], "originY": joints[2]["y"]}
    foreign = lw.read_foreign(project("guide_on_a_still_bar", joints=joints))
    assert ("warning", "import.skipped") in codes(foreign) and "guide: frame" in foreign.text


def test_an_input_angle_that_does_not_assemble_is_replaced_by_the_nearest() -> None:
    given = {"ground": 100, "input": 60, "coupler": 40, "output": 50}
    foreign = lw.read_foreign(project("four_bar_open", parameters=given, inputAngle=120))
    assert ("warning", "import.assembly") in codes(foreign) and "start: 6" in foreign.text


@pytest.mark.parametrize("name", ["my plate", "L1"])
def test_a_point_of_a_body_stays_on_it_whatever_the_body_is_called(name: str) -> None:
    """A link's name has no blank, and a bar may have the same id; the point is at a corner that the joints give."""
    data = json.loads((FILES / "watt_body.json").read_text("utf-8"))
    data["bodies"][0]["id"] = data["tracers"][0]["bodyId"] = name
    foreign = lw.read_foreign(json.dumps(data))
    link, point = foreign.traced[0].split(".")
    points = foreign.mechanism.links[link].points
    assert set(points) == {"J2", "J3", "J5", "T1"} and point == "T1"
    assert math.dist(points["J2"], points["T1"]) == pytest.approx(0.0385, abs=1e-9)

"""A metric, a load and a driver law of another package: in files, commands, pictures and sweeps."""

from __future__ import annotations

import importlib
import json
import sys
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from tests.contract.elements_for_a_while import taken_away
from tests.contract.settling import LAW
from tests.refusals import refused

import linkwright as lw
from linkwright.cli import main
from linkwright.files.write import dump

PACKAGE = '''
"""What somebody else's package holds: public base classes and registries, nothing else."""

from dataclasses import dataclass
from typing import ClassVar

from linkwright.drivers.base import LAWS
from linkwright.applied_loads import base
from linkwright.applied_loads.base import LOADS, Load
from linkwright.applied_loads.site import Wrench
from linkwright.analysis import METRICS
from linkwright.analysis.base import Metric
from linkwright.fields.base import Quantity


@LOADS.register("wind")
@dataclass(frozen=True, kw_only=True)
class Wind(Load):
    """A constant force to the right at a point."""

    kind: ClassVar[str] = "wind"
    on: str = base.link(moving=True, doc="the link")
    at: str = base.point_of("on", doc="its point")
    size: float = base.quantity("force", doc="how strong it is")

    def wrenches(self, site):
        return [Wrench(self.on, site.direction(0.0) * site.dimension("size"), site.place(self.on, self.at))]


@LOADS.register("tether")
@dataclass(frozen=True, kw_only=True)
class Tether(Load):
    """A force to the right at a point that grows with an output."""

    kind: ClassVar[str] = "tether"
    end: base.LinkPoint = base.point(doc="where it pulls")
    follows: base.Output = base.output(doc="what it goes by")
    rate: float = base.quantity("stiffness", doc="force per length")

    def wrenches(self, site):
        place = site.place(self.end.link, self.end.point)
        return [Wrench(self.end.link, site.direction(0.0) * site.magnitude(), place)]

    def from_cycle(self, signals):
        return self.rate * signals.output(self.follows)[0]


@LOADS.register("gale")
@dataclass(frozen=True, kw_only=True)
class Gale(Load):
    """A force to the right at a point, of any size within any phase."""

    kind: ClassVar[str] = "gale"
    exactly_one: ClassVar = (("magnitude", "ramp", "table"),)
    on: str = base.link(moving=True, doc="the link")
    at: str = base.point_of("on", doc="its point")
    magnitude: base.Magnitude = base.magnitude("force")

    def wrenches(self, site):
        return [Wrench(self.on, site.direction(0.0) * site.magnitude(), site.place(self.on, self.at))]
'''
PACKAGE += LAW
PACKAGE += '''

LAWS.register("settling")(Settling)


@METRICS.register("mean_crank_torque")
class MeanTorque(Metric):
    """Mean of the driver's torque over the positions."""

    name = "mean_crank_torque"
    dimension = "torque"
    source = "the arithmetic mean of the solved positions"
    needs_forces = True

    def values(self, analysis):
        yield self.value(analysis, "driver", float(analysis.forces.input_torque.mean()))
'''
MODEL = """
format: 1
name: slider-crank in the wind
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.2 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.7 m}
  piston: {points: [B]}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
driver: {turn: crank, about: O, LAW}
cycle: {duration: 2 s}
loads: {gust: {kind: wind, on: piston, at: B, size: 50 N}}
"""


@pytest.fixture(scope="module", autouse=True)
def installed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """The other package on the path and imported; taken away again."""
    folder = tmp_path_factory.mktemp("site")
    (folder / "windpackage.py").write_text(PACKAGE, "utf-8")
    sys.path.insert(0, str(folder))
    package = importlib.import_module("windpackage")
    yield
    sys.path.remove(str(folder))
    del sys.modules["windpackage"]
    taken_away(package.LOADS, "wind", "tether", "gale")
    taken_away(package.LAWS, "settling")
    taken_away(package.METRICS, "mean_crank_torque")


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "wind.yaml"
    path.write_text(MODEL.replace("LAW", "settling: 300 deg"), "utf-8")
    return path


def torque_by_hand(time: np.ndarray) -> np.ndarray:
    """50 N to the right on the piston, and the crank's own inertia with q = 300° (1 - exp(-t))."""
    way = np.radians(300.0)
    q, rate, second = way * (1 - np.exp(-time)), way * np.exp(-time), -way * np.exp(-time)
    slope = -0.2 * np.sin(q) - 0.04 * np.sin(q) * np.cos(q) / np.sqrt(0.49 - 0.04 * np.sin(q) ** 2)
    assert (rate > 0).all()
    return -50.0 * slope + (0.01 + 0.1**2) * second


def test_law_and_load_are_read_and_solved(file: Path) -> None:
    motion = lw.solve_motion(lw.load(file), steps=40)
    assert motion.input == pytest.approx(np.radians(300.0) * (1 - np.exp(-motion.time)), rel=1e-13)
    forces = lw.solve_forces(motion)
    assert forces.input_torque == pytest.approx(torque_by_hand(motion.time), rel=1e-10, abs=1e-10)
    assert np.abs(forces.power_residual).max() < 1e-9
    assert forces.load("gust").force == pytest.approx(np.array([(50.0, 0.0)] * 41))


def test_they_are_written_and_read_again(file: Path) -> None:
    mechanism = lw.load(file)
    again = lw.loads(dump(mechanism))
    assert again.loads == mechanism.loads
    assert again.drivers == mechanism.drivers


def test_a_design_number_stands_in_the_table(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    forces = lw.solve_forces(lw.solve_motion(lw.load(file), steps=40))
    expected = torque_by_hand(forces.motion.time).mean()
    assert lw.metrics(forces).value("mean_crank_torque") == pytest.approx(expected, rel=1e-10)
    for language in ("en", "zh"):
        assert main(["metrics", str(file), "--steps", "40", "--names", "mean_crank_torque", "--lang", language]) == 0
        assert f"{expected:.2f}"[:4] in capsys.readouterr().out
    assert main(["metrics", str(file), "--steps", "40", "--names", "mean_crank_torque", "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)["metrics"]
    assert row["value"] == pytest.approx(expected, rel=1e-10) and row["unit"] == "N·m"


def test_the_command_line_solves_and_draws_them(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", str(file)]) == 0
    assert main(["solve", str(file), "--steps", "8", "--json"]) == 0
    capsys.readouterr()
    target = tmp_path / "wind.svg"
    assert main(["draw", str(file), "--forces", "--output", str(target)]) == 0
    texts = {"".join(each.itertext()) for each in ET.parse(target).iter("{http://www.w3.org/2000/svg}text")}
    assert any("gust" in text for text in texts)
    assert main(["plot", str(file), "--kind", "torque", "--steps", "24", "--output", str(tmp_path / "t.svg")]) == 0


def test_a_finding_about_them_says_where(file: Path) -> None:
    file.write_text(file.read_text("utf-8").replace("size: 50 N", "size: 50 kg"), "utf-8")
    with refused("wrong-dimension", lw.ModelError) as caught:
        lw.load(file)
    (finding,) = caught.value.findings
    line = 1 + [*MODEL.splitlines()].index(next(each for each in MODEL.splitlines() if "gust" in each))
    assert (finding.key, finding.where.split(":")[-2]) == ("loads.gust.size", str(line))


def test_sweeps_and_derivatives_go_through_the_load(file: Path) -> None:
    """The torque's largest value over sizes of the gust, against the formula; its derivative too."""
    mechanism = lw.load(file)
    sizes = np.array([0.0, 25.0, 50.0])
    found = lw.sweep(mechanism, {"loads.gust.size": sizes}, outputs=[("input_torque", "max")], steps=40)
    time = lw.solve_motion(mechanism, steps=40).time
    inertial = (0.01 + 0.1**2) * -np.radians(300.0) * np.exp(-time)
    unit = (torque_by_hand(time) - inertial) / 50.0
    best = [(inertial + size * unit).max() for size in sizes]
    assert found["input_torque", "max"] == pytest.approx(np.array(best), rel=1e-9)
    slope = lw.sensitivity(mechanism, of=["input_torque"], by=["loads.gust.size"], steps=40)
    assert slope.slope("input_torque", "loads.gust.size") == pytest.approx(unit, rel=1e-7, abs=1e-9)


def test_a_load_of_its_own_way_follows_an_output_at_a_point() -> None:
    """100 N per metre of the piston's place, at the same piston: power 100 s ds/dt, in numbers and in sweeps."""
    text = MODEL.replace("LAW", "speed: 3 rad/s").replace("cycle: {duration: 2 s}\n", "")
    tether = "{kind: tether, end: B, follows: guide, rate: 100 N/m}"
    machine = lw.loads(text.replace("{kind: wind, on: piston, at: B, size: 50 N}", tether))
    assert lw.loads(dump(machine)).loads == machine.loads and "loads.gust.rate" in machine.dimensions()
    forces = lw.solve_forces(machine, steps=36)
    turn = forces.motion.input
    place = 0.2 * np.cos(turn) + np.sqrt(0.49 - 0.04 * np.sin(turn) ** 2)
    slope = -0.2 * np.sin(turn) * (1 + 0.2 * np.cos(turn) / np.sqrt(0.49 - 0.04 * np.sin(turn) ** 2))
    assert forces.load("gust").force[:, 0] == pytest.approx(100 * place)
    assert forces.input_torque == pytest.approx(-100 * place * slope, abs=1e-9)
    for key, right, wrong, value in (("end", "B", "Q", "name"), ("follows", "guide", "guid", "text")):
        other = tether.replace(f"{key}: {right}", f"{key}: {wrong}")
        with refused("unknown-name", lw.ModelError, **{value: wrong}) as caught:
            lw.loads(text.replace("{kind: wind, on: piston, at: B, size: 50 N}", other))
        assert [each.key for each in caught.value.findings] == [f"loads.gust.{key}"]
    found = lw.sweep(machine, {"loads.gust.rate": [100.0, 200.0]}, outputs=["driver.effort max"], steps=36)
    assert found["driver.effort max"] == pytest.approx(np.array([1, 2]) * forces.input_torque.max())
    with refused("study.cycle_load_slope", name="gust", kind="tether"):
        lw.sensitivity(machine, of=["driver.effort rms"], by=["crank.length"], steps=36)


@pytest.mark.parametrize(
    "size",
    [
        "magnitude: 40 N",
        'magnitude: "40 N + 100*guide*(1 N/m)"',
        "ramp: [10 N, 60 N], phase: {of: guide, from: min, to: max}",
        "ramp: [10 N, 60 N], phase: {input: [300 deg, 70 deg]}",
        "table: {over: guide, x: [0.4 m, 1 m], y: [9 N, 90 N]}, phase: {moving: rod, direction: increasing}",
    ],
)
def test_a_load_has_all_sizes_and_phases_by_one_line(size: str) -> None:
    """As the force of the library has them: in files, alone, in sweeps and in derivatives."""
    text = MODEL.replace("LAW", "speed: 3 rad/s").replace("cycle: {duration: 2 s}\n", "")
    own, known = (
        lw.loads(text.replace("kind: wind, on: piston, at: B, size: 50 N", f"{kind}, on: piston, at: B, {size}"))
        for kind in ("kind: gale", "kind: force, direction: 0 deg")
    )
    assert lw.loads(dump(own)).loads == own.loads
    assert set(own.dimensions()) | {"loads.gust.direction"} == set(known.dimensions())
    torques = [lw.solve_forces(each, steps=36).input_torque for each in (own, known)]
    assert torques[0].tolist() == torques[1].tolist() and np.abs(torques[0]).max() > 0.5
    lengths = {"crank.length": np.array([0.19, 0.2, 0.21])}
    swept = [lw.sweep(each, lengths, outputs=["driver.effort max"], steps=36) for each in (own, known)]
    assert swept[0]["driver.effort max"].tolist() == swept[1]["driver.effort max"].tolist()
    slopes = [lw.sensitivity(each, of=["driver.effort rms"], by=["crank.length"], steps=36) for each in (own, known)]
    gradients = [each.gradient("driver.effort rms").tolist() for each in slopes]
    assert gradients[0] == gradients[1] and abs(gradients[0][0]) > 1.0

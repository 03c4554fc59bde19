"""An installed package with joint kinds, a load, a driver law and a metric of its own: the how-to's, run."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.contract import curved_slot_of_a_package as curved
from tests.contract import drums_of_a_package as drums
from tests.contract import triad_of_a_package as triad
from tests.contract.settling import LAW

import linkwright

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "en" / "how-to" / "own_elements.md"
POINTS = """[linkwright.joints]
pin_in_slot = slots:PinInSlot
curved_slot = slots:CurvedSlot
tape = drums:Tape
[linkwright.loads]
wind = slots:Wind
[linkwright.drivers]
settling = slots:Settling
LEVER[linkwright.metrics]
mean_torque = slots:MeanTorque
"""
LEVER = "[linkwright.groups]\nslotted_lever = slots:SlottedLever\nthree_guides = trammels:ThreeGuides\n"
#: A slotted lever driven by a crank's pin, once with the kind of the package, once with a massless block and a guide.
PROGRAM = r'''
import sys, numpy as np, linkwright as lw
from linkwright.cli import main
from linkwright.files.write import dump
from linkwright.files.model_file import json_schema
MODEL = """
format: 1
name: slotted lever
frame: {points: {O: [0 m, 0 m], Q: [0 m, -0.3 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 1 kg, inertia: 0.01 kg·m²}
  lever: {points: [Q, E], length: 0.6 m, mass: 2 kg, inertia: 0.05 kg·m²}
BLOCK
joints: {slot: {JOINT, guide: lever, through: Q, REST}}
DRAWN
driver: {turn: crank, about: O, speed: 60 rpm}
loads: {gust: {kind: wind, on: lever, at: E, size: 20 N}}
"""
own = MODEL.replace("BLOCK", "").replace("JOINT", "kind: pin_in_slot").replace("REST", "block: crank, at: A")
own = own.replace("DRAWN", "drawing: {A: [0.1 m, 0 m], E: [0.18973665961010275 m, 0.2692099788303083 m]}")
if sys.argv[1] == "closed":
    own = own.split("drawing:")[0] + "driver:" + own.split("driver:")[1]
known = MODEL.replace("BLOCK", "  block: {points: [A]}").replace("JOINT", "kind: prismatic, direction: 0 deg")
known = known.replace("REST", "block: block, at: A").replace("DRAWN", "assembly: {slot: forward}")
LACKING = "model.kind_lacks", "pin_in_slot", "sums"
mechanism = lw.loads(own)
found, expected = (lw.solve_forces(lw.solve_motion(m, steps=24)) for m in (mechanism, lw.loads(known)))
for name in ("crank", "lever"):
    for each in ("direction", "angular_velocity", "angular_acceleration"):
        a, b = (getattr(f.motion.link(name), each) for f in (found, expected))
        assert np.abs(a - b).max() < 1e-9 * max(1.0, np.abs(b).max()), (name, each)
assert np.abs(found.input_torque - expected.input_torque).max() < 1e-9
assert np.abs(found.reaction("Q", on="lever") - expected.reaction("Q", on="lever")).max() < 1e-8
assert found.balance_residual.max() < 1e-9
structure = lw.structure(mechanism)
assert (found.motion.tracked is None) == (sys.argv[1] == "closed")
assert (structure.mobility, [g.signature for g in structure.groups]) == (1, ["R", "RS"])
assert "pin_in_slot" in str(json_schema()["properties"]["joints"])
assert lw.loads(dump(mechanism)).joints == mechanism.joints
try:
    lw.loads(own.replace("pin_in_slot", "pin_in_slott"))
    raise SystemExit("an unknown kind was taken")
except lw.ModelError as error:
    (finding,) = error.findings
    assert (finding.code, finding.key) == ("unknown-word", "joints.slot.kind"), error
    assert (finding.values["text"], "pin_in_slot" in str(finding)) == ("pin_in_slott", True), error
try:
    lw.loads(own.replace("at: A}}", "at: AA}}"))
    raise SystemExit("an unknown point was taken")
except lw.ModelError as error:
    assert [each.key for each in error.findings] == ["joints.slot.at"], error
assert lw.metrics(found).value("mean_torque") == found.input_torque.mean()
sweep = lw.sweep(mechanism, {"lever.mass": np.array([2.0, 3.0])}, outputs=[("input_torque", "max")], steps=24)
assert sweep["input_torque", "max"][0] == np.max(found.input_torque) or abs(
    sweep["input_torque", "max"][0] - np.max(found.input_torque)) < 1e-9
varied = ["crank.length", "frame.Q.y", "loads.gust.size"]
both = [lw.objective(each, "driver.effort rms", vary=varied, steps=24) for each in (mechanism, lw.loads(known))]
(value, slope), (other, expected_slope) = (each(each.start) for each in both)
assert abs(value - other) < 1e-9 and np.abs(slope - expected_slope).max() < 1e-8 * np.abs(slope).max()
for k in range(len(varied)):
    h = 1e-6 * np.eye(len(varied))[k] * max(1.0, abs(both[0].start[k]))
    near = [both[0](both[0].start + sign * h)[0] for sign in (1.0, -1.0)]
    assert abs((near[0] - near[1]) / (2 * h[k]) - slope[k]) < 1e-6 * np.abs(slope).max(), varied[k]
try:
    lw.worked(found)
    raise SystemExit("worked")
except lw.LinkwrightError as error:
    assert (error.code, error.values["kind"], error.values["what"]) == LACKING, error
law = lw.loads(known.replace("speed: 60 rpm}", "settling: 90 deg}\ncycle: {duration: 1 s}"))
assert abs(lw.solve_motion(law, steps=4).input[-1] - np.radians(90) * (1 - np.exp(-1.0))) < 1e-14
open("own.yaml", "w").write(own)
assert main(["check", "own.yaml"]) == 0
assert main(["draw", "own.yaml", "--output", "own.svg"]) == 0 and "lever" in open("own.svg").read()
assert main(["solve", "own.yaml", "--steps", "8"]) == 0
assert main(["export", "own.yaml", "--output", "own.csv"]) == 0
assert main(["export", "own.yaml", "--to", "own.html"]) == 0
try:
    mechanism.joints["slot"].sums(mechanism)
    raise SystemExit("sums")
except lw.LinkwrightError as error:
    assert (error.code, error.values["kind"], error.values["what"]) == LACKING, error
print("all is well")
'''


def run(folder: Path, way: str, more: str = "") -> str:
    """What a process prints in which the package is installed in a folder."""
    code = re.findall(r"^```py\n(.*?)^```", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL)
    (folder / "slots.py").write_text("\n\n".join(code) + LAW, "utf-8")
    (folder / "trammels.py").write_text(triad.PACKAGE, "utf-8")
    (folder / "drums.py").write_text(drums.PACKAGE, "utf-8")
    info = folder / "slots-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: slots\nVersion: 1.0\n", "utf-8")
    (info / "entry_points.txt").write_text(POINTS.replace("LEVER", LEVER if way == "closed" else ""), "utf-8")
    source = str(Path(linkwright.__file__).parents[1])
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([source, str(folder), str(ROOT)])}
    command = [sys.executable, "-c", PROGRAM + more, way]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, env=environment, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_an_installed_package_of_elements(tmp_path: Path) -> None:
    """Without a closed form for the group of the package's joint."""
    printed = run(tmp_path, "followed", curved.PROGRAM)
    assert all(line in printed for line in ("all is well", "the curved slot too"))


@pytest.mark.rotating
def test_an_installed_package_of_elements_with_closed_forms(tmp_path: Path) -> None:
    """With one for the group of the package's joint, for a triad, and with a pair of wheels of its own."""
    printed = run(tmp_path, "closed", triad.PROGRAM + drums.PROGRAM)
    assert all(line in printed for line in ("all is well", "the triad too", "the drums too"))

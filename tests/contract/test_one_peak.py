"""A peak is one number: tables, labels, columns and texts of a machine in few positions have the one between them."""

import json
import re
import zipfile
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from tests import store

import linkwright as lw
from linkwright import plot
from linkwright.cli import main
from linkwright.plotting.animation import animate

#: Positions of the coarse cycle, and of the fine one.
FEW, MANY = 24, 5760
MACHINES = {
    "jaw_crusher_sixbar": ("O5", "jaw", "jaw.mass"),
    "jaw_crusher_fourbar": ("B", "jaw", "jaw.mass"),
    "swing_conveyor": ("O", "crank", "crank.mass"),
    "shaper_quick_return": ("O1", "crank", "crank.length"),
}


@cache
def peaks(machine: str) -> tuple[float, float]:
    """The largest force in the joint, and the largest driving effort, refined from the fine cycle, whose largest
    values they exceed by little, or, where a load ends between positions, by what it does from one to the next."""
    joint, link, _ = MACHINES[machine]
    forces = lw.solve_forces(store.machine(machine), steps=MANY)
    (driver,) = forces.mechanism.drivers
    found = {(row.metric, row.subject): row.value for row in lw.metrics(forces)}
    force, effort = found["peak_reaction", joint], found["peak_input_torque", driver]
    sampled = np.hypot(*forces.reaction(joint, on=link).T), np.abs(forces.driver_effort(driver))
    for peak, values in zip((force, effort), sampled, strict=True):
        assert 1.0 - 1e-9 <= abs(peak) / values.max() <= 1.0 + 5e-4
    return force, effort


def shown(texts: list[str], peak: float) -> bool:
    """Whether one of the numbers in some texts is the peak to its digits, four or more, in N, kN or MN."""
    for number in re.findall(r"-?\d+(?:\.\d+)?", " ".join(texts).replace("−", "-")):
        digits = len(re.sub(r"\D", "", number).lstrip("0"))
        step = 10.0 ** -len(number.partition(".")[2])
        sizes = (abs(peak), 1e-3 * abs(peak), 1e-6 * abs(peak))
        if digits >= 4 and any(abs(abs(float(number)) - size) <= 0.5001 * step for size in sizes):
            return True
    return False


@pytest.mark.parametrize("machine", MACHINES)
def test_numbers_of_one_peak_agree(machine: str, capsys: pytest.CaptureFixture[str]) -> None:
    joint, link, varied = MACHINES[machine]
    mechanism, (force, effort) = store.machine(machine), peaks(machine)
    forces = lw.solve_forces(mechanism, steps=FEW)
    (driver,) = mechanism.drivers
    reaction, torque = f"peak_reaction {joint}", "peak_input_torque"
    of_outputs = {f"reaction {joint} on {link} max": force, f"{driver}.effort peak": abs(effort)}
    vary = {varied: [mechanism.dimension(varied)] * 2}
    study = lw.study(mechanism, vary, metrics=[reaction, torque, *of_outputs], steps=FEW)
    compared = lw.compare([mechanism, mechanism], metrics=[reaction, torque, *of_outputs], steps=FEW)
    swept = lw.sweep(mechanism, vary, outputs=[reaction, torque], steps=FEW)
    slopes = lw.sensitivity(mechanism, of=[reaction, torque], by=[varied], steps=FEW)
    for name, peak in ((reaction, force), (torque, effort)):
        found = [study[name][0], compared.value(name, 0), swept[name][0], slopes.value(name)]
        assert found == pytest.approx([peak] * 4, rel=1e-8), name
    for name, peak in of_outputs.items():
        assert [study[name][0], compared.value(name, 0)] == pytest.approx([peak] * 2, rel=1e-8), name
    table = {(row.metric, row.subject): row.value for row in lw.metrics(forces)}
    assert main(["solve", f"gallery:{machine}", "--steps", str(FEW), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["largest_reactions [N]"]
    assert [table["peak_reaction", joint], told[f"{joint} on {link}"]] == pytest.approx([force] * 2, rel=1e-8)
    assert table[torque, driver] == pytest.approx(effort, rel=1e-8)


@pytest.mark.parametrize("machine", MACHINES)
def test_what_is_written_of_one_peak_agrees(machine: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    joint, link, _ = MACHINES[machine]
    forces, (force, effort) = lw.solve_forces(store.machine(machine), steps=FEW), peaks(machine)
    output = f"reaction {joint} on {link}"
    book = tmp_path / "book.xlsx"
    written: dict[str, list[str]] = {}
    calls = {
        "solve": ["solve", f"gallery:{machine}", "--steps", str(FEW)],
        "metrics": ["metrics", f"gallery:{machine}", "--steps", str(FEW)],
        "export": ["export", f"gallery:{machine}", "--steps", str(FEW), "--output", str(book)],
    }
    for name, call in calls.items():
        assert main(call) == 0
        written[name] = capsys.readouterr().out.splitlines()
    with zipfile.ZipFile(book) as parts:
        last = max(name for name in parts.namelist() if re.fullmatch(r"xl/worksheets/sheet\d\.xml", name))
        written["export"] = [
            f"{float(each):.6g}"
            for each in re.findall(r"<v>([^<]*)</v>", parts.read(last).decode())
            if re.fullmatch(r"-?[\d.]+(e-?\d+)?", each)
        ]
    diagrams = {
        "reactions": plot(forces, "reactions", joint=joint, on=link),
        "sva": plot(forces, "sva", of=output),
        "torque": plot(forces, "torque"),
    }
    written |= {name: re.findall(r"<!-- (.*?) -->", each.svg()) for name, each in diagrams.items()}
    (driver,) = forces.mechanism.drivers
    moving = animate(forces.motion, forces=forces, curves=[output, f"{driver}.effort"], frames=4)
    written["animation"] = re.findall(r">([^<>]*…[^<>]*)<", moving.svg)
    for name in written.keys() - {"torque"}:
        assert shown(written[name], force), (name, force, written[name])
    for name in written.keys() - {"reactions", "sva"}:
        assert shown(written[name], effort), (name, effort, written[name])

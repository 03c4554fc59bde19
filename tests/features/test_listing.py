"""The program listing: run by itself, it prints the columns of the motion and the forces of its machine."""

from __future__ import annotations

import csv
import io
import runpy
import subprocess
import sys
from contextlib import redirect_stdout
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.reference.random_mechanisms import random_mechanism

import linkwright as lw
from linkwright.cli import main

STEPS = 24
#: Driven bar and slider, every dyad, moving guides; a group that the library solves; a structure without a driver.
CORE = ("shaper_quick_return", "dyad_prp", "oldham_coupling", "stephenson_sixbar_triad", "truss")


def run(path: Path, *, apart: bool = True) -> dict[str, np.ndarray]:
    """What the program prints, by columns; ``apart``: in a process of its own."""
    if apart:
        done = subprocess.run([sys.executable, str(path)], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        printed = done.stdout
    else:
        with redirect_stdout(io.StringIO()) as caught:
            runpy.run_path(str(path))
        printed = caught.getvalue()
    head, *rows = csv.reader(io.StringIO(printed))
    return dict(zip(head, np.array(rows, dtype=float).T, strict=True))


def agrees(printed: dict[str, np.ndarray], wanted: dict[str, np.ndarray], rows: np.ndarray) -> None:
    """Every printed column is that of the result to 1e-9 of the largest of its unit; angles may differ by turns."""
    sizes: dict[str, float] = {}
    for name, column in wanted.items():
        unit = name[name.index("[") :] if "[" in name else ""
        sizes[unit] = max(sizes.get(unit, 1e-3), float(np.nanmax(np.abs(column), initial=0.0)))
    for name, column in printed.items():
        own = wanted[name][rows]
        if name.endswith(".direction [rad]"):
            force = wanted[name.replace(".direction [rad]", ".magnitude [N]")][rows]
            known = force > 1e-11 * sizes["[N]"]
            column, own = column[known], own[known]
        turns = name.endswith((".angle [rad]", ".direction [rad]"))
        gap = np.angle(np.exp(1j * (column - own))) if turns else column - own
        assert np.abs(gap).max(initial=0.0) <= 1e-9 * sizes[name[name.index("[") :]], name


def compare(machine: lw.Mechanism, model: str, folder: Path, *, apart: bool = False) -> set[str]:
    """Writes and runs the program of a machine; the columns of the result that it does not print."""
    motion = lw.solve_motion(machine, steps=STEPS, failures="mark")
    result = lw.solve_forces(motion) if machine.has_loads else motion
    path = lw.export(result, folder / "solution.py", model=model)
    printed = run(path, apart=apart)
    wanted = result.columns()
    agrees(printed, wanted, np.flatnonzero(motion.ok))
    derived = ("residual", "shaking", "time [s]", *machine.outputs)
    return {each for each in set(wanted) - set(printed) if not any(word in each for word in derived)}


@pytest.mark.parametrize("name", CORE)
def test_the_program_prints_the_results(name: str, tmp_path: Path):
    assert compare(store.machine(name), f"gallery:{name}", tmp_path, apart=True) == set()


@pytest.mark.rotating
@pytest.mark.parametrize("name", [name for name in store.names() if name not in CORE])
def test_programs_of_the_whole_gallery(name: str, tmp_path: Path):
    left = compare(store.machine(name), f"gallery:{name}", tmp_path)
    # several groups share a pin whose force the library gives for all of them together
    shared = {"excavator", "pinion_between_racks", "printing_press"}
    passive = {each for each in left if each.startswith(("ring_2 on", "ring_3 on"))}
    assert left == set() or name in shared or (name == "planetary_two_inputs" and left == passive)


#: Guides that moving links carry, both modes of every dyad, driven blocks, welded plates, loads of all kinds.
SEEDS = (3, 8, 19, 31, 300, 305)


@pytest.mark.parametrize("seed", SEEDS)
def test_programs_of_random_machines(seed: int, tmp_path: Path):
    text = random_mechanism(seed, triads=False, inner_drivers=False, with_loads=seed >= 300)
    path = tmp_path / "machine.yaml"
    path.write_text(text, "utf-8")
    assert compare(lw.load(path), str(path), tmp_path) == set()


@pytest.mark.rotating
@pytest.mark.parametrize("seed", range(1000, 1040))
def test_programs_of_more_random_machines(seed: int, tmp_path: Path):
    test_programs_of_random_machines(seed, tmp_path)


MODEL = """
format: 1
name: Names that no program knows
frame: {points: {print: [0 mm, 0 mm], "O-2": [200 mm, 0 mm]}}
links:
  lambda: {points: [print, 曲柄端], length: 60 mm}
  np: {points: [曲柄端, B-1], length: 220 mm, mass: 2 kg, inertia: 0.01 kg·m²}
  曲柄端_: {points: ["O-2", B-1], length: 150 mm, mass: 1 kg}
drivers: {class: {turn: lambda, about: print, speed: -12 rad/s, start: 10 deg}}
gravity: [0, -9.81 m/s²]
"""


def test_any_name_becomes_one_of_the_program(tmp_path: Path):
    forces = lw.solve_forces(lw.solve_motion(lw.loads(MODEL), steps=12))
    printed = run(lw.export(forces, tmp_path / "names.py"))
    agrees(printed, forces.columns(), np.arange(forces.steps))


def test_in_chinese(tmp_path: Path):
    path = lw.export(store.forces("dyad_rrp", STEPS), tmp_path / "program.py", language="zh")
    assert "# 2  RRP 杆组：bar, block" in path.read_text("utf-8")
    agrees(run(path), store.forces("dyad_rrp", STEPS).columns(), np.arange(STEPS))


def test_a_driver_on_a_moving_link_and_a_driven_block_on_a_guide(tmp_path: Path):
    text = """
format: 1
name: An arm with an elbow and a pusher
frame: {points: {O: [0 mm, 0 mm]}}
links:
  upper: {points: [O, E], length: 300 mm, mass: 2 kg, inertia: 0.02 kg·m²}
  fore: {points: {E: [0 mm, 0 mm], H: [200 mm, 30 mm]}, mass: 1 kg, inertia: 0.01 kg·m²}
  pusher: {points: {P: [0 mm, 0 mm], T: [50 mm, 10 mm]}, mass: 0.5 kg, inertia: 0.001 kg·m²}
joints:
  rail: {kind: prismatic, guide: pusher, through: T, direction: 20 deg, block: fore, at: H,
    offset: 7 mm, block_angle: 65 deg}
drivers:
  shoulder: {turn: upper, about: O, position: "40 deg*sin(2*pi*t/(1 s))"}
  elbow: {turn: upper, about: E, relative_to: fore, position: "50 deg*cos(2*pi*t/(1 s))"}
  push: {slide: rail, position: "30 mm*sin(4*pi*t/(1 s))"}
cycle: {duration: 1 s}
gravity: [0, -9.81 m/s²]
"""
    forces = lw.solve_forces(lw.solve_motion(lw.loads(text), steps=10))
    printed = run(lw.export(forces, tmp_path / "arm.py"))
    agrees(printed, forces.columns(), np.arange(forces.steps))
    assert {"elbow.effort [N·m]", "push.effort [N]", "rail on fore.couple [N·m]"} <= set(printed)


def test_the_command_writes_the_program_for_its_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    model, target = tmp_path / "own machine.yaml", tmp_path / "solution.py"
    model.write_text(store.text("triad"), "utf-8")
    assert main(["export", str(model), "--to", str(target), "--steps", "6", "--lang", "zh"]) == 0
    capsys.readouterr()
    forces = lw.solve_forces(lw.solve_motion(lw.load(model), steps=6))
    agrees(run(target, apart=False), forces.columns(), np.arange(6))


def test_loads_that_vary_and_friction_come_as_numbers_of_the_positions(tmp_path: Path):
    text = """
format: 1
name: A piston that rubs
frame: {points: {O: [0 mm, 0 mm], V: [0 mm, 20 mm]}}
links:
  crank: {points: [O, A], length: 60 mm, mass: 1 kg, inertia: 0.001 kg·m²}
  rod: {points: [A, B], length: 220 mm, mass: 2 kg, inertia: 0.01 kg·m²}
  piston: {points: [B], mass: 3 kg}
joints:
  A: {kind: revolute, pin_radius: 10 mm, friction: 0.1}
  bore: {kind: prismatic, guide: frame, through: V, direction: 0 deg, block: piston, at: B, friction: 0.15}
loads:
  gas: {kind: force, on: piston, at: B, direction: 180 deg, magnitude: 200 N}
  pull: {kind: spring, between: [frame.V, rod.B], stiffness: 1000 N/m, free_length: 50 mm}
driver: {turn: crank, about: O, speed: 20 rad/s}
gravity: [0, -9.81 m/s²]
"""
    assert compare(lw.loads(text), "machine.yaml", tmp_path) == set()
    assert "rod_force[:, 0] = np.array([" in (tmp_path / "solution.py").read_text("utf-8")

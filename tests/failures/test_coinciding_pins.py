"""Pins at one place, links of no length, parallel guides and rigid parts in every dyad and in triads: each position
is solved and balanced, or says why not; nothing ends in an internal error."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.refusals import checked

import linkwright as lw
from linkwright.cli import main

Q = "Q: [0.1 m, 0 m]"
G = "G: [0 m, 0 m]"
ARM = "arm: {points: [A, B], length: 0.5 m, mass: 1 kg}"
BLOCK = "block: {points: {A: [0 m, 0 m], C: [0.1 m, 0 m]}, mass: 1 kg}"
SLOT = "slot: {kind: prismatic, guide: %s, through: %s, direction: 0 deg, block: %s, at: A, offset: %s}"
SHORT = "a: {points: {A: [0 m, 0 m], B: [0 m, 0 m]}, mass: 1 kg}"
LONG = "a: {points: [A, B], length: %s, mass: 1 kg}"
ON_A, ON_Q = "b: {points: [A, B], length: %s, mass: 1 kg}", "b: {points: [Q, B], length: %s, mass: 1 kg}"
SLIDE = "g: {kind: prismatic, guide: %s, through: %s, direction: %s, block: s, at: %s}"
OTHER = "h: {kind: prismatic, guide: %s, through: %s, direction: %s, block: t, at: %s}"
S, T = "s: {points: [C], mass: 1 kg}", "t: {points: [C], mass: 1 kg}"
#: Points of the frame, links, joints; how many of twelve positions are solved, and what becomes of the others.
MODELS = {
    "RPR on one pin": ("", (ARM, BLOCK), (SLOT % ("arm", "B", "block", "0 m"),), 0, "coinciding"),
    "RPR on one pin, turned over": ("", (ARM, BLOCK), (SLOT % ("block", "C", "arm", "0 m"),), 0, "coinciding"),
    "RPR on one pin, offset": ("", (ARM, BLOCK), (SLOT % ("arm", "B", "block", "20 mm"),), 0, "apart"),
    "RPR that meets its pin": (
        Q,
        ("arm: {points: [Q, B], length: 0.5 m, mass: 1 kg}", "block: {points: [A], mass: 1 kg}"),
        (SLOT % ("arm", "Q", "block", "0 m"),),
        11,
        "coinciding",
    ),
    "RRR on one pin": ("", (LONG % "0.5 m", ON_A % "0.5 m"), (), 0, "coinciding"),
    "RRR on one pin, unequal": ("", (LONG % "0.5 m", ON_A % "0.4 m"), (), 0, "apart"),
    "RRR with a link of no length": (Q, (SHORT, ON_Q % "0.3 m"), (), 0, "apart"),
    "RRR of links of no length": (
        Q,
        (SHORT, "b: {points: {Q: [0 m, 0 m], B: [0 m, 0 m]}, mass: 1 kg}"),
        (),
        0,
        "coinciding apart",
    ),
    "RRR that folds on its pins": (Q, (LONG % "0.5 m", ON_Q % "0.5 m"), (), 11, "coinciding"),
    "RRP with a rod of no length": (
        G,
        (SHORT, "s: {points: [B], mass: 1 kg}"),
        (SLIDE % ("frame", "G", "0 deg", "B"),),
        0,
        "singular apart",
    ),
    "RRP with its guide through its pin": (
        "",
        (LONG % "0.2 m", "s: {points: [B], mass: 1 kg}"),
        (SLIDE % ("crank", "A", "30 deg", "B"),),
        12,
        "",
    ),
    "PRP of parallel guides": (
        "",
        (S, T),
        (SLIDE % ("crank", "A", "0 deg", "C"), OTHER % ("crank", "O", "180 deg", "C")),
        0,
        "singular",
    ),
    "PRP of guides that become parallel": (
        G,
        (S, T),
        (SLIDE % ("crank", "A", "0 deg", "C"), OTHER % ("frame", "G", "90 deg", "C")),
        10,
        "singular",
    ),
    "PRP of guides through one point": (
        "",
        (S, T),
        (SLIDE % ("crank", "A", "0 deg", "C"), OTHER % ("crank", "A", "90 deg", "C")),
        12,
        "",
    ),
    "RPP of parallel guides": (
        G,
        ("s: {points: {C: [0 m, 0 m], D: [0.1 m, 0 m]}, mass: 1 kg}", "t: {points: [A], mass: 1 kg}"),
        (SLIDE % ("frame", "G", "0 deg", "C"), OTHER % ("s", "C", "0 deg", "A")),
        0,
        "singular",
    ),
    "RPP of crossed guides": (
        G,
        ("s: {points: {C: [0 m, 0 m], D: [0.1 m, 0 m]}, mass: 1 kg}", "t: {points: [A], mass: 1 kg}"),
        (SLIDE % ("frame", "G", "0 deg", "C"), OTHER % ("s", "C", "90 deg", "A")),
        12,
        "",
    ),
}


def model(points: str, links: tuple[str, ...], joints: tuple[str, ...]) -> str:
    frame = ", ".join(filter(None, ("O: [0 m, 0 m]", points)))
    crank = "crank: {points: [O, A], length: 0.1 m, mass: 1 kg}"
    rows = ["format: 1", f"frame: {{points: {{{frame}}}}}", "links:", *(f"  {each}" for each in (crank, *links))]
    rows += ["joints:", *(f"  {each}" for each in joints)] if joints else []
    return "\n".join([*rows, "driver: {turn: crank, about: O, speed: 10 rpm}", "gravity: [0, -9.81 m/s²]\n"])


def triad(
    p: str, q: str, r: str, a: str = "30 mm, 0 mm", o2: str = "130 mm, -210 mm", o3: str = "360 mm, 90 mm"
) -> str:
    return f"""format: 1
frame:
  points: {{O: [0 mm, 0 mm], O2: [{o2}], O3: [{o3}]}}
links:
  crank: {{points: [O, A]}}
  bar_1: {{points: [A, P], mass: 1 kg}}
  bar_2: {{points: [O2, Q], mass: 1 kg}}
  bar_3: {{points: [O3, R], mass: 0.6 kg}}
  plate: {{points: [P, Q, R], mass: 2 kg}}
drawing: {{A: [{a}], P: [{p}], Q: [{q}], R: [{r}]}}
driver: {{turn: crank, about: O, speed: 10 rad/s}}
gravity: [0, -9.81 m/s²]
"""


TRIADS = {
    "both pins of the frame at one place": (
        triad("210 mm, 90 mm", "190 mm, -10 mm", "235 mm, 5 mm", o3="130 mm, -210 mm"),
        12,
        "",
    ),
    "two pins of the plate at one place": (triad("210 mm, 90 mm", "190 mm, -10 mm", "190 mm, -10 mm"), 12, ""),
    "three parallel bars": (
        triad("0 mm, 90 mm", "100 mm, 90 mm", "200 mm, 90 mm", o2="130 mm, 0 mm", o3="230 mm, 0 mm"),
        0,
        "singular lost",
    ),
}
EVERY = {name: (model(*made), solved, others) for name, (*made, solved, others) in MODELS.items()} | TRIADS


@pytest.mark.parametrize("name", EVERY)
def test_every_position_is_solved_and_balanced_or_says_why_not(name: str, tmp_path: Path) -> None:
    text, solved, others = EVERY[name]
    mechanism = lw.loads(text)
    motion = lw.solve_motion(mechanism, steps=12, failures="mark")
    if solved is not None:
        assert motion.ok.sum() == solved
    failed = {lw.LinkwrightError(each.sentence).code for each in motion.outcomes if not each.ok}
    assert failed == {f"outcome.{each}" for each in others.split()}
    lw.metrics(motion)
    if motion.ok.all():
        forces = lw.solve_forces(motion)
        assert np.abs(forces.balance_residual).max() < 1e-12
        assert np.abs(forces.power_residual).max() < 1e-12
    else:
        with pytest.raises(lw.PositionError):
            lw.solve_motion(mechanism, steps=12)
    file = tmp_path / "model.yaml"
    file.write_text(text, encoding="utf-8")
    code, found = checked(file)
    assert code == any(each.severity == "error" for each in found)
    drawn = main(["draw", str(file), "--output", str(tmp_path / "drawing.svg")])
    assert drawn == (0 if motion.ok.any() else 1)


@pytest.mark.rotating
def test_diagrams_leave_extremes_out_that_lie_where_nothing_is_reached(tmp_path: Path) -> None:
    file = tmp_path / "model.yaml"
    file.write_text(EVERY["RPR that meets its pin"][0], encoding="utf-8")
    main(["plot", str(file), "--output", str(tmp_path / "diagram.svg")])
    assert (tmp_path / "diagram.svg").exists()

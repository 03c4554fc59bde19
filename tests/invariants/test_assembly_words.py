"""The assembly words mean what the documentation says, for all dyads, both words, and guides on either link.

The meaning is read off the positions: sides and directions of points, nothing of the solution's formulas.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw

HEAD = """
format: 1
name: words
frame:
  points: {{O1: [0 m, 0 m], O2: [0.9 m, 0.1 m], V: [0.2 m, 0.35 m]}}
links:
  crank: {{points: [O1, A], length: 0.15 m}}
{links}
joints:
{joints}
{assembly}
driver: {{turn: crank, about: O1, speed: 1 rad/s}}
"""


def solved(links: list[str], joints: str, assembly: str) -> lw.Motion:
    text = HEAD.format(links="\n".join(f"  {each}" for each in links), joints=joints, assembly=assembly)
    text = text if joints else text.replace("joints:\n\n", "")
    motion = lw.solve_motion(lw.loads(text), steps=24, failures="mark")
    assert motion.ok[0]
    return motion


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def along(motion: lw.Motion, link: str, angle: float) -> np.ndarray:
    """Direction (n, 2) at an angle in a link's axes."""
    e = motion.link(link).direction
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * e[:, 0] - s * e[:, 1], s * e[:, 0] + c * e[:, 1]], axis=1)


@pytest.mark.parametrize("word", ["left", "right"])
@pytest.mark.parametrize("swapped", [False, True])
def test_rrr_lies_on_its_side_of_the_ray_from_the_first_links_outer_pin(word: str, swapped: bool) -> None:
    bars = ["coupler: {points: [A, B], length: 0.7 m}", "rocker: {points: [O2, B], length: 0.5 m}"]
    motion = solved(bars[::-1] if swapped else bars, "", f"assembly: {{B: {word}}}")
    p, q = motion.point("A").position, np.tile([0.9, 0.1], (24, 1))
    if swapped:
        p, q = q, p
    assert ((cross(q - p, motion.point("B").position - p) > 0.0) == (word == "left")).all()


@pytest.mark.parametrize("word", ["forward", "backward"])
@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("direction", [0.3, 0.3 + np.pi])
@pytest.mark.parametrize("own", [False, True])
def test_rrp_has_its_inner_pin_ahead_along_the_guide_on_whichever_link_it_is(
    word: str, swapped: bool, direction: float, own: bool
) -> None:
    """``own``: the slider carries the guide, its block is on the frame."""
    bars = ["rod: {points: [A, B], length: 0.8 m}", "slider: {points: {B: [0 m, 0 m], G: [0.1 m, 0.05 m]}}"]
    if own:
        guide = f"guide: slider, through: G, direction: {direction} rad, block: frame, at: V, block_angle: 0.5 rad"
    else:
        guide = f"guide: frame, through: V, direction: {direction} rad, block: slider, at: B, block_angle: 0.5 rad"
    joints = f"  way: {{kind: prismatic, {guide}}}"
    motion = solved(bars[::-1] if swapped else bars, joints, f"assembly: {{B: {word}}}")
    g = along(motion, "slider" if own else "frame", direction)
    ahead = ((motion.point("B").position - motion.point("A").position) * g).sum(axis=1)
    assert ((ahead > 0.0) == (word == "forward")).all()


@pytest.mark.parametrize("word", ["forward", "backward"])
@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("on_rod", [False, True])
def test_rpr_has_the_blocks_pin_ahead_of_the_guides_pin(word: str, swapped: bool, on_rod: bool) -> None:
    """``on_rod``: the link on the crank carries the guide, the one on the frame the block; else the reverse."""
    bars = [
        "rod: {points: {A: [0 m, 0 m], G: [0.2 m, 0.05 m]}}",
        "lever: {points: {O2: [0 m, 0 m], H: [0.1 m, 0.02 m]}}",
    ]
    guide, block = (("rod", "G"), ("lever", "H")) if on_rod else (("lever", "H"), ("rod", "G"))
    joints = (
        f"  way: {{kind: prismatic, guide: {guide[0]}, through: {guide[1]}, direction: 0.4 rad, block: {block[0]}, "
        f"at: {block[1]}, offset: 0.03 m, block_angle: 1.1 rad}}"
    )
    motion = solved(bars[::-1] if swapped else bars, joints, f"assembly: {{way: {word}}}")
    a, o2 = motion.point("A").position, np.tile([0.9, 0.1], (24, 1))
    way = o2 - a if on_rod else a - o2
    assert (((way * along(motion, guide[0], 0.4)).sum(axis=1) > 0.0) == (word == "forward")).all()


ONE_MODE = {
    "PRP": (
        ["die: {points: [B]}", "rod: {points: [B]}"],
        "  slot: {kind: prismatic, guide: crank, through: A, direction: 80 deg, block: die, at: B}\n"
        "  way: {kind: prismatic, guide: frame, through: V, direction: 10 deg, block: rod, at: B}",
        "B",
    ),
    "RPP": (
        ["slider: {points: {S: [0 m, 0 m]}}", "bar: {points: {A: [0 m, 0 m]}}"],
        "  way: {kind: prismatic, guide: frame, through: V, direction: 10 deg, block: slider, at: S}\n"
        "  cross: {kind: prismatic, guide: slider, through: S, direction: 75 deg, block: bar, at: A}",
        "cross",
    ),
}


@pytest.mark.parametrize("kind", ONE_MODE)
@pytest.mark.parametrize("word", ["forward", "left", "both"])
def test_dyads_with_one_mode_take_no_word(kind: str, word: str) -> None:
    links, joints, inner = ONE_MODE[kind]
    motion = solved(links, joints, "")
    assert kind in repr(motion.structure)
    with pytest.raises(lw.LinkwrightError) as said:
        solved(links, joints, f"assembly: {{{inner}: {word}}}")
    if word == "both":
        (finding,) = said.value.findings  # type: ignore[attr-defined]
        assert (finding.code, finding.key) == ("unknown-word", f"assembly.{inner}")
    else:
        assert (said.value.code, said.value.values["joint"]) == ("motion.not_inner", inner)


def test_a_wrong_word_is_refused_with_the_right_ones() -> None:
    bars = ["coupler: {points: [A, B], length: 0.7 m}", "rocker: {points: [O2, B], length: 0.5 m}"]
    with refused("motion.no_mode", first="left", second="right", joint="B", word="forward", signature="RRR"):
        solved(bars, "", "assembly: {B: forward}")
    with refused("unknown-word", lw.ModelError, text="lefft") as said:
        solved(bars, "", "assembly: {B: lefft}")
    assert [each.key for each in said.value.findings] == ["assembly.B"]  # type: ignore[attr-defined]


def test_a_word_for_a_joint_that_is_no_inner_one_is_refused() -> None:
    bars = ["coupler: {points: [A, B], length: 0.7 m}", "rocker: {points: [O2, B], length: 0.5 m}"]
    with refused("motion.not_inner", joint="A", names=("B",)):
        solved(bars, "", "assembly: {A: left}")

"""Over-driven, under-driven and wrongly assembled mechanisms: which links, which remedy, what is left."""

from __future__ import annotations

import pytest

import linkwright as lw

FOUR_BAR = """
format: 1
name: four-bar
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 3.5 m}
  rocker: {points: [O2, B], length: 2.5 m}
ASSEMBLY
DRIVERS
"""


def four_bar(drivers: str, assembly: str = "assembly: {B: left}") -> lw.Mechanism:
    return lw.loads(FOUR_BAR.replace("DRIVERS", drivers).replace("ASSEMBLY", assembly))


ONE = "first: {turn: crank, about: O1, speed: 1 rad/s}"
TWO = "second: {turn: rocker, about: O2, speed: 1 rad/s}"


def refusal(mechanism: lw.Mechanism) -> str:
    with pytest.raises(lw.LinkwrightError) as raised:
        lw.structure(mechanism)
    return str(raised.value)


def test_two_drivers_on_one_freedom_are_refused() -> None:
    text = refusal(four_bar(f"drivers:\n  {ONE}\n  {TWO}"))
    assert "determined more than once" in text
    assert all(name in text for name in ("crank", "coupler", "rocker"))
    assert "mobility 1 and two drivers" in text and "driver 'second'" in text


def test_the_same_joint_driven_twice_is_refused() -> None:
    with pytest.raises(lw.LinkwrightError):
        lw.structure(four_bar(f"drivers:\n  {ONE}\n  again: {{turn: crank, about: O1, speed: 2 rad/s}}"))


def test_only_the_links_that_are_over_driven_are_named() -> None:
    """A crank of its own beside the over-driven four-bar has nothing to do with it."""
    text = FOUR_BAR.replace("links:", "links:\n  fan: {points: [O1, F], length: 1 m}")
    text = text.replace("ASSEMBLY", "").replace(
        "DRIVERS", f"drivers:\n  {ONE}\n  {TWO}\n  third: {{turn: fan, about: O1, speed: 1 rad/s}}"
    )
    said = refusal(lw.loads(text))
    assert "rocker" in said and "fan" not in said


def test_a_mechanism_without_driver_names_what_is_free() -> None:
    text = refusal(four_bar(""))
    assert "'crank'" in text and "'coupler'" in text and "'rocker'" in text
    assert "share nothing but the frame" not in text


def test_two_mechanisms_in_one_file_are_told_apart() -> None:
    text = FOUR_BAR.replace("links:", "links:\n  fan: {points: [O3, F], length: 1 m}")
    text = text.replace("O2: [4 m, 0 m]", "O2: [4 m, 0 m], O3: [9 m, 0 m]").replace("ASSEMBLY", "")
    said = refusal(lw.loads(text.replace("DRIVERS", f"driver: {ONE.split(': ', 1)[1]}")))
    assert "2 mechanisms that share nothing but the frame" in said
    assert "{fan}" in said and "{crank, coupler, rocker}" in said


def test_the_number_of_drivers_is_said() -> None:
    one = lw.structure(four_bar(f"driver: {ONE.split(': ', 1)[1]}")).text()
    assert "number of drivers (1)" in one
    two = lw.structure(lw.load("gallery:dyad_rrr")).text()
    assert "number of drivers (2)" in two


@pytest.mark.parametrize(
    ("assembly", "words"),
    [
        ("assembly: {B: forward}", ("assembly.B", "forward", "left", "right")),
        ("assembly: {B: lef}", ('did you mean "left"',)),
        ("assembly: {A: left}", ("assembly.A", "inner joint")),
        ("assembly: {B: left, O2: left}", ("assembly.O2",)),
    ],
)
def test_wrong_words_of_assembly(assembly: str, words: tuple[str, ...]) -> None:
    with pytest.raises(lw.LinkwrightError) as raised:
        lw.solve_motion(four_bar(f"driver: {ONE.split(': ', 1)[1]}", assembly), steps=4)
    for word in words:
        assert word in str(raised.value)


def test_both_wrong_words_are_found_at_once() -> None:
    with pytest.raises(lw.LinkwrightError) as raised:
        lw.solve_motion(
            four_bar(f"driver: {ONE.split(': ', 1)[1]}", "assembly: {B: forward, O1: left}"), steps=4
        )
    assert "assembly.B" in str(raised.value) and "assembly.O1" in str(raised.value)


def test_signatures_of_welds_and_drivers() -> None:
    """A plate welded to the crank is a group of its own, W; a driven crank is R, a driven slide P."""
    model = lw.load("gallery:crank_rocker")
    assert [g.signature for g in lw.structure(model).groups] == ["R", "RRR"]
    text = FOUR_BAR.replace(
        "ASSEMBLY",
        "joints: {W: {kind: weld, links: [crank, plate], at: W, angle: 90 deg}}\nassembly: {B: left}",
    ).replace("length: 1 m}", "length: 1 m, also: {W: [0.5 m, 0.1 m]}}")
    text = text.replace("  coupler:", "  plate: {points: [W, V], length: 0.2 m}\n  coupler:")
    found = lw.structure(lw.loads(text.replace("DRIVERS", f"driver: {ONE.split(': ', 1)[1]}")))
    assert sorted(g.signature for g in found.groups) == ["R", "RRR", "W"]

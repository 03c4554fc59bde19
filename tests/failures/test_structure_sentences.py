"""Over-driven, under-driven and wrongly assembled mechanisms: which links, which remedy, what is left."""

from __future__ import annotations

import pytest
from tests import store
from tests.refusals import findings, noted, refused, said

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


#: The links of the loop.
LOOP = {"'crank'", "'coupler'", "'rocker'"}


def test_two_drivers_on_one_freedom_are_refused() -> None:
    with refused("mobility.excess", mobility=1, count=2, links=LOOP, extra=("driver 'second'",)):
        lw.structure(four_bar(f"drivers:\n  {ONE}\n  {TWO}"))


def test_the_same_joint_driven_twice_is_refused() -> None:
    drivers = f"drivers:\n  {ONE}\n  again: {{turn: crank, about: O1, speed: 2 rad/s}}"
    found = findings(FOUR_BAR.replace("DRIVERS", drivers).replace("ASSEMBLY", ""))
    said(found, "duplicate", "drivers.again", message='the driver "{name}" drives the same coordinate', name="first")


def test_only_the_links_that_are_over_driven_are_named() -> None:
    """A crank of its own beside the over-driven four-bar has nothing to do with it."""
    text = FOUR_BAR.replace("links:", "links:\n  fan: {points: [O1, F], length: 1 m}")
    text = text.replace("ASSEMBLY", "").replace(
        "DRIVERS", f"drivers:\n  {ONE}\n  {TWO}\n  third: {{turn: fan, about: O1, speed: 1 rad/s}}"
    )
    with refused("mobility.excess", mobility=2, count=3, links=LOOP):
        lw.structure(lw.loads(text))


def test_a_mechanism_without_driver_names_what_is_free() -> None:
    with refused("mobility.free", mobility=1, count=1, links=LOOP):
        lw.structure(four_bar(""))


def test_two_mechanisms_in_one_file_are_told_apart() -> None:
    text = FOUR_BAR.replace("links:", "links:\n  fan: {points: [O3, F], length: 1 m}")
    text = text.replace("O2: [4 m, 0 m]", "O2: [4 m, 0 m], O3: [9 m, 0 m]").replace("ASSEMBLY", "")
    parts = {"first": ("{fan}",), "last": "{crank, coupler, rocker}"}
    with refused("mobility.islands", count=2, mobility=2, **parts):
        lw.structure(lw.loads(text.replace("DRIVERS", f"driver: {ONE.split(': ', 1)[1]}")))


def test_the_number_of_drivers_is_said() -> None:
    one = lw.structure(four_bar(f"driver: {ONE.split(': ', 1)[1]}")).text()
    assert "(1)" in one
    two = lw.structure(store.machine("dyad_rrr")).text()
    assert "(2)" in two


@pytest.mark.parametrize(
    ("assembly", "code", "values"),
    [
        (
            "assembly: {B: forward}",
            "motion.no_mode",
            {"joint": "B", "word": "forward", "first": "left", "second": "right"},
        ),
        ("assembly: {B: lef}", "unknown-word", {"text": "lef"}),
        ("assembly: {A: left}", "motion.not_inner", {"joint": "A", "names": ("B",)}),
        ("assembly: {B: left, O2: left}", "motion.not_inner", {"joint": "O2"}),
    ],
)
def test_wrong_words_of_assembly(assembly: str, code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        lw.solve_motion(four_bar(f"driver: {ONE.split(': ', 1)[1]}", assembly), steps=4)


def test_both_wrong_words_are_found_at_once() -> None:
    with pytest.raises(lw.LinkwrightError) as caught:
        lw.solve_motion(four_bar(f"driver: {ONE.split(': ', 1)[1]}", "assembly: {B: forward, O1: left}"), steps=4)
    both = [caught.value.values[each] for each in ("first", "second")]
    noted(both, "motion.no_mode", joint="B", word="forward")
    noted(both, "motion.not_inner", joint="O1")


def test_signatures_of_welds_and_drivers() -> None:
    """A plate welded to the crank is a group of its own, W; a driven crank is R, a driven slide P."""
    model = store.machine("crank_rocker")
    assert [g.signature for g in lw.structure(model).groups] == ["R", "RRR"]
    text = FOUR_BAR.replace(
        "ASSEMBLY", "joints: {W: {kind: weld, links: [crank, plate], at: W, angle: 90 deg}}\nassembly: {B: left}"
    ).replace("length: 1 m}", "length: 1 m, also: {W: [0.5 m, 0.1 m]}}")
    text = text.replace("  coupler:", "  plate: {points: [W, V], length: 0.2 m}\n  coupler:")
    found = lw.structure(lw.loads(text.replace("DRIVERS", f"driver: {ONE.split(': ', 1)[1]}")))
    assert sorted(g.signature for g in found.groups) == ["R", "RRR", "W"]

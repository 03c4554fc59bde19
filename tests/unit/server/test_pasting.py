"""Copies of drawn machines: shifted ones move alike, mirrored ones as in a mirror."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.refusals import refused
from tests.unit.server.drawing import FOURBAR, NEW, PIVOTS, bar, done

import linkwright as lw

PLATE = bar(["A", "B", "P"], name="plate", places={"B": [0.16, 0.12], "P": [0.08, 0.16]})
MACHINE = (
    *PIVOTS,
    bar(["O1", "A"], name="crank", places={"A": [0.03, 0.04]}),
    PLATE,
    bar(["B", "O2"], name="rocker"),
    bar(["P", "C"], name="rod", places={"C": [0.3, 0.1]}),
    {"do": "guide", "at": "C", "angle": 20},
    {"do": "driver", "link": "crank"},
    {"do": "load", "link": "plate", "at": "P", "force": "10 N", "angle": -60},
    {
        "do": "add",
        "section": "loads",
        "stem": "spring",
        "entry": {"kind": "spring", "between": ["crank.A", "rod.C"], "stiffness": "1 N/mm"},
    },
)
LINKS = ("crank", "plate", "rocker", "rod")


def copied(*names: str, text: str | None = None, **more: Any) -> Any:
    items = [{"kind": "link", "name": each} for each in names]
    return done(text or done(NEW, *MACHINE).text, {"do": "paste", "items": items, "shift": [0.0, 0.0], **more})


def alone(text: str) -> str:
    """The copy by itself: the original removed, the copy driven."""
    gone = [{"kind": "link", "name": each} for each in LINKS] + [{"kind": "pair", "name": "guide1"}]
    gone += [{"kind": "point", "name": each} for each in ("O1", "O2")]
    return done(text, {"do": "remove", "items": gone}, {"do": "driver", "link": "crank2"}).text


@pytest.mark.parametrize(("mirror", "turn"), [("", 1), ("x", -1), ("y", -1)])
def test_a_copy_moves_like_the_original(mirror: str, turn: int) -> None:
    """The curve of C: shifted, or mirrored about the middle, run through the other way round."""
    text = done(NEW, *MACHINE).text
    now = copied(*LINKS, shift=[0.5, 0.1], **({"mirror": mirror} if mirror else {}))
    assert {"crank2", "plate2", "rocker2", "rod2", "slider2"} <= set(now.made)
    assert {"O3", "O4"} <= set(now.made)
    copy = lw.loads(alone(now.text))
    (guide,) = copy.guides.values()
    assert len(copy.loads) == 2
    machine = lw.loads(text)
    at = {"driver": np.angle(0.03 + 0.04j)}
    first, second = (complex(*now.picture["points"][each]) for each in copy.link("crank2").points)
    start = {"driver": np.angle(second - first)}
    angles = np.linspace(0, 2, 9)
    before = [lw.solve_motion(machine, at={"driver": at["driver"] + a}).point("C").position[0] for a in angles]
    after = [
        lw.solve_motion(copy, at={"driver": start["driver"] + turn * a}).point(guide.at).position[0] for a in angles
    ]
    lows, highs = np.min([*_points(text).values()], axis=0), np.max([*_points(text).values()], axis=0)
    wanted = np.array(before)
    for axis, name in enumerate("xy"):
        if mirror == name:
            wanted[:, axis] = lows[axis] + highs[axis] - wanted[:, axis]
    assert np.array(after) == pytest.approx(np.add(wanted, (0.5, 0.1)), abs=1.5e-4)


def _points(text: str) -> dict[str, list[float]]:
    return done(text).picture["points"]  # type: ignore[no-any-return]


def test_what_is_between_chosen_links_comes_along_and_nothing_else() -> None:
    now = copied("crank", "plate")
    assert set(now.picture["links"]) - {*LINKS, "slider"} == {"crank2", "plate2"}
    assert [*now.picture["loads"]] == ["load1", "spring1", "force1"]
    again = copied("crank2", text=now.text)
    assert "crank3" in again.made
    four = done(NEW, *FOURBAR)
    point = done(four.text, {"do": "paste", "items": [{"kind": "point", "name": "O1"}], "shift": [0.01, 0]})
    assert point.made == ["O3"]
    with refused("studio.no_copy"):
        done(four.text, {"do": "paste", "items": [], "shift": [0, 0]})
    with refused("studio.no_link", name="no"):
        copied("no")


def test_what_has_been_cut_comes_from_the_text_that_had_it() -> None:
    """A machine that is cut and pasted, or pasted into another file, moves as it did."""
    whole = done(NEW, *MACHINE).text
    items = [{"kind": "link", "name": each} for each in LINKS]
    for into in (NEW, done(NEW, *FOURBAR).text):
        pasted = done(into, {"do": "paste", "items": items, "shift": [0.0, 0.0], "of": whole})
        crank, rod = (next(each for each in pasted.made if each.startswith(name)) for name in ("crank", "rod"))
        gone = [{"kind": kind, "name": name} for kind, name in _own(into)]
        text = done(pasted.text, {"do": "remove", "items": gone}, {"do": "driver", "link": crank}).text
        before, after = lw.loads(whole), lw.loads(text)
        _start, end = after.link(rod).points
        for angle in (0.9, 2.0, 4.0):
            wanted = lw.solve_motion(before, at={"driver": angle}).point("C").position
            assert lw.solve_motion(after, at={"driver": angle}).point(end).position == pytest.approx(
                wanted, abs=1.5e-4
            )


def _own(text: str) -> list[tuple[str, str]]:
    shown = done(text).picture
    return [("link", each) for each in shown["links"]] + [("point", each) for each in shown["fixed"]]

"""Where the source names a kind of joint outside the kinds' own files: never where mechanisms are solved."""

from __future__ import annotations

import re
from pathlib import Path

import linkwright

ROOT = Path(linkwright.__file__).parent
NAMED = re.compile(
    r"isinstance\([^)]*\b(?:Revolute|Prismatic|Weld|Cam)Joint\b|isinstance\([^)]*\b(?:Gear|Wheel|Rack|Belt)Pair\b"
    r"|\bkind (?:==|!=|in|not in) .*\"(?:revolute|prismatic|weld|gear|rack|belt|chain|cam)\""
)
#: Rooms that solve: nothing there asks which kind a joint is.
SOLVING = ("structure", "kinematics", "engine", "groups")
MOST = 95


def named(*rooms: str) -> list[str]:
    found = []
    for path in sorted(ROOT.rglob("*.py")):
        room = path.relative_to(ROOT).parts[0]
        if room == "joints" or (rooms and room not in rooms):
            continue
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1):
            found += [f"{path.relative_to(ROOT)}:{number}"] * len(NAMED.findall(line))
    return found


def test_kinds_are_named_in_few_places() -> None:
    found = named()
    assert len(found) <= MOST, "\n".join(found)


def test_solvers_ask_the_joint() -> None:
    assert named(*SOLVING) == []

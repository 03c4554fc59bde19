"""Gallery machines written as MuJoCo models and read again: points over the cycle, masses, inertias, colours."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright import gallery

pytest.importorskip("mujoco")
#: Positions over the cycle.
STEPS = 24


def driven(name: str) -> bool:
    """Whether the machine moves, and without a cam, which MuJoCo does not carry."""
    text = gallery.content(name).decode()
    return bool(store.machine(name).drivers) and not re.search(r"\bkind: cam\b", text)


@pytest.mark.rotating
@pytest.mark.parametrize("name", [name for name in store.names() if driven(name)])
def test_what_is_written_is_read(name: str, tmp_path: Path) -> None:
    machine, motion = store.machine(name), store.motion(name, STEPS)
    found = lw.read_foreign(lw.export(motion, tmp_path / "a.xml")).mechanism
    assert found is not None
    assert set(found.links) == set(machine.links)
    again = lw.solve_motion(found, times=motion.time - motion.time[0])
    size = max(1.0, *(float(np.abs(motion.point(place).position).max()) for place in places(machine)))
    for place in every(places(machine)):
        np.testing.assert_allclose(
            again.point(place).position, motion.point(place).position, rtol=0, atol=1e-9 * size, err_msg=place
        )
    for link, other in every((machine.links[each], found.links[each]) for each in machine.links):
        assert (other.mass, other.colour) == (pytest.approx(link.mass), link.colour)
        assert other.inertia == pytest.approx(link.inertia, rel=1e-9, abs=1e-14)


def places(machine: lw.Mechanism) -> list[str]:
    """All points of moving links."""
    return [f"{name}.{point}" for name, link in machine.links.items() for point in link.points]

"""Machines of the gallery as URDF with their loops and read back: all their points are where they were."""

from pathlib import Path

import numpy as np
import pytest
from tests import store

import linkwright as lw

#: Robots know no cams.
NAMES = [name for name in store.names() if name != "printing_press"]
STEPS = 24


def deviation(name: str, folder: Path) -> float:
    """The largest distance, m, of a point from where it was; all points are read back."""
    machine = store.machine(name)
    motion = lw.solve_motion(machine, steps=STEPS, failures="mark")
    path = folder / f"{name}.urdf"
    lw.export(motion, path)
    reread = lw.loads(lw.read_foreign(path).text)
    times = motion.time[motion.ok] - motion.time[int(motion.ok.argmax())]
    again = lw.solve_motion(reread, times=times)
    worst = 0.0
    for link, points in ((link, machine.links[link].points) for link in machine.links):
        for point in points:
            was, now = (each.point(f"{link}.{point}").position for each in (motion, again))
            worst = max(worst, float(np.hypot(*(was[motion.ok] - now).T).max()))
    return worst


def test_racks_and_their_pinion_come_back(tmp_path: Path) -> None:
    assert deviation("pinion_between_racks", tmp_path) < 1e-9


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_every_machine_comes_back(name: str, tmp_path: Path) -> None:
    assert deviation(name, tmp_path) < 1e-9

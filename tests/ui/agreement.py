"""Living pages against the solver: rows, metrics, the file that a page hands out."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from tests.every import every
from tests.ui.browser import Opened
from tests.ui.pages import STEPS, page_of

import linkwright as lw

CLOSE = 1e-12
#: How near metrics come.
NUMBERS = 2e-7
#: Digits that numbers of a file keep, and those that lengths keep between coordinates of a drawing.
WRITTEN, DRAWN = 4e-16, 2e-13
#: Names of metrics by the beginnings of a page's.
METRICS = {
    "range:angle:": "swing_angle",
    "range:s:": "stroke",
    "ratio:angle:": "quick_return_ratio",
    "ratio:s:": "quick_return_ratio",
    "least:m:": "transmission_angle",
    "largest:effort:": "peak_input_torque",
    "rms:effort:": "rms_input_torque",
}
#: Changes each dimension that can change a little, one after the other, in the order of their addresses' lengths.
CHANGED = """(s, seed) => {
  const {model} = s, size = model.size;
  let k = seed, gone = 0;
  const share = () => ((k = (k * 16807) % 2147483647) / 2147483647 - 0.5);
  for (const {address, value, geometry} of s.data.dimensions) {
    const step = 0.02 * share() * (Math.abs(value) || (geometry ? 0.3 * size : 0.3));
    for (const part of [1, 0.1, 0.01]) {
      const tried = {...model.values, [address]: value + part * step};
      if (!model.allows(tried)) continue;
      model.change(tried);
      gone++;
      break;
    }
  }
  s.touched();
  return gone;
}"""


def rows_agree(page: Opened, mechanism: lw.Mechanism, tolerance: float = CLOSE) -> None:
    """Points, their rates and reactions of the page against the solver, to a share of the largest of their kind."""
    motion = lw.solve_motion(mechanism, steps=STEPS)
    keys = every(motion.point_names())
    got = page.rows([f"{kind}:{key}.{axis}" for kind in "pva" for key in keys for axis in "xy"])
    for place, kind in enumerate("pva"):
        points = [motion.point(key) for key in keys]
        want = np.array([(p.position, p.velocity, p.acceleration)[place] for p in points])
        found = np.array([np.stack([got[f"{kind}:{key}.x"], got[f"{kind}:{key}.y"]], axis=1) for key in keys])
        np.testing.assert_allclose(found, want, rtol=0, atol=tolerance * (np.abs(want).max() + 1e-9))
    if page.run("s => s.model.forces && s.data.signals.some(x => x.id === 'shake')"):
        forces_agree(page, motion, tolerance)


def forces_agree(page: Opened, motion: lw.Motion, tolerance: float) -> None:
    """All reactions, and the efforts of the drivers."""
    solved = lw.solve_forces(motion)
    names = every(page.run("s => s.data.signals.filter(x => x.id.startsWith('r:')).map(x => x.id)"))
    got = page.rows([f"{name}.{axis}" for name in names for axis in "xy"])
    want = np.array([_reaction(solved, name) for name in names])
    found = np.array([np.stack([got[f"{name}.x"], got[f"{name}.y"]], axis=1) for name in names])
    largest = np.abs(want).max()
    np.testing.assert_allclose(found, want, rtol=0, atol=tolerance * largest)
    for name in motion.mechanism.drivers:
        effort, want = page.rows([f"effort:{name}"])[f"effort:{name}"], solved.driver_effort(name)
        size = max(np.abs(want).max(), largest * motion.mechanism.size)
        np.testing.assert_allclose(effort, want, rtol=0, atol=10 * tolerance * size)


def _reaction(solved: lw.Forces, name: str) -> np.ndarray:
    joint, link = name.removeprefix("r:").split("|")
    return solved.reaction(joint, on=link)


def moved(page: Opened, mechanism: lw.Mechanism) -> lw.Mechanism:
    """The mechanism with the dimensions that the page has."""
    values = page.values()
    changed = {address: value for address, value in values.items() if value != mechanism.dimension(address)}
    return mechanism.with_dimensions(changed)


def dragged(page: Opened, mechanism: lw.Mechanism) -> None:
    """At first and after a drag the page has the solver's numbers; groups without closed form to 1e-9."""
    tolerance = 1e-9 if page.run("s => s.model.solver.iterated") else CLOSE
    rows_agree(page, mechanism, tolerance)
    before = page.values()
    keys = every(page.run("s => s.data.points.filter(p => p.moved.length).map(p => p.key)"))
    page.drag(keys[len(keys) // 2], 5.0, -4.0)
    assert (page.values() != before) or page.wall() is not None
    rows_agree(page, moved(page, mechanism), max(tolerance, 1e-11))


def numbers_agree(page: Opened, solved: lw.Motion | lw.Forces, mean: float = NUMBERS) -> list[str]:
    """The numbers of the page that were compared with those of ``metrics``; ``mean``: how near mean squares come."""
    rows = {(row.metric, row.subject): row.value for row in lw.metrics(solved)}
    rows |= {("shake", "frame"): rows.get(("peak_shaking_force", "frame"), 0.0)}
    reaction = max((value for (metric, _), value in rows.items() if metric == "peak_reaction"), default=0.0)
    compared = []
    for name, got in page.run("s => s.model.numbers()").items():
        begin = next((each for each in METRICS if name.startswith(each)), None)
        if name.startswith("largest:r:"):
            want = rows.get(("peak_reaction", name.removeprefix("largest:r:").split("|")[0]))
        elif name == "largest:shake":
            want = rows["shake", "frame"]
        else:
            want = None if begin is None else rows.get((METRICS[begin], name.removeprefix(begin)))
        if want is not None:
            near = mean if name.startswith("rms:") else NUMBERS
            assert got == pytest.approx(want, rel=near, abs=1e-12 * reaction), name
            compared.append(name)
    return compared


def handed_out_and_read(page: Opened, text: str, folder: Path, seed: int = 1) -> int:
    """Changes all dimensions of a page, reads its file and opens it as a page again; how many were changed."""
    mechanism = lw.loads(text)
    page.run("s => s.take({...s.model.values, ...s.model.original.values})")
    gone = page.run(CHANGED, seed)
    found = page.run("s => s.text()")
    assert found["missing"] == []
    assert comments(found["text"]) == comments(text)
    again = lw.loads(found["text"])
    _has(page, again, mechanism)
    rows_agree(page, again, 1e-9)
    _same_machine(page, again, found["text"], folder)
    return int(gone)


def comments(text: str) -> list[str]:
    return re.findall(r"#.*", text)


def _has(page: Opened, again: lw.Mechanism, mechanism: lw.Mechanism) -> None:
    """The dimensions of the file are those of the page, to the last digit; those of a drawing to its own."""
    values, own = page.values(), again.dimensions()
    drawn = [f"{name}." for name, link in mechanism.links.items() if link.geometry == "drawing"]
    for address, value in values.items():
        near = DRAWN * mechanism.size if address.startswith(tuple(drawn)) else WRITTEN * abs(value)
        assert abs(own[address] - value) <= near, address


def _same_machine(page: Opened, again: lw.Mechanism, text: str, folder: Path) -> None:
    """A page of the file shows what the first one did."""
    names = "s => s.model.main.program.outputs.filter(n => /^[pva]:/.test(n))"
    before = page.rows(every(page.run(names)))
    page.open(page_of(text, folder))
    after = page.rows(list(before))
    for name, row in before.items():
        np.testing.assert_allclose(after[name], row, rtol=0, atol=1e-9 * (np.abs(row).max() + again.size))

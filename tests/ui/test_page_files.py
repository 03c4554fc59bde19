"""What a page hands out as a file is, read again, the machine on the page: page, file, solver, page."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from tests.ui.browser import Opened, browser, needs_chromium
from tests.ui.test_page import GEARED

import linkwright as lw
from linkwright.mechanism.mechanism import Mechanism

pytestmark = needs_chromium
STEPS = 36
#: Digits that numbers of a file keep, and those that lengths keep between coordinates of a drawing.
WRITTEN, DRAWN = 4e-16, 2e-13
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


@pytest.fixture(scope="module")
def opened() -> Iterator[Opened]:
    """One tab for many pages."""
    with browser() as chromium:
        context = chromium.new_context(viewport={"width": 1280, "height": 900}, offline=True)
        yield Opened(context.new_page())


def rows_agree(page: Opened, mechanism: Mechanism) -> None:
    """Points, their rates and reactions of the page are those of the solver."""
    motion = lw.solve_motion(mechanism, steps=STEPS)
    keys = list(motion.point_names())
    got = page.rows([f"{kind}:{key}.{axis}" for kind in "pva" for key in keys for axis in "xy"])
    for place, kind in enumerate("pva"):
        points = [motion.point(key) for key in keys]
        want = np.array([(p.position, p.velocity, p.acceleration)[place] for p in points])
        found = np.array([np.stack([got[f"{kind}:{key}.x"], got[f"{kind}:{key}.y"]], axis=1) for key in keys])
        np.testing.assert_allclose(found, want, rtol=0, atol=1e-9 * (np.abs(want).max() + 1e-9))
    if page.run("s => s.model.forces && s.data.signals.some(x => x.id === 'shake')"):
        forces = lw.solve_forces(motion)
        for name in mechanism.drivers:
            effort = np.array(page.rows([f"effort:{name}"])[f"effort:{name}"])
            want = forces.driver_effort(name)
            np.testing.assert_allclose(effort, want, rtol=0, atol=1e-8 * (np.abs(want).max() + 1e-9))


def comments(text: str) -> list[str]:
    return re.findall(r"#.*", text)


def handed_out_and_read(opened: Opened, folder: Path, text: str, seed: int = 1) -> int:
    """Changes all dimensions of a page, reads its file and opens it as a page again; how many were changed."""
    mechanism = lw.loads(text)
    motion = lw.solve_motion(mechanism, steps=STEPS)
    opened.open(lw.export(motion, folder / "page.html", text=text, force=True))
    gone = opened.run(CHANGED, seed)
    found = opened.run("s => s.text()")
    assert found["missing"] == []
    assert comments(found["text"]) == comments(text)
    again = lw.loads(found["text"])
    page_has(opened, again, mechanism)
    rows_agree(opened, again)
    same_machine(opened, folder, again, found["text"])
    return int(gone)


def page_has(opened: Opened, again: Mechanism, mechanism: Mechanism) -> None:
    """The dimensions of the file are those of the page, to the last digit; those of a drawing to its own."""
    values, own = opened.values(), again.dimensions()
    drawn = [f"{name}." for name, link in mechanism.links.items() if link.geometry == "drawing"]
    for address, value in values.items():
        near = DRAWN * mechanism.size if address.startswith(tuple(drawn)) else WRITTEN * abs(value)
        assert abs(own[address] - value) <= near, address


def same_machine(opened: Opened, folder: Path, again: Mechanism, text: str) -> None:
    """A page of the file shows what the first one did."""
    names = "s => s.model.main.program.outputs.filter(n => /^[pva]:/.test(n))"
    before = opened.rows(opened.run(names))
    opened.open(lw.export(lw.solve_motion(again, steps=STEPS), folder / "again.html", text=text, force=True))
    after = opened.rows(list(before))
    for name, row in before.items():
        np.testing.assert_allclose(after[name], row, rtol=0, atol=1e-9 * (np.abs(row).max() + again.size))


#: One of every way in which files say what can change: drawings, guides, expressions, wheels.
KINDS = ("triad", "wedge", "two_bars_equilibrium", "geneva_wheel", "rack_and_rocker")


@pytest.mark.parametrize("name", KINDS)
def test_the_file_of_a_page_is_its_machine(opened: Opened, tmp_path: Path, name: str) -> None:
    assert handed_out_and_read(opened, tmp_path, lw.read_document(f"gallery:{name}").text) > 5


def test_wheels_with_phases_from_the_drawing(opened: Opened, tmp_path: Path) -> None:
    assert handed_out_and_read(opened, tmp_path, GEARED) > 8

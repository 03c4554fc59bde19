"""Living pages of joint kinds that a package brings: rows as the solver has them, also after changed dimensions."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from pathlib import Path

import pytest
from tests.contract.elements_for_a_while import taken_away
from tests.ui.agreement import dragged
from tests.ui.browser import Opened, needs_chromium
from tests.ui.pages import page_of

import linkwright as lw
from linkwright.joints.base import JOINTS

pytestmark = needs_chromium
HOW_TO = Path(__file__).parents[3] / "docs" / "en" / "how-to" / "own_elements.md"
MODEL = """
format: 1
name: slotted lever of a package
frame: {points: {O: [0 m, 0 m], Q: [0 m, -0.3 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 1 kg, inertia: 0.01 kg·m²}
  lever: {points: [Q, E], length: 0.6 m, mass: 2 kg, inertia: 0.05 kg·m²}
joints: {slot: {kind: KIND, guide: lever, through: Q, block: crank, at: A}}
drawing: {A: [0.1 m, 0 m], E: [0.1897 m, 0.2692 m]}
driver: {turn: crank, about: O, speed: 60 rpm}
gravity: [0, -9.81 m/s²]
loads: {gust: {kind: force, on: lever, at: E, components: [20 N, 0 N]}}
"""


@pytest.mark.parametrize("kind", ["pin_in_slot", "curved_slot"])
def test_a_page_has_the_solvers_numbers_of_a_kind_with_a_residual_alone(
    opened: Opened, tmp_path: Path, kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    code = re.findall(r"^```py\n(.*?)^```", HOW_TO.read_text("utf-8"), re.MULTILINE | re.DOTALL)
    (tmp_path / "slots_of_pages.py").write_text("\n\n".join(code), "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    slots = import_module("slots_of_pages")
    JOINTS.register(kind)(slots.PinInSlot if kind == "pin_in_slot" else slots.CurvedSlot)
    try:
        text = MODEL.replace("KIND", kind)
        opened.open(page_of(text, tmp_path))
        dragged(opened, lw.loads(text))
    finally:
        taken_away(JOINTS, kind)
        sys.modules.pop("slots_of_pages")

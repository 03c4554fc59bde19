"""Every gallery file's living page: the solver's rows and numbers, dragged, handed out as a file and read again."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests import store
from tests.ui.agreement import dragged, handed_out_and_read, numbers_agree
from tests.ui.browser import Opened, needs_chromium
from tests.ui.pages import page

pytestmark = needs_chromium
#: Pins, slides, slots, racks, chains, two drivers, none, a followed group; gears and cams have tests of their own.
CORE = ("jaw_crusher_sixbar", "triad", "geneva_wheel", "chain_drive", "dyad_rrr", "rack_and_rocker", "truss")


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in CORE else pytest.mark.rotating) for name in store.names()]
)
def test_a_page_has_the_solvers_numbers_and_hands_out_its_machine(opened: Opened, tmp_path: Path, name: str) -> None:
    mechanism = store.machine(name)
    opened.open(page(name))
    # Polynomials through few positions give a mean square.
    numbers_agree(opened, store.forces(name) if mechanism.has_loads else store.motion(name), mean=1e-6)
    dragged(opened, mechanism)
    handed_out_and_read(opened, store.text(name), tmp_path)
    assert opened.errors == []


def test_the_fixed_core_is_in_the_gallery() -> None:
    assert set(CORE) <= set(store.names())

"""Call table and program listing of reports: for every machine, in both languages; the listing prints the tables."""

from __future__ import annotations

import csv
import io
import runpy
from contextlib import redirect_stdout
from pathlib import Path

import numpy as np
import pytest
from tests import store

import linkwright as lw
from linkwright.reports.document import Code, Paragraph, Table
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.settings import settings

CORE = ("shaper_quick_return", "swing_conveyor", "truss")


def _blocks(name: str, language: str):
    found = lw.report(f"gallery:{name}", sections=["calls", "program"], language=language)
    assert not found.document.broken
    return found, found.document.blocks


def _run(text: str, folder: Path) -> dict[str, np.ndarray]:
    path = folder / "listing.py"
    path.write_text(text, "utf-8")
    with redirect_stdout(io.StringIO()) as printed:
        runpy.run_path(str(path))
    head, *rows = csv.reader(io.StringIO(printed.getvalue()))
    return dict(zip(head, np.array(rows, dtype=float).T, strict=True))


def check(name: str, language: str, folder: Path) -> None:
    """The listing prints what the tables hold; every call is in the table of its subprogram."""
    found, blocks = _blocks(name, language)
    listing = next(block for block in blocks if isinstance(block, Code) and block.language == "python")
    case = ReportContext(
        store.machine(name), settings(dict(store.machine(name).report), language, store.machine(name)), language
    )
    numbered = case.numbered
    wanted = (case.numbered_forces if case.mechanism.has_loads else numbered.motion).columns()
    rows = [i for i in numbered.rows if numbered.motion.ok[i]]
    for head, column in _run(listing.text, folder).items():
        own = wanted[head][rows]
        if head.endswith(".direction [rad]"):  # a force that is rounding has none
            force = wanted[head.replace(".direction [rad]", ".magnitude [N]")]
            known = force[rows] > 1e-11 * np.nanmax(force)
            column, own = column[known], own[known]
        turns = head.endswith((".angle [rad]", ".direction [rad]"))
        gap = np.angle(np.exp(1j * (column - own))) if turns else column - own
        unit = head[head.index("[") :]
        size = max(float(np.nanmax(np.abs(v), initial=1e-3)) for k, v in wanted.items() if k.endswith(unit))
        assert np.abs(gap).max(initial=0.0) <= 1e-8 * size, head
    called = [
        line for block in blocks if isinstance(block, Code) and not block.language for line in block.text.splitlines()
    ]
    tables = [block for block in blocks if isinstance(block, Table) and len(block.head) > 8]
    if called:
        assert sum(len(table.rows) for table in tables) >= len(called)
    assert found.missing == () or not called


@pytest.mark.parametrize("name", CORE)
def test_the_listing_prints_the_tables(name: str, tmp_path: Path) -> None:
    check(name, "zh" if name == "swing_conveyor" else "en", tmp_path)


@pytest.mark.rotating
@pytest.mark.parametrize("name", [name for name in store.names() if name not in CORE])
def test_listings_of_the_whole_gallery(name: str, tmp_path: Path) -> None:
    check(name, "en" if len(name) % 2 else "zh", tmp_path)


def test_the_call_table_of_the_shaper() -> None:
    """Numbers and lengths as one writes them by hand from the drawing of the machine."""
    _, blocks = _blocks("shaper_quick_return", "zh")
    rows = {block.head[1:]: block.rows for block in blocks if isinstance(block, Table)}
    rprk = rows["m", "n1", "n2", "k1", "k2", "r1", "r2", "vr2", "ar2", "t", "w", "e", "p", "vp", "ap"]
    assert rprk[0][1:7] == ("1", "3", "2", "3", "2", "0")
    rrpk = next(found for head, found in rows.items() if head[:8] == ("m", "n1", "n2", "n3", "k1", "k2", "k3", "r1"))
    assert rrpk[0][1:9] == ("1", "4", "6", "7", "4", "5", "6", "0.135")
    points = next(block for block in blocks if isinstance(block, Table) and block.head[0] == "n")
    beside = points.rows[5]  # the ram's pin moves 0.5285 m above O3: 0.1485 m above O1
    assert beside[0] == "6" and "0.1485" in beside[3]


def test_a_machine_without_such_groups_says_so() -> None:
    found, blocks = _blocks("elliptic_trammel", "en")
    assert any(isinstance(block, Paragraph) and block.kind == "missing" for block in blocks)
    assert any(isinstance(block, Code) for block in blocks)
    assert found.missing

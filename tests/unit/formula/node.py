"""Programs evaluated by Node, with the engine that pages carry."""

from __future__ import annotations

import base64
import json
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from linkwright.formula.program import Program
from linkwright.formula.table import Tables
from linkwright.formula.wasm import wasm_module

NODE = shutil.which("node")
needs_node = pytest.mark.skipif(NODE is None, reason="no Node on this machine")


def work(
    program: Program,
    values: Mapping[str, float],
    positions: Mapping[str, Any],
    n: int,
    *,
    fields: Mapping[str, Any] | None = None,
    tables: Tables | None = None,
) -> dict[str, Any]:
    """One evaluation of one design as plain data."""
    return {
        "program": program.names,
        "module": base64.b64encode(wasm_module(program)).decode(),
        "values": dict(values),
        "positions": {name: _plain(row) for name, row in positions.items()},
        "fields": {name: _plain(row) for name, row in (fields or {}).items()},
        "tables": {name: table.numbers.tolist() for name, table in (tables or {}).items()},
        "n": n,
    }


def _plain(row: Any) -> list[float | None]:
    return [None if np.isnan(x) else float(x) for x in np.asarray(row, dtype=float)]


def in_node(works: Sequence[dict[str, Any]], folder: Path) -> list[dict[str, Any]]:
    """Results of the works, by the names of the outputs."""
    assert NODE is not None
    engine = files("linkwright") / "page" / "built" / "engine.mjs"
    job, result = folder / "job.json", folder / "result.json"
    job.write_text(json.dumps({"works": list(works)}))
    runner = Path(__file__).with_name("engine_in_node.mjs")
    subprocess.run([NODE, str(runner), str(engine), str(job), str(result)], check=True, timeout=120)
    found: list[dict[str, Any]] = json.loads(result.read_text())
    return found

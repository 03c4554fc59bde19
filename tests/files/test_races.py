"""Folders that several sweeps write at once."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests import store
from tests.at_once import at_once

from linkwright.errors import RequestError
from linkwright.exporters.sweep_parts import sweep_parts


def test_of_two_sweeps_into_one_folder_one_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    mechanism = store.machine("crank_rocker")
    for k in range(2):
        work = [
            lambda n=n, k=k: sweep_parts(
                mechanism, {"coupler.length": f"3.4..3.6 m:{n}"}, tmp_path / str(k), outputs=["swing_angle"], steps=12
            )
            for n in (3, 4)
        ]
        found = at_once(*work)
        assert sum(isinstance(each, RequestError) for each in found) == 1

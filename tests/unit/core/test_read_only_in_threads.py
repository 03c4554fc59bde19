"""Mappings are made read-only whatever another thread is importing."""

import sys
from types import ModuleType

import pytest

from linkwright.core.data import FrozenDict, frozen


def test_mappings_are_made_read_only_while_another_thread_imports_numpy(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "numpy", ModuleType("numpy"))
    assert isinstance(frozen({"length": [1.0]}), FrozenDict)

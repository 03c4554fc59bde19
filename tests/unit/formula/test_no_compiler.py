"""What is compiled says so where no compiler can be loaded."""

import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw


def test_compiled_derivatives_are_refused_where_nothing_can_be_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("linkwright.formula.llvm_backend.compile_program", lambda *given: None)
    with refused("study.no_llvmlite"):
        crank_rocker = store.machine("crank_rocker")
        lw.sensitivity(crank_rocker, of="B.velocity", by=["coupler.length"], backend="llvm")

"""The benchmarks run at small sizes, and all ways in them give the same numbers. No time is judged."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest
from tests.every import every

pytestmark = pytest.mark.long
ROOT = Path(__file__).parents[2]
#: Relative difference of ways that differ by rounding only.
ROUNDING = 1e-12


@pytest.fixture(autouse=True)
def _from_the_root(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT))


def _work(name: str) -> Any:
    from benchmarks import cases

    return getattr(cases, name)(24)


@pytest.mark.parametrize("name", ["fourbar", "sixbar"])
def test_all_outputs_agree_with_numpy_by_hand(name: str) -> None:
    from benchmarks.kernels_alone import NUMPY_ROUTE, disagreement

    gaps = disagreement(name, _work(name))
    assert NUMPY_ROUTE in gaps
    assert max(gaps.values()) < ROUNDING


@pytest.mark.parametrize("name", ["fourbar", "sixbar"])
def test_summaries_of_sweeps_agree_with_numpy_by_hand(name: str) -> None:
    from benchmarks.sweeps import SweepWork

    gaps = SweepWork(name, _work(name), 70).disagreement()
    assert "numpy" in gaps
    assert max(gaps.values()) < 1e-10  # designs near singular positions are among them


def test_public_results_agree_with_numpy_by_hand() -> None:
    from benchmarks.public import NUMPY_ROUTE, disagreement

    gaps = disagreement(_work("sixbar"))
    assert NUMPY_ROUTE in gaps
    assert max(gaps.values()) < ROUNDING


@pytest.mark.parametrize("name", ["fourbar", "sixbar"])
def test_gradients_agree_with_differences(name: str) -> None:
    from benchmarks.gradients import GradientWork

    assert GradientWork(name, _work(name), 8).disagreement() < 1e-6


def test_objectives_agree_with_the_complex_step_and_with_sweeps() -> None:
    from benchmarks.objectives import PathWork, TorqueWork

    assert PathWork().disagreement() < ROUNDING
    assert TorqueWork(8, 24).disagreement() < 1e-9


def test_runs_of_designs_agree_with_scipy() -> None:
    from benchmarks.dynamics import SixbarRuns, growth

    work = SixbarRuns(12)
    assert work.disagreement(4) < 1e-7
    assert (work.together(work.designs) == work.alone(work.designs)).all()
    assert [each.name for each in every(work.right_hand_sides(), least=1)]
    assert growth((1, 2), 1, 1e-4)[1] < 3.0


@pytest.mark.parametrize("name", ["fourbar", "sixbar"])
def test_peers_agree_where_installed(name: str) -> None:
    from benchmarks import by_numpy, peers

    work = _work(name)
    rows = getattr(by_numpy, name)(work.cosine, work.sine, work.nominal())
    truth = dict(zip(work.outputs, rows, strict=True))
    present, missing = peers.found(name, work)
    assert all("skipped" in line for line in missing)
    exact = [peer for peer in present if peer.name != "kinepy"]  # its rates are differences
    gaps = {peer.name: peers.error(peer, work, truth) for peer in exact}
    assert "fsolve per angle" in gaps
    silent = [peer for peer, gap in gaps.items() if math.isnan(gap)]
    assert set(silent) <= {"Exudyn"}  # it integrates in time, and gives no outputs at the angles
    assert max(gap for peer, gap in gaps.items() if peer not in silent) < 1e-9, gaps


@pytest.mark.parametrize("name", ["fourbar", "sixbar"])
def test_results_are_those_of_50_digits(name: str) -> None:
    pytest.importorskip("mpmath")
    from benchmarks import accuracy, cases

    for errors in every(accuracy.cycle(name, getattr(cases, name)(8)).values()):
        assert max(errors.values()) < ROUNDING


def test_loss_near_a_dead_point_is_that_of_the_condition_number() -> None:
    pytest.importorskip("mpmath")
    from benchmarks import accuracy

    for near in every(accuracy.near_singular(_work("fourbar"), [1e-2, 1e-4, 1e-6]), least=3):
        assert max(near.multiples) < 16.0


def test_command_prints_tables_and_goals(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    from benchmarks import __main__ as command
    from benchmarks import report, sections

    monkeypatch.setattr(sections, "QUICK", sections.Size(16, 2, 1e-4, 64, 64, 8, 4, 4, 1, (2, 4)))
    monkeypatch.setattr(command, "QUICK", sections.QUICK)
    before = report.PAGE.read_text(encoding="utf-8")
    assert command.main(["--quick", "--only", "public", "gradient", "growth", "cycles"]) == 0
    printed = capsys.readouterr().out
    tables = [line for line in printed.splitlines() if line.startswith("|")]
    assert len(tables) > 20 and any(re.search(r"\| 4 \w+ +\|", line) for line in tables)
    assert report.PAGE.read_text(encoding="utf-8") == before

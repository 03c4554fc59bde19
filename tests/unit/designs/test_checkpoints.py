"""Studies and tolerance runs that are stopped at random moments go on from a file, with results equal to the bit."""

from __future__ import annotations

import random
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

import linkwright as lw
from linkwright.analysis.of_designs import NumbersOfDesigns
from linkwright.cli import main
from linkwright.core.arrays import Floats
from linkwright.designs import checkpoints, metrics_of_designs
from linkwright.designs.checkpoints import _made, _plain
from linkwright.designs.criteria import Criterion
from linkwright.designs.study import PIECE, _Work
from linkwright.designs.sweep import sweep_curves
from linkwright.designs.sweep_run import SweepRun
from linkwright.formula.reductions import Results
from linkwright.words import _

pytestmark = pytest.mark.rotating

CRANK = "gallery:crank_rocker"
VARY = ["--vary", "coupler.length=3.2..3.8m:7"]  # so few that they are found one by one
STUDY = ["study", CRANK, *VARY, "--metrics", "travel", "transmission_angle", "--json"]
SPREAD = ["tolerance", "gallery:crank_rocker_tolerance", "--json"]


@pytest.mark.parametrize("seed", range(3))
def test_an_interrupted_study_goes_on_from_its_file_without_what_it_had(
    seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    machine = lw.load(CRANK)
    vary, metrics = {"coupler.length": np.linspace(3.2, 3.8, 7)}, ["travel", "transmission_angle"]
    whole = lw.study(machine, vary, metrics=metrics)
    stop, measured = random.Random(seed).randrange(1, 7), list[float]()
    original = _Work._measured

    def counted(self: _Work, changes: dict[str, float], asked: list[Criterion]) -> object:
        measured.append(changes["coupler.length"])
        return original(self, changes, asked)

    def interrupt(done: int, _: int) -> None:
        if len(measured) == stop:
            raise KeyboardInterrupt

    monkeypatch.setattr(_Work, "_measured", counted)
    with pytest.raises(lw.Interrupted) as stopped, lw.checkpointing(None, machine.name, "asked"):
        lw.study(machine, vary, metrics=metrics, progress=interrupt)
    assert stopped.value.state.exists() and len(measured) == stop
    with lw.checkpointing(stopped.value.state, machine.name, "asked"):
        resumed = lw.study(machine, vary, metrics=metrics)
    assert measured == vary["coupler.length"].tolist()  # each of them once, in both runs together
    assert resumed.data() == whole.data() and resumed.text("zh") == whole.text("zh")


def test_numbers_of_a_sweep_are_kept_piece_by_piece_and_one_by_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Those of whole designs together, of the one that reaches a part of its cycle by itself."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(checkpoints, "MAX_BYTES_PER_SECOND", float("inf"))  # kept however fast it was found
    crank, lengths, asked = lw.load(CRANK), np.array([3.0, 3.4, 2.3]), ["B.y max", "rocker.angle max"]
    whole = lw.sweep(crank, {"coupler.length": lengths}, outputs=asked, partial=True)

    def interrupt(done: int, total: int) -> None:
        if done == total:
            raise KeyboardInterrupt

    with pytest.raises(lw.Interrupted) as stopped, lw.checkpointing(None, crank.name, "asked"):
        lw.sweep(crank, {"coupler.length": lengths}, outputs=asked, partial=True, progress=interrupt)

    def never(*given: object, **named: object) -> None:
        raise AssertionError("found again")

    monkeypatch.setattr(NumbersOfDesigns, "evaluate", never)
    monkeypatch.setattr(metrics_of_designs, "_alone", never)
    with lw.checkpointing(stopped.value.state, crank.name, "asked"):
        resumed = lw.sweep(crank, {"coupler.length": lengths}, outputs=asked, partial=True)
    for each in asked:
        assert np.isfinite(whole[each]).all() and np.array_equal(resumed[each], whole[each])


def test_an_interrupted_tolerance_run_says_from_which_file_it_goes_on(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(checkpoints, "MAX_BYTES_PER_SECOND", float("inf"))  # kept however fast it was found
    assert main(SPREAD) == 0
    whole = capsys.readouterr().out
    original, calls = SweepRun._computed, list[bytes]()

    def interrupt(self: SweepRun, part: Mapping[str, Floats], first: int) -> Results:
        calls.append(b"".join(column.tobytes() for column in part.values()))
        if len(calls) == 2:
            raise KeyboardInterrupt
        return original(self, part, first)

    monkeypatch.setattr(SweepRun, "_computed", interrupt)
    assert main(SPREAD) == 130
    (left,) = tmp_path.iterdir()
    assert f"--state {left.name}" in capsys.readouterr().err
    assert main([*SPREAD, "--state", left.name]) == 0
    assert capsys.readouterr().out == whole
    assert len(calls) == len(set(calls)) + 1  # the sweep that was finished is not done again


def test_what_a_cluster_finds_is_kept_piece_by_piece(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(checkpoints, "MAX_BYTES_PER_SECOND", float("inf"))  # kept however fast it was found
    crank, draw, given = lw.load(CRANK), np.random.default_rng(2), list[str]()
    columns = {"coupler.length": draw.uniform(3.2, 4, 4100), "rocker.length": draw.uniform(2, 2.8, 4100)}
    ranges = {"coupler.length": "3.2..4 m:100", "rocker.length": "2..2.8 m:42"}
    asked = {"vary": ranges, "metrics": ["transmission_angle", "rocker.angle range"], "steps": 24}
    curves = {"outputs": ["rocker.angle"], "steps": 24}
    whole, lines = lw.study(crank, **asked), [*sweep_curves(crank, columns, **curves)]

    numbered = list[int]()

    def interrupt(done: int, total: int) -> None:
        numbered.extend([done] * (2 * done > total))  # the sweep is the first half
        if len(numbered) == 3:
            raise KeyboardInterrupt

    options = {"n_workers": 1, "threads_per_worker": 1, "dashboard_address": ":0", "processes": False}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster, set_as_default=False) as client:
        original = client.submit

        def counted(timed: object, work: object, *task: object, pure: bool) -> object:
            given.append(str(work))
            return original(timed, work, *task, pure=pure)

        monkeypatch.setattr(client, "submit", counted)
        state = tmp_path / "cluster.state"
        with pytest.raises(lw.Interrupted), lw.checkpointing(state, "crank", 1), lw.on_cluster(client):
            lw.study(crank, **asked, progress=interrupt)
        given.clear()
        with lw.checkpointing(state, "crank", 1), lw.on_cluster(client):
            resumed, spread = lw.study(crank, **asked), [*sweep_curves(crank, columns, **curves)]
        pieces = -(-int(whole.ok.sum()) // PIECE)
        assert len(given) == pieces - 3 + 2  # three of the study and both of its sweep were there; two of curves
        given.clear()
        with lw.checkpointing(state, "crank", 1), lw.on_cluster(client):
            again = lw.study(crank, **asked)
        assert given == []
    for name, column in whole.metrics.items():
        assert column.tobytes() == resumed.metrics[name].tobytes() == again.metrics[name].tobytes()
    assert whole.text("zh") == resumed.text("zh") == again.text("zh")
    for (_unused, one), (_unused2, other) in zip(lines, spread, strict=True):
        assert one["rocker.angle"].tobytes() == other["rocker.angle"].tobytes()


def test_values_that_are_kept_come_back_to_the_bit() -> None:
    sentence = _(
        "{count} fail {place}, such as: {example}",
        code="study.fail",
        count=3,
        place="A",
        example=_("leave it out", code="study.leave_out"),
    )
    values = np.array([0.1, -0.0, np.inf, 5e-324])
    given = {"a": (values, [1, 0.1, float("inf"), None, True, sentence]), 3: {"b": values > 0}}
    back = _made(_plain(given))
    assert back["a"][0].tobytes() == values.tobytes() and back["a"][1] == given["a"][1]  # type: ignore[index]
    assert (back[3]["b"] == (values > 0)).all() and back["a"][1][5].translate("zh") == sentence.translate("zh")
    with pytest.raises(TypeError):
        _plain(object())

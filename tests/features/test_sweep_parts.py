"""Sweeps in parts: the designs of a sweep, restarts, folders of other sweeps, and a cluster whose workers die."""

from pathlib import Path

import numpy as np
import pytest

import linkwright as lw
from linkwright.cli import main
from linkwright.study.designs import sweep_curves

VARY = {"coupler.length": "3.2..4 m:40", "rocker.length": "2..2.8 m:30"}
NUMBERS = ["rocker.angle range", "transmission_angle"]


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.glob("part-*.parquet"))}


def test_parts_are_the_sweep_and_a_restart_makes_what_is_missing(tmp_path: Path) -> None:
    crank = lw.load("gallery:crank_rocker")
    found = lw.sweep_parts(crank, VARY, tmp_path, outputs=NUMBERS, part=256, steps=60)
    assert (found.designs, found.parts, found.skipped) == (1200, 5, 0)
    mesh = np.meshgrid(np.linspace(3.2, 4, 40), np.linspace(2, 2.8, 30), indexing="ij")
    whole = lw.sweep(crank, dict(zip(VARY, map(np.ravel, mesh), strict=True)), outputs=NUMBERS, steps=60)
    columns = found.columns()
    for name, column in whole.columns().items():
        assert columns[name] == pytest.approx(column, rel=1e-12, nan_ok=True)
    best = found.best("rocker.angle range", 3, largest=True)
    assert best["rocker.angle range"][0] == np.nanmax(columns["rocker.angle range"])
    assert found.best("rocker.angle range", 1)["rocker.angle range"] == [
        np.nanmin(columns["rocker.angle range"])
    ]
    assert found.best("transmission_angle", 1)["transmission_angle"] == [
        np.nanmax(columns["transmission_angle"])
    ]
    before = contents(tmp_path)
    found.path(3).unlink()
    found.path(1).write_bytes(found.path(1).read_bytes()[:200])  # cut short by something else
    again = lw.sweep_parts(crank, VARY, tmp_path, outputs=NUMBERS, part=256, steps=60)
    assert again.skipped == 3 and contents(tmp_path) == before
    with pytest.raises(lw.LinkwrightError, match="another sweep"):
        lw.sweep_parts(crank, VARY, tmp_path, outputs=NUMBERS, part=256, steps=61)


def test_sobol_designs_do_not_depend_on_the_parts(tmp_path: Path) -> None:
    crank = lw.load("gallery:crank_rocker")
    ranges = {"coupler.length": "3.2..4 m", "rocker.length": "2..2.8 m"}
    manner = {"outputs": NUMBERS[:1], "sampling": "sobol", "samples": 500, "steps": 30, "seed": 4}
    small = lw.sweep_parts(crank, ranges, tmp_path / "small", part=64, **manner).columns()
    large = lw.sweep_parts(crank, ranges, tmp_path / "large", **manner).columns()
    assert small["coupler.length"].tobytes() == large["coupler.length"].tobytes()
    assert len(small["coupler.length"]) == 500


def test_the_command(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("linkwright.study.cluster.PATIENCE", 0.3)
    words = ["sweep", "gallery:crank_rocker", "--vary", "coupler.length=3.2..4m:50", "--numbers", *NUMBERS]
    assert (
        main([*words, "--folder", str(tmp_path / "a"), "--part", "16", "--best", "transmission_angle"]) == 0
    )
    out = capsys.readouterr().out
    assert "50 designs in 4 parts" in out and "Best transmission_angle" in out
    assert main([*words, "--folder", str(tmp_path / "a"), "--part", "16", "--json"]) == 0
    assert '"skipped": 4' in capsys.readouterr().out
    assert main([*words, "--folder", str(tmp_path / "a"), "--part", "32"]) == 2
    nobody = ["--cluster", "tcp://127.0.0.1:9"]
    assert main([*words, "--folder", str(tmp_path / "b"), *nobody]) == 1
    assert main(["study", "gallery:crank_rocker", "--vary", "coupler.length=3..4m:2", *nobody]) == 1
    assert main(["tolerance", "gallery:crank_rocker_tolerance", *nobody]) == 1
    assert capsys.readouterr().err.count('"tcp://127.0.0.1:9"') == 3


def test_a_cluster_gives_the_same_bits(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    from tests.cluster import TEETH

    crank, pair = lw.load("gallery:crank_rocker"), lw.loads(TEETH)  # whose teeth go one by one
    draw = np.random.default_rng(1)
    columns = {"coupler.length": draw.uniform(3.2, 4, 4100), "rocker.length": draw.uniform(2, 2.8, 4100)}
    search = {"evaluations": 12, "population": 6}
    here = lw.sweep(crank, columns, outputs=NUMBERS, steps=40)
    wide = {"coupler.length": "2..4 m:40", "rocker.length": "1.5..2.8 m:30"}
    study = {"vary": wide, "metrics": ["travel", "transmission_angle", "peak_acceleration"], "steps": 40}
    whole = lw.study(crank, **study)
    curves = [*sweep_curves(crank, columns, outputs=["rocker.angle"], steps=40)]
    alone = lw.optimize(pair, minimize="peak_input_torque", **search)
    parts = lw.sweep_parts(crank, VARY, tmp_path / "here", outputs=NUMBERS, part=256, steps=60)
    options = {"n_workers": 1, "threads_per_worker": 2, "dashboard_address": ":0", "processes": False}
    with (
        distributed.LocalCluster(**options) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        with lw.on_cluster(client):
            there = lw.sweep(crank, columns, outputs=NUMBERS, steps=40)
            spread = [*sweep_curves(crank, columns, outputs=["rocker.angle"], steps=40)]
            shared = lw.optimize(pair, minimize="peak_input_torque", **search)
            pieces = lw.study(crank, **study)
        again = lw.sweep_parts(
            crank, VARY, tmp_path / "there", outputs=NUMBERS, part=256, steps=60, client=client
        )
    assert contents(parts.folder) == contents(again.folder)
    for name, column in here.columns().items():
        assert column.tobytes() == there.columns()[name].tobytes()
    assert 512 < whole.ok.sum() < 1200 and whole.dimensions == pieces.dimensions
    for name, column in whole.metrics.items():
        assert column.tobytes() == pieces.metrics[name].tobytes()
    assert (
        [place for place, _ in curves]
        == [place for place, _ in spread]
        == [slice(0, 4096), slice(4096, 4100)]
    )
    for (_, one), (_, other) in zip(curves, spread, strict=True):
        assert one["rocker.angle"].tobytes() == other["rocker.angle"].tobytes()
    assert not alone.exact
    assert dict(alone.best.values) == dict(shared.best.values)

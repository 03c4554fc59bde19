"""Sweeps in parts: the designs of a sweep, restarts, folders of other sweeps, and a cluster whose workers die."""

from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.cli.commands import data, is_refused, shown
from tests.cluster import TEETH
from tests.every import every
from tests.refusals import refused

import linkwright as lw

VARY = {"coupler.length": "3.2..4 m:40", "rocker.length": "2..2.8 m:30"}
NUMBERS = ["rocker.angle range", "transmission_angle"]


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.glob("part-*.parquet"))}


def test_parts_are_the_sweep_and_a_restart_makes_what_is_missing(tmp_path: Path) -> None:
    crank = store.machine("crank_rocker")
    found = lw.sweep_parts(crank, VARY, tmp_path, outputs=NUMBERS, part=256, steps=60)
    assert (found.designs, found.parts, found.skipped) == (1200, 5, 0)
    mesh = np.meshgrid(np.linspace(3.2, 4, 40), np.linspace(2, 2.8, 30), indexing="ij")
    whole = lw.sweep(crank, dict(zip(VARY, map(np.ravel, mesh), strict=True)), outputs=NUMBERS, steps=60)
    columns = found.columns()
    for name, column in every(whole.columns().items()):
        assert columns[name] == pytest.approx(column, rel=1e-12, nan_ok=True)
    best = found.best("rocker.angle range", 3, largest=True)
    assert best["rocker.angle range"][0] == np.nanmax(columns["rocker.angle range"])
    assert found.best("rocker.angle range", 1)["rocker.angle range"] == [np.nanmin(columns["rocker.angle range"])]
    assert found.best("transmission_angle", 1)["transmission_angle"] == [np.nanmax(columns["transmission_angle"])]
    before = contents(tmp_path)
    found.path(3).unlink()
    found.path(1).write_bytes(found.path(1).read_bytes()[:200])  # cut short by something else
    again = lw.sweep_parts(crank, VARY, tmp_path, outputs=NUMBERS, part=256, steps=60)
    assert again.skipped == 3 and contents(tmp_path) == before
    with refused("study.other_sweep", folder=tmp_path):
        lw.sweep_parts(crank, VARY, tmp_path, outputs=NUMBERS, part=256, steps=61)


def test_sobol_designs_do_not_depend_on_the_parts(tmp_path: Path) -> None:
    crank = store.machine("crank_rocker")
    ranges = {"coupler.length": "3.2..4 m", "rocker.length": "2..2.8 m"}
    manner = {"outputs": NUMBERS[:1], "sampling": "sobol", "samples": 500, "steps": 30, "seed": 4}
    small = lw.sweep_parts(crank, ranges, tmp_path / "small", part=64, **manner).columns()
    large = lw.sweep_parts(crank, ranges, tmp_path / "large", **manner).columns()
    assert small["coupler.length"].tobytes() == large["coupler.length"].tobytes()
    assert len(small["coupler.length"]) == 500


def test_the_command(tmp_path: Path) -> None:
    words = ["sweep", "gallery:crank_rocker", "--vary", "coupler.length=3.2..4m:50", "--numbers", *NUMBERS]
    parts = ["--folder", str(tmp_path / "a"), "--part", "16"]
    out = shown(*words, *parts, "--best", "transmission_angle")
    assert {"50", "4"} < set(out.split()) and "transmission_angle" in out
    assert data(*words, *parts)["skipped"] == 4
    is_refused([*words, "--folder", str(tmp_path / "a"), "--part", "32"], "study.other_sweep")


@pytest.mark.rotating
def test_a_cluster_gives_the_same_numbers(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    crank, pair = store.machine("crank_rocker"), lw.loads(TEETH)  # whose teeth go one by one
    draw = np.random.default_rng(1)
    columns = {"coupler.length": draw.uniform(3.2, 4, 4100), "rocker.length": draw.uniform(2, 2.8, 4100)}
    search = {"evaluations": 12, "population": 6}
    here = lw.sweep(crank, columns, outputs=NUMBERS, steps=40)
    wide = {"coupler.length": "2..4 m:40", "rocker.length": "1.5..2.8 m:30"}
    study = {"vary": wide, "metrics": ["travel", "transmission_angle", "peak_acceleration"], "steps": 40}
    whole = lw.study(crank, **study)
    alone = lw.optimize(pair, minimize="peak_input_torque", **search)
    parts = lw.sweep_parts(crank, VARY, tmp_path / "here", outputs=NUMBERS, part=256, steps=60)
    options = {"n_workers": 1, "threads_per_worker": 2, "dashboard_address": ":0", "processes": False}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster, set_as_default=False) as client:
        with lw.on_cluster(client):
            there = lw.sweep(crank, columns, outputs=NUMBERS, steps=40)
            shared = lw.optimize(pair, minimize="peak_input_torque", **search)
            pieces = lw.study(crank, **study)
        again = lw.sweep_parts(crank, VARY, tmp_path / "there", outputs=NUMBERS, part=256, steps=60, client=client)
    assert contents(parts.folder) == contents(again.folder)
    for name, column in every(here.columns().items()):
        np.testing.assert_allclose(column, there.columns()[name], rtol=1e-12)
    assert 512 < whole.ok.sum() < 1200 and whole.dimensions == pieces.dimensions
    for name, column in every(whole.metrics.items(), least=3):
        np.testing.assert_allclose(column, pieces.metrics[name], rtol=1e-12)
    assert not alone.exact
    assert dict(alone.best.values) == dict(shared.best.values)

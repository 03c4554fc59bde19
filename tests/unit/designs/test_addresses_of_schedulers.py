"""Addresses at which no scheduler of a cluster answers."""

from pathlib import Path

import pytest
from tests.refusals import refused

import linkwright as lw
from linkwright.cli import main


@pytest.mark.parametrize(
    "address", ["nope", "", "tcp://127.0.0.1:x", "tls://127.0.0.1:9", "http://x:1", "inproc://x"]
)
def test_addresses_of_no_scheduler(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], address: str
) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("linkwright.designs.cluster.PATIENCE", 0.3)
    with refused("study.no_cluster", address=address), lw.on_cluster(address):
        pass
    sweep = ["sweep", "gallery:crank_rocker", "--vary", "coupler.length=3.2..3.8m:2"]
    asked = ["--numbers", "rocker.angle range", "--steps", "12", "--folder", str(tmp_path / "new")]
    assert main([*sweep, *asked, "--cluster", address]) == 1
    assert f'"{address}"' in capsys.readouterr().err

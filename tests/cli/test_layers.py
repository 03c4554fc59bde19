"""``linkwright layers``: options, and exit codes where there are no layers."""

import json
from pathlib import Path

from tests.cli.commands import run


def test_fixed_layers_and_flush_ends(tmp_path: Path) -> None:
    table = tmp_path / "layers.csv"
    found = run(
        "layers", "gallery:crank_rocker", "--ends", "flush", "--fix", "rocker=3", "frame=0", "--output", str(table)
    )
    assert found.code == 0
    rows = [line.split(",")[:2] for line in table.read_text().splitlines()]
    assert sorted(rows[1:]) == [["coupler", "2"], ["crank", "1"], ["frame", "0"], ["rocker", "3"]]


def test_no_layers_is_an_exit_code_of_its_own() -> None:
    """Crank and coupler are on one pin, so that they cannot be in one layer."""
    found = run("layers", "gallery:crank_rocker", "--fix", "crank=1", "coupler=1", "--json")
    assert found.code == 1
    data = json.loads(found.out)
    assert data["count"] is None and [each["first"] for each in data["conflicts"]] == ["crank", "coupler"]


def test_layers_that_are_none() -> None:
    for text, code in (
        ("rocker=-1", "layers.no_number"),
        ("rocker=top", "layers.no_number"),
        ("rokker=1", "layers.no_plate"),
    ):
        found = run("layers", "gallery:crank_rocker", "--fix", text)
        assert found.told is not None and (found.code, found.told.code) == (2, code)

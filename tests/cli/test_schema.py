"""The schema command: the same schema as in Python, with an identity, and it knows the whole gallery's keys."""

import json
from pathlib import Path

import pytest

import linkwright as lw
from linkwright.cli import main


def test_the_schema_is_printed_and_written(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["schema"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed == json.loads(json.dumps(lw.json_schema()))
    assert printed["$id"] == "urn:linkwright:model:1"
    assert printed["$schema"].endswith("2020-12/schema")
    path = tmp_path / "linkwright.schema.json"
    assert main(["schema", "--output", str(path)]) == 0
    assert json.loads(path.read_text(encoding="utf-8")) == printed
    assert main(["schema", "--output", str(path)]) == 2
    assert "exists" in capsys.readouterr().err
    assert main(["schema", "--output", str(path), "--force"]) == 0


def test_parts_of_strokes_are_in_the_schema() -> None:
    phases = [
        form
        for load in lw.json_schema()["properties"]["loads"]["additionalProperties"]["oneOf"]
        if "phase" in load["properties"]
        for form in load["properties"]["phase"]["oneOf"]
    ]
    swings = [form["properties"] for form in phases if "of" in form["properties"]]
    assert swings and all({"first", "last", "free"} <= set(form) for form in swings)

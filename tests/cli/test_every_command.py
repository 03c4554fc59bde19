"""One of each command, as text and as data."""

import csv
import json
from pathlib import Path
from typing import Any

import pytest
from tests.cli.commands import run

from linkwright.cli import commands

#: What each command is asked; OUT stands for a file that it writes.
ASKED: dict[str, list[str]] = {
    "animate": ["gallery:crank_rocker", "--frames", "4", "--output", "OUT.svg"],
    "balance": ["gallery:jaw_crusher_fourbar", "--radius", "200 mm"],
    "beam": ["gallery:cantilever"],
    "cam": ["gallery:cam_lecture"],
    "check": ["gallery:kite"],
    "compensate": ["gallery:printing_press", "lead", "--span", "500 deg", "--steps", "240"],
    "compare": ["gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar", "--of", "jaw"],
    "draw": ["gallery:kite", "--output", "OUT.svg"],
    "equilibrium": ["gallery:lid_on_gas_strut"],
    "export": ["gallery:kite", "--output", "OUT.csv"],
    "gallery": ["list", "kite"],
    "grade": ["exercise/key.json", "answers.csv"],
    "import": [
        '<linkage2><connector id="0" x="0" y="0" anchor="true" input="true" rpm="15"/>'
        '<connector id="1" x="0" y="96"/><connector id="2" x="384" y="96"/>'
        '<connector id="3" x="384" y="-96" anchor="true"/><Link id="0"><connector id="0"/><connector id="1"/></Link>'
        '<Link id="1"><connector id="1"/><connector id="2"/></Link>'
        '<Link id="2"><connector id="2"/><connector id="3"/></Link></linkage2>'
    ],
    "cut": ["gallery:kite"],
    "interference": ["gallery:kite"],
    "layers": ["gallery:kite"],
    "machine": ["gallery:jaw_crusher_fourbar"],
    "metrics": ["gallery:kite"],
    "optimize": [
        "gallery:crank_rocker",
        "--vary",
        "coupler.length=3.4..3.6m",
        "--minimize",
        "rocker.angle range",
        "--evaluations",
        "20",
    ],
    "plot": ["gallery:kite", "--output", "OUT.svg"],
    "program": ["gallery:production_mix"],
    "report": ["gallery:kite", "--sections", "task", "structure", "--to", "html", "--output", "OUT.html"],
    "run": ["gallery:shaper_quick_return", "--for", "0.1s", "--steps", "4"],
    "sheet": ["gallery:slider_crank_offset", "--size", "A1", "--output", "OUT.svg"],
    "size": ["gallery:kite", "--steps", "24"],
    "solve": ["gallery:kite", "--steps", "4"],
    "statics": ["gallery:two_cables"],
    "statistics": ["gallery:spring_rate"],
    "structure": ["gallery:kite"],
    "study": ["gallery:crank_rocker", "--vary", "coupler.length=3.4..3.6m:2", "--metrics", "swing_angle"],
    "sweep": [
        "gallery:crank_rocker",
        "--vary",
        "coupler.length=3.4..3.6m:2",
        "--numbers",
        "rocker.angle range",
        "--folder",
        "OUT",
    ],
    "synthesize": ["slider_crank", "stroke=397.5 mm", "rod_ratio=3.55", "offset_ratio=0.305"],
    "tolerance": ["gallery:crank_rocker_tolerance"],
    "trajectory": ["gallery:thrown_ball"],
    "validate": ["--case", "conveyor"],
    "variants": ["gallery:crank_rocker", "--count", "2", "--seed", "1", "--to", "key", "--output", "OUT"],
    "vibration": ["gallery:free_decay"],
}
#: What answers with a script, a schema or a server; these have tests of their own.
OTHERS = {"completion", "mcp", "schema", "studio"}


def test_every_command_is_here() -> None:
    assert set(ASKED) | OTHERS == set(commands.names())


@pytest.fixture
def exercise(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder with an exercise of one variant and a sheet of right answers."""
    monkeypatch.chdir(tmp_path)
    asked = ["gallery:crank_rocker", "--count", "1", "--seed", "1", "--to", "key", "--output", "exercise"]
    assert run("variants", *asked).code == 0
    key = json.loads(Path("exercise/key.json").read_text("utf-8"))
    names = [question["name"] for question in key["questions"]]
    with open("answers.csv", "w", encoding="utf-8", newline="") as stream:
        rows = csv.writer(stream)
        rows.writerow(["student", "variant", *names])
        rows.writerow(["A. Student", "1", *key["variants"][0]["answers"]])


@pytest.mark.parametrize("command", ASKED)
def test_a_command_as_text_and_as_data(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    """Files are written in both forms and named; nothing is said besides the result."""
    monkeypatch.chdir(tmp_path)
    if command == "grade":
        request.getfixturevalue("exercise")
    text, data = (
        run(command, *(word.replace("OUT", out) for word in ASKED[command]), *form)
        for out, form in (("text", []), ("data", ["--json"]))
    )
    assert (text.code, text.err) == (data.code, data.err) == (0, "")
    assert text.out.strip() and not text.out.startswith(("{", "["))
    found: Any = json.loads(data.out)
    assert found
    if isinstance(found, dict):
        assert found.get("ok", True)
        assert "{" in data.out.splitlines()[0]
    for word in ASKED[command]:
        if "OUT" in word:
            assert word.replace("OUT", "text") in text.out and Path(word.replace("OUT", "text")).exists()
            assert word.replace("OUT", "data") in data.out and Path(word.replace("OUT", "data")).exists()

"""Nothing outside of the folder is read or written, wrong calls are findings, answers are bounded."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import pytest
from mcp import Client
from tests.assistants.calls import CRANK_ROCKER, asked, call
from tests.every import every

import linkwright as lw

SECRET = "format: 1\nname: secret\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a model, next to a file and a picture that it must not reach."""
    inner = tmp_path / "inner"
    (inner / "sub").mkdir(parents=True)
    (inner / ".hidden").mkdir()
    for place in (tmp_path / "secret.yaml", inner / ".hidden" / "a.yaml"):
        place.write_text(SECRET, "utf-8")
    (tmp_path / "secret.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>', "utf-8")
    (tmp_path / "curve.csv").write_text("0, 0\n1, 1\n2, 0\n", "utf-8")
    (inner / "own.yaml").write_text(lw.read_document(CRANK_ROCKER).text, "utf-8")
    os.symlink(tmp_path / "secret.yaml", inner / "link.yaml")
    os.symlink(tmp_path, inner / "up")
    return inner


OUTSIDE = (
    "../secret.yaml",
    "/etc/passwd",
    "link.yaml",
    "up/secret.yaml",
    ".hidden/a.yaml",
    "sub/../../secret.yaml",
    "~/.bashrc",
)


@pytest.mark.parametrize("name", OUTSIDE)
def test_a_file_elsewhere_is_refused(folder: Path, name: str) -> None:
    found = call("check_model", folder, model=name)
    assert found.failed and found.codes[0] in ("file.outside", "no-file")
    assert "secret" not in json.dumps(found.data).replace(name, "")


def test_files_of_the_folder_are_read(folder: Path) -> None:
    assert call("check_model", folder, model="own.yaml").data["ok"]
    assert call("check_model", folder, model="sub/../own.yaml").data["ok"]
    assert call("search_gallery", folder, words="kite").data["files"] == ["own.yaml"]
    finding = call("check_model", folder, model="onw.yaml").data["findings"][0]
    assert finding["code"] == "no-file" and "own.yaml" in finding["remedy"]


@pytest.mark.parametrize("name", ["../a.yaml", "up/a.yaml", ".a.yaml", "/tmp/a.yaml"])
def test_nothing_is_written_elsewhere(folder: Path, name: str) -> None:
    before = sorted(folder.parent.rglob("*"))
    asked_of = {"model": CRANK_ROCKER, "changes": {"crank.length": "0.9 m"}}
    assert call("change_dimension", folder, **asked_of, save_as=name).codes == ["file.outside"]
    report = name.replace(".yaml", ".html")
    assert call("write_report", folder, model=CRANK_ROCKER, file=report).codes == ["file.outside"]
    assert sorted(folder.parent.rglob("*")) == before


def test_what_is_there_is_replaced_only_where_asked(folder: Path) -> None:
    asked_of = {"model": "own.yaml", "changes": {"crank.length": "0.9 m"}, "save_as": "own.yaml"}
    before = (folder / "own.yaml").read_text("utf-8")
    assert call("change_dimension", folder, **asked_of).codes == ["file.exists"]
    assert (folder / "own.yaml").read_text("utf-8") == before
    assert call("change_dimension", folder, **asked_of, overwrite=True).data["written"] == "own.yaml"
    assert lw.load(folder / "own.yaml").dimension("crank.length") == 0.9
    assert call("change_dimension", folder, **(asked_of | {"save_as": "own.txt"})).codes == ["cli.bad_suffix"]


def test_files_that_a_model_names_are_bound_too(folder: Path) -> None:
    text = lw.read_document(CRANK_ROCKER).text
    for name in ("../secret.svg", "up/secret.svg"):
        shown = call("check_model", folder, model=f"{text}\nreport: {{text: {{task: '![x]({name})'}}}}\n")
        assert "wrong-picture" in shown.codes
    tolerance = (
        "format: 1\nkind: tolerance\nmechanism: ../secret.yaml\ndimensions: {crank.length: 1 mm}\nof: [stroke]\n"
    )
    assert not call("check_model", folder, model=tolerance).data["ok"]
    curve = call("synthesize_machine", folder, task="free_curve", demands={"file": "../curve.csv", "seconds": 1})
    assert curve.codes == ["file.outside"]


def test_a_text_in_typst_is_not_set(folder: Path) -> None:
    """Typst reads files and fetches packages."""
    text = lw.read_document(CRANK_ROCKER).text
    own = f'{text}\nreport:\n  text:\n    task: |\n      typst\n      #read("own.yaml")\n'
    call("write_report", folder, model=own, file="r.html", sections=["task"])
    written = folder / "r.html"
    assert not written.exists() or "links:" not in written.read_text("utf-8")


@pytest.mark.parametrize(
    ("tool", "arguments", "key"),
    [
        ("check_model", {"modl": "x"}, "modl"),
        ("check_model", {}, "model"),
        ("solve_machine", {"model": CRANK_ROCKER, "positions": 1000}, "positions"),
        ("solve_machine", {"model": CRANK_ROCKER, "columns": 3}, "columns"),
        ("draw_machine", {"model": CRANK_ROCKER, "width": 100_000}, "width"),
        ("optimize_machine", {"model": CRANK_ROCKER, "evaluations": 10**9}, "evaluations"),
        ("synthesize_machine", {"task": "perpetuum", "demands": {}}, "task"),
    ],
)
def test_arguments_that_do_not_fit_are_findings(tool: str, arguments: dict[str, object], key: str) -> None:
    found = call(tool, **arguments)
    assert found.failed and [(each["key"], each["code"]) for each in found.data["findings"]] == [
        (key, "assistants.argument")
    ]


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("tool", "arguments"),
    [
        ("solve_machine", {"model": CRANK_ROCKER, "at": "0 dg"}),
        ("solve_machine", {"model": CRANK_ROCKER, "at": "0..360 deg:1 deg"}),
        ("solve_machine", {"model": CRANK_ROCKER, "columns": ["rokcer.angle"]}),
        ("solve_machine", {"model": "format: 1\nlinks: 3"}),
        ("solve_machine", {"model": "gallery:truss", "at": "0 deg"}),
        ("solve_machine", {"model": CRANK_ROCKER, "at": "0 deg", "under": "rest"}),
        ("get_metrics", {"model": CRANK_ROCKER, "names": ["strok"]}),
        ("draw_machine", {"model": CRANK_ROCKER, "paths": ["Q"]}),
        ("draw_machine", {"model": CRANK_ROCKER, "at": "0 deg, 10 deg"}),
        ("change_dimension", {"model": CRANK_ROCKER, "changes": {"crnk.length": "1 m"}}),
        ("change_dimension", {"model": CRANK_ROCKER, "changes": {"crank.length": "1 kg"}}),
        ("change_dimension", {"model": CRANK_ROCKER, "changes": {"crank.length": "1 m}\nloads: {"}}),
        ("synthesize_machine", {"task": "slider_crank", "demands": {"strok": "4 mm"}}),
        ("synthesize_machine", {"task": "slider_crank", "demands": {"stroke: 1 mm\nx": "4 mm"}}),
        ("optimize_machine", {"model": CRANK_ROCKER}),
        ("optimize_machine", {"model": CRANK_ROCKER, "vary": {"crank.length": "1 kg"}, "minimize": ["stroke"]}),
        ("compare_machines", {"models": [CRANK_ROCKER, "gallery:kite"], "output": "jaw"}),
        ("write_report", {"model": CRANK_ROCKER, "file": "r.txt"}),
        ("write_report", {"model": CRANK_ROCKER, "file": "r.pdf", "sections": ["tsk"]}),
        ("check_model", {"model": ""}),
        ("check_model", {"model": "gallery:kiet"}),
        ("check_model", {"model": "x" * 1_000_001}),
        ("read_schema", {"section": "joints", "kind": "gaer"}),
        ("search_gallery", {"name": "../secret"}),
    ],
)
def test_what_cannot_be_done_is_a_finding(tmp_path: Path, tool: str, arguments: dict[str, object]) -> None:
    found = call(tool, tmp_path, **arguments)
    assert found.failed and found.data["findings"] and "assistants.unexpected" not in found.codes
    assert "Traceback" not in json.dumps(found.data) and not list(tmp_path.iterdir())
    assert all(each["code"] and each["message"] for each in found.data["findings"])


@pytest.mark.rotating
def test_answers_about_every_machine_of_the_gallery_are_short() -> None:
    """Not more than fits what an assistant reads at once."""

    async def longest(client: Client) -> int:
        found = 0
        for name in every(lw.gallery_names()[::5], least=10):
            for tool in ("check_model", "solve_machine"):
                answer = await client.call_tool(tool, {"model": f"gallery:{name}"})
                found = max(found, len(answer.content[0].text))
        return found

    assert asked(longest) < 30_000


def test_what_tools_open_lies_in_the_folder_in_the_package_or_among_fonts(folder: Path, tmp_path: Path) -> None:
    """Python's own record of opened files: none is written outside of the folder and the cache, and of what is next
    to the folder nothing is read."""
    opened: list[tuple[str, bool]] = []
    listening = [True]

    def heard(event: str, arguments: tuple[object, ...]) -> None:
        if listening[0] and event == "open" and isinstance(arguments[0], str | bytes):
            writes = any(sign in str(arguments[1] or "") for sign in "wax+") or bool(int(str(arguments[2])) & 3)
            opened.append((os.fsdecode(arguments[0]), writes))

    sys.addaudithook(heard)  # it stays, deaf
    named = "report: {text: {task: '![x](../secret.svg) ![y](up/secret.svg)'}}"
    text = f"{lw.read_document(CRANK_ROCKER).text}\n{named}\n"
    try:
        for name in ("own.yaml", "link.yaml", "../secret.yaml", text):
            call("check_model", folder, model=name)
            call("write_report", folder, model=name, file="r.html", sections=["task"], overwrite=True)
        call("change_dimension", folder, model="own.yaml", changes={"crank.length": "0.8 m"}, save_as="new.yaml")
        call("synthesize_machine", folder, task="free_curve", demands={"file": "../curve.csv"})
    finally:
        listening[0] = False
    assert (folder / "new.yaml").exists() and any("new" in path or ".linkwright-" in path for path, _ in opened)
    cache = os.environ["LINKWRIGHT_CACHE"]
    for path, writes in opened:
        place = Path(path).resolve()
        assert not writes or place.is_relative_to(folder) or place.is_relative_to(cache) or path == os.devnull, path
        assert place.is_relative_to(folder) or not place.is_relative_to(tmp_path), path


def test_a_foreign_model_leads_to_no_other_file(tmp_path: Path) -> None:
    pytest.importorskip("mujoco")
    (tmp_path / "secret.xml").write_text("<mujoco><worldbody/></mujoco>")
    folder = tmp_path / "folder"
    folder.mkdir()
    for names in ('<include file="../secret.xml"/>', '<asset><mesh name="m" file="/etc/passwd"/></asset>'):
        found = call("check_model", folder, model=f"<mujoco>{names}<worldbody/></mujoco>")
        assert "import.mjcf_files" in found.codes

"""What a person finds in the folder of the studio: drafts with their times, numbered drawings, other names."""

from __future__ import annotations

import os
import time
from pathlib import Path

from linkwright.server.files import Files
from linkwright.server.folder import listing

PRESS = "format: 1\nlinks:\n  crank: {points: [O1, A]}\n  rod: {points: [A, B]}\n"


def test_drafts_are_listed_with_time_links_and_whether_they_were_saved(tmp_path: Path) -> None:
    files, begun = Files(tmp_path), time.time() * 1e3
    (tmp_path / "press.yaml").write_text(PRESS)
    os.utime(tmp_path / "press.yaml", (1e9, 1e9))
    files.keep("Drawing 1.yaml", "format: 1\n", "w", 0)
    files.keep("press.yaml", PRESS + "# changed\n", "w", 0)
    files.keep("same.yaml", PRESS, "w", 0)
    (tmp_path / "same.yaml").write_text(PRESS)
    (tmp_path / ".linkwright" / "broken.json").write_text("{")
    found = listing(files, "en")
    drafts = {each["name"]: each for each in found["drafts"]}
    assert [each["name"] for each in found["drafts"]] == ["press.yaml", "Drawing 1.yaml"]
    assert (drafts["press.yaml"]["links"], drafts["press.yaml"]["saved"]) == (2, True)
    assert (drafts["Drawing 1.yaml"]["links"], drafts["Drawing 1.yaml"]["saved"]) == (0, False)
    assert all(begun - 1 <= each["time"] <= time.time() * 1e3 for each in found["drafts"])
    assert found["files"][-1] == {"name": "press.yaml", "time": 10**12}
    assert len(found["gallery"]) > 40 and all(each["title"] and each["purpose"] for each in found["gallery"])
    assert {each["title"] for each in listing(files, "zh")["gallery"]}.isdisjoint(
        each["title"] for each in found["gallery"]
    )


def test_new_drawings_are_numbered_and_hide_no_other(tmp_path: Path) -> None:
    files = Files(tmp_path)
    names = [files.fresh("Drawing ", window, numbered=True) for window in ("a", "b")]
    assert names == ["Drawing 1.yaml", "Drawing 2.yaml"]
    files.keep(names[0], "format: 1\n", "a", 0)
    (tmp_path / "Drawing 2.yaml").write_text("format: 1\n")
    assert files.fresh("Drawing ", "a", numbered=True) == "Drawing 3.yaml"


def test_a_file_takes_another_name_with_its_draft_and_none_that_is_taken(tmp_path: Path) -> None:
    files = Files(tmp_path)
    (tmp_path / "a.yaml").write_text("# a\n")
    (tmp_path / "b.yaml").write_text("# b\n")
    files.keep("a.yaml", "# a, changed\n", "w", 0)
    files.keep("Drawing 1.yaml", "# drawn\n", "w", 0)
    version = files.disk("a.yaml")["version"]
    for taken in ("b.yaml", "Drawing 1.yaml"):
        assert not files.rename("a.yaml", taken, version)["renamed"]
    assert not files.rename("a.yaml", "c.yaml", "another version")["renamed"]
    moved = files.rename("a.yaml", "sub/c.yaml", version)
    assert (moved["renamed"], moved["name"], moved["version"]) == (True, "sub/c.yaml", version)
    assert not (tmp_path / "a.yaml").exists()
    assert (tmp_path / "sub/c.yaml").read_text() == "# a\n"
    opened = files.open("sub/c.yaml")
    assert (opened["text"], opened["recovered"], opened["serial"]) == ("# a, changed\n", True, moved["serial"])
    drawn = files.rename("Drawing 1.yaml", "press.yaml", "")
    assert drawn["renamed"] and files.open("press.yaml")["text"] == "# drawn\n"
    assert not (tmp_path / "press.yaml").exists()
    assert [each["name"] for each in files.drafts()] == ["press.yaml", "sub/c.yaml"]


def test_a_draft_is_deleted_and_its_file_stays(tmp_path: Path) -> None:
    files = Files(tmp_path)
    (tmp_path / "a.yaml").write_text("# a\n")
    files.keep("a.yaml", "# a, changed\n", "w", 0)
    files.discard("a.yaml")
    assert files.drafts() == [] and files.open("a.yaml")["text"] == "# a\n"
    files.discard("a.yaml")

"""Files of the studio that several windows and servers read and write at once: nothing is lost unsaid."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from tests.at_once import at_once

from linkwright.server.files import Files
from linkwright.server.web import Address, recalled, remember

ROUNDS, HANDS = 25, 4


def test_of_several_savings_at_once_one_is_saved_and_the_others_are_told(tmp_path: Path) -> None:
    """Of windows of one server and of servers of one folder; the file has the text of the one that was saved."""
    servers = [Files(tmp_path) for _ in range(HANDS)]
    version = ""
    for k in range(2 * ROUNDS):
        hands = servers if k % 2 else servers[:1] * HANDS
        texts = [f"# {k} {hand}\n" for hand in range(HANDS)]
        found = at_once(
            *(lambda f=f, t=t, v=version: f.save("a.yaml", t, v, "a.yaml") for f, t in zip(hands, texts, strict=True))
        )
        assert [each["saved"] for each in found].count(True) == 1
        won = next(place for place, each in enumerate(found) if each["saved"])
        assert (tmp_path / "a.yaml").read_text() == texts[won]
        version = found[won]["version"]


def test_of_several_drafts_at_once_none_is_lost_unsaid(tmp_path: Path) -> None:
    """Windows of several servers store a draft: one is stored, each other one is given its text."""
    servers = [Files(tmp_path) for _ in range(HANDS)]
    for k in range(ROUNDS):
        name, texts = f"{k}.yaml", [f"# {hand}\n" for hand in range(HANDS)]
        found = at_once(
            *(
                lambda f=f, n=n, t=t, name=name: f.keep(name, t, f"window {n}", 0)
                for n, (f, t) in enumerate(zip(servers, texts, strict=True))
            )
        )
        stored = [place for place, each in enumerate(found) if each["other"] is None]
        assert len(stored) == 1
        assert {each["other"] for each in found} == {None, texts[stored[0]]}
        assert servers[0].open(name)["text"] == texts[stored[0]]


def test_new_drawings_at_once_have_different_names(tmp_path: Path) -> None:
    files = Files(tmp_path)
    found = at_once(*(lambda hand=hand: files.fresh("machine", f"window {hand}") for hand in range(HANDS)))
    assert len(set(found)) == HANDS
    assert files.fresh("machine", "window 0") in found


def test_an_address_is_never_half_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LINKWRIGHT_CACHE", str(tmp_path / "cache"))
    addresses = [Address(5000 + hand, f"{hand}" * 40) for hand in range(HANDS)]
    remember(tmp_path, addresses[0])

    def write(address: Address) -> None:
        for _ in range(ROUNDS):
            remember(tmp_path, address)

    def read() -> bool:
        return all(recalled(tmp_path) in addresses for _ in range(4 * ROUNDS))

    *_, whole = at_once(*(lambda each=each: write(each) for each in addresses), read)
    assert whole
    (path,) = (tmp_path / "cache" / "studio").glob("*.json")
    assert path.stat().st_mode & 0o077 == 0


def test_a_drawing_under_another_name_is_never_lost(tmp_path: Path) -> None:
    """Drawn, a new one begun, saved under the first one's name: asked first; then the first has a new name."""
    files = Files(tmp_path)
    first = files.fresh("machine", "w")
    serial = files.keep(first, "# first\n", "w", 0)["serial"]
    second = files.fresh("machine", "w")
    assert (first, second) == ("machine.yaml", "machine2.yaml")
    files.keep(second, "# second\n", "w", 0)
    assert files.unsaved() == [second, first]
    asked = files.save(first, "# second\n", "", second)
    assert not asked["saved"]
    assert files.open(first)["text"] == "# first\n"
    saved = files.save(f"./{first}", "# second\n", asked["version"], second)
    assert (saved["saved"], saved["name"], saved["aside"]) == (True, first, "machine3.yaml")
    assert files.open("machine3.yaml")["text"] == "# first\n"
    assert files.open(first) == {
        "text": "# second\n",
        "version": saved["version"],
        "name": first,
        "serial": 0,
        "recovered": False,
    }
    assert files.unsaved() == ["machine3.yaml"]
    assert files.keep(first, "# more\n", "w", serial)["other"] is None
    assert json.loads(next(path for path in (tmp_path / ".linkwright").glob("*.json")).read_bytes())


def test_what_is_typed_while_a_file_is_saved_stays_a_draft(tmp_path: Path) -> None:
    """A draft goes only with the text that it has; one of another window is given to the window that saves next."""
    files = Files(tmp_path)
    serial = files.keep("a.yaml", "# mine, and more\n", "w", 0)["serial"]
    assert files.save("a.yaml", "# mine\n", "", "a.yaml")["saved"]
    assert files.open("a.yaml") == {
        **files.disk("a.yaml"),
        "name": "a.yaml",
        "text": "# mine, and more\n",
        "serial": serial,
        "recovered": True,
    }
    assert files.keep("a.yaml", "# theirs\n", "v", 0)["other"] == "# mine, and more\n"

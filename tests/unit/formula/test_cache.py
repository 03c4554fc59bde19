"""Machine code on disk: used only where it is whole, ours and made for this machine."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import numpy as np
import pytest

from linkwright.formula import machine_code
from linkwright.formula import machine_code as cache
from linkwright.formula.ir_kernel import ENTRY
from linkwright.formula.llvm_backend import available, compile_program
from linkwright.formula.program import Program
from linkwright.formula.trace import Trace, sin

pytestmark = pytest.mark.skipif(not available(), reason="llvmlite is not installed")
posix = pytest.mark.skipif(sys.platform == "win32", reason="owners and permissions as on POSIX")


@pytest.fixture
def base(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    chosen = tmp_path / "code"
    monkeypatch.setenv("LINKWRIGHT_CACHE", str(chosen))
    cache.forget()
    return chosen


def program(factor: float = 3.0) -> Program:
    t = Trace()
    return Program.of(t, {"y": t.position("x") * sin(t.parameter("a")) * factor})


def works(factor: float = 3.0) -> bool:
    """Whether a program compiled or loaded afresh computes what it should."""
    cache.forget()
    x = np.linspace(0.0, 1.0, 21)
    compiled = compile_program(program(factor))
    assert compiled is not None
    return bool(np.allclose(compiled.store([[0.4]], {"x": x})[0, 0], x * np.sin(0.4) * factor, rtol=1e-14))


def count_compilations(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    compiled: list[str] = []
    original = machine_code.object_code

    def counted(text: str, level: int) -> bytes:
        compiled.append(text)
        return original(text, level)

    monkeypatch.setattr(machine_code, "object_code", counted)
    return compiled


def code_file(base: Path) -> Path:
    (path,) = base.glob("*.lwcode")
    return path


def test_the_second_process_loads_what_the_first_compiled(base: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    compiled = count_compilations(monkeypatch)
    assert works()
    assert works()
    assert len(compiled) == 1
    assert works(4.0)
    assert len(compiled) == 2


@pytest.mark.parametrize("place", [0, 30, -200, -1])
def test_a_damaged_file_is_ignored_and_written_anew(base: Path, monkeypatch: pytest.MonkeyPatch, place: int) -> None:
    compiled = count_compilations(monkeypatch)
    assert works()
    good = code_file(base).read_bytes()
    bad = bytearray(good)
    bad[place] ^= 1
    code_file(base).write_bytes(bytes(bad))
    assert works()
    assert len(compiled) == 2
    assert works()
    assert len(compiled) == 2


@pytest.mark.parametrize("kept", [0, 10, 300])
def test_half_a_file_is_ignored(base: Path, monkeypatch: pytest.MonkeyPatch, kept: int) -> None:
    compiled = count_compilations(monkeypatch)
    assert works()
    path = code_file(base)
    path.write_bytes(path.read_bytes()[:kept])
    assert works()
    assert len(compiled) == 2


@posix
def test_a_folder_open_to_others_is_not_used(base: Path) -> None:
    base.mkdir()
    base.chmod(0o777)
    with pytest.warns(RuntimeWarning, match="others may write"):
        assert works()
    assert list(base.iterdir()) == []


@posix
def test_a_folder_of_another_user_is_not_used(base: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    base.mkdir(mode=0o700)
    monkeypatch.setattr(os, "getuid", lambda: base.stat().st_uid + 1)
    with pytest.warns(RuntimeWarning, match="belongs to another user"):
        assert works()
    assert list(base.iterdir()) == []


@posix
def test_the_folder_is_private(base: Path) -> None:
    assert works()
    assert base.stat().st_mode & 0o077 == 0


def test_another_machine_s_code_is_not_found(base: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    compiled = count_compilations(monkeypatch)
    assert works()
    here = machine_code.host()
    other = machine_code.Host(here.cpu, here.features, here.width, here.description + " other")
    monkeypatch.setattr(machine_code, "host", lambda: other)
    assert works()
    assert len(compiled) == 2


def test_the_cache_can_be_turned_off(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("LINKWRIGHT_CACHE", "off")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache.folder() is None
    assert works()
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_made_is_no_error(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("LINKWRIGHT_CACHE", str(tmp_path / "file" / "code"))
    assert works()


def test_the_oldest_files_go_beyond_the_limit(base: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert works(1.5)
    first = code_file(base)
    os.utime(first, (1.0, 1.0))
    monkeypatch.setattr(cache, "SIZE_LIMIT", 2 * first.stat().st_size + 100)
    assert works(2.5)
    assert first.exists()
    assert works(3.5)
    assert not first.exists()
    assert len(list(base.glob("*.lwcode"))) == 2


@pytest.mark.parametrize(("home", "want"), [("/somewhere", "/somewhere/linkwright"), ("", None)])
def test_the_users_cache_folder_is_the_default(monkeypatch: pytest.MonkeyPatch, home: str, want: str | None) -> None:
    monkeypatch.delenv("LINKWRIGHT_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", home)
    assert str(cache.folder()) == want if want else cache.folder() is not None


def test_code_without_the_function_is_refused() -> None:
    code = machine_code.object_code("define void @other(ptr %p) {\nret void\n}\n")
    with pytest.raises(RuntimeError, match=ENTRY):
        machine_code.Loaded(code, ENTRY)


@posix
def test_code_that_others_may_read_but_not_write_is_used(base: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    compiled = count_compilations(monkeypatch)
    assert works()
    code_file(base).chmod(0o644)
    base.chmod(0o755)
    assert works()
    assert len(compiled) == 1


def test_the_memory_keeps_what_was_used_last(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LINKWRIGHT_CACHE", "off")
    monkeypatch.setattr(cache, "_IN_MEMORY", 2)
    cache.forget()
    compiled = count_compilations(monkeypatch)
    text = "define void @{0}(ptr %p) {{\nret void\n}}\n"

    def use(name: str) -> machine_code.Loaded:
        return cache.loaded_code(name, lambda: (text.format(name), 0), name)

    first = use("one")
    assert use("one") is first and len(compiled) == 1
    use("two")
    assert use("one") is first
    use("three")
    assert use("one") is first and len(compiled) == 3
    use("two")
    assert len(compiled) == 4
    cache.forget()
    use("two")
    assert len(compiled) == 5


def test_code_of_another_version_is_not_found(base: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    compiled = count_compilations(monkeypatch)
    assert works()
    assert len(cache._stamp()) == 32
    stamp = cache._stamp.__wrapped__
    whole = stamp()
    monkeypatch.setattr(cache, "_SOURCES", ("table.py", "lines.py"))
    assert stamp() not in (whole, monkeypatch.setattr(cache, "_SOURCES", ("lines.py",)) or stamp())
    monkeypatch.setattr(cache, "_stamp", lambda: "0" * 32)
    assert works()
    assert len(compiled) == 2
    assert len(list(base.glob("*.lwcode"))) == 2


def test_a_file_that_is_used_becomes_the_youngest(base: Path) -> None:
    assert works()
    os.utime(code_file(base), (1.0, 1.0))
    assert works()
    assert code_file(base).stat().st_mtime > 1e9


@pytest.mark.parametrize(("spare", "left"), [(0, 3), (-1, 2), (-2, 2)])
def test_as_many_files_go_as_are_beyond_the_limit(
    base: Path, monkeypatch: pytest.MonkeyPatch, spare: int, left: int
) -> None:
    base.mkdir()
    for k in range(3):
        path = base / f"{k}.lwcode"
        path.write_bytes(b"x" * (10 + k))
        os.utime(path, (k + 1.0, k + 1.0))
    monkeypatch.setattr(cache, "SIZE_LIMIT", 33 + spare)
    cache._remove_oldest(base)
    assert sorted(path.name for path in base.iterdir()) == [f"{k}.lwcode" for k in range(3 - left, 3)]
    monkeypatch.setattr(cache, "SIZE_LIMIT", 1)
    cache._remove_oldest(base)
    assert list(base.iterdir()) == []


def test_a_file_that_cannot_take_its_place_leaves_nothing_behind(base: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(source: str, target: Path) -> None:
        raise OSError("in the way")

    monkeypatch.setattr(os, "replace", refused)
    with pytest.raises(OSError, match="in the way"):
        cache._replace(base.parent / "file", b"content")
    assert not base.parent.joinpath("file").exists()
    assert works()
    assert list(base.iterdir()) == []


@pytest.mark.parametrize(
    ("platform", "variables", "want"),
    [
        ("linux", {"HOME": "/home/ada"}, "/home/ada/.cache/linkwright"),
        ("linux", {"HOME": "/home/ada", "XDG_CACHE_HOME": "/fast"}, "/fast/linkwright"),
        ("darwin", {"HOME": "/Users/ada"}, "/Users/ada/Library/Caches/linkwright"),
        ("win32", {"HOME": "/Users/ada", "LOCALAPPDATA": "/local"}, "/local/linkwright"),
        ("win32", {"HOME": "/Users/ada"}, "/Users/ada/AppData/Local/linkwright"),
        ("linux", {"HOME": "/home/ada", "LINKWRIGHT_CACHE": "/mine"}, "/mine"),
        ("linux", {"HOME": "/home/ada", "LINKWRIGHT_CACHE": "OFF"}, None),
        ("linux", {"HOME": "/home/ada", "LINKWRIGHT_CACHE": ""}, None),
    ],
)
def test_every_system_has_its_own_cache_folder(
    monkeypatch: pytest.MonkeyPatch, platform: str, variables: dict[str, str], want: str | None
) -> None:
    for name in ("LINKWRIGHT_CACHE", "XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(sys, "platform", platform)
    found = cache.folder()
    assert (None if found is None else found.as_posix()) == want


def test_windows_knows_no_owners(base: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    base.mkdir()
    base.chmod(0o777)
    monkeypatch.setattr(sys, "platform", "win32")
    assert cache._private(base)

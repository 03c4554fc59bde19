"""What is refused: by its code, its place and its values; the wording stands in `tests/words/`."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from dataclasses import replace
from io import StringIO
from pathlib import Path

import pytest
from tests.unit.files.reading import found_in

from linkwright import Finding, LinkwrightError, ModelError
from linkwright.cli import main


@contextmanager
def refused(
    code: str, kind: type[LinkwrightError] = LinkwrightError, /, **values: object
) -> Iterator[pytest.ExceptionInfo[LinkwrightError]]:
    """What is done inside raises an error of a kind, with a code and at least these values."""
    with pytest.raises(kind) as caught:
        yield caught
    assert caught.value.code == code, f'{caught.value.code}: "{caught.value}"'
    agrees(values_of(caught.value), values)


def values_of(error: LinkwrightError) -> Mapping[str, object]:
    """What an error is about; of a ModelError what its first error is about and how to mend it."""
    first = (each for each in getattr(error, "findings", ()) if each.severity == "error")
    return {**next(map(_values, first), {}), **error.values}


@contextmanager
def faulty(code: str, key: str, /, **values: object) -> Iterator[pytest.ExceptionInfo[ModelError]]:
    """What is done inside raises a ModelError, one of whose findings has a code, a key and at least these values."""
    with pytest.raises(ModelError) as caught:
        yield caught
    said(caught.value.findings, code, key, **values)


def findings(text: str, name: str = "<text>") -> list[Finding]:
    """What reading the text of a model file finds; places name the file as given."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "model.yaml")
        path.write_bytes(text.encode("utf-8"))
        return [replace(each, where=name + each.where.removeprefix(path.name)) for each in found_in(path)]


def checked(path: Path) -> tuple[int, list[Finding]]:
    """What the command ``check`` answers about a file: its exit code, and the findings that it tells as data."""
    with redirect_stdout(StringIO()) as told:
        code = main(["check", str(path), "--json"])
    (file,) = json.loads(told.getvalue())["files"]
    return code, [Finding(**each) for each in file["findings"]]


def said(found: Iterable[Finding], code: str, key: str | None = None, /, **values: object) -> Finding:
    """The one finding with a code (at a key of the model, where one is given), which has at least these values.

    Values are those of its message and of its remedy; ``message`` and ``remedy`` are the two themselves, by key.
    """
    told = list(found)
    matching = [each for each in told if each.code == code and key in (None, each.key)]
    assert len(matching) == 1, f"{len(matching)} findings {code}, {key}, among {[str(each) for each in told]}"
    agrees(_values(matching[0]), values)
    return matching[0]


def noted(notes: Iterable[str], code: str, /, **values: object) -> str:
    """The one note of a result (or of what became of a position) with a code, and at least these values."""
    told = list(notes)
    matching = [each for each in told if LinkwrightError(each).code == code]
    assert len(matching) == 1, f"{len(matching)} notes {code} among {[str(each) for each in told]}"
    agrees(LinkwrightError(matching[0]).values, values)
    return matching[0]


def _values(found: Finding) -> dict[str, object]:
    own = {"message": found.message, "remedy": found.remedy}
    return {**replace(found, message=found.remedy).values, **own, **found.values}


def agrees(found: Mapping[str, object], wanted: Mapping[str, object]) -> None:
    """Values are as wanted: numbers to 1e-9, sentences by their code or their text, several in any order of a set."""
    for name, value in wanted.items():
        assert name in found, f"no value {name} among {dict(found)}"
        assert _same(found[name], value), f"{name}: {found[name]!r}, not {value!r}"


def _same(found: object, wanted: object) -> bool:
    if isinstance(wanted, float):
        return isinstance(found, int | float) and found == pytest.approx(wanted, rel=1e-9, nan_ok=True)
    if isinstance(wanted, set | frozenset):
        return isinstance(found, Iterable) and {str(each) for each in found} == {str(each) for each in wanted}
    return wanted in (found, str(found), getattr(found, "msgid", None), getattr(found, "code", None))

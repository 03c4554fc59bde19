"""Reference numbers with their sources: of the data files, and of the models of the gallery."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from importlib.resources import files
from typing import Any

from linkwright import gallery
from linkwright.files.model_file import load
from linkwright.words import _
from linkwright.words.sentence import LocalizedText

#: Units of the last printed digit by which a rounded number may differ.
ROUNDED = 0.51
#: Keys of ``expected`` that are numbers of the structure.
STRUCTURE = ("mobility", "grubler", "class")


#: Why a printed number is wrong, by the word of the case.
WHY = {
    "arc_cosine": _("the angle comes from an arc cosine, which cannot be negative"),
    "follows": _("follows from the rocker's wrong angle"),
}


@dataclass(frozen=True)
class Reference:
    """One number: ``what`` it is, ``text`` with its unit; ``printed``: the source prints it, else it is derived (by
    hand, closed form, independent solution) from what the source gives; ``right`` where a print is wrong, and why."""

    what: str
    text: str
    printed: bool
    right: str = ""
    why: str = ""


@dataclass(frozen=True)
class Published:
    """Numbers of one source that one call finds: ``probe`` with ``inputs``."""

    case: str
    source: str
    probe: str
    inputs: Mapping[str, Any]
    numbers: tuple[Reference, ...]
    within: float = ROUNDED
    place: str = field(default="")


def published() -> Iterator[Published]:
    """All of them, data files first, then the gallery."""
    yield from from_data()
    for name in gallery.names():
        yield from from_gallery(name)


def from_data() -> Iterator[Published]:
    """Those of the data files."""
    import yaml

    folder = files(__package__) / "data"
    for entry in yaml.safe_load((folder / "published.yaml").read_text("utf-8")):
        head = LocalizedText(entry["case"]), entry["source"], entry["probe"]
        within = float(entry.get("within", ROUNDED))
        if "table" in entry:
            rows = csv.DictReader((folder / entry["table"]).read_text("utf-8").splitlines())
            name, unit = entry["at"].split()
            for row in rows:
                numbers = tuple(
                    Reference(column["of"], f"{row[key]} {column['unit']}", printed=True)
                    for key, column in entry["columns"].items()
                )
                place = f"{row[name]} {unit}"
                yield Published(*head, {**entry["given"], "at": place}, numbers, within, place)
            continue
        numbers = tuple(
            _reference(str(what), inputs, printed=key == "printed")
            for key in ("printed", "derived")
            for what, inputs in entry.get(key, {}).items()
        )
        yield Published(*head, entry.get("given", {}), numbers, within)


def _reference(what: str, inputs: Any, *, printed: bool) -> Reference:
    if isinstance(inputs, Mapping):
        why = WHY[inputs["why"]]
        return Reference(what, str(inputs["printed"]), printed, str(inputs["right"]), why)
    return Reference(what, str(inputs), printed)


def from_gallery(name: str) -> Iterator[Published]:
    """Numbers that a gallery file has as ``expected``.

    ``printed`` names those of the source itself, of all states or of one state or limit; the others are derived.
    """
    mechanism = load(f"gallery:{name}")
    expected, head = mechanism.expected, (mechanism.name, mechanism.source)
    printed = frozenset(expected.get("printed", ()))
    for state in expected.get("states", ()):
        here = printed | frozenset(state.get("printed", ()))
        numbers = tuple(Reference(what, text, kind in here) for what, kind, text in _of_state(state))
        place = next((f"{key} {state[key]}" for key in ("input", "time") if key in state), "")
        inputs = {"model": name, **{key: state[key] for key in ("input", "time") if key in state}}
        yield Published(*head, "machine", inputs, numbers, place=place.partition(" ")[2])
    limits = tuple(
        Reference(f"{each['link']} {each['kind']} {what}", str(each[what]), what in each.get("printed", ()))
        for each in expected.get("limits", ())
        for what in ("input", "angle")
        if what in each
    )
    metrics = _plain(expected.get("metrics", {}), printed)
    structure = _plain({key: expected[key] for key in STRUCTURE if key in expected}, printed)
    for probe, found in (("limits", limits), ("metrics", metrics), ("structure", structure)):
        if found:
            yield Published(*head, probe, {"model": name}, found)


def _plain(numbers: Mapping[str, Any], printed: frozenset[str]) -> tuple[Reference, ...]:
    return tuple(Reference(what, str(text), what in printed) for what, text in numbers.items())


def _of_state(state: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """What each number of a state is, the kind under which ``printed`` names it, and its text."""
    for link, numbers in state.get("links", {}).items():
        yield from ((f"{link}.{kind}", kind, str(text)) for kind, text in numbers.items())
    for point, numbers in state.get("points", {}).items():
        for kind, pair in numbers.items():
            yield from (
                (f"{point}.{kind}.{axis}", f"{kind}.{axis}", str(text)) for axis, text in zip("xy", pair, strict=True)
            )
    for joint, numbers in state.get("reactions", {}).items():
        on = f"{joint} on {numbers['on']}"
        pair = numbers.get("force", ())
        yield from ((f"{on}.{axis}", f"force.{axis}", str(text)) for axis, text in zip("xy", pair, strict=False))
        yield from (
            (f"{on}.{kind}", kind, str(numbers[kind])) for kind in ("magnitude", "direction") if kind in numbers
        )
    for driver, text in state.get("efforts", {}).items():
        yield f"{driver}.effort", "effort", str(text)
    if "input_torque" in state:
        yield "input_torque", "input_torque", str(state["input_torque"])

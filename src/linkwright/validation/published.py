"""Published numbers with their sources: of the data files, and of the models of the gallery."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping
from dataclasses import field
from importlib.resources import files
from typing import Any

from linkwright import gallery
from linkwright.core.dataclass import dataclass
from linkwright.files.model_file import load
from linkwright.words.sentence import Sentence

#: Units of the last printed digit by which a rounded number may differ.
ROUNDED = 0.51


@dataclass(frozen=True)
class Printed:
    """One number: ``what`` it is, ``text`` as printed with its unit; ``right`` where the source is wrong, and why."""

    what: str
    text: str
    right: str = ""
    why: str = ""


@dataclass(frozen=True)
class Published:
    """Numbers of one source that one call finds: ``probe`` with what is ``given``."""

    case: str
    source: str
    probe: str
    given: Mapping[str, Any]
    numbers: tuple[Printed, ...]
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
        head = entry["case"], entry["source"], entry["probe"]
        within = float(entry.get("within", ROUNDED))
        if "table" in entry:
            rows = csv.DictReader((folder / entry["table"]).read_text("utf-8").splitlines())
            name, unit = entry["at"].split()
            for row in rows:
                numbers = tuple(
                    Printed(column["of"], f"{row[key]} {column['unit']}")
                    for key, column in entry["columns"].items()
                )
                place = f"{row[name]} {unit}"
                yield Published(*head, {**entry["given"], "at": place}, numbers, within, place)
            continue
        numbers = tuple(_printed(str(what), given) for what, given in entry["numbers"].items())
        yield Published(*head, entry.get("given", {}), numbers, within)


def _printed(what: str, given: Any) -> Printed:
    if isinstance(given, Mapping):
        return Printed(
            what, str(given["printed"]), str(given["right"]), Sentence(f"validate.why_{given['why']}")
        )
    return Printed(what, str(given))


def from_gallery(name: str) -> Iterator[Published]:
    """Numbers that a gallery file has as ``expected``."""
    mechanism = load(f"gallery:{name}")
    expected, head = mechanism.expected, (mechanism.name, mechanism.source)
    for state in expected.get("states", ()):
        numbers = tuple(_of_state(state))
        place = next((f"{key} {state[key]}" for key in ("input", "time") if key in state), "")
        given = {"model": name, **{key: state[key] for key in ("input", "time") if key in state}}
        yield Published(*head, "machine", given, numbers, place=place.partition(" ")[2])
    limits = tuple(
        Printed(f"{each['link']} {each['kind']} {what}", str(each[what]))
        for each in expected.get("limits", ())
        for what in ("input", "angle")
        if what in each
    )
    if limits:
        yield Published(*head, "limits", {"model": name}, limits)
    metrics = tuple(Printed(metric, str(text)) for metric, text in expected.get("metrics", {}).items())
    if metrics:
        yield Published(*head, "metrics", {"model": name}, metrics)
    structure = tuple(
        Printed(key, str(expected[key])) for key in ("mobility", "grubler", "class") if key in expected
    )
    if structure:
        yield Published(*head, "structure", {"model": name}, structure)


def _of_state(state: Mapping[str, Any]) -> Iterator[Printed]:
    for link, numbers in state.get("links", {}).items():
        yield from (Printed(f"{link}.{what}", str(text)) for what, text in numbers.items())
    for point, numbers in state.get("points", {}).items():
        for what, pair in numbers.items():
            yield from (Printed(f"{point}.{what}.{axis}", str(t)) for axis, t in zip("xy", pair, strict=True))
    for joint, numbers in state.get("reactions", {}).items():
        on = f"{joint} on {numbers['on']}"
        pair = numbers.get("force", ())
        yield from (Printed(f"{on}.{axis}", str(text)) for axis, text in zip("xy", pair, strict=False))
        yield from (
            Printed(f"{on}.{what}", str(numbers[what]))
            for what in ("magnitude", "direction")
            if what in numbers
        )
    for driver, text in state.get("efforts", {}).items():
        yield Printed(f"{driver}.effort", str(text))
    if "input_torque" in state:
        yield Printed("input_torque", str(state["input_torque"]))

"""Findings of damaged files: severity, code, line, key; no wording."""

from __future__ import annotations

import random
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

from tests import damage
from tests.state.rows import Entries, refusal
from tests.unit.files.reading import found_in

import linkwright as lw
from linkwright import gallery

#: Batches of accidents, and how many in each; every so many characters a file is cut.
BATCHES, ACCIDENTS, STEP = 24, 60, 149


class Folder:
    """A file that is written anew for every text."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def found(self, text: str, kind: str = "model") -> list[str]:
        """The findings of a text, or how it is refused, or that nothing is remarked."""
        self.path.write_bytes(text.encode("utf-8"))
        try:
            return [self.line(each) for each in FINDERS[kind](self.path)]
        except Exception as error:
            return [refusal(error)]

    def line(self, each: lw.Finding) -> str:
        place = each.where.removeprefix(str(self.path)).removeprefix(self.path.name).lstrip(":")
        return f"{each.severity} {each.code} {place} {each.key}"


def of_task(path: Path) -> Iterable[lw.Finding]:
    """What is wrong with a task of synthesis; a right one is run."""
    try:
        lw.synthesize(path)
    except lw.ModelError as error:
        return error.findings
    return []


def of_model(path: Path) -> Iterable[lw.Finding]:
    """What reading a model finds; its cycle is not turned."""
    try:
        return found_in(path)
    except lw.ModelError as error:
        return error.findings


FINDERS: Mapping[str, Callable[[Path], Iterable[lw.Finding]]] = {
    "model": of_model,
    "calculation": lw.check,
    "task": of_task,
}


def texts() -> dict[str, tuple[str, str]]:
    """Text and kind of every file of the gallery."""
    kinds = {"model": gallery.names(), "calculation": gallery.calculations(), "task": gallery.tasks()}
    return {name: (gallery.content(name).decode(), kind) for kind, names in kinds.items() for name in names}


def accidents(batch: str, folder: Folder) -> Entries:
    rng, known = random.Random(int(batch)), texts()
    for number in range(ACCIDENTS):
        name = rng.choice(list(known))
        text, kind = known[name]
        yield f"{number} {name}", "", folder.found(damage.damaged(text, rng), kind)


def cut(name: str, folder: Folder) -> Entries:
    text, kind = texts()[name]
    for at, beginning in damage.cuts(text, name, STEP):
        yield str(at), "", folder.found(beginning, kind)


def values(value: str, folder: Folder) -> Entries:
    for place in damage.WHERE_ANYTHING:
        yield f"{place.start()} {place[0]}", "", folder.found(damage.with_value(place, value))


def changed(change: Callable[[str], Iterator[tuple[str, str]]]) -> Callable[[str, Folder], Entries]:
    """Findings of every change of a file."""

    def find(name: str, folder: Folder) -> Entries:
        known = {**texts(), "all values": (damage.with_value(damage.VALUES[0], "0 m"), "model")}
        text, kind = known[name]
        for place, broken in change(text):
            yield place, "", folder.found(broken, kind)

    return find


CHANGED = ("all values", "jaw_crusher_sixbar", "double_slider", "gear_differential", "lightest_spring")
#: Kinds of damage with their subjects.
KINDS: Mapping[str, tuple[Callable[[str, Folder], Entries], Callable[[], tuple[str, ...]]]] = {
    "accidents": (accidents, lambda: tuple(map(str, range(BATCHES)))),
    "cuts": (cut, lambda: tuple(texts())),
    "values": (values, lambda: (*damage.NO_NUMBERS, *damage.UNFIT, "1 qq", "wrong", "7", "-3 kg", "2 m²")),
    "misnamed": (changed(damage.misnamed), lambda: CHANGED),
    "indented": (changed(damage.indented), lambda: CHANGED),
    "wide": (changed(damage.wide), lambda: CHANGED[:2]),
}


def findings(subject: str) -> Entries:
    """Of one subject ``kind: name``."""
    kind, _, name = subject.partition(": ")
    with tempfile.TemporaryDirectory() as place:
        yield from KINDS[kind][0](name, Folder(Path(place, "m.yaml")))


def subjects() -> tuple[str, ...]:
    return tuple(f"{kind}: {name}" for kind, (_, names) in KINDS.items() for name in names())

"""Reference numbers with their sources, each next to the one found here."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from importlib.resources import files
from typing import Any

from linkwright import gallery
from linkwright.core.progress import Progress, current_progress, reporting
from linkwright.core.table import Amount, Cell, Table, Tabular
from linkwright.errors import LinkwrightError, speaker
from linkwright.files.model_file import load
from linkwright.units import unit
from linkwright.validation.probes import PROBES
from linkwright.words import _
from linkwright.words.message import LocalizedText, in_language


@dataclass(frozen=True)
class Checked:
    """One reference number and ours: ``value`` and ``expected`` in its unit; ``digits``: the difference in units of
    its last digit; ``trouble``: why there is no value."""

    case: Published
    reference: Reference
    value: float
    expected: float
    digits: float
    trouble: str = ""

    @property
    def ok(self) -> bool:
        """Whether ours agrees to the printed digits; where the source is wrong, with the right number."""
        return abs(self.digits) <= self.case.within

    @property
    def erratum(self) -> bool:
        """Whether the printed number is known to be wrong, and ours shows it."""
        return bool(self.reference.right)


@dataclass(frozen=True)
class Validation(Tabular):
    """All comparisons."""

    checks: tuple[Checked, ...]

    @property
    def ok(self) -> bool:
        """Whether all agree."""
        return all(each.ok for each in self.checks)

    @property
    def failed(self) -> tuple[Checked, ...]:
        """Those that do not."""
        return tuple(each for each in self.checks if not each.ok)

    def cases(self) -> dict[tuple[str, str], list[Checked]]:
        """Comparisons by case and source."""
        found: dict[tuple[str, str], list[Checked]] = {}
        for each in self.checks:
            found.setdefault((each.case.case, each.case.source), []).append(each)
        return found

    def tables(self, language: str = "en", *, every: bool = False, sources: bool = False) -> tuple[Table, ...]:
        """A row per case with its counts, where asked its source; in full what fails and the errata, or ``every``
        number."""
        head = (
            _("case"),
            _("source"),
            _("numbers"),
            _("printed by the source"),
            _("agree"),
            _("largest difference, last digits"),
        )
        rows: list[tuple[Cell, ...]] = []
        for (case, source), checks in self.cases().items():
            agree, worst = sum(each.ok for each in checks), max(abs(each.digits) for each in checks)
            rows.append((case, source, len(checks), _printed(checks), agree, Amount(worst, digits=2)))
        table = Table(head, rows, "<<>>>>")
        if not sources:
            table = Table((head[0], *head[2:]), [(row[0], *row[2:]) for row in rows])
        shown = self.checks if every else [each for each in self.checks if not each.ok or each.erratum]
        count = _(
            "{agree} of {all} numbers of {cases} cases agree to the printed digits. {printed} are "
            "printed by their sources, and {errata} of these are printed wrongly; the others are "
            "derived from what the sources give.",
            agree=sum(each.ok for each in self.checks),
            all=len(self.checks),
            cases=len(self.cases()),
            printed=_printed(self.checks),
            errata=sum(each.erratum for each in self.checks),
        )
        return table, Table(notes=[line(each, language) for each in shown]), Table(notes=[count])

    def data(self) -> dict[str, object]:
        """Plain data."""
        numbers: list[dict[str, object]] = [
            {
                "case": each.case.case,
                "source": each.case.source,
                "place": each.case.place,
                "what": each.reference.what,
                "expected": each.reference.right or each.reference.text,
                "printed": each.reference.text if each.reference.printed else None,
                "right": each.reference.right,
                "why": each.reference.why,
                "ours": each.value,
                "digits": each.digits,
                "ok": each.ok,
            }
            for each in self.checks
        ]
        return {"ok": self.ok, "numbers": numbers}


def _printed(checks: Iterable[Checked]) -> int:
    """How many of the numbers their sources print."""
    return sum(each.reference.printed for each in checks)


def line(each: Checked, language: str) -> str:
    """One number in a sentence."""
    translate = speaker(language)
    number = each.reference.text
    words = {
        "case": f"{in_language(each.case.case, language)} {each.case.place}".rstrip(),
        "what": each.reference.what,
        "inputs": translate(
            (_("printed {number}") if each.reference.printed else _("derived {number}")).format(number=number)
        ),
    }
    if each.trouble:
        return translate(
            _("{case}: {what}: not found: {sentence}").format(sentence=in_language(each.trouble, language), **words)
        )
    ours = f"{each.value:.10g} {number.partition(' ')[2]}".strip()
    if each.erratum:
        return translate(
            _("{case}: {what}: {inputs} is wrong, right is {right} (ours {ours}): {why}").format(
                ours=ours, right=each.reference.right, why=in_language(each.reference.why, language), **words
            )
        )
    return translate(
        (
            _("{case}: {what}: {inputs}, ours {ours} ({digits} last digits)")
            if each.ok
            else _("{case}: {what}: DIFFERS: {inputs}, ours {ours} ({digits} last digits)")
        ).format(ours=ours, digits=f"{each.digits:.2g}", **words)
    )


def validate(cases: Iterable[Published] | None = None, progress: Progress | None = None) -> Validation:
    """Compares reference numbers, printed by their sources or derived from them, with those found here.

    Args:
        cases: which; by default all that the package holds.
        progress: called with (cases done, cases).

    Returns:
        The comparisons, one per number. What cannot be found here counts as a difference, with the reason.
    """
    checks: list[Checked] = []
    every = list(published() if cases is None else cases)
    progress = progress or current_progress()
    for done, case in enumerate(every, 1):
        with reporting(None):
            checks += check(case)
        if progress is not None:
            progress(done, len(every))
    return Validation(tuple(checks))


def check(case: Published) -> list[Checked]:
    """The numbers of one case."""
    try:
        find = PROBES[case.probe](case.inputs)
    except LinkwrightError as error:
        return [Checked(case, each, math.nan, math.nan, math.inf, error.sentence) for each in case.numbers]
    return [_checked(case, each, find) for each in case.numbers]


def _checked(case: Published, reference: Reference, find: Callable[[str], float]) -> Checked:
    number, _unused, name = (reference.right or reference.text).partition(" ")
    factor = unit(name)[0] if name else 1.0
    expected = float(number)
    try:
        value = find(reference.what) / factor
    except (LinkwrightError, KeyError, StopIteration, AttributeError) as error:
        return Checked(case, reference, math.nan, expected, math.inf, f"{type(error).__name__}: {error}")
    gap = value - expected
    if name in ("deg", "rad"):
        turn = 2.0 * math.pi / factor
        gap = math.remainder(gap, turn)
        value = expected + gap
    return Checked(case, reference, value, expected, gap / last_digit(number))


def last_digit(number: str) -> float:
    """One unit of the last digit: 0.01 of ``3.14``, 1e-9 of ``7.41e-7``."""
    mantissa, _unused, power = number.lower().partition("e")
    return float(10.0 ** (int(power or 0) - len(mantissa.partition(".")[2])))


#: Units of the last printed digit by which a rounded number may differ.
ROUNDED = 0.51
#: Keys of ``expected`` that are numbers of the structure.
STRUCTURE = ("mobility", "grubler", "class")


#: Why a printed number is wrong, by the word of the case.
WHY = {
    "arc_cosine": _("the angle comes from an arc cosine, which cannot be negative"),
    "follows": _("follows from the rocker's wrong angle"),
    "own_energy": _("the printed state misses its own energy by 1.5e-10: its integration was off"),
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

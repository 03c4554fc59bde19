"""The text of a synthesis."""

from __future__ import annotations

from math import degrees

from linkwright.synthesis.result import Candidate, Synthesis
from linkwright.words import Say, has, speaker
from linkwright.words.characters import aligned_within
from linkwright.words.sentence import in_language

#: Share of the longest length, or of a radian, below which a deviation is rounding.
ROUNDING = 1e-12
COLUMNS = ("number", "type", "error", "worst", "defects", "input", "transmission", "ratio", "longest")


def title_said(found: Synthesis, tell: Say) -> str:
    """The task and how many candidates there are."""
    key = "synthesize.title_one" if len(found) == 1 else "synthesize.title"
    return tell(key, task=name_said(found.task, tell), count=len(found))


def report(found: Synthesis, language: str, width: int | None) -> list[str]:
    """Title, table of candidates, dimensions of each, counts and notes."""
    tell = speaker(language)
    rows = [[tell(f"synthesize.column.{name}") for name in COLUMNS]]
    rows += [_row(number, each, found.extent, tell) for number, each in enumerate(found.candidates, 1)]
    between = tell("finding.comma")
    lines = [
        title_said(found, tell),
        tell(f"synthesize.error.{found.error_name}"),
        "",
        *(line for each in aligned_within(rows, "><>><<>>>", width) for line in each),
        "",
    ]
    for number, each in enumerate(found.candidates, 1):
        lengths = between.join(
            f"{name_said(name, tell)} {_length(value)}" for name, value in each.linkage.lengths().items()
        )
        lines.append(tell("synthesize.lengths", number=number, lengths=lengths))
        if each.values:
            values = between.join(
                f"{name_said(name, tell)} = {value:.7g}" for name, value in each.values.items()
            )
            lines.append(tell("synthesize.values", values=values))
    if found.counts:
        lines += ["", counts_said(found, tell)]
    return lines + [in_language(sentence, language) for sentence in found.notes]


def counts_said(found: Synthesis, tell: Say) -> str:
    """How many solutions of which sort were found."""
    counts = (f"{name_said(name, tell)} {value}" for name, value in found.counts.items())
    return tell("synthesize.counts", counts=tell("finding.comma").join(counts))


def purpose(found: Synthesis, each: Candidate, language: str) -> str:
    """What a candidate is, for its model file."""
    tell = speaker(language)
    defects = (
        tell("synthesize.purpose_defects", defects=defects_text(each, tell))
        if each.defects
        else tell("synthesize.purpose_sound")
    )
    return tell(
        "synthesize.purpose",
        task=name_said(found.task, tell).replace("_", " "),
        error=error_texts(each)[0],
        transmission=f"{degrees(each.transmission_angle):.4g} deg",
        defects=defects,
    )


def defects_text(each: Candidate, tell: Say) -> str:
    """The defects of a candidate, or that there are none."""
    words = [tell(f"synthesize.defect.{name}") for name in each.defects]
    return tell("finding.comma").join(words) or tell("synthesize.no_defect")


def _row(number: int, each: Candidate, extent: float, tell: Say) -> list[str]:
    return [
        str(number),
        tell(f"synthesize.type.{each.grashof_type}"),
        *error_texts(each),
        defects_text(each, tell),
        tell("synthesize.turns" if each.turns else "synthesize.swings"),
        f"{degrees(each.transmission_angle):.2f}°",
        f"{each.link_ratio:.3g}",
        _longest(each.linkage.longest(), extent),
    ]


def _longest(longest: float, extent: float) -> str:
    """The longest distance on a link, and how many times the demand that is."""
    length = f"{longest * 1e3:.4g} mm" if longest < 1 else f"{longest:.4g} m"
    return f"{length} ({longest / extent:.3g}×)" if extent else length


def error_texts(each: Candidate) -> tuple[str, str]:
    """Error and worst deviation; zero where both are but rounding of the linkage's size."""
    least = ROUNDING * min(1.0, max(each.linkage.lengths().values()))
    exact = each.error <= least and each.worst <= least
    return ("0", "0") if exact else (f"{each.error:.4g}", f"{each.worst:.4g}")


def name_said(name: str, tell: Say) -> str:
    """The word for a task, a link, a value with its unit or a count; other names as they are."""
    stem, _, unit = name.partition(" ")
    numbered = stem.removeprefix("link")
    if numbered.isdecimal():
        return tell("synthesis_names.numbered_link", number=numbered)
    word = tell(f"synthesis_names.{stem}") if has(f"synthesis_names.{stem}") else stem
    return f"{word} {unit}".rstrip()


def _length(value: float) -> str:
    return f"{value * 1e3:.7g} mm" if value < 1 else f"{value:.7g} m"

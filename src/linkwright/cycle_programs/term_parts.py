"""The summaries that design numbers of many designs are made of: at limits, on strokes, and of signals."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from linkwright.cycle.summary import STROKES, TRUE_SPEED, Summary, one, output_of, signal_of
from linkwright.cycle_programs.joint_bends import rests
from linkwright.cycle_programs.limit_stages import extreme_name
from linkwright.cycle_programs.piece_summaries import SIDES
from linkwright.cycle_programs.terms import Term
from linkwright.engine.trace import Scalar, absolute, maximum
from linkwright.kinetostatics.load_site import limit_name
from linkwright.metrics import Analysis
from linkwright.metrics.true_speed import EFFORT, INERTIA

#: Kinds of summaries that are places of an output's limit.
PLACES = ("argmax", "argmin")
#: Those that an output has at its limits: the names of the cycle values, and their sides.
AT_LIMITS = {
    **{f"arg{side}": (limit_name, (side,)) for side in ("max", "min")},
    **{kind: (extreme_name, SIDES[kind]) for kind in ("max", "min", "range")},
}


def of_sides(kind: str, sides: Sequence[Scalar]) -> Scalar:
    """A summary from the sides on which it lies, of one design or of many."""
    if kind == "range":
        return sides[0] - sides[1]
    return maximum(absolute(sides[0]), absolute(sides[1])) if kind == "peak" else sides[0]


def least_of(parts: Iterable[Summary], on_strokes: Mapping[str, Summary]) -> dict[str, tuple[str, str]]:
    """Smallest values over the cycle that are those of the two strokes of some output."""
    ways: dict[tuple[str, str], list[str]] = {}
    for text, part in on_strokes.items():
        ways.setdefault((signal_of(part), output_of(part)), []).append(text)
    both = {signal: (texts[0], texts[1]) for (signal, _), texts in ways.items() if len(texts) == 2}
    return {f"{p.output} {p.kind}": both[p.output] for p in parts if p.kind == "min" and p.output in both}


def outputs_of(parts: Iterable[Summary]) -> Iterator[str]:
    """The outputs that summaries are found from, but for the places of limits."""
    for part in parts:
        if part.kind in TRUE_SPEED:
            yield from (EFFORT, INERTIA)
        elif part.kind in STROKES.values():
            yield signal_of(part)
        elif part.kind not in PLACES:
            yield part.output


def stroke_parts(texts: Iterable[str]) -> dict[str, Summary]:
    """The parts over the strokes of an output."""
    return {text: part for text in texts if (part := one(text)).kind in STROKES.values()}


def without_more_limits(each: Term, analysis: Analysis) -> bool:
    """Whether the outputs whose limits a term takes have no others than two, and rest nowhere."""
    parts = [one(text) for text in each.parts]
    words = [part.output for part in parts if part.kind in PLACES]
    words += [output_of(part) for part in stroke_parts(each.parts).values()]
    outputs = [output for output in map(analysis.output, words) if output is not None]
    moving = (output for output in outputs if not rests(analysis.motion, output))
    return len(outputs) == sum(len(analysis.limits(output)) == 2 for output in moving)


def without_limits(each: Term, analysis: Analysis) -> bool:
    """Whether a term takes neither limits nor strokes of an output, nor the true speed."""
    kinds = {one(text).kind for text in each.parts}
    return kinds.isdisjoint((*PLACES, *STROKES.values(), *TRUE_SPEED))

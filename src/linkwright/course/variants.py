"""Variants of a task: dimensions changed within limits, each solvable, sound and as hard as the others."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np

from linkwright.analysis import metrics
from linkwright.analysis.transmission_angle import TransmissionAngle
from linkwright.core.arguments import integer, require
from linkwright.core.attached import attached
from linkwright.core.progress import Progress, current_progress
from linkwright.core.quantity import number
from linkwright.course.mistakes import Consequence, Sheet
from linkwright.course.task import Question, Task, task
from linkwright.designs.ranges import BAD_SEED
from linkwright.errors import LinkwrightError, RequestError
from linkwright.files.model_file import load
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _

FORMAT = 1
#: Designs that are tried per variant, at most; digits of a changed dimension; positions of the cycle.
TRIES, DIGITS, STEPS = 60, 3, 90
#: Variants that can be asked for.
MOST = 1000
#: Smallest transmission angle that asks for no more, and how far a variant's may be below the model's, rad.
GOOD, SLACK = TransmissionAngle.limit, math.radians(5)
#: An answer may be so many times as large or as small as the model's.
SPREAD = 4.0
#: Why a design is no variant: it does not pass its cycle, transmits worse than the model, has answers of another sign
#: or size, shows other mistakes, or has the answers of another variant.
Failing = Literal["stuck", "flat", "unlike", "mistakes", "same"]
#: Answers of mistakes differ by so many tolerances from the right ones and from each other.
MIN_DIFFERENCE = 3.0
#: What variants do that cannot be used, and what helps.
TOO_FEW = {
    "stuck": _(
        "do not pass their cycle: give narrower limits in course.vary (it varies {vary}), or "
        "name fewer dimensions there, and such as need not fit each other"
    ),
    "flat": _(
        "transmit worse than the model: give narrower limits in course.vary (it varies {vary}), "
        "or start from a machine with a larger transmission angle"
    ),
    "unlike": _(
        "have answers of another sign or of quite another size than the model: move course.at to "
        "a position where the results are not near zero, or ask for others in course.ask"
    ),
    "mistakes": _(
        "show other mistakes than the model: give narrower limits in course.vary (it varies "
        "{vary}), or move course.at"
    ),
    "same": _(
        "have the same answers as others: name dimensions in course.vary on which the answers "
        "depend (it varies {vary}), or give wider limits"
    ),
}


@dataclass(frozen=True)
class Variant:
    """One variant: ``dimensions`` (SI) that were changed, right ``answers`` and those of mistakes, by question;
    ``transmission_angle``: the smallest over the cycle, rad, None where there is none."""

    number: int
    mechanism: Mechanism
    dimensions: Mapping[str, float]
    answers: tuple[float, ...]
    mistakes: tuple[tuple[Consequence, tuple[float, ...]], ...]
    transmission_angle: float | None = None


@dataclass(frozen=True)
class Difficulty:
    """``transmission_angle``: min and max among the variants' smallest, rad; ``ratio``: of an answer's largest
    to its smallest size, in the question where they differ most (angles left out)."""

    transmission_angle: tuple[float, float] | None
    ratio: float

    @property
    def sentence(self) -> Message:
        """The difficulty in one sentence."""
        ratio = f"{self.ratio:.3g}"
        if self.transmission_angle is None:
            return _("difficulty: an answer's sizes differ by {ratio} times at most", ratio=ratio)
        low, high = (number(each, "angle", 3) for each in self.transmission_angle)
        return _(
            "difficulty: smallest transmission angle {low}° to {high}°; an answer's sizes differ "
            "by {ratio} times at most",
            low=low,
            high=high,
            ratio=ratio,
        )


@dataclass(frozen=True)
class Variants:
    """All variants of a task; ``save`` writes sheets, key and questions."""

    task: Task
    seed: int
    variants: tuple[Variant, ...]

    @cached_property
    def drawings(self) -> dict[tuple[int, str, float], str]:
        """Drawings that were made, which several forms show, as SVG by number, language and diagonal."""
        return {}

    @property
    def name(self) -> str:
        """Name of the model."""
        return self.task.mechanism.name

    @property
    def difficulty(self) -> Difficulty:
        """How much the variants differ in what makes a task hard."""
        angles = [each.transmission_angle for each in self.variants if each.transmission_angle is not None]
        ratios = [
            max(abs(column)) / min(abs(column))
            for column, question in zip(
                np.array([v.answers for v in self.variants]).T, self.task.questions, strict=True
            )
            if question.unit != "°" and np.all(column)
        ]
        return Difficulty((min(angles), max(angles)) if angles else None, max(ratios, default=1.0))

    def key(self) -> dict[str, Any]:
        """The answer key as plain data, which ``grade`` reads."""
        return {
            "format": FORMAT,
            "name": self.name,
            "seed": self.seed,
            "tolerance": self.task.tolerance,
            "questions": [{"name": q.name, "column": q.output.heading, "unit": q.unit} for q in self.task.questions],
            "variants": [
                {
                    "number": each.number,
                    "dimensions": dict(each.dimensions),
                    "answers": list(each.answers),
                    "mistakes": [
                        {
                            "mistake": found.mistake,
                            "where": found.where,
                            "answers": [x if math.isfinite(x) else None for x in answers],
                        }
                        for found, answers in each.mistakes
                    ],
                }
                for each in self.variants
            ],
        }

    @attached
    def files(self, forms: Sequence[str] = (), language: str = "en") -> dict[str, bytes]:
        """Contents by path: ``sheets.pdf``, ``key.json``, ``key.csv``, ``prairielearn/…``, ``moodle.xml``, …"""
        raise NotImplementedError

    def save(
        self, folder: str | Path, forms: Sequence[str] = (), language: str = "en", *, force: bool = False
    ) -> list[Path]:
        """Write the files into a folder, each atomically; returns their paths.

        Raises LinkwrightError, and writes none, where one cannot be written or is there already unless ``force``.
        """
        from linkwright.filesystem import atomic_write, make_folder, refuse_target

        contents = {Path(folder) / name: content for name, content in self.files(forms, language).items()}
        for path in contents:
            make_folder(path.parent)
            refuse_target(path, force=force)
        return [atomic_write(path, content, force=force) for path, content in contents.items()]

    def key_text(self) -> str:
        """The answer key as JSON."""
        return json.dumps(self.key(), ensure_ascii=False, indent=1)

    def __repr__(self) -> str:
        return f"Variants({self.name!r}: {len(self.variants)} variants, {len(self.task.questions)} questions)"


def variants(
    machine: Mechanism | str | Path, count: int = 30, *, seed: int = 0, progress: Progress | None = None
) -> Variants:
    """Variants of a machine for a course.

    Args:
        machine: a mechanism, path or gallery name; its section ``course`` says what changes and what is asked.
        count: how many.
        seed: of the random numbers; the same seed gives the same variants.
        progress: called with (variants found, variants).

    Returns:
        The variants. Each passes its cycle, has a transmission angle hardly below the model's and answers of the same
        signs and of like size, and shows the same mistakes.

    Raises:
        LinkwrightError: settings that make no sense; fewer variants than asked for within the limits.
    """
    require(machine, Mechanism, str, PathLike)
    count, seed = integer("count", count), integer("seed", seed)
    if not 1 <= count <= MOST:
        raise RequestError(_("{count} variants cannot be made; give 1 to 1000", code="course.bad_count", count=count))
    if seed < 0:
        raise RequestError(BAD_SEED.format(seed=seed))
    asked = task(machine if isinstance(machine, Mechanism) else load(str(machine)))
    rng = np.random.default_rng(seed)
    model = _solved(asked, 0, {}, asked.mechanism)
    bar = _transmission(asked.mechanism)
    found: list[Variant] = []
    failed = Counter[str]()
    progress = progress or current_progress()
    for _unused in range(TRIES * count if asked.ranges else 0):
        changes = {name: float(f"{rng.uniform(*limits):.{DIGITS}g}") for name, limits in asked.ranges.items()}
        fresh = _sound(asked, len(found) + 1, changes, model, bar)
        if isinstance(fresh, Variant) and any(_same(fresh, each) for each in found):
            fresh = "same"
        if isinstance(fresh, str):
            failed[fresh] += 1
            continue
        found.append(fresh)
        if progress is not None:
            progress(len(found), count)
        if len(found) == count:
            return Variants(asked, seed, tuple(found))
    raise _too_few(asked, len(found), count, failed)


def _too_few(asked: Task, found: int, count: int, failed: Counter[str]) -> LinkwrightError:
    """The error where the limits give fewer variants than asked for, with what mostly stood in the way."""
    if not asked.ranges:
        known = [name for name, value in asked.mechanism.dimensions().items() if value]
        return LinkwrightError(
            _(
                "there is no size of a link to vary; name what changes in course.vary (8 % of one of {known})",
                code="course.nothing_varies",
                known=tuple(known),
            )
        )
    ((why, times),) = failed.most_common(1)
    remedy = TOO_FEW[why].format(vary=tuple(asked.ranges))
    return LinkwrightError(
        _(
            "only {found} of {count} variants were found in {tried} tries; {times} of these {remedy}",
            code="course.too_few",
            found=found,
            count=count,
            tried=TRIES * count,
            times=times,
            remedy=remedy,
        )
    )


def _same(fresh: Variant, other: Variant) -> bool:
    """Whether two variants have the same answers, so that one can be copied from the other."""
    return all(math.isclose(a, b, rel_tol=1e-6) for a, b in zip(fresh.answers, other.answers, strict=True))


def _transmission(mechanism: Mechanism) -> float | None:
    """Smallest transmission angle over the cycle, None where there is none; raises where the cycle is not passed."""
    motion = solve_motion(mechanism, steps=STEPS)
    rows = metrics(motion, ["transmission_angle"]).rows if _transmits(motion) else ()
    return min((row.value for row in rows), default=None)


def _transmits(motion: Any) -> bool:
    from linkwright.analysis.base import METRICS

    return METRICS["transmission_angle"]().applies(motion)


def _sound(
    asked: Task, number: int, changes: Mapping[str, float], model: Variant, bar: float | None
) -> Variant | Failing:
    """A variant, or why it is not as sound or as hard as the model."""
    try:
        mechanism = asked.mechanism.with_dimensions(changes)
        angle = _transmission(mechanism)
    except LinkwrightError:
        return "stuck"
    if bar is not None and (angle is None or angle < min(bar, GOOD) - SLACK):
        return "flat"
    fresh = replace(_solved(asked, number, changes, mechanism), transmission_angle=angle)
    consistent = all(
        _indistinguishable(a, b, q) for a, b, q in zip(fresh.answers, model.answers, asked.questions, strict=True)
    )
    if not consistent:
        return "unlike"
    shown = {each.mistake for each, _unused in fresh.mistakes}
    return fresh if shown == {each.mistake for each, _unused in model.mistakes} else "mistakes"


def _indistinguishable(a: float, b: float, question: Question) -> bool:
    if question.unit == "°":
        return abs(math.remainder(a - b, 360.0)) < 45.0
    return a * b > 0.0 and 1.0 / SPREAD < a / b < SPREAD


def _solved(asked: Task, number: int, changes: Mapping[str, float], mechanism: Mechanism) -> Variant:
    """The answers of a design and of its mistakes; those that no answer shows are left out."""
    sheet = Sheet(mechanism, asked.at)
    outputs = [question.output for question in asked.questions]
    right = tuple(sheet.values[output] for output in outputs)
    held = []
    for each in sheet.consequences():
        answers = tuple(each.values.get(output, math.nan) for output in outputs)
        if any(
            not close(a, b, MIN_DIFFERENCE * asked.tolerance, q.unit)
            for a, b, q in zip(answers, right, asked.questions, strict=True)
        ):
            held.append((each, answers))
    return Variant(number, mechanism, dict(changes), right, tuple(held))


def close(answer: float, right: float, tolerance: float, unit: str) -> bool:
    """Whether an answer is right within a relative tolerance; of angles over full turns, a hundredth being 0.5°."""
    if not math.isfinite(right):
        return not math.isfinite(answer)
    if not math.isfinite(answer):
        return False
    if unit == "°":
        return abs(math.remainder(answer - right, 360.0)) <= 50.0 * tolerance
    return abs(answer - right) <= tolerance * abs(right)

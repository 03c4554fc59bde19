"""The written evaluation of a comparison, built from its numbers, in the reader's language."""

from __future__ import annotations

import numpy as np

from linkwright.core.quantity import SHOWN, shown
from linkwright.core.table import Amount, Cell, Table
from linkwright.designs.alternatives import EFFORTS, Alternative
from linkwright.designs.compare import Comparison, Rank, Row
from linkwright.designs.criteria import criterion
from linkwright.errors import speaker
from linkwright.words import Translate, _, language_of

#: Distance from a change point, as a share of the cycle, at which the direction of an infinite reaction is reported.
NEIGHBOUR_SHARE = 1e-3
#: Share of its largest value up to which a reaction's minimum counts as zero.
PASSING = 1e-9
#: Reasons reported per alternative.
REASONS = 3
MARK = "*"


def value_text(value: float, dimension: str) -> str:
    """A value with its unit for a sentence: four digits, large numbers written out."""
    size = abs(value) * SHOWN.get(dimension, ("", 1.0))[1]
    return shown(value, dimension, 4 if size < 1e4 else 6)


def tables(comparison: Comparison, language: str = "en") -> tuple[Table, ...]:
    """The table, criteria in rows, alternatives in columns, the best values marked; the ranking, the evaluation, the
    notes."""
    translate = speaker(language)
    rows: list[list[Cell]] = []
    for row in comparison.rows:
        stars = [f" {MARK}" if index in row.best else "  " for index in range(len(row.values))]
        values = zip(row.values, stars, strict=True)
        cells = ("—  " if v is None else Amount(v.value, v.dimension, 5, mark=mark) for v, mark in values)
        rows.append([row.criterion.label(language), *cells])
    head = [_("metric"), *comparison.labels]
    title = _("Ranking (mean over the metrics of how near each comes to the best, 100 = best in all)")
    return (
        Table(head, rows, notes=[_("* best of the alternatives")]),
        Table(title=title, notes=ranking(comparison, translate)),
        Table(title=_("Evaluation"), notes=sentences(comparison, language)),
        Table(notes=comparison.notes),
    )


def ranking(comparison: Comparison, translate: Translate) -> list[str]:
    """A line with the score of every alternative, best first, and what decided."""
    if not comparison.judged:
        return [translate(_("None of the metrics has a better direction, so there is no ranking."))]
    lines = []
    for rank in comparison.ranking:
        lines.append(
            translate(
                _(
                    "{place}. {label}: {score} of 100",
                    place=rank.place,
                    label=rank.label,
                    score=f"{100 * rank.score:.0f}",
                )
            )
        )
        lines += [f"   {reason}" for reason in _reasons(comparison, rank, translate)]
    return lines


def _reasons(comparison: Comparison, rank: Rank, translate: Translate) -> list[str]:
    """What an alternative is best in, and what costs it most against the best."""
    best = _best_in(comparison, rank, translate)
    found = [translate(_("best in: {names}", names=best))] if best else []
    costly = sorted(
        (row for row in comparison.judged if row.score(rank.index) < 1.0 - 1e-9),
        key=lambda row: -row.weight * (1.0 - row.score(rank.index)),
    )
    return found + [_against(comparison, row, rank.index, translate) for row in costly[:REASONS]]


def _against(comparison: Comparison, row: Row, index: int, translate: Translate) -> str:
    """How an alternative compares with the best one in a metric."""
    winner = row.best[0]
    mine, theirs = row.values[index], row.values[winner]
    assert mine is not None and theirs is not None
    ratio = abs(mine.value / theirs.value) if theirs.value else float("inf")
    return translate(
        (
            _("{name}: {mine}, against {theirs} of {other} ({ratio} times)")
            if ratio < float("inf")
            else _("{name}: {mine}, against {theirs} of {other}")
        ).format(
            name=row.criterion.label(language_of(translate)),
            mine=value_text(mine.value, mine.dimension),
            theirs=value_text(theirs.value, theirs.dimension),
            other=comparison.labels[winner],
            ratio=f"{ratio:.3g}",
        )
    )


def evaluation(comparison: Comparison, language: str = "en") -> str:
    """A written evaluation."""
    return "\n".join(sentences(comparison, language))


def sentences(comparison: Comparison, language: str) -> list[str]:
    """Sentences about the motion, the pivot, the torque, the flywheel, and a verdict."""
    translate = speaker(language)
    subjects = {_("Motion: {parts}."): _motion}
    if any(each.loaded for each in comparison.alternatives):
        subjects |= {
            _("Pivot reaction: {parts}."): _pivot,
            _("Balancing torque: {parts}."): _torque,
            _("Flywheel on the crank for a speed fluctuation of {fluctuation}: {parts}."): _flywheel,
        }
    found = []
    for subject, part in subjects.items():
        parts = translate(_("; ")).join(part(each, translate) for each in comparison.alternatives)
        found.append(translate(subject.format(parts=parts, fluctuation=f"{comparison.fluctuation:g}")))
    return [*found, *_verdict(comparison, translate)]


def _motion(each: Alternative, translate: Translate) -> str:
    return translate(
        _(
            "in {label} the output {output} travels {travel}, at most {rate} fast, with accelerations up to {second}",
            label=each.label,
            output=str(each.output),
            travel=_measured(each, "travel") or value_text(each.way, each.output.dimension),
            rate=_measured(each, "output_velocity"),
            second=_measured(each, "output_acceleration"),
        )
    )


def _measured(each: Alternative, name: str) -> str:
    """A number of the comparison for a sentence; empty where there is none."""
    found = criterion(name).measure(each)
    return "" if found is None else value_text(found.value, found.dimension)


def _pivot(each: Alternative, translate: Translate) -> str:
    joint, link = each.pivot
    highest, lowest = map(each.analysis.part, each.reactions)
    force = each.forces_at(highest.time).reaction(joint, on=link)[0]
    if not np.isfinite(force).all():  # on a change point: the value next to it
        neighbour = highest.time - NEIGHBOUR_SHARE * (each.motion.positions.period or 0.0)
        force = each.forces_at(neighbour).reaction(joint, on=link)[0]
    return translate(
        _(
            "pivot {joint} of {label} carries at most {most} (at input {at}, direction "
            "{direction}) and at least {least}",
            label=each.label,
            joint=joint,
            most=value_text(highest.value, "force"),
            least=value_text(lowest.value if lowest.value > PASSING * highest.value else 0.0, "force"),
            direction=value_text(float(np.arctan2(force[1], force[0])), "angle"),
            at=value_text(highest.input, each.analysis.input_dimension),
        )
    )


def _torque(each: Alternative, translate: Translate) -> str:
    high, low, root = (each.analysis.part(effort).value for effort in EFFORTS)
    dimension = "torque" if each.analysis.input_dimension == "angle" else "force"
    speed = np.abs(next(iter(each.motion.positions.coordinates.values()))[1]).max()
    gap = float(np.abs(each.forces.power_residual).max() / speed) if speed > 0.0 else 0.0
    return translate(
        _(
            "that of {label} lies between {low} and {high}, root mean square {root}; found from "
            "the joint forces and from the powers it agrees within {gap}",
            label=each.label,
            low=value_text(low, dimension),
            high=value_text(high, dimension),
            root=value_text(root, dimension),
            gap=shown(gap, dimension, 2),
        )
    )


def _flywheel(each: Alternative, translate: Translate) -> str:
    names = {"inertia": "flywheel", "energy": "energy_fluctuation", "power": "mean_power"}
    numbers = {word: _measured(each, name) for word, name in names.items()}
    if not numbers["inertia"]:
        return translate(_("for {label} there is none to lay out", label=each.label))
    return translate(
        _(
            "{label} has an energy fluctuation of {energy} at a mean power of {power} and needs {inertia}",
            label=each.label,
            **numbers,
        )
    )


def _verdict(comparison: Comparison, translate: Translate) -> list[str]:
    """Who comes first, by what, and what speaks for the others."""
    if not comparison.judged:
        return []
    first, *others = comparison.ranking
    names = _best_in(comparison, first, translate)
    lines = [
        translate(
            _(
                "Verdict: {label} comes first ({score} of 100); it is best in: {names}.",
                label=first.label,
                score=f"{100 * first.score:.0f}",
                names=names or "—",
            )
        )
    ]
    for rank in others:
        names = _best_in(comparison, rank, translate)
        verdict = (
            _("{label} ({score} of 100) is to be preferred where this matters most: {names}.")
            if names
            else _("{label} ({score} of 100) is best in none of the metrics.")
        )
        lines.append(translate(verdict.format(label=rank.label, score=f"{100 * rank.score:.0f}", names=names)))
    return lines


def _best_in(comparison: Comparison, rank: Rank, translate: Translate) -> str:
    """The criteria in which an alternative is best."""
    best = [row.criterion.label(language_of(translate)) for row in comparison.judged if rank.index in row.best]
    return translate(_(", ")).join(best)

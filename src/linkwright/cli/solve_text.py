"""Results of ``solve`` as a page of text: the columns that fit, their table, and the notes below it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from rich.text import Text

from linkwright.cli.options import Options
from linkwright.cli.session import Session, bold, styled_lines
from linkwright.cli.solving import Solved, closeness, extremes_of, input_text, largest_reactions, leading, point_keys
from linkwright.core.arrays import largest, runs
from linkwright.core.table import Column, Table
from linkwright.kinetostatics.forces import Forces, reaction_pairs, rubbing_guides
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology import Structure
from linkwright.topology.analysis import turned_against
from linkwright.words import Translate, _, language_of, pgettext
from linkwright.words.characters import GAP, cells, padded
from linkwright.words.message import in_language

if TYPE_CHECKING:
    from linkwright.worked_solutions.solution import Worked

LINK = ("angle", "angular_velocity", "angular_acceleration")
GUIDE = ("displacement", "velocity", "acceleration")
POINT = tuple(f"{kind}.{axis}" for kind in ("position", "velocity", "acceleration") for axis in "xy")


def report(solved: Solved, options: Options, session: Session) -> list[str | Text]:
    """Lines of heading, table, largest forces, checks, notes and warnings."""
    translate, degrees = session.translate, not options.si
    lines: list[str | Text] = [bold(solved.motion.mechanism.name), _structure_line(solved, translate)]
    lines += turned_against(solved.motion.structure, translate)
    for paragraph in (
        *_table(solved, options, session),
        _extremes(solved, translate, degrees=degrees),
        _checks(solved, translate),
        styled_lines(closeness(solved.motion, session.language)),
        _failures(solved, translate, session.language, degrees=degrees),
        [translate(_("Note: {text}", text=in_language(note, session.language))) for note in solved.notes],
        [translate(_("Note: {text}", text=solved.proof.explain(session.language)))] if options.prove else [],
        [session.finding(finding) for finding in solved.warnings],
    ):
        lines += ["", *paragraph] if paragraph else []
    return lines


def course_lines(solved: Solved, options: Options, session: Session) -> list[str | Text]:
    """Lines of the table, of the largest forces and of the checks."""
    lines: list[str | Text] = []
    for paragraph in (
        *_table(solved, options, session),
        _extremes(solved, session.translate, degrees=not options.si),
        _checks(solved, session.translate),
    ):
        lines += ["", *paragraph] if lines and paragraph else paragraph
    return lines


def worked_pages(solved: Solved, options: Options, session: Session) -> list[Worked]:
    """The worked solution of the positions that were named, or of the first one."""
    from linkwright.worked_solutions.solution import worked

    rows = solved.rows if options.at or options.times else solved.rows[:1]
    source = solved.motion if solved.forces is None else solved.forces
    return [worked(source, int(row), language=session.language) for row in rows]


def _table(solved: Solved, options: Options, session: Session) -> tuple[list[Text], list[str]]:
    """Lines of the table, and of what found no place in it; nothing for a structure at rest."""
    if not solved.motion.inputs and not options.columns:
        return [], []
    shown, left_out = _chosen(solved, options, session)
    lines = table(_headed(shown, solved, session.translate), session.translate)
    return styled_lines(lines, heads=len(lines) - len(solved.rows)), [left_out] if left_out else []


def _structure_line(solved: Solved, translate: Translate) -> str:
    structure = solved.motion.structure
    return translate(_("mobility {mobility}: {chain}", mobility=structure.mobility, chain=structure.chain))


def _chosen(solved: Solved, options: Options, session: Session) -> tuple[list[Column], str]:
    """Columns of the table, and a sentence on those that found no place."""
    found = (Column.of(*item) for item in solved.results().items())
    columns = {column.name: column if options.si else column.in_degrees() for column in found}
    first = leading(solved, columns)
    if options.columns:
        points = point_keys(solved.motion, options.points)
        found = (Column.of(*item) for item in solved.picked([*options.columns, *points]).items())
        picked = [column if options.si else column.in_degrees() for column in found]
        names = {column.name for column in picked}
        return [*(column for column in first if column.name not in names), *picked], ""
    return _fitted(solved, columns, first, options, session)


def _fitted(
    solved: Solved, columns: Mapping[str, Column], first: list[Column], options: Options, session: Session
) -> tuple[list[Column], str]:
    """The points that were asked for or the first output, then efforts and links as the width allows."""
    last = efforts(solved, columns)
    asked = point_keys(solved.motion, options.points)
    ranked = blocks(solved, columns, asked)
    minimum = max(len(asked), 1)
    ranked = [*ranked[:minimum], *([last] if last else []), *ranked[minimum:]]
    fitting_blocks = fitting(first, ranked, session.width, session.translate, minimum=minimum)
    names = {column.name for block in fitting_blocks for column in block}
    efforts_shown = [column for column in last if column.name in names]
    shown = [column for column in columns.values() if column.name in names and column.quantity != "effort"]
    left = list(dict.fromkeys(block[0].owner for block in ranked if block[0].name not in names))
    if not left:
        return [*first, *shown, *efforts_shown], ""
    names_left = session.translate(_(", ")).join(left)
    sentence = session.translate(
        _(
            'Left out for width: {names}. See them with --columns "{one}.*"; --output FILE.csv '
            "writes all {total} columns.",
            names=names_left,
            one=left[0],
            total=len(columns),
        )
    )
    return [*first, *shown, *efforts_shown], sentence


def _headed(columns: Sequence[Column], solved: Solved, translate: Translate) -> list[Column]:
    """Columns with the words that the reader sees for drivers and time."""
    inputs = solved.motion.inputs
    found = []
    for column in columns:
        if column.name in inputs:
            column = replace(column, owner=translate(_("input")), quantity="" if len(inputs) == 1 else column.name)
        elif column.quantity == "effort" and len(inputs) == 1:
            column = replace(
                column, owner=translate(_("driver")), quantity="torque" if "m" in column.unit else "force"
            )
        found.append(column)
    return found


def efforts(solved: Solved, columns: Mapping[str, Column]) -> list[Column]:
    """What the drivers must supply."""
    if solved.forces is None:
        return []
    drivers = solved.motion.mechanism.drivers
    names = [f"{name}.effort" for name, driver in drivers.items() if driver.law.prescribed]
    return [replace(columns[name], scale=solved.force_scale) for name in names]


def blocks(solved: Solved, columns: Mapping[str, Column], points: Iterable[str]) -> list[list[Column]]:
    """Columns that belong together, what matters most first: points asked for, outputs, then the other links."""
    mechanism, structure = solved.motion.mechanism, solved.motion.structure
    found = [[columns[f"{point}.{kind}"] for kind in POINT if f"{point}.{kind}" in columns] for point in points]
    for joint in _output_guides(mechanism):
        found.append([columns[f"{joint}.{kind}"] for kind in GUIDE])
    for link in _ranked_links(mechanism, structure):
        found.append([columns[f"{link}.{kind}"] for kind in LINK])
    return [block for block in found if block]


def _output_guides(mechanism: Mechanism) -> list[str]:
    """Guides on the frame that no driver moves."""
    driven = {driver.joint for driver in mechanism.drivers.values()}
    return [
        name
        for name, joint in mechanism.guides.items()
        if mechanism.grounded & set(joint.joined) and name not in driven
    ]


def _ranked_links(mechanism: Mechanism, structure: Structure) -> list[str]:
    """Links that turn: those joined to the frame, the last solved first; then the others; driven ones last. Parts of
    cylinders, which two points stand for, are none of them."""
    every = [link for group in reversed(structure.groups) for link in reversed(group.links)]
    order = [link for link in every if link not in mechanism.cylinder_parts]
    driven = {link for driver in mechanism.drivers.values() for link in (driver.link, driver.relative_to)}
    at_frame = [joint for joint in mechanism.joints.values() if mechanism.grounded & set(joint.joined)]
    sliding = {link for joint in at_frame if joint.coordinate == "slide" for link in joint.joined}
    hinged = {link for joint in at_frame for link in joint.joined}

    def rank(link: str) -> int:
        return 2 if link in driven else 0 if link in hinged else 1

    return sorted((link for link in order if link not in sliding | mechanism.grounded), key=rank)


def fitting(
    fixed: Sequence[Column], blocks: Sequence[Sequence[Column]], width: int, translate: Translate, *, minimum: int
) -> list[list[Column]]:
    """The first blocks (columns that belong together) that fit next to the fixed ones; at least ``minimum``."""
    used = total_width(fixed, translate)
    chosen: list[list[Column]] = []
    for block in blocks:
        wide = len(GAP) + total_width(block, translate)
        if len(chosen) >= minimum and used + wide > width:
            break
        used += wide
        chosen.append(list(block))
    return chosen


def total_width(columns: Sequence[Column], translate: Translate) -> int:
    """Cells that columns take side by side, under their owners and words."""
    widths = _widths(columns, translate)
    _owner_line(columns, widths)
    return sum(widths) + len(GAP) * (len(widths) - 1)


#: What columns are called under their owners' names, by their quantities.
QUANTITIES: dict[str, str] = {
    "time": _("time"),
    "angle": _("angle"),
    "angular_velocity": pgettext("solve", "velocity"),
    "angular_acceleration": pgettext("solve", "acceleration"),
    "displacement": _("displacement"),
    "velocity": _("velocity"),
    "acceleration": _("acceleration"),
    "direction": pgettext("solve", "direction"),
    "couple": _("couple"),
    "effort": _("effort"),
    "torque": _("torque"),
    "force": _("force"),
    "": "",
    "position.x": "x",
    "position.y": "y",
    "velocity.x": "vx",
    "velocity.y": "vy",
    "acceleration.x": "ax",
    "acceleration.y": "ay",
    "x": "Fx",
    "y": "Fy",
    "magnitude": "F",
}


def _widths(columns: Sequence[Column], translate: Translate) -> list[int]:
    return [
        max(cells(text) for text in [*column.cells(), label(column, translate), column.unit]) for column in columns
    ]


def label(column: Column, translate: Translate) -> str:
    """What a column is called under its owner's name."""
    return in_language(QUANTITIES.get(column.quantity, column.quantity), language_of(translate))


def table(columns: Sequence[Column], translate: Translate) -> list[str]:
    """Lines of the table: owners, quantities, units, values."""
    labels = [label(column, translate) for column in columns]
    cells = [column.cells() for column in columns]
    widths = _widths(columns, translate)
    owners = _owner_line(columns, widths)
    lines = [owners] if owners.strip() else []
    for row in [labels, [column.unit for column in columns], *zip(*cells, strict=True)]:
        lines.append(GAP.join(padded(text, wide, ">") for text, wide in zip(row, widths, strict=True)).rstrip())
    return lines


def _owner_line(columns: Sequence[Column], widths: list[int]) -> str:
    """Names over the columns that belong to them; a name wider than its columns widens the first of them."""
    parts: list[str] = []
    start = 0
    while start < len(columns):
        end = start
        while end < len(columns) and columns[end].owner == columns[start].owner:
            end += 1
        owner = columns[start].owner
        span = sum(widths[start:end]) + len(GAP) * (end - start - 1)
        lacking = cells(owner) - span
        if lacking > 0:
            widths[start] += lacking
            span += lacking
        wide = owner and end - start > 1 and span >= cells(owner) + 4
        rule = f" {owner} " if wide else owner
        parts.append(_ruled(rule, span) if rule != owner else padded(owner, span, ">"))
        start = end
    return GAP.join(parts).rstrip()


def _ruled(text: str, span: int) -> str:
    """A name with lines to both sides, over the columns that it heads."""
    space = span - cells(text)
    return "─" * (space // 2) + text + "─" * (space - space // 2)


def _extremes(solved: Solved, translate: Translate, *, degrees: bool) -> list[str]:
    """The largest force in every joint and the range of every driver's effort.

    Over the full cycle these are found between the positions, as the metrics are; of chosen positions, or of
    a cycle that is not passed, they are those of the positions, and the title says so.
    """
    forces = solved.forces
    if forces is None or not solved.motion.ok.any():
        return []
    several = solved.motion.steps > 1
    title = (
        _("Largest joint forces over the cycle (between the positions, too)")
        if solved.between
        else _("Largest joint forces, over {count} positions", count=int(solved.motion.ok.sum()))
        if several
        else pgettext("solve", "Joint forces")
    )
    pairs = reaction_pairs(forces.mechanism)
    peaks = largest_reactions(solved, degrees=degrees)
    heads = (_("joint"), pgettext("solve", "on"), _("force N"), "Fx N", "Fy N", pgettext("solve", "at input"))
    rows: list[tuple[str, ...]] = [heads]
    for (joint, link), peak in zip(pairs, peaks, strict=True):
        force = peak.forces.reaction(joint, on=link)[peak.row]
        number = Column("", "", "N", np.array([peak.value]), solved.force_scale).text
        rows.append((joint, link, number(peak.value), number(force[0]), number(force[1]), peak.input))
    wide = 6 if several else 5
    rubbing = ", ".join(rubbing_guides(forces.mechanism))
    guides = _(
        "The force in a guide is what presses its parts together; its friction, μ times "
        "that, along the guide, comes on top: {names}",
        names=rubbing,
    )
    notes = [*([guides] if rubbing else []), *_efforts(solved, forces, translate, degrees=degrees)]
    return Table((), [row[:wide] for row in rows], "<<>>>>", title, notes).lines(language_of(translate))


def _efforts(solved: Solved, forces: Forces, translate: Translate, *, degrees: bool) -> list[str]:
    """Largest, smallest and mean effort of every driver; the mean over a closed cycle counts its end once."""
    rows = []
    for key, driver in forces.mechanism.drivers.items():
        if not driver.law.prescribed:
            continue
        values = forces.driver_effort(key)
        name = key if len(forces.mechanism.drivers) > 1 else translate(_("driver"))
        if not np.isfinite(values).any():
            continue
        unit = "N·m" if forces.mechanism.joints[driver.joint].coordinate == "turn" else "N"
        number = Column("", "", unit, values, solved.force_scale).text
        if len(values) == 1:
            rows.append(translate(_("{name}: {value} {unit}", name=name, value=number(values[0]), unit=unit)))
            continue
        effort = partial(Forces.driver_effort, name=key)
        high, low = extremes_of(solved, [(effort, "max"), (effort, "min")], degrees)
        at = _("at {place}")
        sentence = translate(
            _(
                "{name}: from {low} {unit} {low_at} to {high} {unit} {high_at}",
                name=name,
                high=number(high.value),
                low=number(low.value),
                unit=unit,
                high_at=at.format(place=high.input),
                low_at=at.format(place=low.input),
            )
        )
        if solved.between and solved.motion.positions.closed:
            sentence += translate(_(", mean {mean} {unit}", mean=number(solved.analysis.mean_of(effort)), unit=unit))
        rows.append(sentence)
    return rows


def _checks(solved: Solved, translate: Translate) -> list[str]:
    """The residuals that belong to the forces."""
    forces = solved.forces
    if forces is None or not solved.motion.ok.any():
        return []
    power = largest(forces.power_residual)
    lines = []
    if any(driver.law.prescribed for driver in forces.mechanism.drivers.values()):
        lines.append(
            translate(
                _(
                    "Check: driver power from joint forces and from all powers differ by {residual} W at "
                    "most (of {size} W)",
                    residual=f"{power:.1e}",
                    size=f"{largest(forces.power):.3g}",
                )
            )
        )
    size = solved.force_scale
    lines.append(
        translate(
            _(
                "Check: forces on every link balance within {residual} N (of {size} N)",
                residual=f"{largest(forces.balance_residual):.1e}",
                size=f"{size:.3g}",
            )
        )
    )
    return lines


def _failures(solved: Solved, translate: Translate, language: str, *, degrees: bool) -> list[str]:
    """Stretches of positions that are not reached, each with the sentence of its first position."""
    ok = solved.motion.ok
    failed = ~ok
    if not failed.any():
        return []
    lines = [translate(_("Not reached: {count} of {of} positions", count=int(failed.sum()), of=len(ok)))]
    outcomes = solved.motion.outcomes
    for run in runs(failed):
        first, last = (input_text(solved.motion, place, degrees=degrees) for place in run)
        where = first if first == last else f"{first} … {last}"
        lines.append(f"  {where}: {outcomes[run[0]].translate(language)}")
    return lines

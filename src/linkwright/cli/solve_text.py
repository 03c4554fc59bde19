"""Results of ``solve`` as a page of text."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import replace

from linkwright.cli import solve_remarks
from linkwright.cli.columns import Column, fitting, table
from linkwright.cli.session import Session
from linkwright.cli.solve_columns import blocks, efforts, leading, point_keys
from linkwright.cli.solving import Solved
from linkwright.structure.analysis import turned_against
from linkwright.words import Say, _
from linkwright.words.sentence import in_language


def report(solved: Solved, options: argparse.Namespace, session: Session) -> list[str]:
    """Lines of heading, table, largest forces, checks, notes and warnings."""
    say, degrees = session.say, not options.si
    lines = [session.strong(solved.motion.mechanism.name), _structure_line(solved, say)]
    lines += turned_against(solved.motion.structure, say)
    for paragraph in (
        *_table(solved, options, session),
        solve_remarks.extremes(solved, say, degrees=degrees),
        solve_remarks.checks(solved, say),
        session.table(solve_remarks.closeness(solved.motion, session.language), heads=0),
        solve_remarks.failures(solved, say, session.language, degrees=degrees),
        [say(_("Note: {text}", text=in_language(note, session.language))) for note in solved.notes],
        [say(_("Note: {text}", text=solved.proof.explain(session.language)))] if options.prove else [],
        [session.finding(finding) for finding in solved.warnings],
    ):
        lines += ["", *paragraph] if paragraph else []
    return lines


def _table(solved: Solved, options: argparse.Namespace, session: Session) -> tuple[list[str], list[str]]:
    """Lines of the table, and of what found no place in it; nothing for a structure at rest."""
    if not solved.motion.inputs and not options.columns:
        return [], []
    shown, left_out = _chosen(solved, options, session)
    lines = table(_headed(shown, solved, session.say), session.say)
    return session.table(lines, heads=len(lines) - len(solved.rows)), [left_out] if left_out else []


def _structure_line(solved: Solved, say: Say) -> str:
    structure = solved.motion.structure
    return say(_("mobility {mobility}: {chain}", mobility=structure.mobility, chain=structure.chain))


def _chosen(solved: Solved, options: argparse.Namespace, session: Session) -> tuple[list[Column], str]:
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
    solved: Solved,
    columns: Mapping[str, Column],
    first: list[Column],
    options: argparse.Namespace,
    session: Session,
) -> tuple[list[Column], str]:
    """The points that were asked for or the first output, then efforts and links as the width allows."""
    last = efforts(solved, columns)
    asked = point_keys(solved.motion, options.points)
    ranked = blocks(solved, columns, asked)
    least = max(len(asked), 1)
    ranked = [*ranked[:least], *([last] if last else []), *ranked[least:]]
    kept = fitting(first, ranked, session.width, session.say, least=least)
    names = {column.name for block in kept for column in block}
    efforts_shown = [column for column in last if column.name in names]
    shown = [column for column in columns.values() if column.name in names and column.quantity != "effort"]
    left = list(dict.fromkeys(block[0].owner for block in ranked if block[0].name not in names))
    if not left:
        return [*first, *shown, *efforts_shown], ""
    names_left = session.say(_(", ")).join(left)
    sentence = session.say(
        _(
            'Left out for width: {names}. See them with --columns "{one}.*"; --output FILE.csv '
            "writes all {total} columns.",
            names=names_left,
            one=left[0],
            total=len(columns),
        )
    )
    return [*first, *shown, *efforts_shown], sentence


def _headed(columns: Sequence[Column], solved: Solved, say: Say) -> list[Column]:
    """Columns with the words that the reader sees for drivers and time."""
    inputs = solved.motion.inputs
    found = []
    for column in columns:
        if column.name in inputs:
            column = replace(column, owner=say(_("input")), quantity="" if len(inputs) == 1 else column.name)
        elif column.quantity == "effort" and len(inputs) == 1:
            column = replace(
                column, owner=say(_("driver")), quantity="torque" if "m" in column.unit else "force"
            )
        found.append(column)
    return found

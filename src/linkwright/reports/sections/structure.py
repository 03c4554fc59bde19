"""Structure analysis: mobility with the formula and its numbers, groups drawn separately, class."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.core.table import Cell, Table
from linkwright.equations.reading import sides
from linkwright.errors import LinkwrightError
from linkwright.joints.base import JOINTS
from linkwright.kinematics.rank_of_motion import rank_sentence
from linkwright.reports.document import Block, Figure, Formula, Paragraph, literal, printed, symbols
from linkwright.reports.group_pictures import group_picture, to_one_scale
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.section import section
from linkwright.topology.analysis import numeral
from linkwright.topology.mobility import lower_pair_counts
from linkwright.words import _, pgettext
from linkwright.words.sentence import in_language


@section("structure", _("Structure analysis"), 3.0)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Mobility, Assur groups in solving order, class of the mechanism."""
    say, built = case.say, case.structure
    first, *rest = (in_language(each, case.language) for each in built.tables(case.language)[0].notes)
    yield Paragraph(symbols(first) + say(_(".")))
    yield _mobility(case)
    for line in rest[1:]:
        yield Paragraph(literal(line))
    sentence = rank_sentence(case.mechanism, case.language)
    if sentence:
        yield Paragraph(say(_("{sentence}.", sentence=literal(sentence))))
    yield _groups(case)
    if len(built.groups) > 1:
        yield _pictures(case)
    chain = " + ".join(group.signature for group in built.groups)
    yield Paragraph(
        say(
            _(
                "The mechanism is the frame with {chain} ({table}); it is a mechanism of class {level}.",
                chain=literal(chain),
                level=numeral(built.mechanism_class, say),
                table="[[groups]]",
            )
        )
    )


def _pictures(case: ReportContext) -> Block:
    """The groups drawn separately, or why they cannot be."""
    try:
        pictures = to_one_scale([group_picture(case, group) for group in case.structure.groups])
    except LinkwrightError as error:
        return Paragraph(literal(case.message(error)), "missing")
    names = ", ".join(f"{n} {group.signature}" for n, group in enumerate(case.structure.groups, 1))
    caption = case.say(_("The groups, separated from the machine, in solving order: {names}", names=literal(names)))
    return Figure(caption, pictures, "group-pictures")


def _mobility(case: ReportContext) -> Formula:
    counts = case.structure.counts
    n, (turning, sliding, w) = counts["links"], lower_pair_counts(counts)
    p = turning + sliding
    higher = sum(count for kind, count in counts.items() if kind in JOINTS and JOINTS[kind].higher)
    symbols, numbers = f"3 n − 2 {'p_L' if higher else 'p'}", f"3·{n} − 2·{p}"
    if higher:
        symbols, numbers = f"{symbols} − p_H", f"{numbers} − {higher}"
    if w:
        symbols, numbers = f"{symbols} − 3 w", f"{numbers} − 3·{w}"
    return Formula(sides(f"F = {symbols} = {numbers} = {case.structure.grubler}"), "mobility")


def _groups(case: ReportContext) -> Block:
    rows: list[list[Cell]] = []
    for number, group in enumerate(case.structure.groups, 1):
        outer = ", ".join(dict.fromkeys(c.joint for c in group.outer_joints))
        inner = ", ".join(dict.fromkeys(c.joint for c in group.inner_joints))
        kind = _("driven link") if group.assur_class == 1 and group.drivers else group.signature
        level = numeral(group.assur_class, case.say)
        rows.append([number, kind, ", ".join(group.links), level, group.assur_order, outer, inner or "–"])
    head = (
        _("step"),
        _("group"),
        _("links"),
        _("class"),
        pgettext("report", "order"),
        _("outer joints"),
        _("inner joints"),
    )
    groups = Table(head, rows, "<<<<<<<", _("Assur groups in solving order"))
    return printed(groups, case.language, "groups")

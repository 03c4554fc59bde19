"""Structure analysis: mobility with the formula and its numbers, groups drawn separately, classes, order."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from linkwright.core.arrays import Floats
from linkwright.core.table import Cell, Table
from linkwright.elements import Group
from linkwright.equations.reading import sides
from linkwright.errors import LinkwrightError
from linkwright.joints.base import JOINTS
from linkwright.kinematics.rank_of_motion import rank_sentence
from linkwright.pictures.drawing import Sketch, bounds, document
from linkwright.pictures.svg import group, natural_size
from linkwright.plotting.drawing.draw import laid_out_with_ghosts
from linkwright.plotting.drawing.machine import Part
from linkwright.plotting.drawing.scene import Scene, Shown, point_labels
from linkwright.reports.document import Block, Figure, Formula, Paragraph, literal, printed, symbols
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.section import section
from linkwright.topology.analysis import numeral
from linkwright.topology.mobility import lower_pair_counts
from linkwright.words import _, pgettext
from linkwright.words.message import in_language


@section("structure", _("Structure analysis"), 3.0)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Mobility, Assur groups in solving order, class of the mechanism."""
    translate, built = case.translate, case.structure
    first, *rest = (in_language(each, case.language) for each in built.tables(case.language)[0].notes)
    yield Paragraph(symbols(first) + translate(_(".")))
    yield _mobility(case)
    for line in rest[1:]:
        yield Paragraph(literal(line))
    sentence = rank_sentence(case.mechanism, case.language)
    if sentence:
        yield Paragraph(translate(_("{sentence}.", sentence=literal(sentence))))
    yield _groups(case)
    if len(built.groups) > 1:
        yield _pictures(case)
    chain = " + ".join(group.signature for group in built.groups)
    yield Paragraph(
        translate(
            _(
                "The mechanism is the frame with {chain} ({table}); it is a mechanism of class {level}.",
                chain=literal(chain),
                level=numeral(built.mechanism_class, translate),
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
    caption = case.translate(
        _("The groups, separated from the machine, in solving order: {names}", names=literal(names))
    )
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
    for number, each in enumerate(case.structure.groups, 1):
        outer = ", ".join(dict.fromkeys(c.joint for c in each.outer_joints))
        inner = ", ".join(dict.fromkeys(c.joint for c in each.inner_joints))
        kind = _("driven link") if each.assur_class == 1 and each.drivers else each.signature
        level = numeral(each.assur_class, case.translate)
        rows.append([number, kind, ", ".join(each.links), level, each.assur_order, outer, inner or "–"])
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


def group_picture(case: ReportContext, chosen: Group) -> str:
    """SVG of one group at the worked position, with its joints, the rest of the machine faded."""
    motion, index = case.worked_motion
    scene, place, _ = laid_out_with_ghosts(motion, Shown(motion, index), (), inputs=False, centres=False)
    own = Scene(scene.machine, tuple(part for part in scene.parts if _belongs(scene, part, chosen)))
    sketch = Sketch()
    ink = own.ink(place)
    sketch.draw([group(scene.at(place), "lw-faded"), *own.at(place)], ink)
    names = {connection.joint for connection in chosen.joints}
    inside = bounds(ink)
    sketch.labels = [
        label
        for label in point_labels(scene.machine, place)
        if label.point.partition(".")[0] in chosen.links or label.text in names
    ]
    sketch.write_names()
    box = bounds([*_corners(inside), *sketch.extent])
    return str(document(sketch.content, box, chosen.name, None))


def to_one_scale(pictures: Sequence[str]) -> tuple[tuple[str, float], ...]:
    """Pictures with the shares of the page's width that show them all to one scale, two or more in a row."""
    most = 0.48 if len(pictures) <= 4 else 0.31 if len(pictures) <= 9 else 0.23
    widths = [natural_size(svg)[0] for svg in pictures]
    return tuple((svg, most * width / max(widths)) for svg, width in zip(pictures, widths, strict=True))


def _belongs(scene: Scene, part: Part, chosen: Group) -> bool:
    """Whether a part is of the group's links, or one of its pins that another link carries."""
    if part.carrier in chosen.links:
        return part.layer != "marks"
    if part.layer not in ("pins", "blocks") or not part.shape.ink:
        return False
    machine = scene.machine
    pins = [
        machine.local(part.carrier, c.joint)
        for c in chosen.joints
        if c.joint in machine.pins and part.carrier in machine.pins[c.joint].joined
    ]
    cloud = part.shape.ink[0]
    middle = (cloud.min(axis=0) + cloud.max(axis=0)) / 2.0
    return any(abs(middle[0] - x) < 1.0 and abs(middle[1] - y) < 1.0 for x, y in pins)


def _corners(box: tuple[float, float, float, float]) -> list[Floats]:
    from linkwright.pictures.symbols.base import points

    left, top, right, bottom = box
    return [points([(left - 10.0, top - 10.0), (right + 10.0, bottom + 10.0)])]

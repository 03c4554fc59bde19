"""The structure analysis in sentences and as data."""

from __future__ import annotations

from linkwright.structure.group import Connection, Group, Structure
from linkwright.words import Say, speaker
from linkwright.words.width import cells, padded


def describe(structure: Structure, language: str = "en") -> str:
    """Mobility, groups in solving order, class: as in the structure chapter of a design report."""
    say = speaker(language)
    chain = " + ".join(f"{group.signature}({', '.join(group.links)})" for group in structure.groups)
    level = numeral(structure.mechanism_class, say)
    lines = [
        *_mobility(structure, say),
        "",
        say("structure_text.groups"),
        *_table(structure, say),
        "",
        say("structure_text.chain", chain=chain),
        say("structure_text.class", level=level),
    ]
    if len(structure.parts) > 1:
        parts = say("structure_text.and").join("{" + ", ".join(part) + "}" for part in structure.parts)
        lines.append(say("structure_text.parts", count=len(structure.parts), parts=parts))
    if structure.drivers:
        lines.append(say("structure_text.other_driver"))
    return "\n".join(lines)


def numeral(number: int, say: Say) -> str:
    """A class as it is written in the books."""
    numerals = say("structure_text.numerals").split()
    return numerals[number - 1] if number <= len(numerals) else str(number)


def _mobility(structure: Structure, say: Say) -> list[str]:
    n, r, p, w = (structure.counts[key] for key in ("links", "revolute", "prismatic", "weld"))
    counts = "counts_welds" if w > 1 else "counts_weld" if w else "counts"
    formula = "mobility_welded" if w else "mobility"
    lines = [
        say(f"structure_text.{counts}", links=n, pairs=r + p, revolute=r, prismatic=p, welds=w),
        say(f"structure_text.{formula}", links=n, pairs=r + p, welds=w, mobility=structure.grubler),
    ]
    if structure.redundant:
        guides = ", ".join(structure.redundant)
        lines.append(say("structure_text.redundant", guides=guides, mobility=structure.mobility))
    drivers = len(structure.drivers)
    if structure.mobility == 0 and not drivers:
        lines.append(say("structure_text.at_rest"))
    elif structure.mobility == drivers:
        lines.append(say("structure_text.determined", count=drivers))
    return lines


def _table(structure: Structure, say: Say) -> list[str]:
    """The groups, one in a line."""
    rows = [_row(number, group, say) for number, group in enumerate(structure.groups, 1)]
    widths = [max(cells(row[i]) for row in rows) for i in range(len(rows[0]))] if rows else []
    return [
        "  " + "  ".join(padded(cell, w) for cell, w in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]


def _row(number: int, group: Group, say: Say) -> tuple[str, str, str, str, str]:
    drivers = ", ".join(group.drivers)
    own = "_unnamed" if group.drivers == ("driver",) else ""
    if group.assur_class == 1 and group.drivers:
        what = say(f"structure_text.driven{own}", drivers=drivers)
    else:
        key = f"class_order_driven{own}" if group.drivers else "class_order"
        level = numeral(group.assur_class, say)
        what = say(f"structure_text.{key}", level=level, order=group.assur_order, drivers=drivers)
    outer = ", ".join(dict.fromkeys(c.joint for c in group.outer_joints))
    inner = ", ".join(dict.fromkeys(c.joint for c in group.inner_joints))
    joints = say(f"structure_text.{'outer_inner' if inner else 'outer'}", outer=outer, inner=inner)
    return f"{number}.", group.signature, f"({', '.join(group.links)})", what, joints


def as_data(structure: Structure) -> dict[str, object]:
    """Plain data for programs."""
    return {
        "mobility": structure.mobility,
        "grubler": structure.grubler,
        "redundant": list(structure.redundant),
        "counts": dict(structure.counts),
        "drivers": list(structure.drivers),
        "parts": [list(part) for part in structure.parts],
        "class": structure.mechanism_class,
        "groups": [
            {
                "links": list(group.links),
                "signature": group.signature,
                "class": group.assur_class,
                "order": group.assur_order,
                "drivers": list(group.drivers),
                "outer_joints": [_joint(c) for c in group.outer_joints],
                "inner_joints": [_joint(c) for c in group.inner_joints],
            }
            for group in structure.groups
        ],
    }


def _joint(connection: Connection) -> dict[str, object]:
    return {"joint": connection.joint, "kind": connection.kind, "links": [connection.a, connection.b]}

"""The structure analysis in sentences and as data."""

from __future__ import annotations

from linkwright.structure.group import Connection, Group, Structure

ROMAN = {1: "I", 2: "II", 3: "III", 4: "IV", 5: "V", 6: "VI", 7: "VII", 8: "VIII", 9: "IX", 10: "X"}


def describe(structure: Structure) -> str:
    """Mobility, groups in solving order, class: as in the structure chapter of a design report."""
    lines = [*_mobility(structure), "", "Assur groups in solving order:"]
    rows = [_row(number, group) for number, group in enumerate(structure.groups, 1)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))] if rows else []
    lines += [
        "  " + "  ".join(f"{cell:<{w}}" for cell, w in zip(row, widths, strict=True)).rstrip() for row in rows
    ]
    chain = " + ".join(f"{group.signature}({', '.join(group.links)})" for group in structure.groups)
    lines += [
        "",
        f"Mechanism = frame + {chain}",
        f"It is a class {roman(structure.mechanism_class)} mechanism.",
    ]
    if len(structure.parts) > 1:
        listed = " and ".join("{" + ", ".join(part) + "}" for part in structure.parts)
        lines.append(
            f"These are {len(structure.parts)} mechanisms that share nothing but the frame: {listed}."
        )
    if structure.drivers:
        lines.append("Another choice of driver leads to other groups, and may change the class.")
    return "\n".join(lines)


def roman(number: int) -> str:
    """A class as it is written in the books."""
    return ROMAN.get(number, str(number))


def _mobility(structure: Structure) -> list[str]:
    n, r, p, w = (structure.counts[key] for key in ("links", "revolute", "prismatic", "weld"))
    welds = f" - 3·{w}" if w else ""
    lines = [
        f"Moving links n = {n}; lower pairs p = {r + p}: {r} revolute, {p} prismatic"
        + (f"; {w} weld{'s' if w > 1 else ''}" if w else ""),
        f"Mobility F = 3n - 2p{welds and ' - 3w'} = 3·{n} - 2·{r + p}{welds} = {structure.grubler}",
    ]
    if structure.redundant:
        lines.append(
            f"The guides {', '.join(structure.redundant)} close a loop in which rotation is already prevented: "
            f"each such demand is redundant, so the mobility is {structure.mobility}."
        )
    if structure.mobility == 0 and not structure.drivers:
        lines.append("Mobility 0 and no driver: a structure at rest, which carries loads.")
    elif structure.mobility == len(structure.drivers):
        noun = "driver" if len(structure.drivers) == 1 else "drivers"
        lines.append(
            f"Mobility equals the number of {noun} ({len(structure.drivers)}): the motion is determined."
        )
    return lines


def _row(number: int, group: Group) -> tuple[str, str, str, str, str]:
    if group.assur_class == 1 and group.drivers:
        what = f"driven by {', '.join(group.drivers)}"
    else:
        what = f"class {roman(group.assur_class)}, order {group.assur_order}"
        if group.drivers:
            what += f", with driver {', '.join(group.drivers)} inside"
    outer = ", ".join(dict.fromkeys(c.joint for c in group.outer_joints))
    inner = ", ".join(dict.fromkeys(c.joint for c in group.inner_joints))
    joints = f"outer joints {outer}" + (f"; inner joints {inner}" if inner else "")
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

"""Results of ``solve`` as CSV and as data, in SI units."""

from __future__ import annotations

import argparse

from linkwright.cli.columns import Column
from linkwright.cli.data import finding_data
from linkwright.cli.solve_columns import leading, point_keys
from linkwright.cli.solve_remarks import closeness, largest_reactions
from linkwright.cli.solving import Solved
from linkwright.core.arrays import Floats, largest
from linkwright.mechanism.force_names import reaction_pairs


def named_columns(solved: Solved, options: argparse.Namespace) -> dict[str, Floats]:
    """The chosen columns by their names with units."""
    return {f"{column.name} [{column.unit}]": column.values for column in chosen(solved, options)}


def data(solved: Solved, options: argparse.Namespace) -> dict[str, object]:
    """Everything that the table and what stands beneath it say."""
    motion, forces = solved.motion, solved.forces
    failed = [int(row) for row in solved.rows if not motion.ok[row]]
    found: dict[str, object] = {
        "ok": motion.whole and solved.trouble is None,
        "name": motion.mechanism.name,
        "mobility": motion.structure.mobility,
        "turned": motion.structure.data()["turned"],
        "positions": len(solved.rows),
        "columns": named_columns(solved, options),
        "reached": motion.ok[solved.rows],
        "not_reached": {str(list(solved.rows).index(row)): motion.outcomes[row].sentence for row in failed},
        "notes": list(solved.notes),
        "warnings": [each.removeprefix("! ") for each in closeness(motion, "en")],
        "findings": [finding_data(finding) for finding in solved.warnings],
    }
    if options.prove:
        proof = solved.proof
        found["proof"] = {"said": proof.explain(), "proved": proof.proved, "margin": proof.margin}
    if forces is not None:
        found["static"] = forces.static
        found["checks"] = {
            "power_residual [W]": largest(forces.power_residual),
            "balance_residual [N]": largest(forces.balance_residual),
        }
        peaks = largest_reactions(solved) if motion.ok.any() else []
        found["largest_reactions [N]"] = {
            f"{joint} on {link}": peak.value
            for (joint, link), peak in zip(reaction_pairs(forces.mechanism), peaks, strict=bool(peaks))
        }
    if solved.trouble is not None:
        found["error"] = str(solved.trouble)
    return found


def chosen(solved: Solved, options: argparse.Namespace) -> list[Column]:
    """The columns that are asked for behind time and inputs; all of them if none is asked for."""
    columns = {column.name: column for column in (Column.of(*item) for item in solved.results().items())}
    patterns = [*(options.columns or ()), *point_keys(solved.motion, options.points)]
    if not patterns:
        return list(columns.values())
    first = {column.name: column for column in [columns["time"], *leading(solved, columns)]}
    picked = (Column.of(*item) for item in solved.picked(patterns).items())
    return list({**first, **{column.name: column for column in picked}}.values())

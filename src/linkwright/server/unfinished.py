"""What is not worth a finding while a machine is being drawn: that it is not finished."""

from __future__ import annotations

from collections.abc import Iterable

from linkwright.errors import Finding

#: Codes that only say what is still to be drawn or driven: the line of the structure says what there is.
UNFINISHED = frozenset({"empty", "unused", "mobility.free", "mobility.free_idle", "mobility.islands"})
#: Sections without which a sheet is merely empty.
EMPTY = frozenset({"frame", "links"})
#: Codes about a cycle that cannot be passed, which the gap tells, or the driver's rocking takes away.
BARRED = frozenset(
    {
        "motion.refused",
        "motion.refused_told",
        "motion.not_passed",
        "motion.no_natural_end",
        "motion.no_limit",
        "range.not_assembled",
    }
)


def in_earnest(findings: Iterable[Finding], *, told: bool) -> list[Finding]:
    """The findings that are left; ``told``: the page has a gap for a cycle that is barred, or a rocking machine."""
    return [each for each in findings if not unfinished(each.code, each.key) and not (told and each.code in BARRED)]


def unfinished(code: str, key: str = "") -> bool:
    """Whether a finding says no more than that something is still missing."""
    return code in UNFINISHED or (code == "missing-key" and key in EMPTY)

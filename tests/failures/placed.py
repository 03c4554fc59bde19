"""Whether a finding is placed."""

import re

from linkwright import Finding


def is_placed(finding: Finding, text: str) -> bool:
    """Whether a finding says a place that the text has."""
    place = re.fullmatch(r"m\.yaml(?::(\d+):(\d+))?", finding.where)
    if place is None or not finding.message:
        return False
    return place[1] is None or int(place[1]) <= text.count("\n") + text.count("\r") + 1

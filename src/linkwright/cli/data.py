"""Results as data for programs."""

from __future__ import annotations

import json
import math
from typing import Any

from linkwright.errors import Finding


def json_text(value: object) -> str:
    """JSON text of plain data and arrays; what is not a finite number becomes null."""
    return json.dumps(_plain(value), ensure_ascii=False, indent=1, allow_nan=False)


def finding_data(finding: Finding) -> dict[str, str]:
    """A finding as a mapping."""
    return {
        "severity": finding.severity,
        "where": finding.where,
        "key": finding.key,
        "message": finding.message,
        "remedy": finding.remedy,
        "code": finding.code,
    }


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, dict):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value

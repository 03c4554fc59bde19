"""Results as data for programs."""

from __future__ import annotations

import json
from typing import Any

from linkwright.core.json_data import plain
from linkwright.errors import Finding


def json_text(value: object) -> str:
    """JSON text of plain data and arrays, a list of numbers on one line; what is not finite becomes null."""
    return _written(plain(value), "")


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


def _written(value: Any, margin: str) -> str:
    inner = margin + "  "
    if isinstance(value, dict) and value:
        rows = [f"{inner}{_scalar(key)}: {_written(each, inner)}" for key, each in value.items()]
        return "{\n" + ",\n".join(rows) + f"\n{margin}}}"
    if isinstance(value, list) and any(isinstance(each, dict | list | str) for each in value):
        return "[\n" + ",\n".join(inner + _written(each, inner) for each in value) + f"\n{margin}]"
    return _scalar(value)


def _scalar(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)

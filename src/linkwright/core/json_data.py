"""Plain data: what JSON can write."""

from __future__ import annotations

import math
from typing import Any

Plain = dict[str, Any]


def plain(value: Any) -> Any:
    """Data and arrays as plain data; what is not finite becomes None."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, dict):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value

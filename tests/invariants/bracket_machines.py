"""Machines whose frame's points are those of a link that is welded to the frame, and data of files as numbers."""

from __future__ import annotations

import json
import re
from typing import Any

import yaml
from tests.store import text

import linkwright as lw


def numbered(value: Any) -> Any:
    """Data of texts with its bare numbers as numbers: what YAML 1.2 reads in these files."""
    if isinstance(value, dict):
        return {key: numbered(each) for key, each in value.items()}
    if isinstance(value, list):
        return [numbered(each) for each in value]
    return json.loads(value) if re.fullmatch(r"-?\d+(\.\d+)?(e[-+]?\d+)?", value) else value


def on_a_bracket(name: str) -> lw.Mechanism:
    """A machine of the gallery whose frame's points are those of a link welded to the frame."""
    data = numbered(yaml.load(text(name), Loader=yaml.BaseLoader))
    for key in ("expected", "report"):
        data.pop(key, None)

    def moved(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: moved(each) for key, each in value.items()}
        return "bracket" if value == "frame" else value

    data |= {key: moved(data[key]) for key in ("joints", "loads", "driver") if key in data}
    points = data["frame"]["points"]
    points |= {"W": next(iter(points.values()))}  # elsewhere it would be more of the room that the machine takes
    data["frame"] = {"points": {"W": points["W"]}}
    data["links"] = {"bracket": {"points": points}} | data["links"]
    weld = {"kind": "weld", "links": ["frame", "bracket"], "at": "W", "angle": "0 rad"}
    data.setdefault("joints", {})["foot"] = weld
    data["driver"].setdefault("relative_to", "bracket")
    return lw.loads(json.dumps(data))

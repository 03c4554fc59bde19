"""Numbers and text of a MuJoCo model."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable

import numpy as np

from linkwright.kinematics.motion import Motion
from linkwright.words.characters import printable


def numbers(values: Iterable[float]) -> str:
    """Numbers with all their digits, apart by spaces."""
    return " ".join(f"{float(value) + 0.0:.17g}" for value in values)


def seconds(motion: Motion) -> float:
    """Duration of the motion, s; 1 s where there is none."""
    if motion.positions.period:
        return float(motion.positions.period)
    return float(np.ptp(motion.time)) or 1.0


def written(root: ET.Element) -> bytes:
    """The indented XML document."""
    ET.indent(root)
    for element in root.iter():
        for name, value in element.attrib.items():
            element.attrib[name] = printable(value)
    return (
        b'<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(root, encoding="unicode").encode() + b"\n"
    )

"""Closed loops of a MuJoCo model: constraints at the joints where the Assur groups are cut."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from linkwright.export.mjcf.bodies import Bodies
from linkwright.export.mjcf.text import numbers
from linkwright.export.results import Results


def loops(results: Results, bodies: Bodies) -> ET.Element:
    """A ``connect`` for each cut pin, a ``weld`` to the rider of each cut guide and for each cut weld."""
    equality = ET.Element("equality")
    for group in results.structure.groups:
        for cut in group.cuts:
            name = f"{cut.joint}.{cut.b}"
            if cut.turns:
                ET.SubElement(
                    equality, "connect", name=name, site1=f"{cut.a}.{cut.joint}", site2=f"{cut.b}.{cut.joint}"
                )
            elif cut.slides:
                ET.SubElement(equality, "weld", name=name, body1=f"{cut.joint}.rider", body2=cut.b)
            elif cut.higher:
                ET.SubElement(equality, "tendon", name=name, tendon1=cut.joint, polycoef="0 0 0 0 0")
            else:
                a, b = (link if link != "frame" else "world" for link in (cut.a, cut.b))
                ET.SubElement(equality, "weld", name=name, body1=a, body2=b)
    return equality


def tendons(results: Results, bodies: Bodies) -> ET.Element:
    """For each higher pair the sum of joint coordinates that it keeps, as a tendon of fixed factors."""
    found = ET.Element("tendon")
    for group in results.structure.groups:
        for cut in group.cuts:
            if not cut.higher:
                continue
            rotations, slides, _ = results.mechanism.joints[cut.joint].sums(results.mechanism)
            factors = bodies.turned(rotations)
            for name, factor in slides.items():
                factors[name] = factors.get(name, 0.0) + factor
            tendon = ET.SubElement(found, "fixed", name=cut.joint)
            for name, factor in factors.items():
                if factor:
                    ET.SubElement(tendon, "joint", joint=name, coef=numbers([factor]))
    return found

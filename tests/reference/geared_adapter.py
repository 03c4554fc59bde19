"""The reference system of a mechanism with gear pairs, rolling wheels and racks, made from its plain data only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import hypot, tan
from typing import Any

import numpy as np
from tests.reference.adapter import link_points, reference_system
from tests.reference.geared import Geared, Rack, Row, gear
from tests.reference.multibody import Multibody


def driven_system(mechanism: Any) -> Multibody:
    """The reference's system with all drivers, and with gear pairs, rolling wheels and racks as rows."""
    higher = [joint for joint in mechanism.joints.values() if joint.higher]
    if not higher:
        return reference_system(mechanism)
    plain = replace(mechanism, joints={k: j for k, j in mechanism.joints.items() if not j.higher})
    base = reference_system(plain)
    return like(base, base.constraints, [_row(mechanism, joint) for joint in higher])


def _row(mechanism: Any, joint: Any) -> Row:
    if joint.kind in ("gear", "rolling"):
        (a, b), (pa, pb) = joint.links, joint.centres
        places = link_points(mechanism, joint.carrier)
        distance = hypot(*np.subtract(places[pb], places[pa]))
        ends = a, link_points(mechanism, a)[pa], b, link_points(mechanism, b)[pb]
        return gear(joint.name, *ends, distance, joint.transmission, getattr(joint, "pressure_angle", 0.0), 0.0)
    if joint.kind == "rack":
        centre = link_points(mechanism, joint.pinion)[joint.centre]
        through = link_points(mechanism, joint.rack)[joint.through]
        along, lever = joint.direction, joint.side * joint.radius
        return Rack(
            joint.name, joint.pinion, centre, joint.rack, 0.0, through, along, lever, tan(joint.pressure_angle)
        )
    raise NotImplementedError(joint.kind)


def like(system: Multibody, constraints: Sequence[Any], rolling: Sequence[Row]) -> Multibody:
    if rolling:
        return Geared(system.bodies, constraints, rolling, system.drivers)
    return Multibody(system.bodies, constraints, system.drivers)

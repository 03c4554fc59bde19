"""Loads of a `linkwright` Mechanism as loads of the reference, made from their plain data only."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, pi
from typing import Any

import numpy as np
from tests.reference.adapter import link_points
from tests.reference.formulas import force_in_link, force_in_space, gravity
from tests.reference.multibody import Load


def reference_loads(mechanism: Any) -> list[Load]:
    """Gravity and all loads of the mechanism; raises KeyError for a kind that the reference does not know."""
    loads = [KINDS[load.kind](mechanism, load) for load in mechanism.loads.values()]
    return [gravity(mechanism.gravity), *loads] if any(mechanism.gravity) else loads


def _constant(value: Any) -> float:
    if not isinstance(value, float):
        raise NotImplementedError(f"magnitude {value!r}")
    return value


def _force(mechanism: Any, load: Any) -> Load:
    if load.phase is not None or load.magnitude is None:
        raise NotImplementedError(f"load {load.name}")
    at, size = link_points(mechanism, load.on)[load.at], _constant(load.magnitude)
    if load.direction is not None:
        return force_in_space(
            load.on, at, (size * float(np.cos(load.direction)), size * float(np.sin(load.direction)))
        )
    angle = _angle_in_link(mechanism, load)
    return force_in_link(load.on, at, (size * float(np.cos(angle)), size * float(np.sin(angle))), load.on)


def _angle_in_link(mechanism: Any, load: Any) -> float:
    if load.in_link is not None:
        return float(load.in_link)
    points = link_points(mechanism, load.on)
    (ax, ay), (bx, by) = (points[p] for p in load.normal_to or load.along)
    return atan2(by - ay, bx - ax) + (pi / 2 if load.normal_to else 0.0)


KINDS: dict[str, Callable[[Any, Any], Load]] = {"force": _force}

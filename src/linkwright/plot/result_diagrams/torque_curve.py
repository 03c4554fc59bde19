"""A torque curve over the angle, with its mean."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.machine.torque_curve import TorqueCurve
from linkwright.pictures.diagram import Figure
from linkwright.plot.diagrams.axes import InputAxis
from linkwright.plot.diagrams.base import Request, result_diagram
from linkwright.plot.diagrams.marks import Curve
from linkwright.plot.diagrams.panels import stacked, with_mean

STEPS = 720
#: How far before a jump the curve is drawn, as a share of its period.
BEFORE = 1e-9


@result_diagram("torque_curve", TorqueCurve)
def draw_torque_curve(result: TorqueCurve, request: Request) -> Figure:
    """T(φ) over one period; jumps are drawn upright."""
    angle = _angles(result)
    panel = with_mean(f"{request.say('torque')} T", "torque", Curve("", result(angle)), result.mean, request)
    return stacked([panel], InputAxis("", "angle", angle), request, request.titled(""))[0]


def _angles(curve: TorqueCurve) -> Floats:
    """Angles over one period, each kink or jump on both of its sides."""
    end = curve.start + curve.period
    knots = np.array(curve.knots)
    near = np.concatenate([knots - BEFORE * curve.period, knots, [end - BEFORE * curve.period]])
    within = near[(near >= curve.start) & (near <= end)]
    return np.unique(np.concatenate([np.linspace(curve.start, end, STEPS + 1), within]))

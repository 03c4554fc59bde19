"""Positions that a call names: inputs of drivers, times, limit positions."""

from __future__ import annotations

from linkwright.cli.positions import inputs
from linkwright.errors import RequestError
from linkwright.events.position_list import known_outputs, of_text
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _


def positions_at(mechanism: Mechanism, at: str) -> Motion:
    """The motion at named positions, in their order, those that are not reached marked.

    ``at``: a list of inputs of the first driver, times and limit positions; of several drivers ``NAME=list; …``.
    Raises LinkwrightError for a text that is none, and for a machine without a driver.
    """
    if not mechanism.drivers:
        raise RequestError(_("the model has no driver, so there is no input to set", code="solve.no_input"))
    if "=" in at:
        return solve_motion(mechanism, at=inputs(at, mechanism, "at"), failures="mark")
    listed = of_text(at, (mechanism.across, "time"))
    known_outputs(mechanism, listed)
    return listed.solved(mechanism)

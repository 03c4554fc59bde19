"""Motion: positions, velocities and accelerations over a cycle."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion as Motion
    from linkwright.kinematics.outcome import Outcome as Outcome
    from linkwright.kinematics.outcome import PositionError as PositionError
    from linkwright.kinematics.positions import CycleError as CycleError
    from linkwright.kinematics.solve import solve_motion as solve_motion

offer(__name__)

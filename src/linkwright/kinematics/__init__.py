"""Motion: positions, velocities and accelerations over a cycle."""

from linkwright.kinematics.cycle import CycleError as CycleError
from linkwright.kinematics.motion import Motion as Motion
from linkwright.kinematics.outcome import Outcome as Outcome
from linkwright.kinematics.outcome import PositionError as PositionError
from linkwright.kinematics.solve import solve_motion as solve_motion

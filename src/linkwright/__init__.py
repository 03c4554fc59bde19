"""Linkwright: analysis and design of planar machines."""

from linkwright.errors import Finding as Finding
from linkwright.errors import LinkwrightError as LinkwrightError
from linkwright.errors import ModelError as ModelError
from linkwright.kinematics import Motion as Motion
from linkwright.kinematics import PositionError as PositionError
from linkwright.kinematics import solve_motion as solve_motion
from linkwright.kinetostatics import Balancing as Balancing
from linkwright.kinetostatics import Forces as Forces
from linkwright.kinetostatics import balance as balance
from linkwright.kinetostatics import solve_forces as solve_forces
from linkwright.model.file import check as check
from linkwright.model.file import load as load
from linkwright.model.file import loads as loads
from linkwright.model.mechanism import Mechanism as Mechanism
from linkwright.structure import Structure as Structure
from linkwright.structure import StructureError as StructureError
from linkwright.structure import structure as structure

__version__ = "0.1.0"

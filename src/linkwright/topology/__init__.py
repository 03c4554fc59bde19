"""Structure: mobility and Assur groups in solving order."""

from linkwright.elements import Connection as Connection
from linkwright.elements import Group as Group
from linkwright.topology.analysis import Structure as Structure
from linkwright.topology.decompose import structure as structure
from linkwright.topology.mobility import StructureError as StructureError

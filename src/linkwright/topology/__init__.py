"""Structure: mobility and Assur groups in solving order."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.elements.topology import Connection as Connection
    from linkwright.elements.topology import Group as Group
    from linkwright.topology.analysis import Structure as Structure
    from linkwright.topology.decompose import structure as structure
    from linkwright.topology.mobility import StructureError as StructureError

offer(__name__)

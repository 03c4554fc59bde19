"""Structure: mobility and Assur groups in solving order."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.structure.decompose import structure as structure
    from linkwright.structure.group import Connection as Connection
    from linkwright.structure.group import Group as Group
    from linkwright.structure.group import Structure as Structure
    from linkwright.structure.mobility import StructureError as StructureError

offer(__name__)

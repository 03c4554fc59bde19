"""The worked solution of one position, in the order in which a textbook solves it."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.worked_solutions.solution import Worked as Worked
    from linkwright.worked_solutions.solution import worked as worked

offer(__name__)

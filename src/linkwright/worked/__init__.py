"""The worked solution of one position, in the order in which a textbook solves it."""

from linkwright.worked.solution import Worked as Worked
from linkwright.worked.solution import worked as worked

"""Kinetostatics: joint reactions, driver effort, shaking force, and the checks that belong to them."""

from linkwright.kinetostatics.forces import Forces as Forces
from linkwright.kinetostatics.forces import solve_forces as solve_forces

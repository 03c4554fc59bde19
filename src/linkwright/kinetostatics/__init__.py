"""Kinetostatics: joint reactions, driver effort, shaking force, and the checks that belong to them."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.kinetostatics.forces import Forces as Forces
    from linkwright.kinetostatics.run import solve_forces as solve_forces

offer(__name__)

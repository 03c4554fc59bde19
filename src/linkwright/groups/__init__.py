"""Assur groups: one file per group with a closed form, and Newton's method for the rest."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.groups.base import DYADS as DYADS
    from linkwright.groups.base import Dyad as Dyad

offer(__name__)

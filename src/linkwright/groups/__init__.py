"""Assur groups: one file per group with a closed form, and Newton's method for the rest."""

from linkwright.groups.base import DYADS as DYADS
from linkwright.groups.base import Dyad as Dyad

"""The single bar and the five dyads as functions, for who solves a machine group by group himself.

Points and guides with their rates go in, everything inside a group comes out: :func:`bar` and :func:`slider` for
driven links, :func:`rrr`, :func:`rrp`, :func:`rpr`, :func:`prp`, :func:`rpp` for the dyads, :func:`forces`,
:func:`bar_forces` and :func:`slider_forces` for the joint forces. Arrays of any number of positions are welcome.

The teaching texts' subprograms: bark is :func:`bar` with ``Line.point``; rrrk, rrpk, rprk, prpk, rppk are the five
dyads; rrrf, rrpf, rprf, prpf, rppf are :func:`forces`; barf is :func:`bar_forces`.
"""

from linkwright.dyads.forces import Body as Body
from linkwright.dyads.forces import DyadForces as DyadForces
from linkwright.dyads.forces import Load as Load
from linkwright.dyads.forces import bar_forces as bar_forces
from linkwright.dyads.forces import forces as forces
from linkwright.dyads.forces import slider_forces as slider_forces
from linkwright.dyads.motion import DyadMotion as DyadMotion
from linkwright.dyads.motion import bar as bar
from linkwright.dyads.motion import prp as prp
from linkwright.dyads.motion import rpp as rpp
from linkwright.dyads.motion import rpr as rpr
from linkwright.dyads.motion import rrp as rrp
from linkwright.dyads.motion import rrr as rrr
from linkwright.dyads.motion import slider as slider
from linkwright.dyads.values import Line as Line
from linkwright.dyads.values import Slide as Slide
from linkwright.dyads.values import State as State

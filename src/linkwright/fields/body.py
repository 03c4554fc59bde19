"""What a file may say about a rigid body, wherever its points are said."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.fields.base import Field, Quantity
from linkwright.fields.colour import Colour
from linkwright.fields.mass import Mass
from linkwright.fields.references import PlaceOrPoint
from linkwright.fields.shape_of_link import ShapeField
from linkwright.words import _

BODY_FIELDS: Mapping[str, Field] = {
    "mass": Mass(doc=_("mass (default 0); from shape: it follows from the shape, and so do inertia and mass centre")),
    "inertia": Quantity("inertia", minimum=0, doc=_("moment of inertia about the mass centre (default 0)")),
    "mass_centre": PlaceOrPoint("length", ("x", "y"), doc=_("mass centre: [x, y] or a point (default: midway)")),
    "colour": Colour(doc=_('colour of the link in drawings: a name, or "#rrggbb" (default: that of all lines)')),
    "shape": ShapeField(doc=_("shape of the link's plate: a word, or a table (default: bar, or plate)")),
}

"""Area, centre and polar moment of area of a shape."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from linkwright.shapes.boundary import boundary
from linkwright.shapes.loop import Edge, Loop
from linkwright.shapes.shape import Shape


@dataclass(frozen=True)
class AreaMoments:
    """``area`` m², its ``centre`` m, x + i y, and its ``polar`` moment about the centre, m⁴."""

    area: float
    centre: complex
    polar: float


def area_moments(shape: Shape) -> AreaMoments:
    """Area, centre and polar moment of area of a shape, bored holes taken off; exact for lines and arcs.

    A plate of thickness t and density ρ has the mass ρ t area, and about its mass centre the moment of inertia
    ρ t polar. Raises RequestError as ``boundary`` does.
    """
    return moments_within(boundary(shape))


def moments_within(loops: Iterable[Loop]) -> AreaMoments:
    """Area, centre and polar moment of area within loops, clockwise ones taken off.

    Green's theorem: the sum over all edges of the triangle from one origin over the chord, and of the segment between
    chord and arc. Triangle with corners 0, a, b: A = (a × b)/2, centre (a + b)/3, polar moment about 0
    A(a² + a·b + b²)/6. Segment of radius r and angle θ: A = r²(θ − sin θ)/2, first moment about the circle's centre
    2 r³ sin³(θ/2)/3 towards its middle, polar moment about it r⁴(θ/4 − sin θ (2 + cos θ)/12): sector less triangle.
    (Young, Budynas, Sadegh: Roark's Formulas for Stress and Strain, table A.1; Beer, Johnston: Vector Mechanics for
    Engineers, Statics, 5.2 and 9.6.)
    """
    edges = [edge for loop in loops for edge in loop.edges]
    origin = sum(edge.start for edge in edges) / len(edges)
    parts = [part for edge in edges for part in _parts(edge, origin)]
    area = math.fsum(part[0] for part in parts)
    first = complex(math.fsum(part[1].real for part in parts), math.fsum(part[1].imag for part in parts))
    polar = math.fsum(part[2] for part in parts)
    centre = first / area
    return AreaMoments(area, origin + centre, polar - area * abs(centre) ** 2)


def _parts(edge: Edge, origin: complex) -> Iterable[tuple[float, complex, float]]:
    """Area, first and polar moment about an origin of the triangle and the segment of an edge."""
    a, b = edge.start - origin, edge.end - origin
    area, segment = edge.areas(origin)
    yield area, area * (a + b) / 3.0, area * (abs(a) ** 2 + (a.conjugate() * b).real + abs(b) ** 2) / 6.0
    if not edge.bulge:
        return
    angle, radius, centre = edge.angle, edge.radius, edge.centre - origin
    middle = edge.at(0.5) - edge.centre
    reach = 2.0 * radius**3 * math.sin(0.5 * angle) ** 3 / 3.0
    inner = reach * middle / (abs(middle) or 1.0)
    polar = radius**4 * (angle / 4.0 - math.sin(angle) * (2.0 + math.cos(angle)) / 12.0)
    # to the origin: the polar moment of z + c is that of z with 2 c·(first moment) and c² area
    moved = polar + 2.0 * (centre.conjugate() * inner).real + segment * abs(centre) ** 2
    yield segment, inner + segment * centre, moved

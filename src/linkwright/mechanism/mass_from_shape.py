"""Mass, moment of inertia and mass centre of links from their plates (``mass: from shape``)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

from linkwright.errors import LinkwrightError
from linkwright.formula.trace import Scalar, cos, sin
from linkwright.joints.lower_pair import TurningJoint
from linkwright.mechanism.construction import MATERIALS, Construction
from linkwright.mechanism.link import Link, Pair, local_points
from linkwright.mechanism.plate_moments import PlaneMoments, disc_moments, hull_moments, outline_moments
from linkwright.words import _

#: A coordinate of a mass centre up to this share of the plate's size is rounding.
ROUNDING = 1e-14
#: Ends of the addresses that follow from a shape.
ENDS = (".mass", ".inertia", ".mass_centre.x", ".mass_centre.y")


T = TypeVar("T")


class Mass(NamedTuple, Generic[T]):
    """``mass`` kg, moment of ``inertia`` about the mass centre kg·m², and that centre, m, in the link's axes."""

    mass: T
    inertia: T
    x: T
    y: T


class Plated(Protocol):
    """What masses from shapes need to know of a mechanism."""

    @property
    def links(self) -> Mapping[str, Link]: ...
    @property
    def pins(self) -> Mapping[str, TurningJoint]: ...
    @property
    def construction(self) -> Construction | None: ...
    def dimensions(self) -> dict[str, float]: ...


@dataclass(frozen=True)
class SizeAddresses:
    """Addresses of the sizes from which a link's mass follows.

    ``width`` is empty for a shape without one, ``density`` for steel by rule; ``pins``: of the radius of every pin of
    the link. ``missing``: what the file would have to give besides, as pairs of keys, either of which serves.
    """

    thickness: str
    width: str
    density: str
    pins: Mapping[str, str]
    missing: tuple[tuple[str, str], ...]


def derived_addresses(mechanism: Plated) -> dict[str, str]:
    """Addresses of what follows from the shapes of links, with the names of these links."""
    names = (name for name, link in mechanism.links.items() if link.mass_from_shape)
    return {f"{name}{end}": name for name in names for end in ENDS}


def size_addresses(mechanism: Plated, name: str) -> SizeAddresses:
    """The addresses of the sizes of a link with a shape."""
    from linkwright.mechanism.plate import needs_width

    link, construction = mechanism.links[name], mechanism.construction
    missing = list[tuple[str, str]]()

    def address(key: str, own: str, given: object) -> str:
        if given is not None:
            return own
        if construction is None or getattr(construction, key) is None:
            missing.append((own, f"construction.{key}"))
        return f"construction.{key}"

    shape = link.shape
    width = address("width", f"{name}.shape.width", shape and shape.width) if needs_width(link) else ""
    thickness = address("thickness", f"{name}.shape.thickness", shape and shape.thickness)
    pins = {
        pin: address("pin_radius", f"{pin}.pin_radius", joint.pin_radius)
        for pin, joint in mechanism.pins.items()
        if name in joint.joined
    }
    density = "construction.material.density" if construction is not None else ""
    if shape is not None and shape.material is not None:
        density = f"{name}.shape.material.density"
    return SizeAddresses(thickness, width, density, pins, tuple(dict.fromkeys(missing)))


def sources(mechanism: Plated, name: str) -> frozenset[str]:
    """The addresses of all that the mass, inertia and mass centre of a link follow from."""
    given = size_addresses(mechanism, name)
    return outline_sources(mechanism, name) | {each for each in (given.thickness, given.density) if each}


def outline_sources(mechanism: Plated, name: str) -> frozenset[str]:
    """The addresses on which outline and holes of a link depend."""
    given, link = size_addresses(mechanism, name), mechanism.links[name]
    own = {f"{name}.shape{end}" for end in (() if link.shape is None else link.shape.dimensions())}
    own -= {f"{name}.shape.thickness", *(each for each in own if each.startswith(f"{name}.shape.material."))}
    return frozenset(
        {*link.geometry_dimensions(), *own, *given.pins.values(), *([given.width] if given.width else [])}
    )


def mass_of(mechanism: Plated, name: str, value: Callable[[str], float]) -> Mass[float]:
    """Mass, inertia and mass centre of a link with the values of its dimensions, exact for arcs.

    Raises LinkwrightError where a pin's hole leaves the plate or meets another one.
    """
    from dataclasses import replace

    from linkwright.mechanism.plate import plate
    from linkwright.shapes.properties import area_moments

    given = size_addresses(mechanism, name)
    link = mechanism.links[name].with_dimensions(value)
    outline = plate(link, value(given.width) if given.width else 0.0)
    holes = ((complex(*link.points[pin]), value(radius)) for pin, radius in given.pins.items())
    found = area_moments(replace(outline, holes=tuple(hole for hole in holes if hole[1] > 0.0)))
    surface = _surface(given, value)
    x, y = (
        0.0 if abs(each) <= ROUNDING * outline.bound[1] else each for each in (found.centre.real, found.centre.imag)
    )
    return Mass(surface * found.area, surface * found.polar, x, y)


def traced_mass(mechanism: Plated, name: str, dimension: Callable[[str], Scalar], *, moved: bool) -> Mass[Scalar]:
    """The same with traced dimensions, as closed forms; ``moved``: whether the outline or the holes vary.

    Raises LinkwrightError for shapes without a closed form that vary: paths, and bars that are bent.
    """
    given, link = size_addresses(mechanism, name), mechanism.links[name]
    points = local_points(link, dimension, cos, sin)
    outline = _outline(link, points, given, dimension)
    if outline is not None:
        for pin, radius in given.pins.items():
            outline = outline + -disc_moments(points[pin], dimension(radius))
        area, (x, y), polar = outline.about_centre
    elif moved:
        raise LinkwrightError(
            _(
                "the mass of {link} follows from a bent bar, which cannot vary here; give mass, inertia and "
                "mass_centre as numbers, or compare the designs one by one",
                code="shapes.bent_varies",
                link=name,
            )
        )
    else:
        area, x, y, polar = fixed_plate(mechanism, name)
    surface = _surface(given, dimension)
    return Mass(surface * area, surface * polar, x, y)


def fixed_plate(mechanism: Plated, name: str) -> tuple[float, float, float, float]:
    """Area (m²) of the plate of a link, the place of its centre (m), and its polar moment about that (m⁴)."""
    link = mechanism.links[name]
    surface = _surface(size_addresses(mechanism, name), mechanism.dimensions().__getitem__)
    return link.mass / surface, *link.centre, link.inertia / surface


def is_bent(link: Link) -> bool:
    """Whether the plate has no closed form: a path, or a bar whose points leave the line of the first two."""
    kind = None if link.shape is None else link.shape.kind
    return kind == "path" or (kind == "bar" and len(link.points) > 2)


def bent_plates(mechanism: Plated) -> list[str]:
    """The links whose mass follows from a plate without a closed form."""
    return [name for name, link in mechanism.links.items() if link.mass_from_shape and is_bent(link)]


def _outline(
    link: Link, points: Mapping[str, Pair], given: SizeAddresses, dimension: Callable[[str], Scalar]
) -> PlaneMoments | None:
    """The moments of a plate without holes; None of one without a closed form."""
    places, shape = [*points.values()], link.shape
    if shape is not None and shape.kind == "outline":
        return outline_moments(shape.rings)
    if shape is not None and shape.kind == "disc":
        return disc_moments(places[0], dimension(f"{link.name}.shape.radius"))
    straight = all(isinstance(y, float) and y == 0.0 for _unused, y in places)
    if is_bent(link) and (shape is None or shape.kind == "path" or not straight):
        return None
    return hull_moments(places, 0.5 * dimension(given.width))


def _surface(given: SizeAddresses, dimension: Callable[[str], T]) -> T:
    """Mass per area, kg/m²."""
    thickness: Any = dimension(given.thickness)
    found: T = (dimension(given.density) if given.density else MATERIALS["steel"].density) * thickness
    return found

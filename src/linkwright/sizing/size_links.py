"""Sizes of links and pins from the largest forces over the cycle."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from math import dist

from linkwright.core.arguments import integer, positive, real, require
from linkwright.core.quantity import shown
from linkwright.errors import LinkwrightError, RequestError
from linkwright.fields.material import LABELS
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.construction import MATERIALS, Construction, LinkShape, Material
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.plate import needs_width
from linkwright.registry import no_such
from linkwright.sizing.allowed import Allowed
from linkwright.sizing.given import GivenSizes, given_sizes
from linkwright.sizing.link_sizes import LinkSizes
from linkwright.sizing.links import LINK_CRITERIA, LinkLoad, LinkSize, Section
from linkwright.sizing.loads_of import MachineLoads, seat_of
from linkwright.sizing.pins import PIN_CRITERIA, OnPin, PinLoad, PinSize, Seat
from linkwright.sizing.preferred import PLATES, decade
from linkwright.sizing.rule import usual_length
from linkwright.sizing.sections import slenderness
from linkwright.words import Message, _, pgettext

#: Positions over the cycle; largest values are found between them.
POSITIONS = 180
#: A plate has not less than these shares of the widths of its links, and of the diameters of its pins.
OF_WIDTH, OF_DIAMETER = 1.0 / 8.0, 1.0 / 2.0
#: Between two holes there remains this share of the mean diameter.
WALL = 0.2


def size_links(
    mechanism: Mechanism,
    *,
    material: str | Material | None = None,
    safety: float | None = None,
    thickness: float | None = None,
    pressure: float | None = None,
    steps: int = POSITIONS,
) -> LinkSizes:
    """Widths of links, diameters of pins and the thickness of plates from the largest forces over the cycle.

    Pins are of steel, fixed in the frame or in their first link, and sized by the pressure of the links that turn on
    them, bending, shear and the pressure in their seat; links by the eyes around their pins, by normal force and
    bending in the plane, and by buckling. The plates that have no thickness get the thinnest preferred one that fits
    widths, diameters and slenderness. Sizes are the smallest preferred ones; what the file gives stays as it is.

    Args:
        mechanism: with loads or masses; the file's construction is taken into account.
        material: of the links, by name or with its numbers; unless given that of the construction, else steel.
        safety: factor against yield; unless given that of the construction, else 2. Against buckling it is 1.5 times
            this.
        thickness: of the plates that have none of their own, m.
        pressure: allowed between pins and links that turn on them, Pa; unless given 8 MPa for steel in bronze
            bushes, and 1/25 of the strength of weaker materials.
        steps: positions over the cycle.

    Returns:
        The sizes, with the criterion that governs each, its numbers and the worked solution.

    Raises:
        LinkwrightError: forces that cannot be solved, no loads and masses, or forces that no plate of the machine's
            size carries.

    Example:
        >>> import linkwright as lw
        >>> sizes = lw.size_links(lw.load("gallery:slider_crank_inline"))
        >>> round(1e3 * sizes.pins["A"].diameter), sizes.pins["A"].criterion
        (20, 'pressure')
    """
    require(mechanism, Mechanism)
    construction = mechanism.construction or Construction()
    factor = construction.safety if safety is None else _safety(safety)
    if not mechanism.has_loads:
        raise LinkwrightError(
            _(
                "{name!r} has neither loads nor masses, so there are no forces to size its links by; add loads:, or "
                "mass: to links",
                code="sizing.no_loads",
                name=mechanism.name,
            )
        )
    running = None if pressure is None else positive("pressure", pressure)
    usual = construction.material if material is None else _material(material)
    plate = construction.thickness if thickness is None else positive("thickness", thickness)
    forces = solve_forces(mechanism, steps=integer("steps", steps, 1))
    return Sizing(MachineLoads(mechanism, forces), construction, usual, factor, running, plate).found()


def _safety(value: float) -> float:
    found = real("safety", value)
    if found < 1.0:
        raise RequestError(
            _("safety is {value:g}; give a factor of at least 1", code="sizing.too_small", value=found)
        )
    return found


def _material(material: str | Material) -> Material:
    if isinstance(material, Material):
        return material
    if material not in MATERIALS:
        raise LinkwrightError(no_such(_("material"), material, MATERIALS))
    return MATERIALS[material]


@dataclass(frozen=True, eq=False)
class Sizing:
    """The sizes of a machine: ``material`` and ``plate``, the thickness, of links without one of their own, the
    latter None to be found; ``running``: pressure, Pa, of running pins, None for the usual one."""

    loads: MachineLoads
    construction: Construction
    material: Material
    safety: float
    running: float | None
    plate: float | None

    @property
    def mechanism(self) -> Mechanism:
        """Whose sizes they are."""
        return self.loads.mechanism

    @cached_property
    def _shapes(self) -> Mapping[str, LinkShape]:
        links = {"frame": self.mechanism.frame, **self.mechanism.links}
        return {name: link.shape or LinkShape() for name, link in links.items()}

    @cached_property
    def allowed(self) -> Mapping[str, Allowed]:
        """What the links may bear."""
        return {
            name: Allowed.of(shape.material or self.material, self.safety, self.running)
            for name, shape in self._shapes.items()
        }

    @cached_property
    def _given_thickness(self) -> Mapping[str, float]:
        found = {name: shape.thickness or self.plate for name, shape in self._shapes.items()}
        return {name: each for name, each in found.items() if each is not None}

    def found(self) -> LinkSizes:
        """All sizes, with the thinnest plate that fits."""
        free = [name for name in self._shapes if name not in self._given_thickness]
        if not free:
            return self._of(self._given_thickness, self.plate)
        for plate in self._plates():
            thickness = dict.fromkeys(free, plate) | dict(self._given_thickness)
            if self._fits(thickness, free):
                return self._of(thickness, plate)
        largest = max((each.value for each in self.loads.on_pins.values()), default=0.0)
        raise LinkwrightError(
            _(
                "the forces on {name!r} of up to {force} are too large for plates of {material} of its size; take a "
                "stronger material, or check loads, masses and speeds",
                code="sizing.too_large",
                name=self.mechanism.name,
                force=shown(largest, "force", 3),
                material=LABELS.get(self.material.name) or pgettext("sizing", "its material"),
            )
        )

    def _plates(self) -> Iterator[float]:
        """Preferred thicknesses, up to half of the usual length of a link."""
        most, plate = 0.5 * usual_length(self.mechanism), PLATES[-1]
        yield from (each for each in PLATES if each <= most)
        while (plate := decade(plate * 1.01, up=True)) <= most:
            yield plate

    def _fits(self, thickness: Mapping[str, float], free: Collection[str]) -> bool:
        """Whether plates are thick enough for what has no size yet, judged by the positions that were solved."""
        pins = self._pins(thickness)
        for size in pins.values():
            links = (size.load.seat.link, *(each.link for each in size.load.links))
            if not size.given and any(
                thickness[each] < OF_DIAMETER * size.diameter for each in links if each in free
            ):
                return False
        bores = self._bores(pins)
        return all(self._link_fits(name, thickness[name], bores) for name in free)

    def _link_fits(self, name: str, thickness: float, bores: Mapping[str, float]) -> bool:
        load, allowed = self._link(name, thickness, bores), self.allowed[name]
        if load.length is not None and slenderness(load.length, thickness) > load.slenderest:
            return False
        if name in self._given.width:
            return True
        most = thickness / OF_WIDTH
        if max(load.needs(allowed).values(), default=0.0) > most:
            return False
        return load.length is None or self.loads.rough_width(name, bores, thickness, allowed.stress) <= most

    def _of(self, thickness: Mapping[str, float], plate: float | None) -> LinkSizes:
        pins = self._pins(thickness)
        bores = self._bores(pins)
        stress = {name: each.stress for name, each in self.allowed.items()}
        sections = self.loads.sections(bores, thickness, stress)
        links = {}
        for name in self._shapes:
            load = self._link(name, thickness[name], bores, sections.get(name))
            if load.needs(self.allowed[name]) and needs_width(self.mechanism.link(name)):
                links[name] = LinkSize.of(load, self.allowed[name], self._given.width.get(name))
        notes = tuple(self._notes(links, pins))
        return LinkSizes(
            self.mechanism,
            self.material,
            self.safety,
            self.running,
            plate,
            self.allowed,
            thickness,
            links,
            pins,
            notes,
        )

    @cached_property
    def _given(self) -> GivenSizes:
        return given_sizes(self.mechanism)

    def _bores(self, pins: Mapping[str, PinSize]) -> dict[str, float]:
        return {name: pin.diameter + self.construction.fit for name, pin in pins.items()}

    def _pins(self, thickness: Mapping[str, float]) -> dict[str, PinSize]:
        found = {}
        for name, pin in self.mechanism.pins.items():
            radius = self._given.pin_radius.get(name)
            found[name] = PinSize.of(self._pin(name, pin.joined, thickness), radius and 2.0 * radius)
        return found

    def _pin(self, name: str, joined: tuple[str, ...], thickness: Mapping[str, float]) -> PinLoad:
        seat = seat_of(joined)
        links = []
        for link in joined:
            if link != seat:
                allowed, turns = self.allowed[link], (name, link) in self.loads.turning
                limit = allowed.running if turns else allowed.resting
                links.append(OnPin(link, self.loads.on_pins[name, link], thickness[link], turns, limit))
        return PinLoad(
            name,
            Seat(seat, thickness[seat], self.allowed[seat].resting),
            tuple(sorted(links, key=lambda each: each.force)),
            self.construction.washer or 0.0,
            self.construction.supports == "both" and seat == "frame",
            self.safety,
        )

    def _link(
        self, name: str, thickness: float, bores: Mapping[str, float], section: Section | None = None
    ) -> LinkLoad:
        pins = (each for each, pin in self.mechanism.pins.items() if name in pin.joined)
        eyes = {each: (self.loads.on_pins[each, name], bores[each]) for each in pins}
        loads = self.loads
        length = loads.members[name].length if name in loads.members else None
        pressed, bent = loads.compression.get(name), loads.moments.get(name)
        return LinkLoad(name, thickness, eyes, length, section, pressed, bent)

    def _notes(self, links: Mapping[str, LinkSize], pins: Mapping[str, PinSize]) -> Iterator[Message]:
        for name, pin in pins.items():
            if not pin.suffices:
                yield _(
                    "The given pin {pin} of {given} is too thin: {criterion} asks for {needed}.",
                    pin=name,
                    given=shown(pin.diameter, "length"),
                    criterion=PIN_CRITERIA[pin.criterion],
                    needed=shown(pin.needs[pin.criterion], "length"),
                )
        for name, link in links.items():
            yield from self._link_notes(name, link)
        yield from self._close_pins(pins)

    def _link_notes(self, name: str, link: LinkSize) -> Iterator[Message]:
        if not link.suffices:
            yield _(
                "The given width of {link}, {given}, is too small: {criterion} asks for {needed}.",
                link=name,
                given=shown(link.width, "length"),
                criterion=LINK_CRITERIA[link.criterion],
                needed=shown(link.needs[link.criterion], "length"),
            )
        length, side = link.load.length, min(link.load.thickness, link.width)
        if length is not None and slenderness(length, side) > link.load.slenderest * (1.0 + 1e-9):
            yield _(
                "{link} is slender: λ = {ratio:.0f} with a side of {side}; {most:.0f} should not be exceeded.",
                link=name,
                ratio=slenderness(length, side),
                side=shown(side, "length"),
                most=link.load.slenderest,
            )

    def _close_pins(self, pins: Mapping[str, PinSize]) -> Iterator[Message]:
        for name, link in {"frame": self.mechanism.frame, **self.mechanism.links}.items():
            own = [each for each in link.points if each in pins and name in self.mechanism.pins[each].joined]
            for a, b in combinations(own, 2):
                apart, mean = dist(link.points[a], link.points[b]), 0.5 * (pins[a].diameter + pins[b].diameter)
                if 0.0 < apart < mean * (1.0 + WALL):
                    yield _(
                        "The pins {first} and {second} of {link} do not leave room for each other: they are {apart} "
                        "apart, with diameters of {first_size} and {second_size}.",
                        code="sizing.no_room",
                        first=a,
                        second=b,
                        link=name,
                        apart=shown(apart, "length"),
                        first_size=shown(pins[a].diameter, "length"),
                        second_size=shown(pins[b].diameter, "length"),
                    )

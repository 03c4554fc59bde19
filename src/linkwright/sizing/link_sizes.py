"""The sizes of links and pins, with the criterion that governs each, and the way to them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from linkwright.core.attached import attached
from linkwright.core.data import Frozen
from linkwright.core.quantity import shown
from linkwright.core.table import Amount, Cell, Table, Tabular
from linkwright.equations.steps import Step, page
from linkwright.errors import speaker
from linkwright.fields.material import LABELS
from linkwright.files.write import Document
from linkwright.mechanism.construction import Material
from linkwright.mechanism.mechanism import Mechanism
from linkwright.sizing.allowed import PIN, Allowed
from linkwright.sizing.links import LINK_CRITERIA, LinkLoad, LinkSize
from linkwright.sizing.pins import PIN_CRITERIA, PinSize
from linkwright.words import Message, Translate, _, pgettext

#: A bending moment below this share of force times length is zero but for rounding.
NOTHING = 1e-9


@dataclass(frozen=True, eq=False, repr=False)
class LinkSizes(Tabular, Frozen):
    """Sizes of the links and pins of a ``mechanism`` from its largest forces.

    ``material`` of links without one of their own; ``safety`` factor; ``running``: the pressure of running pins that
    was asked for, Pa, None for the usual one; ``plate``: thickness of links without one of their own, m, None where
    there are none; ``allowed``: what the links may bear, and ``thickness`` of all plates, m, by the names of the
    links; ``links``: those with a width, the frame's among them; ``pins``; ``notes``: given sizes that do not
    suffice, and what does not fit together.
    """

    row_names: ClassVar[str | None] = "link"
    mechanism: Mechanism
    material: Material
    safety: float
    running: float | None
    plate: float | None
    allowed: Mapping[str, Allowed]
    thickness: Mapping[str, float]
    links: Mapping[str, LinkSize]
    pins: Mapping[str, PinSize]
    notes: tuple[Message, ...] = ()

    def __repr__(self) -> str:
        widths = ", ".join(f"{name} {shown(each.width, 'length')}" for name, each in self.links.items())
        return f"LinkSizes({self.mechanism.name!r}: {widths}; {len(self.pins)} pins)"

    @property
    def fit(self) -> bool:
        """Whether all pins leave room for each other."""
        return not any(note.code == "sizing.no_room" for note in self.notes)

    @property
    @attached
    def sized(self) -> Mechanism:
        """The machine with these sizes in its construction, links and pins."""
        raise NotImplementedError

    @attached
    def model_text(self, document: Document | None = None) -> str:
        """A model file with these sizes: the text of a document with them, everything else as it was, or a new one.

        Raises LinkwrightError where the document has no place for a size.
        """
        raise NotImplementedError

    @property
    def basis(self) -> tuple[Message, ...]:
        """What the sizes rest on."""
        allowed = Allowed.of(self.material, self.safety, self.running)
        material = LABELS.get(allowed.material.name, pgettext("sizing", "their material"))
        return (
            _(
                "Safety factor {safety:g} against yield, {buckling:g} against buckling; links of {material} with Re "
                "= {strength}, pins of steel with Re = {pin}, pressure of running pins up to {pressure}.",
                safety=allowed.safety,
                buckling=allowed.buckling,
                material=material,
                strength=Amount(allowed.material.strength, "pressure").text,
                pin=Amount(PIN.strength, "pressure").text,
                pressure=Amount(allowed.running, "pressure").text,
            ),
            _(
                "Links on a pin are taken to lie next to each other, and loads as often as they come: fatigue is not "
                "checked. Guides, blocks, wheels and cams are not sized."
            ),
        )

    def tables(self, language: str = "en", *args: Any, **options: Any) -> tuple[Table, ...]:
        """One table of the links, one of the pins, and what they rest on."""
        notes = [each.translate(language) for each in (*self.notes, *self.basis)]
        return (
            Table(title=self.mechanism.translate(language).name),
            self.link_table(),
            self.pin_table(),
            Table(notes=notes),
        )

    def link_table(self) -> Table:
        """Links with the force on their pins, bending moment, criterion, width, thickness and safety."""
        head = (_("link"), _("force"), _("moment"), _("criterion"), _("width"), _("thickness"), _("safety"))
        rows: list[list[Cell]] = [
            [
                name,
                Amount(size.load.force, "force", 4),
                _moment(size.load),
                _given(size.given) or LINK_CRITERIA[size.criterion],
                Amount(size.width, "length"),
                Amount(size.load.thickness, "length"),
                Amount(size.safety, digits=3),
            ]
            for name, size in self.links.items()
        ]
        return Table(head, rows, "<>><>>>", title=_("Links"))

    def pin_table(self) -> Table:
        """Pins with their force, pressure, criterion and diameter."""
        pin, pressure = pgettext("sizing", "pin"), pgettext("sizing", "pressure")
        head = (pin, _("fixed in"), _("force"), pressure, _("criterion"), _("diameter"))
        rows: list[list[Cell]] = [
            [
                name,
                size.load.seat.link,
                Amount(size.load.force, "force", 4),
                Amount(size.pressure, "pressure", 3),
                _given(size.given) or PIN_CRITERIA[size.criterion],
                Amount(size.diameter, "length"),
            ]
            for name, size in self.pins.items()
        ]
        return Table(head, rows, "<<>><>", title=_("Pins"))

    def steps(self, translate: Translate) -> list[Step]:
        """The worked solution: every pin, then every link."""
        found = [size.step(f"1.{k}", translate) for k, size in enumerate(self.pins.values(), 1)]
        return found + [size.step(f"2.{k}", translate) for k, size in enumerate(self.links.values(), 1)]

    def worked(self, language: str = "en") -> str:
        """The worked solution as plain text."""
        title = _("{name}: sizes of pins and links", name=self.mechanism.translate(language).name)
        basis = [each.translate(language) for each in self.basis]
        return page((title.translate(language), *basis), self.steps(speaker(language)))

    def columns(self) -> Mapping[str, Sequence[Any]]:
        """The links with their widths and thicknesses, m, and safety factors."""
        sizes = self.links.values()
        return {
            "link": list(self.links),
            "force [N]": [each.load.force for each in sizes],
            "width [m]": [each.width for each in sizes],
            "thickness [m]": [each.load.thickness for each in sizes],
            "safety": [each.safety for each in sizes],
        }

    def data(self) -> Mapping[str, Any]:
        """Plain data, SI."""
        return {
            "name": self.mechanism.name,
            "links": {name: _link_data(each) for name, each in self.links.items()},
            "pins": {name: _pin_data(each) for name, each in self.pins.items()},
            "notes": [*self.notes, *self.basis],
        }


def _moment(load: LinkLoad) -> Amount | None:
    """The bending moment; as zero where it is one but for rounding."""
    if load.moment is None:
        return None
    least = NOTHING * load.force * (load.length or 0.0)
    return Amount(load.moment.value if load.moment.value > least else 0.0, "torque", 4)


def _given(given: bool) -> Message | None:
    return pgettext("sizing", "given") if given else None


def _link_data(size: LinkSize) -> dict[str, Any]:
    moment, pressed = size.load.moment, size.load.compression
    return {
        "force": size.load.force,
        "moment": None if moment is None else moment.value,
        "compression": None if pressed is None else pressed.value,
        "criterion": size.criterion,
        "needed": dict(size.needs),
        "width": size.width,
        "thickness": size.load.thickness,
        "safety": size.safety,
        "given": size.given,
    }


def _pin_data(size: PinSize) -> dict[str, Any]:
    return {
        "fixed_in": size.load.seat.link,
        "force": size.load.force,
        "pressure": size.pressure,
        "criterion": size.criterion,
        "needed": dict(size.needs),
        "diameter": size.diameter,
        "given": size.given,
    }

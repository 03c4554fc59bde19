"""Which plate lies in which layer, and what keeps a machine from having layers at all."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import cached_property
from itertools import pairwise
from math import inf, isfinite
from typing import Any

from linkwright.collisions.gaps import Gap
from linkwright.core.attached import PlotMixin
from linkwright.core.data import Frozen
from linkwright.core.quantity import length_text, shown
from linkwright.core.table import Amount, Cell, Table, Tabular
from linkwright.errors import RequestError
from linkwright.layering.heights import Layer, stacked
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.solids.solid import Solid, Solids
from linkwright.words import Message, _, pgettext


@dataclass(frozen=True)
class Conflict:
    """A demand that contradicts the others: two bodies that must not share a layer, or a plate whose layer is given.

    ``second`` is empty of a layer that is fixed; ``gap``: the smallest one and where it is, None where it does not
    matter.
    """

    first: str
    second: str
    gap: Gap | None
    sentence: Message

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        found: dict[str, Any] = {"first": self.first, "second": self.second, "sentence": str(self.sentence)}
        if self.gap is not None:
            gap = self.gap
            found |= {
                "gap": gap.size,
                "time": gap.time,
                "input": gap.input,
                "place": [gap.place.real, gap.place.imag],
            }
        return found


@dataclass(frozen=True)
class Pin:
    """A pin in its layers: the plates that it goes through from below, its ``length`` without heads (m), the radius
    of a ``head`` (m), how many are below and above, and the ``spaces`` between one plate and the next (m)."""

    name: str
    plates: tuple[str, ...]
    length: float
    head: float
    heads: tuple[int, int]
    spaces: tuple[float, ...]

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        found = asdict(self)
        return found | {key: list(found[key]) for key in ("plates", "heads", "spaces")}


@dataclass(frozen=True, eq=False)
class Layers(Tabular, PlotMixin, Frozen):
    """The fewest layers in which nothing of a machine collides over its cycle, with the shortest pins.

    ``layer`` of every plate by name, that of the frame 0 (a frame in all layers counts from there); ``fewest`` and
    ``shortest``: whether it is proved that fewer layers are not enough, and that with so many no pins are shorter.
    ``conflicts``: demands that contradict where there are no layers, none of which can be left out; ``layer`` is then
    empty; ``remedies``: changes with which there would be layers. ``clearance``: gap wanted in one layer, m;
    ``gaps``: the smallest ones over the cycle by pairs of names, of all that may be in one layer.
    """

    mechanism: Mechanism = field(repr=False)
    solids: Solids = field(repr=False)
    layer: Mapping[str, int]
    clearance: float = 0.0
    fewest: bool = True
    shortest: bool = True
    conflicts: tuple[Conflict, ...] = ()
    remedies: tuple[Message, ...] = ()
    gaps: Mapping[tuple[str, str], Gap] = field(default_factory=dict, repr=False)
    limits: tuple[Message, ...] = field(default=(), repr=False)

    @property
    def count(self) -> int:
        """How many layers there are besides the frame's own."""
        return max(self.layer.values(), default=0)

    @cached_property
    def walls(self) -> frozenset[str]:
        """Plates in all layers."""
        construction = self.mechanism.construction
        fixed = {} if construction is None else construction.layers
        return frozenset(name for name in self.layer if fixed.get(name, 0) is None)

    @cached_property
    def layers(self) -> tuple[Layer, ...]:
        """The layers from below, with their plates and the heights of their faces."""
        thickness = {name: self.solids.by_name[name].thickness for name in self.layer}
        construction = self.mechanism.construction
        washer = 0.0 if construction is None else construction.washer or 0.0
        return stacked(self.layer, thickness, washer)

    @cached_property
    def height(self) -> Mapping[str, tuple[float, float]]:
        """Heights z of the lower and the upper face of every plate, m, 0 at the lower face of the lowest layer."""
        top = self.layers[-1].high if self.layers else 0.0
        return {name: (0.0, top) if name in self.walls else self._faces(name) for name in self.layer}

    def _faces(self, plate: str) -> tuple[float, float]:
        """Heights of the faces of a plate, of a frame in all layers those of its foot."""
        low = next((each.low for each in self.layers if each.number == self.layer[plate]), 0.0)
        return low, low + self.solids.by_name[plate].thickness

    def span(self, solid: str) -> tuple[int, int]:
        """The lowest and the highest layer of a solid; raises RequestError where it has none."""
        if solid in self.walls:
            return 0, self.count
        found = [self.layer[plate] for plate in self._plates(solid)]
        return min(found), max(found)

    def z(self, solid: str) -> tuple[float, float]:
        """Heights of the lower and the upper end of a solid without its heads, m; raises RequestError where it has
        none."""
        if solid in self.walls:
            return self.height[solid]
        found = [self._faces(plate) for plate in self._plates(solid)]
        return min(low for low, _high in found), max(high for _low, high in found)

    def _plates(self, solid: str) -> list[str]:
        plates = self.solids.by_name[solid].plates if solid in self.solids.by_name else ()
        if found := [each for each in plates if each in self.layer]:
            return found
        names = [name for name, each in self.solids.by_name.items() if {*each.plates} & self.layer.keys()]
        hint = offered(solid, names, _("in layers are: {names}"))
        raise RequestError(
            _('there is no "{name}" in a layer; {hint}', code="layers.no_solid", name=solid, hint=hint)
        )

    @cached_property
    def pins(self) -> tuple[Pin, ...]:
        """All pins in their layers."""
        pins = (each for each in self.solids.by_name.values() if each.sort == "pin" and self.layer)
        return tuple(self._pin(each) for each in pins)

    def _pin(self, solid: Solid) -> Pin:
        plates = sorted((each for each in solid.plates if each in self.layer), key=self._faces)
        low, high = self.z(solid.name)
        faces = [self._faces(each) for each in plates]
        heads = (0, 0)
        if solid.head > 0.0:
            frame = {self.layer[each] for each in plates if self.solids.by_name[each].sort == "frame"}
            heads = (int(0 not in frame), int(not ("cover" in self.layer and self.count in frame)))
        spaces = tuple(above[0] - below[1] for below, above in pairwise(faces))
        return Pin(solid.name, tuple(plates), high - low, solid.head, heads, spaces)

    @cached_property
    def nearest(self) -> tuple[str, str, Gap] | None:
        """The two in one layer that come nearest over the cycle, and their gap; of a machine without layers the two
        that overlap or come too near; None where nothing shares a layer. Pins in one plate, which never come
        nearer, do not count."""
        if self.conflicts:
            against = {each.first for each in self.conflicts} | {each.second for each in self.conflicts}
            found = [(*pair, gap) for pair, gap in self.gaps.items() if {*pair} <= against]
        else:
            found = [(*pair, gap) for pair, gap in self.gaps.items() if self._together(*pair)]
        return min(found, key=lambda each: each[2].size, default=None)

    @property
    def min_gap(self) -> float:
        """The smallest gap over the cycle of what lies in one layer, m; infinite where nothing does."""
        return inf if self.conflicts or self.nearest is None else self.nearest[2].size

    def _together(self, one: str, other: str) -> bool:
        """Whether two solids have a layer in common, and no plate that holds both."""
        if {*self.solids.by_name[one].plates} & {*self.solids.by_name[other].plates}:
            return False
        spans = [self.span(each) for each in (one, other) if {*self.solids.by_name[each].plates} & self.layer.keys()]
        return len(spans) == 2 and max(low for low, _high in spans) <= min(high for _low, high in spans)

    @property
    def notes(self) -> tuple[Message | str, ...]:
        """What was found, and what was taken by rule, in sentences."""
        return (*self._found(), *self.limits, *self.solids.notes)

    def _found(self) -> Iterator[Message]:
        if self.conflicts:
            yield _("There are no layers, however many, in which nothing collides: all this cannot hold together.")
            yield from self.remedies
            return
        yield _("Layers above that of the frame: {count}; nothing collides.", count=self.count)
        if isfinite(self.min_gap):
            yield _("The smallest gap within a layer is {gap}.", gap=length_text(self.min_gap, 4))
        if not self.fewest:
            yield _("The time was over before it was proved that no fewer layers do.")
        if not self.shortest:
            yield _("The time was over before it was proved that no pins are shorter.")

    def tables(self, language: str = "en", *args: Any, **options: Any) -> Sequence[Table]:
        """The layers from the highest to the frame's, and the pins; or the conflicts."""
        if self.conflicts:
            return (self._conflicts_table(), Table(notes=self.notes))
        return (self._layers_table(), self._pins_table(), Table(notes=self.notes))

    def _layers_table(self) -> Table:
        head = (_("layer"), _("plates"), _("thickness"), _("from z"), _("to z"))
        rows: list[list[Cell]] = [
            [
                each.number,
                _("{names}", names=each.plates) if each.plates else _("heads of pins only"),
                Amount(each.thickness, "length", 4),
                Amount(each.low, "length", 5),
                Amount(each.high, "length", 5),
            ]
            for each in self.layers
        ]
        notes = [_("{name} is in all layers.", name=each) for each in self.walls]
        return Table(head, rows, "><>>>", self.mechanism.name, notes)

    def _pins_table(self) -> Table:
        pin, through = pgettext("machine part", "pin"), pgettext("of a pin", "through")
        head = (pin, through, _("length"), _("heads"), _("between the plates"))
        heads = {(0, 0): _("none"), (1, 0): _("below"), (0, 1): _("above"), (1, 1): _("below and above")}
        rows: list[list[Cell]] = [
            [
                each.name,
                _("{names}", names=each.plates),
                Amount(each.length, "length", 5),
                heads[each.heads],
                ", ".join(shown(space, "length", 4) for space in each.spaces),
            ]
            for each in self.pins
        ]
        return Table(head, rows, "<<><<", _("Pins"))

    def _conflicts_table(self) -> Table:
        head = (_("cannot hold together"), _("smallest gap"), _("at"), "x", "y")
        rows = [self._conflict_row(each) for each in self.conflicts]
        return Table(head, rows, "<>>>>", self.mechanism.name)

    def _conflict_row(self, conflict: Conflict) -> list[Cell]:
        gap = conflict.gap
        if gap is None:
            return [conflict.sentence, None, None, None, None]
        return [
            conflict.sentence,
            _("overlap") if gap.size <= 0.0 else Amount(gap.size, "length", 4),
            Amount(gap.input, self.mechanism.across, 4) if isfinite(gap.input) else Amount(gap.time, "time", 4),
            *gap.cells(self.mechanism.size),
        ]

    def data(self) -> Mapping[str, Any]:
        """Everything as plain data, SI."""
        return {
            "name": self.mechanism.name,
            "count": self.count if self.layer else None,
            "fewest": self.fewest,
            "shortest": self.shortest,
            "clearance": self.clearance,
            "min_gap": self.min_gap,
            "layers": [
                {"layer": each.number, "plates": list(each.plates), "z": [each.low, each.high]}
                for each in self.layers
            ],
            "walls": sorted(self.walls),
            "pins": [each.data() for each in self.pins],
            "conflicts": [each.data() for each in self.conflicts],
            "remedies": [str(each) for each in self.remedies],
            "notes": [str(each) for each in self.notes],
        }

    def columns(self) -> dict[str, list[Any]]:
        """The plates by name with layer, thickness and heights of their faces, SI."""
        faces = [self.height[name] for name in self.layer]
        return {
            "plate": [*self.layer],
            "layer": [*self.layer.values()],
            "thickness [m]": [high - low for low, high in faces],
            "from z [m]": [low for low, _high in faces],
            "to z [m]": [high for _low, high in faces],
        }

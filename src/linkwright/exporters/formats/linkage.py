"""Linkage files: links by their connectors, guides as slots, inputs of constant speed, gears and chains."""

from __future__ import annotations

import math

import numpy as np

from linkwright.drivers.base import Driver
from linkwright.drivers.table import TableLaw
from linkwright.errors import RequestError
from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.left_out import LeftOut
from linkwright.exporters.linkage.elements import Elements, LinkElement, Ratio
from linkwright.exporters.linkage.links import FRAME, Links
from linkwright.exporters.linkage.slots import Slots
from linkwright.exporters.results import Results
from linkwright.joints.belt import BeltPair
from linkwright.joints.lower_pair import RigidJoint
from linkwright.joints.toothed import WheelPair
from linkwright.words import _


def linkage_content(results: Results) -> bytes:
    """The machine as it lies at the first position that was reached, lengths with all digits.

    Points of links become connectors, those of the frame anchors. A block of one point is a pin in a slot; a block
    that must not turn slides with two pins in one slot, which gets ends far enough for the solved motion. Drivers
    turn a link about a point of the frame at constant speed, or move two points to and fro at constant speed. Gears
    and rolling wheels are gears; belts, chains and internal gears are chains. Masses and loads are not part of it.

    Raises LinkwrightError for what the program does not have: other laws and drivers, cams, racks.
    """
    return Converter(results).elements().content()


def linkage_report(results: Results) -> LeftOut:
    """What the file leaves out or says in another way."""
    converter = Converter(results)
    converter.elements()
    return LeftOut(results.mechanism.name, "Linkage", tuple(converter.notes))


FORMATS.register("linkage")(Format((".linkage2",), linkage_content, report=linkage_report))


class Converter:
    """Makes elements of a machine; ``notes``: what the file cannot say."""

    def __init__(self, results: Results) -> None:
        self.motion, self.mechanism = results.motion, results.mechanism
        self.links = Links(results)
        self.found, self.notes = self.links.found, self.links.notes
        self.gears: dict[str, LinkElement] = {}

    def elements(self) -> Elements:
        """All elements of the file."""
        if not self.mechanism.drivers:
            raise RequestError(
                _(
                    "the machine has no driver, and Linkage shows motion only; add one",
                    code="export.linkage_no_driver",
                )
            )
        if self.mechanism.cycle is not None and not self.mechanism.cycle.turns:
            self.notes.append(_("The cycle is left out: inputs turn on at constant speed."))
        self.links.add()
        slots = Slots(self.links, self.motion)
        for guide in self.links.guides:
            slots.slide(guide)
        for driver in self.links.cylinders:
            self.actuator(driver)
        for weld in self.links.welds:
            self.weld(weld)
        for pair in self.links.wheels:
            self.pair(pair)
        return self.found

    # -- actuators, welds, wheels

    def actuator(self, driver: Driver) -> None:
        """A driven distance that changes to and fro at constant speed as an actuator."""
        law, cylinder = driver.law, driver.cylinder
        assert cylinder is not None
        ends = [self.links.numbers[each.link, each.point] for each in cylinder.between]
        if law.constant_speed == 0:
            self.found.link(driver.name, ends)
            self.notes.append(_("{driver} rests and is a link of its length.", driver=driver.name))
            return
        strokes = _strokes(law, float(self.motion.time[self.links.index])) if isinstance(law, TableLaw) else None
        if strokes is None:
            raise RequestError(
                _(
                    "{driver}: in Linkage an actuator runs to and fro at constant speed from where it begins; give "
                    "the driver a linear table of that",
                    code="export.linkage_actuator",
                    driver=driver.name,
                )
            )
        element = self.found.link(driver.name, ends)
        element.throw, element.rate = abs(strokes[0]), math.copysign(30 / strokes[1], strokes[0])

    def weld(self, weld: RigidJoint) -> None:
        """A weld as links fastened to each other."""
        a, b = weld.links
        if FRAME in (a, b):
            raise RequestError(
                _(
                    "{weld}: in Linkage no link is fastened to the frame; make its points those of the frame",
                    code="export.linkage_weld",
                    weld=weld.name,
                )
            )
        self.links.of_link[b].fastened_link = self.links.of_link[a].number

    def pair(self, pair: WheelPair) -> None:
        """A pair of wheels as gears, or as a chain where both turn the same way."""
        ratio = pair.transmission
        centres = [self.centre(pair, k) for k in (0, 1)]
        a, b = (self.gear(link, centre) for link, centre in zip(pair.links, centres, strict=True))
        sizes = pair.teeth or pair.radii or (abs(ratio), 1.0)
        radii = isinstance(pair, BeltPair) and ratio > 0
        if radii:
            sizes = pair.pitch_radii() if isinstance(pair, BeltPair) else sizes
        elif isinstance(pair, BeltPair) or ratio > 0:
            self.notes.append(
                _("{pair} turns as in the machine, but is drawn as another kind of pair.", pair=pair.name)
            )
        first, second = sizes
        self.found.ratios.append(Ratio(ratio < 0, (a.number, b.number), (first, second), radii))

    def centre(self, pair: WheelPair, side: int) -> int:
        """The connector about which a wheel turns, which its carrier holds, too."""
        link, point = pair.links[side], pair.centres[side]
        on_carrier = self.links.numbers[pair.carrier, point]
        found = on_carrier if link == FRAME else self.links.numbers[link, point]
        if found != on_carrier and pair.carrier != FRAME:
            raise RequestError(
                _(
                    "{pair}: in Linkage an input turns all links at its point, so that wheel and carrier cannot both "
                    "be there; drive another link",
                    code="export.linkage_carrier",
                    pair=pair.name,
                )
            )
        return found

    def gear(self, link: str, centre: int) -> LinkElement:
        """The gear of a link: the link itself where it is its centre only, else one fastened to it."""
        key = f"{link}.{centre}"
        if key not in self.gears:
            element = self.links.of_link.get(link)
            if element is None or element.connectors != [centre]:
                fastened = element
                element = self.found.link("", [centre])
                if fastened is not None:
                    element.fastened_link = fastened.number
                else:
                    element.fastened_connector = centre
            element.gear = True
            self.gears[key] = element
        return self.gears[key]


def _strokes(law: TableLaw, begin: float) -> tuple[float, float] | None:
    """How far and how long (s) a table goes to and fro at constant speed from its first value; None: it does not."""
    times, values = np.asarray(law.times), np.asarray(law.positions)
    if law.interpolation != "linear" or times.size < 3 or abs(begin - times[0]) > 1e-12:
        return None
    steps, strokes = np.diff(times), np.diff(values)
    even = np.allclose(steps, steps[0], rtol=1e-9) and np.allclose(strokes[1:], -strokes[:-1], rtol=1e-9)
    return (float(strokes[0]), float(steps[0])) if even and strokes[0] else None

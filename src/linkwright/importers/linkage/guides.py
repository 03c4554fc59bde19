"""Sliders of a file of Linkage: pins in slots, links that slide, arcs, and its gears and chains."""

from __future__ import annotations

import math

from linkwright.core.data import Plain
from linkwright.errors import Severity
from linkwright.importers.layout import FRAME, Body, Remarks, Slide, Wheels, free_name
from linkwright.importers.linkage.bodies import Bodies
from linkwright.importers.linkage.elements import PIXEL, Connector, Ratio
from linkwright.mechanism.link import Vec
from linkwright.units import UNITS, number
from linkwright.words import Message, _

#: By how much the radius of an arc exceeds half the distance of its ends at least, m.
MARGIN = 0.0009 * PIXEL
#: Share of its radius by which a slider may be off its arc.
OFF = 1e-5
#: Sizes of gears from which on they are numbers of teeth, where they are integers.
MIN_TEETH = 6


class Guides:
    """Adds the slides of a file to the layout of its bodies."""

    def __init__(self, bodies: Bodies, remarks: Remarks) -> None:
        self.bodies, self.layout, self.remarks = bodies, bodies.layout, remarks
        self.points = {each for body in self.layout.all for each in body.places}

    def add(self) -> None:
        """Adds all slides: of sliders between the same limits those of one body together."""
        groups: dict[tuple[frozenset[int], float], list[Connector]] = {}
        for connector in self.bodies.used.values():
            if connector.slider and self.guide_of(connector) is not None:
                side = 1 if connector.limits[0] < connector.limits[1] else -1
                groups.setdefault((frozenset(connector.limits), side * connector.radius), []).append(connector)
        for members in groups.values():
            self._group(members)

    def guide_of(self, connector: Connector) -> str | None:
        """The body on which a connector slides; None, with a remark, where the program lets it not slide either."""
        used, limits = self.bodies.used, connector.limits
        known = len(set(limits)) == 2 and all(each in used for each in limits)
        guide = self.bodies.holding(*limits) if known else None
        if guide is None:
            message = _("a slider needs two limits that are connectors of one rigid link; it is read without a slide")
            remedy = _("give it two limits on one link")
            self._remark("warning", message, remedy, "import.linkage_slider", connector)
        return guide

    def _group(self, members: list[Connector]) -> None:
        """Slides of the sliders between one pair of limits: two on one body guide it."""
        first = members[0]
        guide = self.bodies.holding(*first.limits) or FRAME
        self._tell_of_ends(members, guide)
        sliding: dict[str, list[Connector]] = {}
        for each in members:
            for name in self._carriers(each, guide):
                sliding.setdefault(name, []).append(each)
        done: set[int] = set()
        for name, pins in sliding.items():
            if len({each.place for each in pins}) > 1:
                done |= {each.number for each in pins}
                self._guided(guide, name, pins)
        for each in members:
            if each.number not in done:
                self._pin_in_slot(guide, each)

    def _carriers(self, connector: Connector, guide: str) -> list[str]:
        """Bodies that have a slider, without the one on which it slides."""
        return [each for each in self.bodies.all_holding(connector.number) if each != guide]

    def _tell_of_ends(self, members: list[Connector], guide: str) -> None:
        """One remark for all sliders between two limits."""
        if guide == FRAME and all(each.anchor for each in members):
            return
        names = ", ".join(self.bodies.names[each] for each in members[0].limits)
        message = _("it slides between {names}; a guide has no ends here, so nothing stops it there", names=names)
        key = ", ".join(each.shown for each in members)
        remedy = _("see whether it stays between them")
        self.remarks.remark("note", message, remedy, "import.slide_ends", line=members[0].line, key=key)

    # -- straight

    def _guided(self, guide: str, body: str, pins: list[Connector]) -> None:
        """A body that is led by two of its pins between the same limits."""
        if pins[0].radius:
            self._about_centre(guide, body, pins[0])
            return
        first, second = (self.bodies.names[each.number] for each in pins[:2])
        start, end = (self.bodies.names[each] for each in pins[0].limits)
        if body == FRAME:  # two fixed pins, over which the link with the limits slides
            self._slide(first, FRAME, first, (first, second), guide, start)
        else:
            self._slide(first, guide, start, (start, end), body, first)

    def _slide(self, name: str, guide: str, through: str, line: tuple[str, str], block: str, at: str) -> None:
        names = [*(each.name for each in self.layout.slides), *(each.name for each in self.layout.wheels)]
        self.layout.slides.append(Slide(free_name(f"guide_{name}", names), guide, through, line, block, at))

    def _pin_in_slot(self, guide: str, connector: Connector) -> None:
        """A pin that slides: a block of one point on it; where its link has this one point only, the link itself."""
        carriers = self._carriers(connector, guide)
        if connector.radius:
            self._on_arc(guide, connector)
            return
        name = self.bodies.names[connector.number]
        alone = next((each for each in carriers if len(self.layout.body(each).places) == 1 and each != FRAME), None)
        block = alone or self._extra(f"block_{name}", {name: connector.place})
        start, end = (self.bodies.names[each] for each in connector.limits)
        self._slide(name, guide, start, (start, end), block, name)

    def _extra(self, name: str, places: dict[str, Vec]) -> str:
        """A further body."""
        return self.layout.add(Body(free_name(name, self.layout.bodies), places)).name

    # -- arcs

    def _on_arc(self, guide: str, connector: Connector) -> None:
        """A pin that slides on an arc: a link from it to the arc's centre."""
        point, centre = self.bodies.names[connector.number], self._centre(connector)
        name = self._centre_name(guide, point, centre)
        self._extra(f"arc_{point}", {name: centre, point: connector.place})
        message = _("its arc is read as a link from its centre {name}, of the arc's radius", name=name)
        self._remark("note", message, "", "import.linkage_arc", connector)

    def _about_centre(self, guide: str, body: str, connector: Connector) -> None:
        """A body with two pins on one arc turns about the arc's centre."""
        centre = self._centre(connector)
        name = self._centre_name(guide, self.bodies.names[connector.number], centre)
        self.layout.body(body).places[name] = centre
        message = _(
            "it and another slider of its link are on one arc: read as a pin at the arc's centre {name}", name=name
        )
        self._remark("note", message, "", "import.linkage_arc", connector)

    def _centre_name(self, guide: str, point: str, centre: Vec) -> str:
        """The name of an arc's centre, a point of the guide."""
        name = free_name(f"centre_{point}", self.points)
        self.points.add(name)
        self.layout.body(guide).places[name] = centre
        return name

    def _centre(self, connector: Connector) -> Vec:
        """Centre of the arc through both limits: that of the two about which the connector lies; where it fits both,
        for a positive radius to the left of the line from the first limit."""
        (x0, y0), (x1, y1) = (self.bodies.used[each].place for each in connector.limits)
        dx, dy = x1 - x0, y1 - y0
        span = math.hypot(dx, dy)
        radius = max(abs(connector.radius), span / 2 + MARGIN)
        away = math.copysign(math.sqrt(radius**2 - span**2 / 4), connector.radius) / (span or 1.0)
        centres = [((x0 + x1) / 2 - side * dy, (y0 + y1) / 2 + side * dx) for side in (away, -away)]
        offs = [math.dist(each, connector.place) - radius for each in centres]
        nearer = int(abs(offs[1]) < abs(offs[0]) - OFF * radius)
        centre, off = centres[nearer], abs(offs[nearer])
        if off > OFF * radius:
            shown = f"{off / PIXEL:.4g}"
            message = _(
                "it lies {off} units of the file off its arc; it keeps its distance from the centre", off=shown
            )
            self._remark("warning", message, _("move it onto its arc"), "import.linkage_off_arc", connector)
        return centre

    def _remark(
        self, severity: Severity, message: Message, remedy: Message | str, code: str, connector: Connector
    ) -> None:
        self.remarks.remark(severity, message, remedy, code, line=connector.line, key=connector.shown)


class Gearing:
    """Gears and chains of a file between the bodies of its layout."""

    def __init__(self, bodies: Bodies, remarks: Remarks) -> None:
        self.bodies, self.layout, self.remarks = bodies, bodies.layout, remarks

    def add(self) -> None:
        """Adds all pairs of wheels."""
        for ratio in self.bodies.file.ratios:
            wheels = self._pair(ratio)
            if wheels is not None:
                self.layout.wheels.append(wheels)

    def _pair(self, ratio: Ratio) -> Wheels | None:
        """A pair of wheels; None, with a remark, where the program does not turn them either."""
        links = [self.bodies.file.link(each) for each in ratio.links]
        names = [self.bodies.body_of(each) for each in links]
        whole = len(links) == 2 and all(each is not None and each.connectors for each in links)
        if not whole or min(ratio.sizes) <= 0 or None in names or names[0] == names[1]:
            message = _("these wheels are not two bodies with sizes; the pair is left out")
            self._remark(message, _("name two links with sizes above 0"), ratio.line)
            return None
        centres = [each.connectors[0] for each in links if each is not None]
        carrier = self._carrier(centres)
        if carrier is None:
            message = _(
                "no link holds the centres of both wheels; the pair is left out, as the program turns neither"
            )
            self._remark(message, _("join the centres by a link, or fix both"), ratio.line)
            return None
        values: Plain = {"links": names}
        if carrier != FRAME:
            values["carrier"] = carrier
        kind = "gear" if ratio.gears else "chain"
        taken = [*(each.name for each in self.layout.slides), *(each.name for each in self.layout.wheels)]
        name = free_name("mesh" if ratio.gears else "chain", taken)
        return Wheels(name, kind, values | self._sizes(ratio, centres))

    def _carrier(self, centres: list[int]) -> str | None:
        """The body that holds both centres; the frame where both are anchors."""
        held = self.bodies.holding(*centres)
        return held or (FRAME if all(self.bodies.used[each].anchor for each in centres) else None)

    def _sizes(self, ratio: Ratio, centres: list[int]) -> Plain:
        """Teeth or the ratio of gears; radii of a chain, half of those that would touch where none are given."""
        first, second = ratio.sizes
        if ratio.gears and all(each == int(each) and each >= MIN_TEETH for each in ratio.sizes):
            return {"teeth": [int(first), int(second)]}
        if ratio.gears:
            return {"ratio": -first / second}
        scale = 1.0
        if not ratio.radii:
            scale = math.dist(*(self.bodies.used[each].place for each in centres)) / (first + second) / 2
        factor = UNITS[self.layout.unit][0]
        return {"radii": [f"{number(each * scale / factor)} {self.layout.unit}" for each in ratio.sizes]}

    def _remark(self, message: Message, remedy: Message, line: int) -> None:
        self.remarks.remark("warning", message, remedy, "import.linkage_wheels", line=line, key="ratio")

"""Rigid bodies of a file of Linkage: which links move as one, which are the frame, and what carries a connector."""

from __future__ import annotations

from collections.abc import Iterable

from linkwright.importers.layout import FRAME, Body, Layout, Remarks, free_name
from linkwright.importers.linkage.elements import Connector, LinkageFile, LinkElement
from linkwright.words import _


class Bodies:
    """Bodies of the layout by the links of the file; ``of`` maps the index of a link to the name of its body."""

    def __init__(self, file: LinkageFile, layout: Layout, remarks: Remarks) -> None:
        self.file, self.layout, self.remarks = file, layout, remarks
        self.links = [each for each in file.links if not each.shown_only and not each.measure]
        self.used = {number: each for number, each in file.connectors.items() if self._matters(each)}
        for link in self.links:
            link.connectors = [each for each in link.connectors if each in self.used]
        self.actuators = [each for each in self.links if each.actuator and len(each.connectors) == 2]
        self.rigid = [each for each in self.links if each not in self.actuators and each.connectors]
        self.names: dict[int, str] = {}
        for number, connector in self.used.items():
            self.names[number] = free_name(connector.shown, self.names.values())
        self._leaders = list(range(len(self.rigid) + 1))  # the last one is the frame
        self._join()
        self.of: dict[int, str] = {}
        self._build()

    def _matters(self, connector: Connector) -> bool:
        """Whether a connector is of the mechanism, or traces a path as a part of one of its links."""
        if not connector.shown_only:
            return True
        held = connector.fastened is not None or any(
            connector.number in each.held for each in self.file.links if not each.shown_only
        )
        return connector.draw and held

    # -- which links are one body

    def _join(self) -> None:
        """Joins links that are fastened to each other, turned by one input, or fixed."""
        for index, link in enumerate(self.rigid):
            if self.is_fixed(link):
                self._one(index, len(self.rigid))
            target = self.file.link(link.fastened_link)
            if target is not None and target in self.rigid and target is not link:
                self._one(index, self.rigid.index(target))
            if link.fastened_connector is not None:
                self._fasten_to_connector(index, link, link.fastened_connector)
        for connector in self.used.values():
            turned = list(self.turned_by(connector))
            for index in turned[1:]:
                self._one(turned[0], index)

    def is_fixed(self, link: LinkElement) -> bool:
        """Whether a link is the frame: all its connectors are anchors, or two of them are."""
        anchors = [each for each in link.connectors if self.used[each].anchor]
        if link.gear:
            connector = self.used.get(link.fastened_connector) if link.fastened_connector is not None else None
            return connector is not None and connector.anchor
        if len(anchors) == len(link.connectors):
            return len(anchors) > 1 or not self.used[anchors[0]].input
        return len(anchors) > 1

    def turned_by(self, connector: Connector) -> Iterable[int]:
        """Indices of the links that an input turns: all at it that are not fixed, nor fastened to what is."""
        if connector.input:
            frame = self._leader(len(self.rigid))
            for index, link in enumerate(self.rigid):
                if connector.number in link.connectors and self._leader(index) != frame and not self.is_fixed(link):
                    yield index

    def _fasten_to_connector(self, index: int, link: LinkElement, number: int) -> None:
        """A link that moves with a connector: it is fixed with an anchor, else one with the connector's link."""
        connector = self.used.get(number)
        if connector is None:
            return
        if connector.anchor:
            self._one(index, len(self.rigid))
            return
        holders = [k for k, each in enumerate(self.rigid) if number in each.connectors and each is not link]
        if holders:
            self._one(index, holders[0])
            message = _(
                "it moves with connector {name}, and is read as a part of that one's link", name=connector.shown
            )
            self.remarks.remark(
                "warning",
                message,
                _("fasten it to the link"),
                "import.linkage_fastened",
                line=link.line,
                key=link.key,
            )

    def _one(self, one: int, other: int) -> None:
        self._leaders[self._leader(one)] = self._leader(other)

    def _leader(self, index: int) -> int:
        while self._leaders[index] != index:
            index = self._leaders[index]
        return index

    # -- bodies

    def _build(self) -> None:
        """One body for each set of links, with the connectors of all of them."""
        frame = self._leader(len(self.rigid))
        self.layout.frame.places |= {
            self.names[each.number]: each.place for each in self.used.values() if each.anchor and not each.shown_only
        }
        sets: dict[int, list[int]] = {}
        for index in range(len(self.rigid)):
            sets.setdefault(self._leader(index), []).append(index)
        for leader, members in sets.items():
            name = FRAME if leader == frame else self._name([self.rigid[each] for each in members])
            body = self.layout.frame if leader == frame else self.layout.add(Body(name))
            for index in members:
                self.of[index] = name
                link = self.rigid[index]
                body.colour = body.colour or ("" if leader == frame else link.colour)
                body.key = body.key or link.key
                for number in (*link.connectors, *self._held(link)):
                    body.places.setdefault(self.names[number], self.used[number].place)

    def _held(self, link: LinkElement) -> Iterable[int]:
        """Connectors that are fastened to a link."""
        named = [each.number for each in self.used.values() if self.file.link(each.fastened) is link]
        return dict.fromkeys(each for each in (*link.held, *named) if each in self.used)

    def _name(self, links: list[LinkElement]) -> str:
        """A name: the first that the file gives, else crank, gear or link with its number as the program shows it."""
        taken = [FRAME, *self.layout.bodies]
        given = next((each.name for each in links if each.name), "")
        if given:
            return free_name(given, taken, "link")
        number = min(each.number for each in links) + 1
        if any(
            index in self.turned_by(each) for each in self.used.values() for index in map(self.rigid.index, links)
        ):
            return free_name("crank", taken)
        return free_name(f"gear_{number}" if all(each.gear for each in links) else f"link_{number}", taken)

    # -- what carries what

    def holding(self, *numbers: int) -> str | None:
        """The body of the first link that has all of some connectors."""
        for index, link in enumerate(self.rigid):
            if all(each in link.connectors for each in numbers):
                return self.of[index]
        return None

    def all_holding(self, number: int) -> list[str]:
        """All bodies that have a connector, the frame first where it is an anchor."""
        name = self.names[number]
        return [body.name for body in self.layout.all if name in body.places]

    def body_of(self, link: LinkElement | None) -> str | None:
        """The body of a link."""
        return next((self.of[k] for k, each in enumerate(self.rigid) if each is link), None)

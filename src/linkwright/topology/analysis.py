"""The result of the structure analysis, in sentences and as data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from linkwright.core.table import Table, Tabular
from linkwright.elements import Connection, Group
from linkwright.errors import speaker
from linkwright.joints.base import JOINTS, PAIRS
from linkwright.topology.constraints import GearTrain, written
from linkwright.topology.mobility import lower_pair_counts
from linkwright.words import Translate, _, language_of, ngettext
from linkwright.words.message import link_label


@dataclass(frozen=True)
class Structure(Tabular):
    """Mobility and Assur groups of a mechanism, in solving order.

    ``grubler``: mobility by Grübler's formula, 3n - 2p_L - p_H; ``redundant``: demands on rotations that others
    make already (joint names), added to it, those of higher pairs also in ``passive``; ``parts``: sets of links
    that share nothing but the frame (more than one: several mechanisms in one model); ``trains``: ratios of gears and
    belts with their carriers stopped; ``turned``: of every turning driver the link, the pin and the link
    against which it turns. See the theory page on structure.
    """

    grubler: int
    redundant: tuple[str, ...]
    drivers: tuple[str, ...]
    groups: tuple[Group, ...]
    counts: dict[str, int]
    parts: tuple[tuple[str, ...], ...] = ()
    passive: tuple[str, ...] = ()
    trains: tuple[GearTrain, ...] = ()
    turned: Mapping[str, tuple[str, str, str]] = field(default_factory=dict)

    @property
    def mobility(self) -> int:
        """Number of independent inputs."""
        return self.grubler + len(self.redundant)

    @property
    def mechanism_class(self) -> int:
        """The highest class of its groups."""
        return max((group.assur_class for group in self.groups), default=1)

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """The structure analysis as a student would write it: mobility, groups in solving order, class, trains."""
        translate = speaker(language)
        groups = [_row(number, group, translate) for number, group in enumerate(self.groups, 1)]
        title = _("Assur groups in solving order:")
        return (
            Table(notes=_mobility(self, translate)),
            Table((), groups, "<<<<<", title, turned_against(self, translate)),
            Table(notes=_class(self, translate)),
            *(_train(train, translate) for train in self.trains),
        )

    def data(self) -> dict[str, object]:
        """The same as plain data."""
        return {
            "mobility": self.mobility,
            "grubler": self.grubler,
            "redundant": list(self.redundant),
            "counts": dict(self.counts),
            "drivers": list(self.drivers),
            "turned": {
                name: {"link": link, "about": pin, "relative_to": other}
                for name, (link, pin, other) in self.turned.items()
            },
            "trains": [{"carrier": t.carrier, "pairs": list(t.pairs), "ratios": dict(t.ratios)} for t in self.trains],
            "parts": [list(part) for part in self.parts],
            "class": self.mechanism_class,
            "groups": [
                {
                    "links": list(group.links),
                    "signature": group.signature,
                    "class": group.assur_class,
                    "order": group.assur_order,
                    "drivers": list(group.drivers),
                    "outer_joints": [_joint(c) for c in group.outer_joints],
                    "inner_joints": [_joint(c) for c in group.inner_joints],
                }
                for group in self.groups
            ],
        }

    @property
    def chain(self) -> str:
        """The groups in solving order: ``RRR(coupler, rocker) + RRP(rod, slider)``."""
        return " + ".join(f"{group.signature}({', '.join(group.links)})" for group in self.groups)

    def __repr__(self) -> str:
        return f"Structure(mobility {self.mobility}; {self.chain}; class {self.mechanism_class})"


def _class(structure: Structure, translate: Translate) -> Sequence[str]:
    """The groups in one line, the mechanism's class, and what else is to be known of it."""
    level = numeral(structure.mechanism_class, translate)
    lines = [
        _("Mechanism = frame + {chain}", chain=structure.chain),
        _("It is a class {level} mechanism.", level=level),
    ]
    if len(structure.parts) > 1:
        parts = translate(_(" and ")).join("{" + ", ".join(part) + "}" for part in structure.parts)
        lines.append(
            _(
                "These are {count} mechanisms that share nothing but the frame: {parts}.",
                count=len(structure.parts),
                parts=parts,
            )
        )
    if structure.drivers:
        lines.append(_("Another choice of driver leads to other groups, and may change the class."))
    return lines


def turned_against(structure: Structure, translate: Translate) -> list[str]:
    """The drivers that turn a link against another one than the frame, a sentence each."""
    return [
        _(
            "{driver}: turns {link} about {pin} against {other}, not against the frame.",
            driver=name,
            link=link,
            pin=pin,
            other=other,
        )
        for name, (link, pin, other) in structure.turned.items()
        if other != "frame"
    ]


def numeral(number: int, translate: Translate) -> str:
    """A class as it is written in the books."""
    numerals = translate(_("I II III IV V VI VII VIII IX X")).split()
    return numerals[number - 1] if number <= len(numerals) else str(number)


_MOBILITIES = {
    (False, False): _("Mobility F = 3n - 2p = 3·{links} - 2·{pairs} = {mobility}"),
    (False, True): _("Mobility F = 3n - 2p - 3w = 3·{links} - 2·{pairs} - 3·{welds} = {mobility}"),
    (True, False): _("Mobility F = 3n - 2p - p_H = 3·{links} - 2·{pairs} - {higher} = {mobility}"),
    (True, True): _("Mobility F = 3n - 2p - 3w - p_H = 3·{links} - 2·{pairs} - 3·{welds} - {higher} = {mobility}"),
}


def _mobility(structure: Structure, translate: Translate) -> list[str]:
    n, (r, p, w) = structure.counts["links"], lower_pair_counts(structure.counts)
    higher = {kind: count for kind, count in structure.counts.items() if kind in JOINTS and JOINTS[kind].higher}
    h = sum(higher.values())
    counted = (
        ngettext(
            "Moving links n = {links}; lower pairs p = {pairs}: {revolute} revolute, {prismatic} prismatic; "
            "{count} weld",
            "Moving links n = {links}; lower pairs p = {pairs}: {revolute} revolute, {prismatic} prismatic; "
            "{count} welds",
            count=w,
        )
        if w
        else _("Moving links n = {links}; lower pairs p = {pairs}: {revolute} revolute, {prismatic} prismatic")
    ).format(links=n, pairs=r + p, revolute=r, prismatic=p)
    first = translate(counted)
    if h:
        kinds = ", ".join(f"{count} {_kind(kind, translate)}" for kind, count in higher.items())
        first += translate(_("; higher pairs p_H = {higher}: {kinds}", higher=h, kinds=kinds))
    values = {"links": n, "pairs": r + p, "welds": w, "higher": h, "mobility": structure.grubler}
    lines = [first, translate(_MOBILITIES[bool(h), bool(w)].format(**values))]
    guides = ", ".join(name for name in structure.redundant if name not in structure.passive)
    if guides:
        lines.append(
            _(
                "The guides {guides} close a loop in which rotation is already prevented: each such "
                "demand is redundant, so the mobility is {mobility}.",
                guides=guides,
                mobility=structure.mobility,
            )
        )
    if structure.passive:
        pairs = ", ".join(structure.passive)
        lines.append(
            _(
                "The pairs {pairs} demand what other pairs demand already: they are passive "
                "constraints, so the mobility is {mobility}.",
                pairs=pairs,
                mobility=structure.mobility,
            )
        )
    drivers = len(structure.drivers)
    if structure.mobility == 0 and not drivers:
        lines.append(_("Mobility 0 and no driver: a structure at rest, which carries loads."))
    elif structure.mobility == drivers:
        lines.append(_("Mobility equals the number of drivers ({count}): the motion is determined.", count=drivers))
    return lines


def _kind(kind: str, translate: Translate) -> str:
    """A kind of joint as it is read; a kind of another package by its own word."""
    return translate(PAIRS[kind]) if kind in PAIRS else kind


def _train(train: GearTrain, translate: Translate) -> Table:
    """The ratios of a train by the method of the stopped carrier."""
    wheels = list(train.ratios)
    carrier, frame = (link_label(name, language_of(translate)) for name in (train.carrier, "frame"))
    stopped = translate(_("{carrier} stopped", carrier=carrier))
    rows = [["", *wheels], [stopped, *map(written, train.ratios.values())]]
    if train.planetary:
        rows[0].append(train.carrier)
        rows[1].append("0")
        rows.append([translate(_("all as one")), *["1"] * (len(wheels) + 1)])
        if speeds := train.speeds:
            rows.append([translate(_("{carrier} stopped", carrier=frame)), *map(written, speeds.values())])
    title = _(
        "Ratios of the train {pairs} by the method of the stopped carrier ({carrier}):",
        pairs=", ".join(train.pairs),
        carrier=carrier,
    )
    notes = [
        _(
            "  (n_{wheel} - n_{carrier}) / (n_{first} - n_{carrier}) = {ratio}",
            carrier=train.carrier,
            first=train.first,
            wheel=wheel,
            ratio=written(ratio),
        )
        for wheel, ratio in list(train.ratios.items())[1:]
        if train.planetary
    ]
    return Table((), rows, "<" * len(rows[0]), title, notes)


def _row(number: int, group: Group, translate: Translate) -> tuple[str, str, str, str, str]:
    drivers = ", ".join(group.drivers)
    unnamed = group.drivers == ("driver",)
    if group.assur_class == 1 and group.drivers:
        what = translate(_("driven by driver") if unnamed else _("driven by {drivers}", drivers=drivers))
    else:
        level, form = numeral(group.assur_class, translate), _("class {level}, order {order}")
        if group.drivers:
            form = (
                _("class {level}, order {order}, with the driver inside")
                if unnamed
                else _("class {level}, order {order}, with driver {drivers} inside")
            )
        what = translate(form.format(level=level, order=group.assur_order, drivers=drivers))
    outer = ", ".join(dict.fromkeys(c.joint for c in group.outer_joints))
    inner = ", ".join(dict.fromkeys(c.joint for c in group.inner_joints))
    seats = _("outer joints {outer}; inner joints {inner}") if inner else _("outer joints {outer}")
    joints = translate(seats.format(outer=outer, inner=inner))
    return f"{number}.", group.signature, f"({', '.join(group.links)})", what, joints


def _joint(connection: Connection) -> dict[str, object]:
    return {"joint": connection.joint, "kind": connection.kind, "links": [connection.a, connection.b]}

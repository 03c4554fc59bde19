"""The gears of the machine: sizes, ratios with the carrier stopped, geometry of the teeth."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from linkwright.errors import LinkwrightError
from linkwright.gears.gear import Gear
from linkwright.gears.pair import GearPair, gear_pair
from linkwright.joints.base import Joint
from linkwright.joints.gear import GearPair as GearJoint
from linkwright.joints.rack import RackPair
from linkwright.joints.toothed import WheelPair
from linkwright.report.case import Case, Missing
from linkwright.report.document import Block, Figure, Formula, Heading, Paragraph, Table, literal
from linkwright.report.section import SECTIONS, Section
from linkwright.structure.trains import GearTrain, written
from linkwright.words import has
from linkwright.words.sentence import Sentence
from linkwright.worked.symbols import tex


@SECTIONS.register("gears")
class Gears(Section):
    """Pairs of wheels and racks with their sizes, ratios of trains, teeth where module and numbers are given."""

    name, rank, optional = "gears", 8.5, True

    def blocks(self, case: Case) -> Iterator[Block]:
        pairs = [joint for joint in case.mechanism.joints.values() if isinstance(joint, WheelPair | RackPair)]
        if not pairs:
            raise Missing(Sentence("report.no_gears"))
        yield Paragraph(case.say("report.gears_text"))
        yield _sizes(case, pairs)
        for train in case.structure.trains:
            yield from _train(case, train)
        for same in _alike(pairs):
            yield from _teeth(case, same)


def _sizes(case: Case, pairs: list[WheelPair | RackPair]) -> Table:
    say = case.say
    rows = tuple(tuple(map(literal, _row(case, pair))) for pair in pairs)
    head = (
        say("report.joint"), say("report.kind"), say("report.wheels"), "$z$", "$m$ / mm", "$r$ / mm",
        "$a$ / mm", r"$\alpha$ / °", "$i$",
    )  # fmt: skip
    return Table(say("report.wheels_table"), head, rows, "<<<>>>>>>", "wheels")


def _row(case: Case, pair: WheelPair | RackPair) -> tuple[str, ...]:
    """Name, kind, wheels, teeth, module, pitch radii, centre distance, pressure angle, ratio."""
    kind = case.say(f"nouns.pair_{pair.kind}") if has(f"nouns.pair_{pair.kind}") else pair.kind
    own: Any = pair
    module, angle = getattr(own, "module", None), getattr(own, "pressure_angle", None)
    size = f"{1e3 * module:.6g}" if module else "–"
    pressure = f"{math.degrees(angle):.6g}" if angle is not None else "–"
    if isinstance(pair, RackPair):
        teeth = f"{pair.teeth:g}" if pair.teeth else "–"
        wheels = f"{pair.pinion}, {pair.rack}"
        return pair.name, kind, wheels, teeth, size, f"{1e3 * pair.radius:.6g}", "–", pressure, "–"
    distance = _distance(case, pair)
    teeth = ", ".join(f"{each:g}" for each in pair.teeth) if pair.teeth else "–"
    return (
        pair.name, kind, ", ".join(pair.links), teeth, size, _radii(pair, distance), f"{1e3 * distance:.6g}",
        pressure, written(pair.transmission),
    )  # fmt: skip


def _distance(case: Case, pair: WheelPair) -> float:
    points = case.mechanism.link(pair.carrier).points
    return math.dist(*(points[each] for each in pair.centres))


def _radii(pair: WheelPair, distance: float) -> str:
    """Pitch radii, mm: of belts and chains, or as given; else from ratio and centre distance."""
    found = pair.running_radii() or pair.radii
    if found is None:
        i = pair.transmission
        found = (abs(distance * i / (i - 1.0)), abs(distance / (i - 1.0)))
    return ", ".join(f"{1e3 * each:.6g}" for each in found)


def _train(case: Case, train: GearTrain) -> Iterator[Block]:
    """The table of the stopped carrier, and the equations that follow from it."""
    say, wheels = case.say, list(train.ratios)
    carrier = [train.carrier] if train.planetary else []
    stopped = [say("structure_text.stopped", carrier=train.carrier), *map(written, train.ratios.values())]
    rows = [(*stopped, "0") if carrier else tuple(stopped)]
    if carrier:
        rows.append((say("structure_text.as_one"), *["1"] * (len(wheels) + 1)))
    caption = say("report.train_table", pairs=", ".join(train.pairs), carrier=train.carrier)
    head = (say("report.motion"), *wheels, *carrier)
    yield Table(literal(caption), tuple(map(literal, head)),
                tuple(tuple(map(literal, row)) for row in rows), "<" + ">" * (len(head) - 1))  # fmt: skip
    omega = {name: rf"\omega_{{{number}}}" for name, number in case.heads.numbers.items()}
    first = omega[train.first]
    for wheel, ratio in list(train.ratios.items())[1:]:
        own = omega[wheel]
        if train.planetary:
            c = omega[train.carrier]
            yield Formula((rf"\frac{{{own} - {c}}}{{{first} - {c}}}", _latex(ratio)))
        else:
            yield Formula((f"i_{{{tex(wheel)}}}", rf"\frac{{{own}}}{{{first}}}", _latex(ratio)))
    if train.blocked:
        yield Paragraph(literal(say("report.blocked", pairs=", ".join(train.blocked))), "note")


def _latex(ratio: float) -> str:
    text = written(ratio)
    above, bar, below = text.partition("/")
    sign = "-" if above.startswith("-") else ""
    return rf"{sign}\frac{{{above.removeprefix('-')}}}{{{below}}}" if bar else text


def _alike(pairs: Sequence[Joint]) -> list[list[GearJoint]]:
    """Gears whose module and whole numbers of teeth are given, those with equal ones together."""
    found: dict[tuple[object, ...], list[GearJoint]] = {}
    for pair in pairs:
        if (
            isinstance(pair, GearJoint)
            and pair.module
            and pair.teeth
            and all(z == int(z) for z in pair.teeth)
        ):
            sizes = (pair.teeth, pair.module, pair.pressure_angle, pair.mesh)
            found.setdefault(sizes, []).append(pair)
    return list(found.values())


def _teeth(case: Case, same: list[GearJoint]) -> Iterator[Block]:
    """Diameters and contact of equal pairs of gears."""
    say, pair = case.say, same[0]
    assert pair.teeth is not None and pair.module is not None
    internal = pair.mesh == "internal"
    ends = list(zip(pair.teeth, pair.links, strict=True))
    (first, a), (second, b) = sorted(ends) if internal else ends
    title = "; ".join(f"{each.name} ({', '.join(each.links)})" for each in same)
    yield Heading(literal(title), 2)
    teeth, names = (int(first), int(second)), [a, b]
    try:
        mesh = gear_pair(teeth, pair.module, pressure_angle=pair.pressure_angle, internal=internal)
    except LinkwrightError as error:
        yield Paragraph(literal(case.told(error)), "missing")
        return
    yield Paragraph(say("report.teeth_text"))
    yield _diameters(case, mesh, names)
    yield Paragraph(
        say("report.contact", ratio=f"{mesh.contact_ratio:.4g}", distance=f"{1e3 * mesh.centre_distance:.6g}",
            angle=f"{math.degrees(mesh.working_pressure_angle):.6g}")
    )  # fmt: skip
    for sentence in mesh.findings:
        yield Paragraph(literal(case.sentence(sentence)), "note")
    yield Figure(say("report.caption_teeth", pair=literal(", ".join(each.name for each in same))),
                 ((mesh.draw(language=case.language).svg, 0.7),), tallest=110.0)  # fmt: skip


def _diameters(case: Case, mesh: GearPair, names: list[str]) -> Table:
    say = case.say
    rows = tuple(
        (literal(name), str(gear.teeth), *(f"{1e3 * each:.6g}" for each in _circles(gear)))
        for name, gear in zip(names, (mesh.pinion, mesh.wheel), strict=True)
    )
    head = (say("report.link"), "$z$", "$d$ / mm", "$d_{b}$ / mm", "$d_{a}$ / mm", "$d_{f}$ / mm", "$s$ / mm")
    return Table(say("report.diameters"), head, rows, "<>>>>>>")


def _circles(gear: Gear) -> tuple[float, ...]:
    """Diameters of pitch, base, tip and root circle, and the thickness of a tooth on the pitch circle, m."""
    return gear.pitch_diameter, gear.base_diameter, gear.tip_diameter, gear.root_diameter, gear.thickness

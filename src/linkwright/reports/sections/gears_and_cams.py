"""Gears of the machine: sizes, ratios, teeth; and its cams: law, profile, pressure angle, curvature."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from linkwright.cams.cam import cam_of
from linkwright.cams.result import CamDesign
from linkwright.core.quantity import number
from linkwright.core.table import Amount, Cell, Table
from linkwright.equations.notation import Fraction, Row, row, sign
from linkwright.equations.reading import read, read_name
from linkwright.errors import LinkwrightError, with_remedy
from linkwright.gears.gear import Gear
from linkwright.gears.pair import GearPair, gear_pair
from linkwright.joints.cam import CamJoint
from linkwright.laws.base import LABELS
from linkwright.laws.program import MotionProgram
from linkwright.mechanism.wheels_and_cams import WheelSizes, wheel_sizes
from linkwright.reports.calculation import numbers_and_way
from linkwright.reports.document import Block, Figure, Formula, Heading, Paragraph, literal, printed
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.topology.constraints import GearTrain, written
from linkwright.words import _, pgettext
from linkwright.words.message import link_label


@section("gears", _("Gears, racks and belts"), 8.5, optional=True)
def gears(case: ReportContext) -> Iterator[Block]:
    """Pairs of wheels and racks with their sizes, ratios of trains, teeth where module and numbers are given."""
    mechanism = case.mechanism
    found = {joint.name: wheel_sizes(joint, mechanism) for joint in mechanism.joints.values()}
    pairs = {name: sizes for name, sizes in found.items() if sizes is not None}
    if not pairs:
        raise Missing(_("there are no gears, racks or belts", code="report.no_gears"))
    yield Paragraph(
        case.translate(
            _(
                "$z$: numbers of teeth, $m$: module, $r$: pitch radii, $a$: centre distance, "
                "$\\alpha$: pressure angle, $i$: ratio of the second wheel to the first with the "
                "carrier stopped."
            )
        )
    )
    yield _sizes(case, pairs)
    for train in case.structure.trains:
        yield from _train(case, train)
    for names in _equal_pairs(pairs):
        yield from _teeth(case, names, pairs[names[0]])


def _sizes(case: ReportContext, pairs: Mapping[str, WheelSizes]) -> Block:
    rows = [_row(case, name, sizes) for name, sizes in pairs.items()]
    head = (_("joint"), _("kind"), _("wheels"), "$z$", "$m$ / mm", "$r$ / mm", "$a$ / mm", r"$\alpha$ / °", "$i$")
    table = Table(head, rows, "<<<>>>>>>", _("Pairs of wheels and racks"))
    return printed(table, case.language, "wheels")


def _row(case: ReportContext, name: str, sizes: WheelSizes) -> tuple[str, ...]:
    """Name, kind, wheels, teeth, module, pitch radii, centre distance, pressure angle, ratio."""
    return (
        name,
        case.sentence(case.mechanism.joints[name].word()),
        ", ".join(sizes.links),
        _listed(sizes.teeth),
        _listed(sizes.module, 1e3),
        _listed(sizes.radii, 1e3),
        _listed(sizes.distance, 1e3),
        _listed(sizes.pressure_angle, 180.0 / math.pi),
        "–" if sizes.ratio is None else written(sizes.ratio),
    )


def _listed(values: float | Sequence[float] | None, factor: float = 1.0) -> str:
    """Numbers times a factor, or a dash where there are none."""
    if values is None:
        return "–"
    several = [values] if isinstance(values, float) else values
    return ", ".join(f"{factor * each:.6g}" for each in several)


def _train(case: ReportContext, train: GearTrain) -> Iterator[Block]:
    """The table of the stopped carrier, and the equations that follow from it."""
    translate, wheels = case.translate, list(train.ratios)
    carrier = [train.carrier] if train.planetary else []
    held, frame = (link_label(name, case.language) for name in (train.carrier, "frame"))
    stopped = [translate(_("{carrier} stopped", carrier=held)), *map(written, train.ratios.values())]
    rows = [(*stopped, "0") if carrier else tuple(stopped)]
    if carrier:
        rows.append((translate(_("all as one")), *["1"] * (len(wheels) + 1)))
    if speeds := train.speeds:
        rows.append((translate(_("{carrier} stopped", carrier=frame)), *map(written, speeds.values())))
    caption = translate(
        _(
            "Speeds of the train {pairs} with the carrier ({carrier}) stopped, as shares of the first one",
            pairs=", ".join(train.pairs),
            carrier=held,
        )
    )
    head = (pgettext("report", "motion"), *map(literal, (*wheels, *carrier)))
    yield printed(Table(head, rows, title=literal(caption)), case.language)
    omega = {name: read_name(f"ω{number}") for name, number in case.heads.numbers.items()}
    first = omega[train.first]
    for wheel, ratio in list(train.ratios.items())[1:]:
        own = omega[wheel]
        if train.planetary:
            less = (sign("-"), omega[train.carrier])
            yield Formula((Row((Fraction(row((own, *less)), row((first, *less))),)), read(written(ratio))))
        else:
            yield Formula((read_name(f"i_{wheel}"), Row((Fraction(own, first),)), read(written(ratio))))
    if train.blocked:
        yield Paragraph(
            literal(
                translate(
                    _(
                        "{pairs} would give a wheel another ratio: the wheels cannot turn against the carrier.",
                        pairs=", ".join(train.blocked),
                    )
                )
            ),
            "note",
        )


def _equal_pairs(pairs: Mapping[str, WheelSizes]) -> list[list[str]]:
    """Names of gears with a module and integer numbers of teeth, those with equal ones together."""
    found: dict[tuple[object, ...], list[str]] = {}
    for name, sizes in pairs.items():
        if sizes.involute and all(z == int(z) for z in sizes.teeth or ()):
            own = (sizes.teeth, sizes.module, sizes.pressure_angle, _internal(sizes))
            found.setdefault(own, []).append(name)
    return list(found.values())


def _internal(sizes: WheelSizes) -> bool:
    return sizes.ratio is not None and sizes.ratio > 0


def _teeth(case: ReportContext, same: Sequence[str], sizes: WheelSizes) -> Iterator[Block]:
    """Diameters and contact of equal pairs of gears."""
    translate, internal = case.translate, _internal(sizes)
    assert sizes.teeth is not None and sizes.module is not None and sizes.pressure_angle is not None
    ends = list(zip(sizes.teeth, sizes.links, strict=True))
    (first, a), (second, b) = sorted(ends) if internal else ends
    joints = case.mechanism.joints
    title = "; ".join(f"{name} ({', '.join(joints[name].joined)})" for name in same)
    yield Heading(literal(title), 2)
    teeth, names = (int(first), int(second)), [a, b]
    try:
        mesh = gear_pair(teeth, sizes.module, pressure_angle=sizes.pressure_angle, internal=internal)
    except LinkwrightError as error:
        yield Paragraph(literal(case.message(error)), "missing")
        return
    yield Paragraph(
        translate(
            _(
                "Standard involute teeth (addendum 1 module, dedendum 1.25 modules), no profile "
                "shift; $d$, $d_{b}$, $d_{a}$, $d_{f}$: diameters of the pitch, base, tip and root "
                "circles, $s$: thickness of a tooth (of a ring: of a space) on the pitch circle."
            )
        )
    )
    yield _diameters(case, mesh, names)
    yield Paragraph(
        translate(
            _(
                "Contact ratio {ratio}, centre distance {distance} mm, pressure angle in mesh {angle}°.",
                ratio=f"{mesh.contact_ratio:.4g}",
                distance=number(mesh.centre_distance, "length"),
                angle=number(mesh.working_pressure_angle, "angle"),
            )
        )
    )
    for sentence in mesh.findings:
        yield Paragraph(literal(case.sentence(sentence)), "note")
    yield Figure(
        translate(_("Teeth of {pair} in mesh", pair=literal(", ".join(same)))),
        ((mesh.draw(language=case.language).svg, 0.7),),
        tallest=110.0,
    )


def _diameters(case: ReportContext, mesh: GearPair, names: list[str]) -> Block:
    rows: list[list[Cell]] = [
        [name, gear.teeth, *(Amount(each, "length", bare=True) for each in _circles(gear))]
        for name, gear in zip(names, (mesh.pinion, mesh.wheel), strict=True)
    ]
    head = (_("link"), "$z$", "$d$ / mm", "$d_{b}$ / mm", "$d_{a}$ / mm", "$d_{f}$ / mm", "$s$ / mm")
    return printed(Table(head, rows, title=_("Circles and teeth")), case.language)


def _circles(gear: Gear) -> tuple[float, ...]:
    """Diameters of pitch, base, tip and root circle, and the thickness of a tooth on the pitch circle, m."""
    return gear.pitch_diameter, gear.base_diameter, gear.tip_diameter, gear.root_diameter, gear.thickness


#: What a follower touches its cam with.
TOUCH = {"roller": _("a roller"), "knife": _("an edge"), "flat": _("a flat face")}


@section("cams", _("Cams"), 8.6, optional=True)
def cams(case: ReportContext) -> Iterator[Block]:
    """Every cam with its motion program, its profile, and the checks that a cam is designed by."""
    joints = [joint for joint in case.mechanism.joints.values() if isinstance(joint, CamJoint)]
    if not joints:
        raise Missing(_("there are no cams", code="report.no_cams"))
    for joint in joints:
        cam = cam_of(case.mechanism, joint.name, speed=_speed(case, joint))
        yield Heading(literal(joint.name), 2)
        yield Paragraph(_about(case, joint))
        if isinstance(cam.program, MotionProgram):
            yield _program(case, cam.program, lift_unit="°" if joint.side else "mm")
        for finding in cam.findings():
            text = with_remedy(finding.message, finding.remedy)
            yield Paragraph(literal(case.sentence(text)), "note")
        yield from numbers_and_way(CamDesign(cam), case.translate, case.language, 3)


def _about(case: ReportContext, joint: CamJoint) -> str:
    translate = case.translate
    motion = _("pivoted") if joint.side else _("guided")
    law = (
        _("The lift follows a motion program; numbers below are per turn of the cam.")
        if joint.program is not None
        else _("The lift is the smooth curve through {count} given points.", count=len(joint.angles))
    )
    return translate(
        _(
            "{cam} moves {follower}, which is {motion}, through {touch}. ",
            cam=literal(joint.cam),
            follower=literal(joint.follower),
            motion=motion,
            touch=TOUCH[joint.touch],
        )
    ) + translate(law)


def _speed(case: ReportContext, joint: CamJoint) -> float:
    """Angular velocity of the cam against its carrier, rad/s; zero where it varies."""
    if not case.mechanism.drivers:
        return 0.0
    rates = case.motion.link(joint.cam).angular_velocity - case.motion.link(joint.carrier).angular_velocity
    known = rates[np.isfinite(rates)]
    return float(known[0]) if np.ptp(known) <= 1e-9 * abs(known[0]) else 0.0


def _program(case: ReportContext, program: MotionProgram, lift_unit: str) -> Block:
    """The segments of a program: from where to where, lifts, law."""
    kind = "angle" if lift_unit == "°" else "length"
    ends = list(itertools.pairwise(program.edges))
    lifts = list(itertools.pairwise(program.lift_at_edges))
    rows: list[list[Cell]] = [
        [
            index,
            *(Amount(each, "angle", bare=True) for each in place),
            *(Amount(each, kind, bare=True) for each in lift),
            LABELS.get(law, law),
        ]
        for index, (place, lift, law) in enumerate(zip(ends, lifts, program.law_names, strict=True), 1)
    ]
    head = (
        _("no."),
        _("from $\\varphi$ / °"),
        _("to $\\varphi$ / °"),
        case.translate(_("lift from")) + f" / {lift_unit}",
        case.translate(_("lift to")) + f" / {lift_unit}",
        _("law"),
    )
    return printed(Table(head, rows, ">>>>><", _("Motion program")), case.language)

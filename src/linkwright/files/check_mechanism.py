"""Checks across the model: what is used nowhere, not joined, or probably misspelt."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from functools import partial

from linkwright.errors import Severity
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import below
from linkwright.files.reader import Reader
from linkwright.joints.base import Joint
from linkwright.mechanism.link import Link, Vec
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.wheels_and_cams import disc_radii
from linkwright.units import number
from linkwright.words import _

_NAME = re.compile(r"[^\W\d]\w*")
#: Points of a link of which all pairs are measured.
MOST_PAIRED = 32
#: Angles of guides, as a file rounds them, that agree within this (rad).
SAME_ANGLE = 1e-3


def check_mechanism(reader: Reader, root: MappingNode, mechanism: Mechanism) -> None:
    """Add the findings that concern the complete model."""
    _unused_parameters(reader, root, mechanism)
    if not _all_read(reader, root, mechanism):
        return
    _lonely_links(reader, root, mechanism)
    _islands(reader, root, mechanism)
    _near_points(reader, root, mechanism)
    _guides_at_odds(reader, root, mechanism)
    _unlikely_inertias(reader, root, mechanism)
    _missing_inertias(reader, root, mechanism)
    _assumed_centres(reader, root, mechanism)
    _phases_of_no_motion(reader, root, mechanism)


def _all_read(reader: Reader, root: MappingNode, mechanism: Mechanism) -> bool:
    """Whether every link and joint could be read: only then is a missing connection really missing."""
    joints = root.get("joints")
    declared = [key for key, _unused in joints] if isinstance(joints, MappingNode) else []
    links = all(name in mechanism.links or name == "frame" for name in reader.names.links)
    return links and bool(mechanism.links) and all(name in mechanism.joints for name in declared)


def _unused_parameters(reader: Reader, root: MappingNode, mechanism: Mechanism) -> None:
    expected = _NAME.findall(str(dict(mechanism.expect))) if mechanism.expect else ()
    for name in mechanism.parameters:
        if name not in reader.used and name not in expected:
            reader.finding(
                below(root, "parameters", name),
                f"parameters.{name}",
                _('the parameter "{name}" is used nowhere'),
                "unused",
                _("use or remove it"),
                severity="warning",
                name=name,
            )


def _lonely_links(reader: Reader, root: MappingNode, mechanism: Mechanism) -> None:
    of_link: dict[str, list[Joint]] = {name: [] for name in ("frame", *mechanism.links)}
    for joint in mechanism.joints.values():
        for name in dict.fromkeys(joint.joined):
            of_link[name].append(joint)
    for name, link in mechanism.links.items():
        joints = of_link[name]
        key, node = f"links.{name}", below(root, "links", name)
        if not joints:
            points = ", ".join(link.points)
            reader.finding(
                node,
                key,
                _('the link "{name}" is used nowhere: no other link has one of its points ({points})'),
                "unused",
                _("give a shared point the same name on both links, or remove the link"),
                name=name,
                points=points,
            )
        elif len(link.points) == 1 and all(joint.coordinate == "turn" for joint in joints):
            reader.finding(
                node,
                key,
                _('the link "{name}" has one point and is in no prismatic joint'),
                "one-point",
                _("add a second point with a length, or a prismatic joint with it as block"),
                name=name,
            )


def _islands(reader: Reader, root: MappingNode, mechanism: Mechanism) -> None:
    reached, found = set[str](), {"frame"}
    while found:
        reached |= found
        found = {
            link
            for joint in mechanism.joints.values()
            if reached & set(joint.joined)
            for link in joint.joined
            if link not in reached
        }
    unreached = [name for name in mechanism.links if name not in reached]
    joined = [name for name in unreached if any(name in joint.joined for joint in mechanism.joints.values())]
    if joined and not reader.names.incomplete:
        reader.finding(
            below(root, "links", joined[0]),
            f"links.{joined[0]}",
            _("{links} are not connected to the frame"),
            "not-connected",
            _("share a point with the frame or with a link that is connected"),
            links=tuple(joined),
        )


def _near_points(reader: Reader, root: MappingNode, mechanism: Mechanism) -> None:
    everywhere = {point for link in (mechanism.frame, *mechanism.links.values()) for point in link.points}
    folded: dict[str, set[str]] = {}
    for point in everywhere:
        folded.setdefault(point.casefold(), set()).add(point)
    for name, link in mechanism.links.items():
        own = set(link.points)
        for point in link.points:
            similar = sorted(folded[point.casefold()] - own)
            if similar and reader.names.owners(point) == [name]:
                reader.finding(
                    below(root, "links", name),
                    f"links.{name}.points",
                    _('"{point}" is on this link only, and there is a point "{similar}"'),
                    "near-name",
                    _("write the same name on both if one point is meant"),
                    severity="warning",
                    point=point,
                    similar=similar[0],
                )


def _guides_at_odds(reader: Reader, root: MappingNode, mechanism: Mechanism) -> None:
    """Guides that hold a link at another angle than other guides do, so that it cannot be put together.

    A block of one point that carries no guide has no angle of its own: without a ``block_angle`` it takes the one
    that fits.
    """
    carriers = {guide.guide for guide in mechanism.guides.values()}
    for name, block, off in guides_at_odds(mechanism):
        key, angle_node = f"joints.{name}.block_angle", below(root, "joints", name, "block_angle")
        if angle_node is None and len(mechanism.links[block].points) == 1 and block not in carriers:
            continue
        node = angle_node or below(root, "joints", name)
        fitting = math.remainder(mechanism.guides[name].block_angle + off, math.tau)
        reader.finding(
            node,
            key,
            _(
                'the guide "{name}" holds "{link}" at an angle that is {off}° off the one at which '
                "other guides hold it, so that they do not fit together"
            ),
            "at-odds",
            _("write block_angle: {fitting} deg"),
            name=name,
            link=block,
            off=number(math.degrees(abs(off)), 6),
            fitting=number(math.degrees(fitting), 9),
        )


def guides_at_odds(mechanism: Mechanism) -> Iterator[tuple[str, str, float]]:
    """Guides that hold their blocks at another angle than other guides and welds do, and by how much, rad."""
    held: dict[str, tuple[str, float]] = {}
    for name, joint in sorted(mechanism.joints.items(), key=lambda each: not each[1].ties):
        if not joint.ties:
            return
        a, b = joint.ties
        (root_a, angle_a), (root_b, angle_b) = (held.get(link, (link, 0.0)) for link in (a, b))
        turn = joint.turn_of(b, mechanism)
        if root_a != root_b:
            for link, (top, angle) in {**held, root_b: (root_b, 0.0)}.items():
                if top == root_b:
                    held[link] = (root_a, angle + angle_a + turn - angle_b)
            continue
        off = math.remainder(turn - (angle_b - angle_a), math.pi)
        if joint.coordinate == "slide" and abs(off) > SAME_ANGLE:
            yield name, b, off


def _unlikely_inertias(reader: Reader, root: MappingNode, mechanism: Mechanism) -> None:
    """Moments of inertia that no body of the link's mass and size could have."""
    for name, link in mechanism.links.items():
        if not link.inertia:
            continue
        size = _size(link)
        if not size and (link.mass or set(link.points) <= set(mechanism.frame.points)):
            continue
        if link.inertia <= link.mass * (2.0 * size) ** 2:
            continue
        if mechanism.higher and reader.error_count:  # a wheel may not be read, or not be placed
            continue
        size = max(size, *_discs(mechanism, name), 0.0)
        if link.inertia <= link.mass * (2.0 * size) ** 2:
            continue
        if link.mass:
            radius = math.sqrt(link.inertia / link.mass)
            sentence = _(
                "with {mass} kg the radius of gyration is {radius} m",
                mass=number(link.mass, 6),
                radius=number(radius, 4),
            )
            problem = _(
                "{sentence}, more than twice the link's size of {size} m", sentence=sentence, size=number(size, 4)
            )
        else:
            problem = _("a link without mass has a moment of inertia", code="model.inertia_without_mass")
        at = below(root, "links", name, "inertia")
        remedy = _("check its unit (kg·m²), the mass, and that it is about the mass centre")
        reader.error(at, f"links.{name}.inertia", problem, remedy, "unlikely", severity="warning")


def _discs(mechanism: Mechanism, link: str) -> list[float]:
    """How far the wheels and cams of a link reach, m."""
    pairs = (joint.settled(mechanism, _unreported) for joint in mechanism.joints.values() if joint.higher)
    return [radii[link] for pair in pairs if link in (radii := disc_radii(pair, mechanism))]


def _unreported(*_: object, **__: object) -> None:
    """Findings that are reported when all of the model is read."""


def _missing_inertias(reader: Reader, root: MappingNode, mechanism: Mechanism) -> None:
    """Links that turn and have a mass, but no word about their moment of inertia, which then counts as zero."""
    sliding = links_that_slide(mechanism)
    for name, link in mechanism.links.items() if mechanism.drivers else ():
        if len(link.points) == 1 and reader.error_count:  # perhaps a block whose guide is not named
            continue
        if name in sliding or not link.mass or link.mass_from_shape or below(root, "links", name, "inertia"):
            continue
        message = _(
            'the link "{link}" turns and has a mass of {mass} kg, but no moment of inertia: it counts as zero',
            link=name,
            mass=number(link.mass, 6),
        )
        at, remedy = (
            below(root, "links", name, "mass"),
            _("add the moment of inertia about its mass centre (inertia: … kg·m²), or inertia: 0 if that is meant"),
        )
        reader.error(at, f"links.{name}.inertia", message, remedy, "no-inertia", severity="warning")


def _assumed_centres(reader: Reader, root: MappingNode, mechanism: Mechanism) -> None:
    """Links of three points and more, in axes of their own, with a mass, but no word about their mass centre, where
    midway between the first two points is not the middle of all."""
    for name, link in mechanism.links.items():
        drawn = link.geometry not in ("coordinates", "bent")
        if drawn or len(link.points) < 3 or not link.mass or link.mass_centre is not None:
            continue
        middle = [(min(row) + max(row)) / 2 for row in zip(*link.points.values(), strict=True)]
        if math.dist(middle, link.centre) > 1e-9 * link.reach:
            first, second = list(link.points)[:2]
            message = _(
                'the link "{link}" has a mass and more than two points, but no mass centre: it is '
                "taken midway between the first two, {first} and {second}",
                link=name,
                first=first,
                second=second,
            )
            at, remedy = (
                below(root, "links", name, "mass"),
                _("give mass_centre: [x, y] in the link's axes, or one of its points"),
            )
            reader.error(at, f"links.{name}.mass_centre", message, remedy, "no-mass-centre", severity="warning")


def links_that_slide(mechanism: Mechanism) -> set[str]:
    """The frame and the links that cannot turn, since guides and welds tie them to it."""
    sliding, grown = {"frame"}, True
    while grown:
        pairs = [j.joined[:2] for j in mechanism.joints.values() if j.ties]
        more = {link for pair in pairs if sliding & set(pair) for link in pair} - sliding
        sliding, grown = sliding | more, bool(more)
    return sliding


def _phases_of_no_motion(reader: Reader, root: MappingNode, mechanism: Mechanism) -> None:
    """Loads that act by the angle of a link that only slides: it never reverses, so that a stroke of it is an error;
    while it moves is never, which is odd.
    """
    sliding = links_that_slide(mechanism)
    for name, load in mechanism.loads.items():
        outputs = load.magnitude.phase.outputs
        output = next((each for each in outputs if each.kind == "angle" and each.owner in sliding), None)
        if output is None:
            continue
        key = "moving" if below(root, "loads", name, "phase", "moving") else "of"
        at = below(root, "loads", name, "phase", key)
        guides = [joint for joint in mechanism.guides if output.owner in mechanism.joints[joint].joined]
        message = _(
            'the link "{link}" only slides: its angle never changes, so there is nothing to act by', link=output.owner
        )
        remedy = (
            _("name the guide's displacement: {word}: {guide}", word=key, guide=guides[0])
            if guides
            else _("name a point's coordinate, such as C.x, or a guide")
        )
        severity: Severity = "error" if key == "of" else "warning"
        reader.error(at, f"loads.{name}.phase.{key}", message, remedy, "no-motion", severity=severity)


def _size(link: Link) -> float:
    """Largest distance between two points of a link, its mass centre among them, m; of many points within 1 %."""
    places = [*link.points.values(), link.centre]
    if len(places) > MOST_PAIRED:
        turns = [math.tau * k / MOST_PAIRED for k in range(MOST_PAIRED)]
        places = [max(places, key=partial(_ahead, math.cos(turn), math.sin(turn))) for turn in turns]
    return max(math.dist(a, b) for a in places for b in places)


def _ahead(c: float, s: float, place: Vec) -> float:
    return c * place[0] + s * place[1]

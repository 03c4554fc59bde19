"""The section ``construction`` of a model file, masses from shapes, and the points through which shapes go."""

from __future__ import annotations

from dataclasses import replace

from linkwright.errors import LinkwrightError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence, below
from linkwright.fields.reading import Place
from linkwright.files.reader import Reader
from linkwright.joints.lower_pair import SlidingJoint
from linkwright.mechanism.construction import Construction, LinkShape
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _


def read_construction(reader: Reader, node: Node | None) -> Construction | None:
    """How the machine is made, if the file says so."""
    if node is None:
        return None
    before = reader.error_count
    values = reader.table(node, Place("construction", "construction"), Construction.fields())
    return None if values is None or reader.error_count > before else Construction.of_values(values)


def shape_points_known(reader: Reader, node: Node, link: str, shape: LinkShape | None) -> bool:
    """Whether a link has the points through which its shape goes; a finding where it does not."""
    through = below(node, "shape", "through")
    key = f"{'frame' if link == 'frame' else f'links.{link}'}.shape.through"
    return all(
        reader.point_of(each, key, each.text, link)
        for each in (through.items if isinstance(through, Sequence) and shape is not None else ())
        if isinstance(each, Scalar)
    )


def weighed(reader: Reader, root: MappingNode, mechanism: Mechanism) -> Mechanism:
    """The mechanism with mass, inertia and mass centre of the links whose file gives ``mass: from shape``."""
    if not any(link.mass_from_shape for link in mechanism.links.values()):
        return mechanism
    from linkwright.mechanism.mass_from_shape import mass_of

    links = dict(mechanism.links)
    for name, link in mechanism.links.items():
        if not link.mass_from_shape or not _can_be_weighed(reader, root, mechanism, name):
            continue
        try:
            mass, inertia, x, y = mass_of(mechanism, name, mechanism.dimensions().__getitem__)
        except LinkwrightError as error:
            node = below(root, "links", name, "shape") or below(root, "links", name, "mass")
            reader.error(node, f"links.{name}.shape", error.sentence, "", "outline")
            continue
        links[name] = replace(link, mass=float(mass), inertia=float(inertia), mass_centre=(float(x), float(y)))
    return replace(mechanism, links=links)


def _other_plate(mechanism: Mechanism, name: str) -> Message | None:
    """Why a link's plate is not the one that its points and its width give; None where it is."""
    link = mechanism.links[name]
    if link.shape is not None and link.shape.kind == "outline":
        return None
    for joint in mechanism.joints.values():
        guided = isinstance(joint, SlidingJoint) and (
            joint.guide == name or (joint.block == name and len(link.points) == 1 and link.shape is None)
        )
        if guided:
            return _(
                "the plate of {link} depends on the stroke and the size of the guide {joint}, so that it cannot be "
                "weighed here",
                code="shapes.guide_weighs",
                link=name,
                joint=joint.name,
            )
        if joint.higher and name in joint.joined and link.shape is None:
            return _(
                "the wheel or cam of {link} in the pair {joint} is not part of the shape of its points",
                code="shapes.wheel_weighs",
                link=name,
                joint=joint.name,
            )
    return None


def _can_be_weighed(reader: Reader, root: MappingNode, mechanism: Mechanism, name: str) -> bool:
    """Whether the file gives all that a mass follows from, and nothing that contradicts it."""
    from linkwright.mechanism.mass_from_shape import size_addresses

    key, node = f"links.{name}", below(root, "links", name, "mass")
    for other in ("inertia", "mass_centre"):
        at = below(root, "links", name, other)
        if at is not None:
            problem = _(
                "{key_} is given besides mass: from shape, which gives it too", code="shapes.given_twice", key_=other
            )
            reader.error(at, f"{key}.{other}", problem, _("keep one of them"), "choice")
            return False
    shape = mechanism.links[name].shape
    if shape is not None and shape.kind == "none":
        problem = _("a link of shape: none has no mass from its shape", code="shapes.none_weighs")
        reader.error(node, f"{key}.mass", problem, _("give its mass as a number, or another shape"), "choice")
        return False
    elsewhere = _other_plate(mechanism, name)
    if elsewhere is not None:
        reader.error(node, f"{key}.mass", elsewhere, _("give its mass as a number, or its outline"), "choice")
        return False
    missing = size_addresses(mechanism, name).missing
    if missing and mechanism.construction is None and below(root, "construction") is not None:
        reader.unread += 1  # what is wrong with the section is reported already
    elif missing:
        own, usual = zip(*missing, strict=True)
        keys = dict.fromkeys(each.rpartition(".")[2] for each in usual)
        problem = _(
            "the mass of {link} follows from its shape, but there is no {keys}",
            code="shapes.no_size",
            link=name,
            keys=tuple(keys),
        )
        remedy = _("add {lines}, or give {own}", lines=tuple(dict.fromkeys(usual)), own=own)
        reader.error(node, f"{key}.mass", problem, remedy, "missing-key")
    return not missing

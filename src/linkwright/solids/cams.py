"""Cams and what touches them: rollers on pins, flat faces and edges on posts, level with the cam."""

from __future__ import annotations

import cmath
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Complexes
from linkwright.core.plane import area
from linkwright.joints.cam import CamJoint
from linkwright.mechanism.wheels_and_cams import CamShape, full_turn
from linkwright.shapes.shape import Piece, Shape, disc, polygon
from linkwright.solids.draft import Body, Draft
from linkwright.solids.mounting import Axle, add_disc, eye, fasten

#: Every which of the places of a drawn profile is a corner of the plate.
EVERY = 2
#: Radius of a post, as a share of the link's width.
POST = 0.15
#: Depth of a face or an edge, and the rim outside a groove, in widths of the link.
DEPTH, RIM = 0.8, 0.5


@dataclass
class Cam:
    """A cam with its follower as they are made: ``plate`` of the cam, ``posts`` of the follower's face or edge and
    its ``outline``, all in the axes of their carriers, m."""

    joint: CamJoint
    shape: CamShape
    posts: tuple[complex, ...] = ()
    outline: tuple[complex, ...] = ()
    plate: str = ""

    @property
    def grooved(self) -> bool:
        """Whether the roller runs in a groove."""
        return self.joint.closure == "groove" and self.joint.touch == "roller"


def plan_cams(draft: Draft) -> list[Cam]:
    """All cams; those around all points of their links become the plates of these."""
    joints = [each for each in draft.mechanism.joints.values() if isinstance(each, CamJoint) and each.centre]
    found = [Cam(joint, CamShape.of(joint, draft.mechanism)) for joint in joints]
    for cam in found:
        _settle(draft, cam)
        if cam.joint.touch != "roller":
            _plan_face(draft, cam)
    return found


def _settle(draft: Draft, cam: Cam) -> None:
    """Whether a cam is its link's plate; what else that plate is to hold."""
    body = draft.body(cam.joint.cam)
    if cam.grooved:
        body.fixed.append(_groove_posts(draft, cam))
        return
    centre = draft.carriers.place(cam.joint.cam, cam.joint.centre)
    inner = float(np.abs(cam.shape.profile(full_turn()) - cam.shape.centre).min())
    held = [*draft.points(body), *body.held]
    within = all(abs(each - centre) + eye(draft, body, each) <= inner for each in held)
    if draft.is_free(body) and (within or len(held) == 1):
        body.shape, body.sort, cam.plate = cam_shape(draft, cam), "cam", body.carrier


def _rings(draft: Draft, cam: Cam) -> list[Complexes]:
    """The profile in the axes of the cam's carrier, counter-clockwise; of a groove the rim and the outer wall too."""
    place, phi = draft.carriers.places[cam.joint.cam], full_turn()[::EVERY]
    profile = cam.shape.profile(phi)
    rings = [profile]
    if cam.grooved:
        wall = cam.shape.profile(phi, outer=True)
        reach = float(np.abs(wall - cam.shape.centre).max()) + RIM * draft.sizes.width[cam.joint.cam]
        rings = [cam.shape.centre + reach * np.exp(1j * phi), wall, profile]
    return [place.origin + place.turn * _counter_clockwise(ring) for ring in rings]


def _counter_clockwise(ring: Complexes) -> Complexes:
    return ring if area(ring) > 0.0 else ring[::-1]


def cam_shape(draft: Draft, cam: Cam) -> Shape:
    """What lies within the profile; of a cam with a groove what lies on both sides of the groove."""
    return Shape((Piece(tuple(_rings(draft, cam)), 0.0, filled=True),))


def _groove_posts(draft: Draft, cam: Cam) -> tuple[complex, complex]:
    """Two places opposite each other in the rim outside a groove."""
    place, centre = draft.carriers.places[cam.joint.cam], cam.shape.centre
    rim, wall, _profile = _rings(draft, cam)
    middle = 0.5 * (abs(rim[0] - place.of(centre)) + float(np.abs(wall - place.of(centre)).max()))
    return place.of(centre - middle), place.of(centre + middle)


def _plan_face(draft: Draft, cam: Cam) -> None:
    """A flat face as a bar behind it, an edge as a wedge behind it, each with two posts to the follower."""
    place = draft.carriers.places[cam.joint.follower]
    depth = DEPTH * draft.sizes.width[cam.joint.follower]
    corners: tuple[complex, ...]
    own, side = cmath.exp(1j * cam.shape.geometry.own), {"": 0.0, "left": 1.0, "right": -1.0}[cam.joint.side]
    outward = 1j * side * own if side else own
    if cam.joint.touch == "flat":
        start, end = cam.shape.face()
        back = outward * depth
        corners = (start, end, end + back, start + back)
        inset = 0.5 * depth * (end - start) / abs(end - start)
        posts = (start + inset + 0.5 * back, end - inset + 0.5 * back)
    else:
        edge, half = cam.shape.at, 0.5j * outward * depth
        near, far = edge + outward * depth, edge + 3.0 * outward * depth
        corners = (edge, near - half, far - half, far + half, near + half)
        posts = (edge + 1.5 * outward * depth, edge + 2.5 * outward * depth)
    cam.outline, cam.posts = tuple(place.of(each) for each in corners), tuple(place.of(each) for each in posts)
    draft.body(cam.joint.follower).fixed.append(cam.posts)


def add_cams(draft: Draft, found: list[Cam]) -> list[Axle]:
    """The plates of cams that are not their links', and what touches them."""
    axles: list[Axle] = []
    for cam in found:
        body = draft.body(cam.joint.cam)
        if not cam.plate:
            cam.plate = draft.free_name(f"cam {cam.joint.cam}")
            centre = draft.carriers.place(cam.joint.cam, cam.joint.centre)
            axles.append(add_disc(draft, "cam", cam.joint.cam, cam.plate, cam_shape(draft, cam), centre))
            if cam.grooved:
                radius = POST * draft.width(body)
                fasten(draft, cam.plate, body, cam.plate, _groove_posts(draft, cam), radius)
        if cam.joint.touch == "roller":
            axles.append(_add_roller(draft, cam, draft.body(cam.joint.follower)))
        else:
            _add_face(draft, cam, draft.body(cam.joint.follower))
    return axles


def _add_roller(draft: Draft, cam: Cam, body: Body) -> Axle:
    """A roller, an axle for the pin about which it turns; as the roller meets the cam, so does the pin for gaps."""
    joint = cam.joint
    name, at = draft.free_name(f"roller {joint.follower}"), draft.carriers.place(joint.follower, joint.at)
    draft.plate(name, "roller", body.carrier, disc(at, joint.roller_radius), joint.follower, cam.plate)
    draft.level.append((cam.plate, name))
    return Axle(body.carrier, at, name, cam.plate)


def _add_face(draft: Draft, cam: Cam, body: Body) -> None:
    joint = cam.joint
    name = draft.free_name(f"{'face' if joint.touch == 'flat' else 'edge'} {joint.follower}")
    outline = np.array(cam.outline)
    shape = polygon(_counter_clockwise(outline))
    draft.plate(name, "roller", body.carrier, shape, joint.follower, cam.plate)
    draft.level.append((cam.plate, name))
    fasten(draft, name, body, name, cam.posts, POST * draft.width(body))

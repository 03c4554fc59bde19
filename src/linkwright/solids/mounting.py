"""How plates besides a link's own are held by it: posts, and hubs around the pins about which they turn."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from linkwright.joints.cam import CamJoint
from linkwright.shapes.shape import Shape, disc
from linkwright.solids.draft import Body, Draft
from linkwright.solids.solid import Solid, Sort

#: Radius of a hub, as a share of its pin's.
HUB = 1.6
#: How far a post keeps from pins, in sums of their radii.
APART = 1.25
#: Radius of a roller's pin, as a share of the roller's and of the link's width at most.
ROLLER_PIN, PIN = 0.5, 0.25


@dataclass(frozen=True)
class Axle:
    """A plate besides the link's own on one of its pins: the carrier, the centre in its axes, the plate; its hub, or
    what else its pin touches."""

    carrier: str
    centre: complex
    plate: str
    hub: str = ""


def fasten(draft: Draft, name: str, body: Body, plate: str, places: tuple[complex, ...], radius: float) -> None:
    """Posts that hold a plate on that of a body."""
    plates = tuple(each for each in (body.plate, plate) if each)
    for number, place in enumerate(places, 1):
        post = f"post {name}.{number}"
        draft.add(Solid(post, "post", body.carrier, disc(place, radius), plates), *plates)
        draft.bore(plates, {body.carrier: place}, radius)


def add_disc(draft: Draft, sort: Sort, link: str, name: str, shape: Shape, centre: complex) -> Axle:
    """A wheel or a cam besides the plate of its link, with a hub to that around the pin in its centre."""
    body = draft.body(link)
    draft.plate(name, sort, body.carrier, shape, link)
    radii = [draft.sizes.pin_radius[pin] for pin, place in draft.pinned(body) if abs(place - centre) <= draft.near]
    if not radii or not body.plate:
        return Axle(body.carrier, centre, name)
    hub, radius, plates = draft.free_name(f"hub {link}"), HUB * max(radii), (body.plate, name)
    draft.add(Solid(hub, "post", body.carrier, disc(centre, radius), plates), *plates)
    draft.bore(plates, {body.carrier: centre}, radius)
    return Axle(body.carrier, centre, name, hub)


def clear(draft: Draft, body: Body, places: Iterable[complex], radius: float) -> complex:
    """The first of some places for a post of a radius that is clear of the pins and other posts of a body; else the
    last one."""
    taken = [(place, draft.sizes.pin_radius[name]) for name, place in draft.pinned(body)]
    taken += [(place, radius) for place in body.held]
    found = [*places]
    free = (each for each in found if all(abs(each - other) >= APART * (radius + pin) for other, pin in taken))
    return next(free, found[-1])


def roller_pin(draft: Draft, joint: CamJoint) -> float:
    """The radius of the pin about which the roller of a follower turns, m."""
    return min(ROLLER_PIN * joint.roller_radius, PIN * draft.sizes.width[joint.follower])


def eye(draft: Draft, body: Body, place: complex) -> float:
    """How much room a point of some links needs in a plate, m: that of its pin with a wall around it."""
    radii = (draft.sizes.pin_radius[name] for name, at in draft.pinned(body) if abs(at - place) <= draft.near)
    return HUB * max(radii, default=0.0)

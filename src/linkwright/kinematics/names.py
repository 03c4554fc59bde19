"""Names of the program's outputs, and which link a point is computed on."""

from __future__ import annotations

from dataclasses import replace

from linkwright.core.outputs import Output, row_names
from linkwright.errors import RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import no_such, offered
from linkwright.words.sentence import Sentence


def owners(mechanism: Mechanism, point: str) -> list[str]:
    """Links that carry a point of this name, the frame included."""
    links = {"frame": mechanism.frame, **mechanism.links}
    return [name for name, link in links.items() if point in link.points]


def find_point(mechanism: Mechanism, name: str) -> tuple[str, str]:
    """Link and point for ``C`` or ``jaw.C``.

    Raises RequestError for an unknown name (nearest names offered), and for a name that several links use
    for different points.
    """
    if "." in name:
        link, point = name.split(".", 1)
        if link != "frame" and link not in mechanism.links:
            raise _unknown("link", link, ["frame", *mechanism.links])
        points = mechanism.link(link).points
        if point not in points:
            hint = offered(point, points)
            raise RequestError(Sentence("names.no_such_point", link=link, name=point, hint=hint))
        return link, point
    found = owners(mechanism, name)
    if not found:
        everything = [p for link in [mechanism.frame, *mechanism.links.values()] for p in link.points]
        raise _unknown("point", name, everything)
    if len(found) > 1 and not mechanism.pin_links(name):
        choices = tuple(f"{link}.{name}" for link in found)
        raise RequestError(Sentence("motion.several_points", name=name, choices=choices))
    return found[0], name


def canonical(mechanism: Mechanism, link: str, point: str) -> str:
    """The one key of a point: the pin's name for a pin, else ``link.point``."""
    return point if link in mechanism.pin_links(point) else f"{link}.{point}"


def program_names(mechanism: Mechanism, output: Output) -> tuple[tuple[str, ...], tuple[str, str]]:
    """Names of the program's outputs for a value (an angle as the cosine and sine of a direction), and for its two
    rates."""
    if output.kind == "position":
        output = replace(output, owner=canonical(mechanism, *find_point(mechanism, output.owner)))
    own, rate, second = (each.row for each in output.course)
    return row_names("direction", output.owner) if output.kind == "angle" else (own,), (rate, second)


def _unknown(noun: str, name: str, known: list[str]) -> RequestError:
    return RequestError(no_such(noun, name, known))

"""Names of the program's outputs, and which link a point is computed on."""

from __future__ import annotations

import fnmatch
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from typing import NoReturn

from linkwright.applied_loads.signals import place_named
from linkwright.core.outputs import KINDS, NAMED, POINT, RATIO, RESIDUALS, SLIDE, Output, row_names
from linkwright.errors import RequestError
from linkwright.mechanism.mechanism import Mechanism, named_outputs
from linkwright.registry import no_such, offered
from linkwright.words import Message, _

#: Kinds of outputs that are phrases, ``transmission_angle B``, by their first words.
PHRASES = {
    "input_torque": "input_torque",
    **{kind.word or name: name for name, kind in KINDS.items() if kind.form == "phrase"},
}
#: Products of an output with the cosine and sine of a multiple of the input, and the multiples.
HARMONIC, ORDERS = ("cosine", "sine"), tuple(str(order) for order in range(1, 13))
#: Kinds by what they belong to and the word behind it.
_PARTS = {(kind.of, kind.word or name): name for name, kind in KINDS.items() if kind.form in ("part", "place")}


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
            raise _unknown(_("link"), link, ["frame", *mechanism.links])
        points = mechanism.link(link).points
        if point not in points:
            hint = offered(point, points)
            raise RequestError(
                _(
                    'there is no point of link {link}: "{name}"; {hint}',
                    code="names.no_such_point",
                    link=link,
                    name=point,
                    hint=hint,
                )
            )
        return link, point
    welded = {weld.links[1] for weld in mechanism.welds.values() if weld.at == name}
    found = [link for link in owners(mechanism, name) if link not in welded]
    if not found:
        everything = [p for link in [mechanism.frame, *mechanism.links.values()] for p in link.points]
        raise _unknown(_("point"), name, everything)
    if len(found) > 1 and not mechanism.pin_links(name):
        choices = tuple(f"{link}.{name}" for link in found)
        raise RequestError(
            _(
                "several links have a point {name!r} of their own; say which: {choices}",
                code="motion.several_points",
                name=name,
                choices=choices,
            )
        )
    return found[0], name


def canonical(mechanism: Mechanism, link: str, point: str) -> str:
    """The one key of a point: the pin's name for a pin, else ``link.point``."""
    return point if link in mechanism.pin_links(point) else f"{link}.{point}"


def point_key(mechanism: Mechanism, name: str) -> str:
    """The canonical key of a point, or of a link's mass centre: ``jaw.centre``."""
    name = str(name).replace(".@centre", ".centre")
    link = mechanism.links.get(name.removesuffix(".centre"))
    if name.endswith(".centre") and link is not None and "centre" not in link.points:
        return name.removesuffix("centre") + "@centre"
    return canonical(mechanism, *find_point(mechanism, name))


def program_names(mechanism: Mechanism, output: Output) -> tuple[tuple[str, ...], tuple[str, str]]:
    """Names of the program's outputs for a value (an angle as the cosine and sine of a direction), and for its two
    rates."""
    if KINDS[output.kind].of == "point":
        output = replace(output, owner=canonical(mechanism, *find_point(mechanism, output.owner)))
    own, rate, second = (each.row for each in output.course)
    return row_names("direction", output.owner) if output.kind == "angle" else (own,), (rate, second)


def _unknown(noun: Message, name: str, known: list[str]) -> RequestError:
    return RequestError(no_such(noun, name, known))


def place_meant(mechanism: Mechanism, text: str) -> Output:
    """The place over the cycle that a text means: a link's angle, a guide's displacement, a point's coordinate.

    Raises RequestError, with the nearest one, where it means none.
    """
    meant, found = _output(mechanism, text), place_named(text, mechanism)
    if meant is not None and meant.kind in NAMED:
        raise RequestError(
            _(
                '"{name}" is a formula, whose limit positions are not found; ask for its extremes, '
                '"{name} max" and "{name} min"',
                code="motion.no_limits_of_formula",
                name=text,
            )
        )
    if meant is None or found is None:
        points = [f"{point}.{axis}" for link in mechanism.links.values() for point in link.points for axis in "xy"]
        known = [*mechanism.links, *mechanism.guides, *points]
        if meant is None:
            no_output(mechanism, text, known)
        raise RequestError(
            _(
                "there is no output {text!r}; name a link (its angle), POINT.x, POINT.y or a guide "
                "(its displacement); {hint}",
                code="motion.no_output",
                text=text,
                hint=offered(text, known),
            )
        )
    return meant if found.kind == "displacement" else found


def output_meant(mechanism: Mechanism, text: str) -> Output:
    """The output that the user's words mean: ``C.velocity.x``, ``jaw.angle``, ``reaction O5 on jaw``; or its name
    over a column, ``O5 on jaw.x``, and in a model file, ``jaw``.

    Raises RequestError with the nearest known names.
    """
    found = _output(mechanism, text)
    return no_output(mechanism, text) if found is None else found


def output_or_point(mechanism: Mechanism, text: str) -> Output:
    """The same, or the full motion of a point that is named alone or by a vector of it: its position."""
    found = _output(mechanism, text)
    if found is not None:
        vector = found.kind in POINT and not found.component
        return Output("position", found.owner) if vector else found
    if owners(mechanism, text):
        return Output("position", point_key(mechanism, text))
    if "." in text:
        with suppress(RequestError):
            return Output("position", point_key(mechanism, text))
    return no_output(mechanism, text)


def _output(mechanism: Mechanism, text: str) -> Output | None:
    words, named = text.split(), named_outputs(mechanism.outputs)
    if text in named:
        return named[text]
    if words and words[0] in PHRASES:
        return _phrase(mechanism, text, PHRASES[words[0]], words[1:])
    if len(words) == 3 and words[1] == "on":
        return _over_column(mechanism, text, *words[::2])
    place = place_named(text, mechanism)
    if place is not None and KINDS[place.kind].form != "place":
        return replace(place, written="")
    return _part(mechanism, text)


def result_meant(mechanism: Mechanism, text: str, results: Iterable[Output]) -> Output:
    """The output that a text means: one of some results by its column, with or without its unit, or any other in the
    user's words.

    Raises RequestError with the nearest names.
    """
    known = {each.column: each for each in results}
    headings = {each.heading: each for each in known.values()}
    found = known.get(text) or headings.get(text)
    if found is None:
        found = output_meant(mechanism, text)
        found = known.get(found.column, found)
    return found


def results_meant(mechanism: Mechanism, text: str, results: Iterable[Output]) -> list[Output]:
    """The same of a text that may mean several results: by the beginning of their columns up to a dot, or with ``*``
    and ``?``."""
    known = list(results)
    found = [
        each
        for each in known
        if each.column == text or each.column.startswith(f"{text}.") or fnmatch.fnmatchcase(each.column, text)
    ]
    return found or [result_meant(mechanism, text, known)]


def of_forces(mechanism: Mechanism, names: Iterable[str]) -> bool:
    """Whether one of some names means a result of the forces."""
    for name in names:
        with suppress(RequestError):
            if name in RESIDUALS or not output_meant(mechanism, name).of_motion:
                return True
    return False


def no_output(mechanism: Mechanism, text: str, known: Iterable[str] = ()) -> NoReturn:
    """Raises RequestError with those of the known names that come nearest to one that means nothing; of all outputs
    where there are none."""
    alone = () if "." in text else (*mechanism.links, *mechanism.guides)
    hint = offered(text, known or [*output_names(mechanism), *alone], _("such as {names}"), most=6)
    raise RequestError(
        _(
            "there is no output {name!r} in {mechanism!r}; {hint}",
            code="study.no_such_output",
            name=text,
            mechanism=mechanism.name,
            hint=hint,
        )
    )


def _part(mechanism: Mechanism, text: str) -> Output | None:
    """``OWNER.PART``, with ``.x`` or ``.y`` of what is a vector; ``POINT.x``."""
    base, _unused, last = text.rpartition(".")
    axis = last if last in ("x", "y") else ""
    if axis and base == "shaking_force":
        return Output(base, "", axis)
    for of, owners in (("driver", mechanism.drivers), ("link", mechanism.links)):
        if base in owners and (of, last) in _PARTS:
            return Output(_PARTS[of, last], base, slides=of == "driver" and _slides(mechanism, base))
    if ("guide", last) in _PARTS:
        place = place_named(base, mechanism)
        guide = base if place is None or place.kind != "displacement" else place.owner
        if guide in mechanism.guides:
            return Output(_PARTS["guide", last], guide)
    owner, part = base, last
    if axis:
        owner, _unused2, part = base.rpartition(".")
        if ("point", part) not in _PARTS:
            owner, part = base, "position"
    if not owner or ("point", part) not in _PARTS or (part == "position" and not axis):
        return None
    return Output(part, point_key(mechanism, owner), axis)


def _phrase(mechanism: Mechanism, text: str, kind: str, rest: list[str]) -> Output | None:
    """``KIND``, ``KIND OWNER``, ``KIND JOINT on LINK``."""
    first = next(iter(mechanism.drivers), None)
    if kind == "input_torque":
        return Output("effort", first, slides=_slides(mechanism, first)) if not rest and first else None
    if kind == "distance":
        return Output(kind, rest[0], on=rest[1]) if len(rest) == 2 else None
    if kind in HARMONIC:
        ordered = len(rest) > 1 and rest[-1] in ORDERS
        if not ordered:
            return None
        inner = output_meant(mechanism, " ".join(rest[:-1]))
        return Output(kind, inner.name, on=rest[-1], measured=inner.dimension)
    match KINDS[kind].of:
        case "machine":
            return None if rest else Output(kind)
        case "joint":
            return _at_joint(mechanism, text, kind, rest)
        case "group" if kind == "closeness":
            return Output(kind, "".join(rest[:1]))
    known = {"link": {**mechanism.links, **mechanism.guides}, "load": mechanism.loads}.get(KINDS[kind].of)
    if len(rest) != 1 or (known is not None and rest[0] not in known):
        return None
    if KINDS[kind].of == "link":
        place = output_meant(mechanism, rest[0])
        measured = RATIO[place.dimension, "length" if first and _slides(mechanism, first) else "angle"]
        return Output(kind, place.owner, measured=measured)
    return Output(kind, point_key(mechanism, rest[0]) if KINDS[kind].of in ("point", "handle") else rest[0])


def _over_column(mechanism: Mechanism, text: str, joint: str, place: str) -> Output | None:
    """``JOINT on LINK``, with ``.magnitude``, ``.x``, ``.y`` or ``.direction`` of the force, or ``.couple``."""
    link, _unused, part = place.partition(".")
    axis = f".{part}" if part in ("x", "y") else ""
    if not axis and part not in ("", "magnitude", "direction", "couple"):
        return None
    kind = {"direction": "reaction_direction", "couple": "couple"}.get(part, "reaction")
    return _at_joint(mechanism, text, kind, [joint, "on", link + axis])


def _at_joint(mechanism: Mechanism, text: str, kind: str, rest: list[str]) -> Output | None:
    axis = ""
    if rest and rest[-1].endswith((".x", ".y")):
        rest = [*rest[:-1], rest[-1][:-2]]
        axis = text[-1] if KINDS[kind].vector else ""
    joints = mechanism.joints
    if len(rest) not in (1, 3) or rest[0] not in joints or (len(rest) == 3 and rest[1] != "on"):
        return None
    joint, joined = rest[0], joints[rest[0]].joined
    if len(rest) == 3 and rest[2] not in joined:
        message = _(
            "{name!r}: joint {joint!r} does not touch {link!r}; it joins {joined}",
            code="study.not_touching",
            name=text,
            joint=joint,
            link=rest[2],
            joined=tuple(joined),
        )
        raise RequestError(message)
    links = rest[2:] or [link for link in joined if link != "frame"]
    if len(links) != 1:
        message = _(
            '{name!r}: joint {joint!r} joins {joined}; say on which link: "{name} on {moving}"',
            code="study.say_link",
            name=text,
            joint=joint,
            joined=tuple(joined),
            moving=links[0],
        )
        raise RequestError(message)
    return Output(kind, joint, axis, links[0])


def _slides(mechanism: Mechanism, driver: str) -> bool:
    return mechanism.joints[mechanism.drivers[driver].joint].coordinate != "turn"


def output_names(mechanism: Mechanism) -> Iterator[str]:
    """Names of outputs that a study can ask for, most of them."""
    yield from named_outputs(mechanism.outputs)
    for driver in mechanism.drivers:
        yield Output("effort", driver).name
    yield from ("input_torque", "power", "shaking_force", "shaking_moment", "closeness")
    for link in mechanism.links:
        yield from (each.name for each in Output("angle", link).course)
    for name, joint in mechanism.joints.items():
        if name in mechanism.guides:
            yield from (Output(kind, name).name for kind in (*SLIDE, "slide_jerk"))
            yield Output("couple", name, on=mechanism.guides[name].block).name
        yield from (Output("reaction", name, on=link).name for link in joint.joined if link != "frame")
    keys = {canonical(mechanism, name, p) for name, link in mechanism.links.items() for p in link.points}
    for key in sorted(keys):
        yield from (Output("position", key, axis).name for axis in "xy")
        yield from (Output(kind, key).name for kind in ("velocity", "acceleration"))

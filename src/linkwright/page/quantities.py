"""What a page can plot, and the design numbers that it shows: by words and by rows of its main program."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from linkwright.analysis.outputs import mechanism_outputs
from linkwright.core.arrays import Floats
from linkwright.core.data import Plain
from linkwright.core.outputs import KINDS, Output, row_names
from linkwright.kinematics.names import canonical
from linkwright.kinetostatics.forces import reaction_pairs
from linkwright.page.programs import PagePrograms
from linkwright.words import LANGUAGES, Message, _

#: Numbers over the cycle that are shown of a signal.
_NUMBERS = {
    "transmission_angle": ("least",),
    "effort": ("largest", "rms"),
    "reaction": ("largest",),
    "shaking_force": ("largest",),
}


_EXTREMES = {
    "least": _("smallest {name}"),
    "largest": _("largest {name}"),
    "rms": _("root mean square of the {name}"),
}


def signals(page: PagePrograms) -> dict[Output, Plain]:
    """Everything that is plotted over the input. ``form``: how the value follows from the ``rows``."""
    outputs = [*_motion(page), *([] if page.forces is None else _forces(page))]
    return {each: _signal(page, each) for each in outputs}


def _signal(page: PagePrograms, output: Output) -> Plain:
    owner, form, key = output.owner, "row", output.row
    rows: tuple[str, ...] = (key,)
    if output.kind == "angle":
        form, key, rows = "angle", f"angle:{owner}", row_names("direction", owner)
    elif KINDS[output.kind].vector:
        form, rows = "size", row_names(output.kind, owner, output.on)
    title = output.sentence(alone=len(page.mechanism.drivers) == 1)
    name = {language: title.say(language) for language in LANGUAGES}
    return {"id": key, "form": form, "rows": list(rows), "kind": output.dimension, "name": name}


def _translated(message: Message) -> dict[str, str]:
    return {language: message.translate(language) for language in LANGUAGES}


def _motion(page: PagePrograms) -> Iterator[Output]:
    mechanism = page.mechanism
    for name in mechanism.links:
        yield from Output("angle", name).course
    for name in mechanism.guides:
        yield from Output("displacement", name).course
    for key in page.solver.outputs.point_keys():
        yield from (Output("velocity", key), Output("acceleration", key))
    for group in page.dyads:
        yield Output("transmission_angle", group.name)


def _forces(page: PagePrograms) -> Iterator[Output]:
    for name in page.loaded.forces.efforts:
        yield Output("effort", name, slides=page.mechanism.drivers[name].joint in page.mechanism.guides)
    stored = {(joint, link) for joint, link, _ in page.loaded.outputs.reaction_keys()}
    for joint, link in reaction_pairs(page.mechanism):
        if (joint, link) in stored:
            yield Output("reaction", joint, on=link)
    yield Output("shaking_force")


def numbers(page: PagePrograms, known: Mapping[Output, Plain]) -> list[Plain]:
    """Metrics over the full cycle; ``kind``: how one follows from a signal."""
    found = []
    rotating = _one_steady_turn(page)
    for output in mechanism_outputs(page.mechanism) if page.motion.positions.count > 1 else ():
        angle = output.kind == "angle"
        if angle and _turns(page, output.owner):
            continue
        name = _("swing angle of {name}") if angle else _("stroke at {name}")
        found.append(_number("range", known[output], _translated(name.format(name=output.owner))))
        if rotating and _returns_once(page.motion.read(output)):
            found.append(
                _number(
                    "ratio", known[output], _translated(_("quick-return ratio of {name}", name=output.owner)), "ratio"
                )
            )
    for output, signal in known.items():
        found += [_number(kind, signal, _within(kind, signal)) for kind in _NUMBERS.get(output.kind, ())]
    return found


def _number(kind: str, signal: Plain, name: dict[str, str], quantity: str | None = None) -> Plain:
    return {
        "id": f"{kind}:{signal['id']}",
        "kind": kind,
        "signal": signal["id"],
        "quantity": quantity or signal["kind"],
        "name": name,
    }


def _within(word: str, signal: Plain) -> dict[str, str]:
    return {
        language: _EXTREMES[word].format(name=signal["name"][language]).translate(language) for language in LANGUAGES
    }


def _turns(page: PagePrograms, link: str) -> bool:
    """Whether a link turns through over the cycle."""
    angle = page.motion.link(link).angle
    return bool(len(angle) > 2 and page.motion.positions.closed and abs(angle[-1] - angle[0]) > 4.0)


def _returns_once(course: Floats) -> bool:
    """Whether something goes to and fro once in a closed cycle and rests nowhere."""
    steps = np.diff(course, append=course[0])
    ways = np.where(np.abs(steps) <= 1e-9 * np.ptp(course), 0.0, np.sign(steps))
    if ((ways == 0.0) & (np.roll(ways, -1) == 0.0)).any():
        return False
    moving = ways[ways != 0.0]
    return int((moving != np.roll(moving, -1)).sum()) == 2


def _one_steady_turn(page: PagePrograms) -> bool:
    """Whether the only driver turns once, steadily, in a closed cycle."""
    drivers = list(page.mechanism.drivers.values())
    speed = drivers[0].law.constant_speed if len(drivers) == 1 else None
    if speed is None or not page.motion.positions.closed:
        return False
    span = abs(speed) * (page.motion.positions.period or 0.0)
    return page.motion.positions.rotary[drivers[0].name] and abs(span - 6.283185307179586) < 1e-9


def usual_curves(page: PagePrograms, known: Mapping[Output, Plain]) -> list[str]:
    """The curves that a page opens with: motion of an output, effort, largest reaction, transmission angle."""
    wanted = [each for output in mechanism_outputs(page.mechanism)[-1:] for each in output.course]
    for kind, place in (("effort", 0), ("transmission_angle", -1), ("reaction", 0)):
        wanted += [each for each in known if each.kind == kind][place:][:1]
    wanted = [each for each in wanted if each in known]
    return [known[each]["id"] for each in (wanted or known)][:6]


def point_keys(page: PagePrograms) -> list[Plain]:
    """All points with what they are: on the frame or moving, a joint or not."""
    frame = {canonical(page.mechanism, "frame", point) for point in page.mechanism.frame.points}
    keys = [*frame, *(key for key in page.solver.outputs.point_keys() if key not in frame)]
    return [{"key": key, "fixed": key in frame, "moved": moving_dimensions(page, key)} for key in sorted(keys)]


def moving_dimensions(page: PagePrograms, key: str) -> list[str]:
    """Dimensions that place a point on its links, in their order; parameters in place of what follows them."""
    mechanism, found = page.mechanism, dict[str, None]()
    fixed = [f"frame.{point}" for point in mechanism.frame.points if canonical(mechanism, "frame", point) == key]
    if fixed:
        return [each for axis in "xy" for each in _behind(page, f"{fixed[0]}.{axis}")]
    for name, link in mechanism.links.items():
        for number, point in enumerate(link.points):
            if canonical(mechanism, name, point) != key:
                continue
            own = link.geometry_dimensions()
            placed = [a for a in own if a.startswith(f"{name}.{point}.")]
            if link.geometry in ("length", "bent") and number < 2 + (link.geometry == "bent"):
                placed = [a for a in own if ".length" in a or a.endswith(".angle")]
                placed = placed if number != 1 or link.geometry == "length" else placed[:1]
            elif number == 0 and link.geometry == "drawing":
                placed = [a for a in own if a.endswith(".x")][:1]
            found |= dict.fromkeys(placed)
    for joint in mechanism.guides.values():
        if key == canonical(mechanism, joint.block, joint.at):
            found[f"{joint.name}.offset"] = None
    return list(dict.fromkeys(each for address in found for each in _behind(page, address)))


def _behind(page: PagePrograms, address: str) -> list[str]:
    """The dimension itself, or the parameters that its expression takes."""
    expression = page.mechanism.expressions.get(address)
    if expression is None:
        return [address]
    return [each for name in sorted(expression.names) for each in _behind(page, name)]

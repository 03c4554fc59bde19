"""What a page can plot, and the design numbers that it shows: by words and by rows of its main program."""

from __future__ import annotations

from typing import Any

from linkwright.kinematics.names import canonical
from linkwright.metrics.outputs import mechanism_outputs
from linkwright.page.programs import PagePrograms
from linkwright.plot.force_names import reaction_pairs
from linkwright.words import LANGUAGES, say

Plain = dict[str, Any]


def signals(page: PagePrograms) -> list[Plain]:
    """Everything that is plotted over the input. ``form``: how the value follows from the ``rows``."""
    return [*_motion(page), *([] if page.forces is None else _forces(page))]


def _signal(key: str, form: str, rows: list[str], kind: str, word: str, **names: str) -> Plain:
    return {"id": key, "form": form, "rows": rows, "kind": kind, "name": _said(word, **names)}


def _said(word: str, **names: str) -> dict[str, str]:
    return {language: say(f"page.{word}", language, **names) for language in LANGUAGES}


def _pair(prefix: str, key: str) -> list[str]:
    return [f"{prefix}:{key}.x", f"{prefix}:{key}.y"]


def _motion(page: PagePrograms) -> list[Plain]:
    mechanism = page.mechanism
    found = []
    for name in mechanism.links:
        found += [
            _signal(f"angle:{name}", "angle", _pair("e", name), "angle", "angle", name=name),
            _signal(f"w:{name}", "row", [f"w:{name}"], "angular_velocity", "angular_velocity", name=name),
            _signal(
                f"g:{name}", "row", [f"g:{name}"], "angular_acceleration", "angular_acceleration", name=name
            ),
        ]
    for name in mechanism.guides:
        found += [
            _signal(f"s:{name}", "row", [f"s:{name}"], "length", "displacement", name=name),
            _signal(f"sv:{name}", "row", [f"sv:{name}"], "velocity", "slide_velocity", name=name),
            _signal(f"sa:{name}", "row", [f"sa:{name}"], "acceleration", "slide_acceleration", name=name),
        ]
    for key in page.traced.solver.outputs.point_keys():
        found += [
            _signal(f"v:{key}", "size", _pair("v", key), "velocity", "velocity", name=key),
            _signal(f"a:{key}", "size", _pair("a", key), "acceleration", "acceleration", name=key),
        ]
    for group in page.dyads:
        rows = [f"m:{group.name}"]
        found.append(_signal(rows[0], "row", rows, "angle", "transmission", name=group.name))
    return found


def _forces(page: PagePrograms) -> list[Plain]:
    found = []
    for name in page.traced.forces.forces.efforts:
        turning = page.mechanism.drivers[name].joint not in page.mechanism.guides
        word, kind = ("input_torque", "torque") if turning else ("input_force", "force")
        one = len(page.mechanism.drivers) == 1
        found.append(
            _signal(f"effort:{name}", "row", [f"effort:{name}"], kind, word if one else "effort", name=name)
        )
    stored = {(joint, link) for joint, link, _ in page.traced.forces.outputs.reaction_keys()}
    for joint, link in reaction_pairs(page.mechanism):
        if (joint, link) in stored:
            rows = _pair("r", f"{joint}|{link}")
            found.append(
                _signal(f"r:{joint}|{link}", "size", rows, "force", "reaction", joint=joint, link=link)
            )
    found.append(_signal("shake", "size", ["shake.x", "shake.y"], "force", "shaking_force"))
    return found


def numbers(page: PagePrograms, known: list[Plain]) -> list[Plain]:
    """Design numbers over the whole cycle; ``kind`` says how one follows from a signal."""
    by_id = {each["id"]: each for each in known}
    found = []
    rotating = _one_steady_turn(page)
    for output in mechanism_outputs(page.mechanism) if page.motion.positions.count > 1 else ():
        angle = output.kind == "angle"
        signal = by_id[f"angle:{output.owner}" if angle else f"s:{output.owner}"]
        if angle and _turns(page, output.owner):
            continue
        word = "swing" if angle else "stroke"
        found.append(_number("range", signal, _said(word, name=output.owner)))
        if rotating:
            found.append(_number("ratio", signal, _said("ratio", name=output.owner), "ratio"))
    for each in known:
        if each["id"].startswith("m:"):
            found.append(_number("least", each, _within("least", each)))
        elif each["id"].startswith("effort:"):
            found += [
                _number("largest", each, _within("largest", each)),
                _number("rms", each, _within("rms", each)),
            ]
        elif each["id"].startswith("r:") or each["id"] == "shake":
            found.append(_number("largest", each, _within("largest", each)))
    return found


def _number(kind: str, signal: Plain, name: dict[str, str], quantity: str | None = None) -> Plain:
    return {
        "id": f"{kind}:{signal['id']}", "kind": kind, "signal": signal["id"],
        "quantity": quantity or signal["kind"], "name": name,
    }  # fmt: skip


def _within(word: str, signal: Plain) -> dict[str, str]:
    return {language: say(f"page.{word}", language, name=signal["name"][language]) for language in LANGUAGES}


def _turns(page: PagePrograms, link: str) -> bool:
    """Whether a link turns through over the cycle."""
    angle = page.motion.link(link).angle
    return bool(len(angle) > 2 and page.motion.positions.closed and abs(angle[-1] - angle[0]) > 4.0)


def _one_steady_turn(page: PagePrograms) -> bool:
    """Whether the only driver turns once, steadily, in a closed cycle."""
    drivers = list(page.mechanism.drivers.values())
    speed = drivers[0].law.constant_speed if len(drivers) == 1 else None
    if speed is None or not page.motion.positions.closed:
        return False
    span = abs(speed) * (page.motion.positions.period or 0.0)
    return page.motion.positions.rotary[drivers[0].name] and abs(span - 6.283185307179586) < 1e-9


def usual_curves(page: PagePrograms, known: list[Plain]) -> list[str]:
    """The curves that a page opens with: motion of an output, effort, largest reaction, transmission angle."""
    ids = [each["id"] for each in known]
    outputs = mechanism_outputs(page.mechanism)
    wanted: list[str] = []
    for output in outputs[-1:]:
        prefixes = ("angle", "w", "g") if output.kind == "angle" else ("s", "sv", "sa")
        wanted += [f"{prefix}:{output.owner}" for prefix in prefixes]
    wanted += [each for each in ids if each.startswith("effort:")][:1]
    wanted += [each for each in ids if each.startswith("m:")][-1:]
    wanted += [each for each in ids if each.startswith("r:")][:1]
    wanted = [each for each in wanted if each in ids]
    return (wanted or ids)[:6]


def point_keys(page: PagePrograms) -> list[Plain]:
    """All points with what they are: on the frame or moving, a joint or not."""
    frame = {canonical(page.mechanism, "frame", point) for point in page.mechanism.frame.points}
    keys = [*frame, *(key for key in page.traced.solver.outputs.point_keys() if key not in frame)]
    return [
        {"key": key, "fixed": key in frame, "moved": moving_dimensions(page, key)} for key in sorted(keys)
    ]


def moving_dimensions(page: PagePrograms, key: str) -> list[str]:
    """Dimensions that place a point on its links, in their order; parameters in place of what follows them."""
    mechanism, found = page.mechanism, dict[str, None]()
    fixed = [
        f"frame.{point}" for point in mechanism.frame.points if canonical(mechanism, "frame", point) == key
    ]
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

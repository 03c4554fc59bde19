"""Kinds of actuators, end stops and conditions of a run as forms: each key with its name, and what it may be."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.actuators.base import ACTUATORS, Actuator, AlongCoordinate
from linkwright.actuators.motor import Motor
from linkwright.core.data import Plain
from linkwright.fields.base import Field, Quantity, Word
from linkwright.fields.references import LinkName, OutputName, PointReferences
from linkwright.fields.tables import Flag
from linkwright.joints.base import JointName
from linkwright.mechanism.run_conditions import PerDriver, RunConditions
from linkwright.mechanism.stops import AlongOutput, Stop
from linkwright.units import example
from linkwright.words import pgettext
from linkwright.words.message import in_language

_KINDS = {
    "brake": pgettext("actuator", "Brake"),
    "constant": pgettext("actuator", "Constant torque or force"),
    "curve": pgettext("actuator", "Motor by its curve"),
    "cylinder": pgettext("actuator", "Cylinder"),
    "dc": pgettext("actuator", "DC motor"),
    "flywheel": pgettext("actuator", "Flywheel"),
    "induction": pgettext("actuator", "Induction motor"),
    "servo": pgettext("actuator", "Servo motor"),
}
_KEYS = {
    "on": pgettext("actuator", "Turns"),
    "against": pgettext("actuator", "Against"),
    "along": pgettext("actuator", "Along the guide"),
    "between": pgettext("actuator", "Between points"),
    "torque": pgettext("actuator", "Torque"),
    "force": pgettext("actuator", "Force"),
    "speed": pgettext("actuator", "Speed"),
    "interpolation": pgettext("actuator", "Between values"),
    "beyond": pgettext("actuator", "Beyond the values"),
    "bore": pgettext("actuator", "Bore"),
    "rod": pgettext("actuator", "Rod diameter"),
    "pressure": pgettext("actuator", "Pressure"),
    "rod_pressure": pgettext("actuator", "Rod side pressure"),
    "largest_speed": pgettext("actuator", "Largest speed"),
    "stroke": pgettext("actuator", "Length, least and most"),
    "voltage": pgettext("actuator", "Voltage"),
    "constant": pgettext("actuator", "Torque constant"),
    "resistance": pgettext("actuator", "Resistance"),
    "current": pgettext("actuator", "Current limit"),
    "stall_torque": pgettext("actuator", "Stall torque"),
    "no_load_speed": pgettext("actuator", "No-load speed"),
    "power": pgettext("actuator", "Rated power"),
    "synchronous": pgettext("actuator", "Synchronous speed"),
    "pull_out": pgettext("actuator", "Breakdown torque ratio"),
    "starting": pgettext("actuator", "Starting torque ratio"),
    "star_until": pgettext("actuator", "In star until"),
    "continuous": pgettext("actuator", "Continuous torque"),
    "peak": pgettext("actuator", "Peak torque"),
    "gain": pgettext("actuator", "Gain"),
    "knee": pgettext("actuator", "Knee speed"),
    "ramp": pgettext("actuator", "Ramp time"),
    "ratio": pgettext("actuator", "Gear ratio"),
    "lead": pgettext("actuator", "Travel per turn"),
    "efficiency": pgettext("actuator", "Efficiency"),
    "inertia": pgettext("actuator", "Moment of inertia"),
    "self_locking": pgettext("actuator", "Self-locking"),
    "holding": pgettext("actuator", "Holding torque"),
    "from": pgettext("actuator", "Acts from"),
    "until": pgettext("actuator", "Acts until"),
}
_STOP_KEYS = {
    "of": pgettext("stop", "Stops"),
    "at": pgettext("stop", "At"),
    "side": pgettext("stop", "Not further"),
    "restitution": pgettext("stop", "Restitution"),
}
_RUN_KEYS = {
    "speed": pgettext("run", "Speed"),
    "for": pgettext("run", "Runs for"),
    "turns": pgettext("run", "Turns"),
    "until": pgettext("run", "Until"),
    "at_most": pgettext("run", "At most"),
}
_WORDS = {
    "linear": pgettext("actuator", "straight"),
    "cubic": pgettext("actuator", "smooth"),
    "hold": pgettext("actuator", "as at the end"),
    "zero": pgettext("actuator", "none"),
    "straight": pgettext("actuator", "straight on"),
    "below": pgettext("stop", "below this"),
    "above": pgettext("stop", "above this"),
    "steady": pgettext("run", "it is steady"),
    "rest": pgettext("run", "it is at rest"),
    "true": pgettext("actuator", "yes"),
    "false": pgettext("actuator", "no"),
}
#: Keys of which those of one group go together, and not with those of another.
_GROUPS = {
    "dc": (("voltage", "constant", "resistance", "current"), ("stall_torque", "no_load_speed")),
    "cylinder": (("bore", "rod", "pressure", "rod_pressure"), ("force",)),
}
#: Right forms of keys of which the usual one of their dimension would mislead.
_EXAMPLES = {"turns": "5", "efficiency": "0.9", "pull_out": "2.5", "starting": "1.8", "ratio": "12"}
#: Keys that many kinds have and few need; they stand apart.
_USUAL = {each.key or name for kind in (AlongCoordinate, Motor) for name, each in kind.fields().items()}


def forms(language: str) -> Plain:
    """Every kind of actuator with its keys, and the keys of stops and of a run."""
    kinds = [
        {
            "kind": kind,
            "label": in_language(_KINDS.get(kind, kind.replace("_", " ")), language),
            "about": _first(each),
            "fields": _of_actuator(each, language),
        }
        for kind, each in ACTUATORS.items()
    ]
    return {
        "kinds": kinds,
        "stops": _fields(Stop.fields(), _STOP_KEYS, language),
        "run": _fields(RunConditions.fields({}), _RUN_KEYS, language),
    }


def _first(kind: type[Actuator]) -> str:
    return " ".join((kind.__doc__ or "").partition("\n\n")[0].split())


def _of_actuator(kind: type[Actuator], language: str) -> list[Plain]:
    """The fields of a kind; ``instead``: keys of which one is enough, ``further``: whether it stands apart."""
    found = _fields(kind.fields(), _KEYS, language)
    for each in found:
        key = each["key"]
        each["instead"] = sorted(_instead(kind, key) - {key})
        each["further"] = key in _USUAL and not each["needed"] and not each["instead"]
    return found


def _instead(kind: type[Actuator], key: str) -> set[str]:
    """The keys of a kind that a key does not go with."""
    groups = _GROUPS.get(kind.kind, ())
    own = next((group for group in groups if key in group), None)
    if own is not None:
        return {one for group in groups if group is not own for one in group}
    return {one for group in kind.exactly_one if key in group for one in group}


def _fields(fields: Mapping[str, Field], words: Mapping[str, str], language: str) -> list[Plain]:
    found: list[Plain] = []
    for name, each in fields.items():
        key = each.key or name
        found.append(
            {
                "key": key,
                "label": in_language(words.get(key, key.replace("_", " ")), language),
                "about": in_language(each.doc, language),
                "needed": each.required,
                "form": _form(each),
                "words": [[word, in_language(_WORDS.get(word, word), language)] for word in _choices(each)],
                "example": _EXAMPLES.get(key) or _hint(each),
                "instead": [],
                "further": False,
            }
        )
    return found


def _form(field: Field) -> str:
    """What a field names: a ``link``, a ``moving`` one, a ``joint``, an ``output``, two ``points``; else nothing."""
    if isinstance(field, LinkName):
        return "moving" if field.moving else "link"
    if isinstance(field, PointReferences):
        return "points"
    return "joint" if isinstance(field, JointName) else "output" if isinstance(field, OutputName) else ""


def _choices(field: Field) -> list[str]:
    return ["true", "false"] if isinstance(field, Flag) else list(field.choices) if isinstance(field, Word) else []


def _hint(field: Field) -> str:
    """A right form of what is typed."""
    if isinstance(field, PerDriver):
        return example(field.rotary)
    if isinstance(field, AlongOutput):
        return example("length")
    return example(field.dimension) if isinstance(field, Quantity) else ""

"""Whether alternatives do the same work: what would make their numbers incomparable."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence

from linkwright.designs.alternatives import Alternative
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import Message, _

#: Keys of a load that say where it acts, not how large it is.
PLACES = ("on", "at", "between", "joint", "links", "direction", "in_link", "normal_to", "along", "against")


def unlike(alternatives: Sequence[Alternative]) -> tuple[str, ...]:
    """Sentences on loads, inputs and outputs in which the alternatives differ."""
    tasks: dict[Message, Callable[[Alternative], tuple[str, ...]]] = {
        _(
            "! The alternatives carry different loads ({values}): torque, power, reactions and "
            "flywheel compare unlike things.",
            code="compare.unlike_loads",
        ): lambda each: _loads(each.mechanism),
        _(
            "! The alternatives are driven at different speeds ({values}): rates, forces and powers "
            "compare unlike things.",
            code="compare.unlike_speeds",
        ): lambda each: _speeds(each.mechanism),
        _(
            "! The outputs of the alternatives are of different kinds ({values}): their travels and "
            "rates compare unlike things.",
            code="compare.unlike_outputs",
        ): lambda each: (each.output.dimension,),
    }
    return tuple(
        message.format(values=[_named_facts(each, read(each)) for each in alternatives])
        for message, read in tasks.items()
        if len({_rounded(read(each)) for each in alternatives}) > 1
    )


def _named_facts(each: Alternative, facts: tuple[str, ...]) -> Message:
    cause = facts or _("none")
    return _("{name}: {cause}", name=each.label, cause=cause)


def _rounded(facts: tuple[str, ...]) -> Hashable:
    return tuple(sorted(facts))


def _loads(mechanism: Mechanism) -> tuple[str, ...]:
    """Kind and size of every load."""
    found = []
    for load in mechanism.loads.values():
        written = {key: value for key, value in load.written().items() if key not in (*PLACES, "phase")}
        kind = str(written.pop("kind"))
        found.append(" ".join([kind, *(_size(value) for value in written.values())]))
    return tuple(found)


def _size(value: object) -> str:
    if isinstance(value, dict):
        return "{" + " ".join(_size(each) for each in value.values()) + "}"
    if isinstance(value, list | tuple):
        return " ".join(_size(each) for each in value)
    return str(value)


def _speeds(mechanism: Mechanism) -> tuple[str, ...]:
    """Sizes of the drivers' constant speeds."""
    laws = (driver.law for driver in mechanism.drivers.values())
    return tuple(
        f"{abs(law.constant_speed):.6g} {'rad/s' if law.rotary else 'm/s'}"
        for law in laws
        if law.constant_speed is not None
    )

"""Mobility by counting, and what is wrong when the count does not come out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from linkwright.errors import LinkwrightError
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.joints.revolute import RevoluteJoint
from linkwright.model.mechanism import Mechanism
from linkwright.structure.constraints import FRAME, ConstraintGraph


class StructureError(LinkwrightError):
    """A model whose motion is not determined, or over-determined, by its drivers."""


def counts(mechanism: Mechanism) -> dict[str, int]:
    """Moving links and pairs: ``links``, ``revolute``, ``prismatic``, ``weld``; a pin of k links is k-1 pairs."""
    joints = mechanism.joints.values()
    revolute = sum(len(j.links) - 1 for j in joints if isinstance(j, RevoluteJoint))
    prismatic = sum(isinstance(j, PrismaticJoint) for j in joints)
    weld = sum(not isinstance(j, RevoluteJoint | PrismaticJoint) for j in joints)
    return {"links": len(mechanism.links), "revolute": revolute, "prismatic": prismatic, "weld": weld}


def grubler(numbers: Mapping[str, int]) -> int:
    """Mobility in the plane, F = 3n - 2p (p lower pairs); a weld takes three.

    n counts the moving links. Range: every planar chain; loops of guides only and special lengths
    move more than the formula says (Grübler 1917; Norton, Design of Machinery, ch. 2).
    """
    return 3 * numbers["links"] - 2 * (numbers["revolute"] + numbers["prismatic"]) - 3 * numbers["weld"]


def islands(mechanism: Mechanism) -> list[list[str]]:
    """Sets of moving links that share nothing but the frame."""
    neighbours: dict[str, set[str]] = {name: set() for name in mechanism.links}
    for equation in ConstraintGraph.of(mechanism).equations:
        for body in equation.bodies:
            neighbours.setdefault(body, set()).update(equation.bodies)
    found: list[list[str]] = []
    seen: set[str] = set()
    for name in mechanism.links:
        if name in seen:
            continue
        reached, stack = set(), [name]
        while stack:
            body = stack.pop()
            if body not in reached:
                reached.add(body)
                stack.extend(neighbours[body])
        seen |= reached
        found.append([link for link in mechanism.links if link in reached])
    return found


def explain_free(mechanism: Mechanism, free: Sequence[str], lacking: int, mobility: int) -> StructureError:
    """The sentence for freedoms that nothing determines."""
    links = ", ".join(repr(name) for name in free)
    drivers = len(mechanism.drivers)
    said = f"{mechanism.name!r} has mobility {mobility} and {_times(drivers, 'driver')}"
    parts = islands(mechanism)
    if len(parts) > 1:
        listed = " and ".join("{" + ", ".join(part) + "}" for part in parts)
        said += f"; the file holds {len(parts)} mechanisms that share nothing but the frame: {listed}"
    hint = (
        f"give {_times(lacking, 'more driver')} (driver: {{turn: …, about: …, speed: …}}), "
        "or join the links further"
    )
    return StructureError(f"{said}; nothing determines the motion of {links}; {hint}")


def explain_excess(
    mechanism: Mechanism, sources: Sequence[str], bodies: Sequence[str], mobility: int
) -> StructureError:
    """The sentence for demands that exceed the freedoms."""
    links = ", ".join(repr(name) for name in bodies)
    extra = ", ".join(repr(name) for name in sources)
    drivers = len(mechanism.drivers)
    if mobility <= 0 and drivers:
        why = (
            f"{mechanism.name!r} has mobility {mobility} by Grübler's formula, so it cannot be driven, "
            f"but {_times(drivers, 'driver')} {'is' if drivers == 1 else 'are'} given"
        )
    else:
        why = f"{mechanism.name!r} has mobility {mobility} and {_times(drivers, 'driver')}"
    return StructureError(
        f"{why}; the links {links} are determined more than once (by {extra} among others); "
        "remove a driver, a redundant link or a redundant guide"
    )


def _times(count: int, noun: str) -> str:
    word = {0: "no", 1: "one", 2: "two", 3: "three"}.get(count, str(count))
    return f"{word} {noun}" + ("" if count == 1 else "s")


__all__ = ["FRAME", "StructureError", "counts", "explain_excess", "explain_free", "grubler", "islands"]

"""Where forces switch: comparisons that go over together, and whose forces go by them."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.core.outputs import Output
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.switches import gap_name


@dataclass(frozen=True)
class Surface:
    """Where comparisons go over together: the switches by number, with 1 for those that hold above, -1 below.

    ``by_rate``: its gap goes by rates, so that forces decide on which side it goes on; ``owners``: loads and joints
    whose forces switch there; ``follows``: its gap goes by the sides of others, so that it jumps with them.
    """

    members: tuple[tuple[int, float], ...]
    by_rate: bool
    owners: tuple[str, ...]
    follows: bool = False

    @property
    def number(self) -> int:
        """The switch whose gap is that of the surface, but for its sign."""
        return self.members[0][0]


def surfaces_of(equation: EquationOfMotion) -> list[Surface]:
    """The switches, those together whose comparisons differ by sense alone."""
    lines = equation.switches.trace.lines
    rates = {f"qd:{name}" for name in equation.free}
    found: dict[tuple[int, ...], list[tuple[int, float]]] = {}
    for number, line in enumerate(equation.switches.lines):
        low, high = lines[line][1:]
        found.setdefault((min(low, high), max(low, high)), []).append((number, 1.0 if low < high else -1.0))
    owners = _owners(equation)
    surfaces = []
    for members in found.values():
        gap = equation.program([gap_name(members[0][0])])
        own = tuple(dict.fromkeys(owner for number, _sign in members for owner in owners[number]))
        by_rate = not rates.isdisjoint(gap.positions)
        follows = not by_rate and not set(equation.switches.names).isdisjoint(gap.positions)
        surfaces.append(Surface(tuple(members), by_rate, own, follows))
    return surfaces


def _owners(equation: EquationOfMotion) -> list[list[str]]:
    """The loads and the joints that rub whose forces go by each switch."""
    trace, lines = equation.switches.trace, equation.switches.lines
    found: list[list[str]] = [[] for _line in lines]
    for name, wrenches in equation.forces.forces.wrenches.items():
        values = [value for each in wrenches for value in (each.force.x, each.force.y, each.torque)]
        needed = set(trace.needed([trace.lift(value) for value in values]))
        owner = name if name in equation.mechanism.loads else Output.of_row(name).owner
        for number, line in enumerate(lines):
            if line in needed and owner not in found[number]:
                found[number].append(owner)
    return found

"""A machine's own numbers: structure, motion, forces, metrics, limits, running, balancing, worked positions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property

from tests.state.rows import Entries, attempt, codes, columns, curve, leaves, sums

import linkwright as lw

#: Columns that are rounding alone.
ROUNDING = ("power_residual", "balance_residual")


class Machine:
    """A mechanism with what is found from it once, and asked for by several parts."""

    def __init__(self, mechanism: lw.Mechanism, steps: int = 360) -> None:
        self.mechanism, self.steps = mechanism, steps

    @cached_property
    def motion(self) -> lw.Motion:
        return lw.solve_motion(self.mechanism, steps=self.steps, failures="mark")

    @cached_property
    def forces(self) -> lw.Forces:
        return lw.solve_forces(self.motion)


def structure(machine: Machine) -> Entries:
    """Mobility, groups, dimensions."""
    yield from attempt("structure", lambda: leaves(lw.structure(machine.mechanism).data()))
    for address, value in machine.mechanism.dimensions().items():
        yield f"dimension/{address}", "", value


def motion(machine: Machine) -> Entries:
    """Columns of the motion, and what becomes of its positions."""
    found = machine.motion
    yield from columns(found.columns())
    kinds = [each.kind for each in found.outcomes]
    yield "outcomes", "", runs(kinds)
    yield "failing groups", "", runs([str(each.group) for each in found.outcomes])
    yield "notes", "", codes(found.notes)


def runs(words: list[str]) -> list[str]:
    """Equal neighbours as one, with their number."""
    found: list[list[object]] = []
    for word in words:
        if found and found[-1][0] == word:
            found[-1][1] = int(str(found[-1][1])) + 1
        else:
            found.append([word, 1])
    return [f"{number} {word}" for word, number in found]


def forces(machine: Machine) -> Entries:
    """Columns of the forces that those of the motion have not, powers, and what each load does."""
    found = machine.forces
    before = machine.motion.columns()
    yield from columns({k: v for k, v in found.columns().items() if k not in before and not k.startswith(ROUNDING)})
    yield "power", "W", curve(found.power)
    yield "friction power", "W", curve(found.friction_power)
    yield from attempt("torque from power", lambda: [("", "N·m", curve(found.input_torque_from_power))])
    yield "notes", "", codes(found.notes)
    yield from attempt("static", lambda: static(machine))


def static(machine: Machine) -> Entries:
    """The efforts of the drivers without inertia."""
    found = lw.solve_forces(machine.motion, static=True)
    for name in machine.mechanism.drivers:
        yield name, "N·m", sums(found.driver_effort(name))


def metrics(machine: Machine) -> Entries:
    """All metrics that apply, what does not, and Grashof's chains."""
    table = lw.metrics(solved(machine))
    for row in table.data()["metrics"]:
        name = f"{row['metric']}/{row['subject']}"
        yield name, row["unit"] or "", row["value"]
        if row["at"] is not None:
            yield f"{name}/at", row["at_unit"] or "", row["at"]
        if row["place"] is not None:
            yield f"{name}/place", "m", row["place"]
        if not row["exact"] or row["warning"]:
            yield f"{name}/marks", "", [word for word in ("exact", "warning") if row[word]]
    yield "skipped", "", sorted(table.skipped)
    yield "notes", "", codes(table.notes)
    for name in table.skipped:
        yield from attempt(name, lambda name=name: unasked(machine, name))
    yield from attempt("four-bars", lambda: chains(machine))
    for point in list(machine.motion.point_names())[-1:]:
        yield from attempt(f"coupler curve/{point}", lambda point=point: coupler(machine, point))
    for link in list(machine.mechanism.links)[-2:]:
        yield from attempt(f"centre/{link}", lambda link=link: centre(machine, link))


def chains(machine: Machine) -> Entries:
    """Four-bar loops with their lengths and Grashof's margins."""
    from linkwright.analysis import four_bars

    for bar in four_bars(machine.mechanism):
        yield bar.name, "m", [bar.margin, *bar.lengths.values()]


def coupler(machine: Machine, point: str) -> Entries:
    """Length, area and special points of a coupler curve."""
    from linkwright.analysis import coupler_curve

    found = coupler_curve(machine.motion, point)
    yield from leaves({"length [m]": found.length, "area [m²]": found.area, "path [m]": found.path})
    yield "double points", "m", [float(each) for place, _ in found.double_points for each in place]
    yield "cusps", "m", [float(each) for place, _ in found.cusps for each in place]


def centre(machine: Machine, link: str) -> Entries:
    """The instant centre of a link on the frame."""
    from linkwright.analysis import instant_centre

    yield "", "m of centres", curve(instant_centre(machine.motion, link))


def unasked(machine: Machine, name: str) -> Entries:
    """A metric that was skipped, asked for by its name."""
    for row in lw.metrics(solved(machine), name).data()["metrics"]:
        yield row["subject"], row["unit"] or "", row["value"]


def solved(machine: Machine) -> lw.Forces | lw.Motion:
    """The forces where there are any, else the motion."""
    try:
        return machine.forces
    except lw.LinkwrightError:
        return machine.motion


def limits(machine: Machine) -> Entries:
    """Limit positions of every link, guide and point, and the ranges of the drivers."""
    mechanism = machine.mechanism
    outputs = [*mechanism.links, *mechanism.guides]
    outputs += [f"{name}.{axis}" for name in list(machine.motion.point_names())[-2:] for axis in "xy"]
    for output in outputs:
        yield from attempt(output, lambda output=output: limits_of(machine, output))
    yield from ranges(machine)


def limits_of(machine: Machine, output: str) -> Entries:
    found = lw.limit_positions(machine.motion, output)
    yield "kinds", "", [each.kind for each in found]
    yield "values", "", [each.value for each in found]
    yield "at", "", [each.input for each in found]
    yield "times", "s", [each.time for each in found]


def ranges(machine: Machine) -> Entries:
    """The reachable range of every driver."""
    for driver in machine.mechanism.drivers:
        yield from attempt(f"range/{driver}", lambda driver=driver: range_of(machine, driver))


def range_of(machine: Machine, driver: str) -> Entries:
    found = lw.input_range(machine.mechanism, driver)
    for side in ("low", "high"):
        end = getattr(found, side)
        yield side, "", None if end is None else end.value
        if end is not None:
            yield f"{side}/precision", "", "exact" if end.precision < 1e-7 else "near"


def running(machine: Machine) -> Entries:
    """Motor, flywheel and true speed for some fluctuations."""
    for options in ({"fluctuation": 0.02}, {"fluctuation": 0.1, "ratio": 4.0, "efficiency": 0.9, "margin": 1.2}):
        yield from attempt(str(options["fluctuation"]), lambda options=options: running_with(machine, options))


def running_with(machine: Machine, options: Mapping[str, float]) -> Entries:
    found = lw.steady_running(machine.forces, **options)
    yield from leaves(found.data())
    for name in ("speed", "exact_speed"):
        curve_of = getattr(found, name)
        yield f"{name}/slowest", "rad/s", curve_of.slowest[1]
        yield f"{name}/fastest", "rad/s", curve_of.fastest[1]
        yield f"{name}/mean", "rad/s", curve_of.mean
        yield f"{name}/fluctuation", "", curve_of.fluctuation


def balancing(machine: Machine) -> Entries:
    """Counterweights, and what they do to the peaks."""
    for share in (1.0, 0.5):
        yield from attempt(str(share), lambda share=share: balanced(machine, share))


def balanced(machine: Machine, share: float) -> Entries:
    found = lw.balance(machine.mechanism, radius=0.1, share=share)
    for number, each in enumerate(found.counterweights):
        for name in ("link", "mass", "place"):
            yield f"{number}/{name}", "", getattr(each, name, None)
    yield from leaves(found.effect())


def worked(machine: Machine) -> Entries:
    """The numbers of a worked position."""
    found = lw.worked(solved(machine), machine.steps // 6)
    for step in found.data()["steps"]:
        for item in step["items"]:
            if isinstance(item.get("value"), float):
                yield f"{step['number']}/{item.get('symbol', '')}", item.get("unit", ""), item["value"]


PARTS: Mapping[str, Callable[[Machine], Entries]] = {
    "structure": structure,
    "motion": motion,
    "forces": forces,
    "metrics": metrics,
    "limits": limits,
    "running": running,
    "balancing": balancing,
    "worked": worked,
}

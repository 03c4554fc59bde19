"""Machines with changed dimensions: sweeps, gradients, sensitivities, studies, prepared machines, searches."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import chain

import numpy as np
from tests.state.machines import Machine
from tests.state.rows import Entries, attempt, codes, curve, leaves, named, sums

import linkwright as lw

STEPS = 72
#: Ends of the addresses of the dimensions that are varied, and how many of each.
VARIED = ((".length", 2), (".mass", 1), (".x", 1), (".0", 1))
#: Outputs that each need only the motion, need forces, or are metrics.
OUTPUTS: Mapping[str, Sequence[str]] = {
    "motion": ("{link}.angle range", "{link}.angular_velocity rms", "{link}.angular_acceleration peak"),
    "point": ("{point}.x range", "{point}.velocity mean", "{point}.acceleration max"),
    "drive": ("driver.effort rms", "driver.effort max", "driver.effort min", "power mean"),
    "frame": ("shaking_force peak",),
    "closeness": ("closeness min",),
    "torque": ("rms_input_torque", "peak_input_torque"),
    "angle": ("transmission_angle",),
}
#: Kinds on which masses have no influence.
MASSLESS = ("motion", "point", "closeness", "angle")


def dimensions(machine: Machine) -> list[str]:
    """A few dimensions to vary, of several kinds."""
    known = {name: value for name, value in machine.mechanism.dimensions().items() if value}
    found = [[name for name in known if name.endswith(end)][:most] for end, most in VARIED]
    return list(chain(*found)) or list(known)[:1]


def outputs(machine: Machine) -> dict[str, list[str]]:
    """Outputs by the kind of their source, for the last link and the last point."""
    names = {"link": list(machine.mechanism.links)[-1], "point": list(machine.motion.point_names())[-1]}
    return {kind: [each.format(**names) for each in texts] for kind, texts in OUTPUTS.items()}


def around(machine: Machine, by: Sequence[str]) -> dict[str, np.ndarray]:
    """Five designs around the machine, each dimension changed in its own way."""
    start = {name: machine.mechanism.dimension(name) for name in by}
    return {
        name: value * (1 + 2e-3 * np.sin(np.arange(5) * (k + 1))) for k, (name, value) in enumerate(start.items())
    }


def in_groups(machine: Machine, find: Callable[[Machine, list[str], list[str]], Entries]) -> Entries:
    """For each kind of outputs all dimensions together; where that is refused, one after the other."""
    whole = dimensions(machine)
    for kind, asked in outputs(machine).items():
        by = [name for name in whole if not (kind in MASSLESS and name.endswith(".mass"))]
        found = list(attempt(kind, lambda asked=asked, by=by: find(machine, asked, by)))
        yield from found
        if found and found[-1][0].endswith("refused"):
            for one in by:
                yield from attempt(f"{kind}/{one}", lambda asked=asked, one=one: find(machine, asked, [one]))


def sweep(machine: Machine) -> Entries:
    """Sweeps, all designs together and those that do not pass part by part."""
    yield from in_groups(machine, swept)


def swept(machine: Machine, asked: list[str], by: list[str]) -> Entries:
    found = lw.sweep(machine.mechanism, around(machine, by), outputs=asked, steps=STEPS, threads=1)
    for name, values in found.columns().items():
        yield *named(name), curve(values)
    yield "notes", "", codes(found.notes)


def objective(machine: Machine) -> Entries:
    """Values and gradients at the machine and beside it."""
    yield from in_groups(machine, gradients)


def gradients(machine: Machine, asked: list[str], by: list[str]) -> Entries:
    for output in asked:
        yield from attempt(output, lambda output=output: gradient(machine, output, by))


def gradient(machine: Machine, output: str, by: list[str]) -> Entries:
    found = lw.objective(machine.mechanism, output, vary=by, steps=STEPS)
    for name, factor in (("start", 1.0), ("beside", 1.0007)):
        value, slopes = found(np.asarray(found.start) * factor)
        yield f"{name}/value", of(output), value
        yield f"{name}/gradient", of(output), np.multiply(slopes, found.start)


def sensitivity(machine: Machine) -> Entries:
    """Derivatives of curves and of summaries."""
    yield from in_groups(machine, sensitivities)


def sensitivities(machine: Machine, asked: list[str], by: list[str]) -> Entries:
    curves = list(dict.fromkeys(each.rsplit(" ", 1)[0] for each in asked if " " in each))
    found = lw.sensitivity(machine.mechanism, of=[*asked, *curves], by=by, steps=STEPS)
    start = np.array([machine.mechanism.dimension(name) for name in by])
    for output in asked:
        yield f"{output}/value", of(output), found.value(output)
        yield f"{output}/gradient", of(output), np.multiply(found.gradient(output), start)
    for output in curves:
        yield f"{output}/curve", of(output), curve(found.curve(output))
        for one, value in zip(by, start, strict=True):
            yield f"{output}/{one}", of(output), curve(found.slope(output, one) * value)


def of(output: str) -> str:
    """The unit of an output and of its derivatives, each times its dimension: they are judged by the largest."""
    return f"of {output}"


def study(machine: Machine) -> Entries:
    """The usual metrics of a few designs."""
    vary = {name: values[:3] for name, values in around(machine, dimensions(machine)[:1]).items()}
    found = lw.study(machine.mechanism, vary, steps=STEPS)
    for name, values in found.columns().items():
        yield *named(name), curve(values)
    yield "ok", "", [bool(each) for each in found.ok]


def prepared(machine: Machine) -> Entries:
    """A design of a prepared machine; of every column a sum."""
    by = dimensions(machine)
    ready = lw.prepare(machine.mechanism, vary=by, steps=STEPS)
    changed = {name: machine.mechanism.dimension(name) * 1.0009 for name in by}
    found = ready.solve(changed, failures="mark")
    for name, values in found.columns().items():
        if "_residual" not in name:
            yield *named(name), sums(values)


def optimize(machine: Machine) -> Entries:
    """A short search."""
    name = dimensions(machine)[0]
    value = machine.mechanism.dimension(name)
    low, high = sorted((value * 0.95, value * 1.05))
    goal = outputs(machine)["motion"][0]
    found = lw.optimize(machine.mechanism, vary={name: [low, high]}, minimize=goal, evaluations=60, steps=36, seed=1)
    yield from leaves(found.data())


PARTS: Mapping[str, Callable[[Machine], Entries]] = {
    "sweep": sweep,
    "objective": objective,
    "sensitivity": sensitivity,
    "study": study,
    "prepared": prepared,
    "optimize": optimize,
}

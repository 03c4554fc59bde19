"""Random mechanisms without reserve, as model files: any groups, drivers, laws, loads, and cycles.

Unlike those of `random_mechanisms` they may be driven into limits, and their assemblies may nearly meet.
The same seed gives the same text.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import pi

import numpy as np
from tests.reference import random_mechanisms as base
from tests.reference.draft import Awkward, Draft
from tests.reference.general_pieces import angle_or_length, compose
from tests.reference.multibody import FRAME, Multibody
from tests.reference.random_loads import cyclic_loads, random_loads
from tests.reference.random_mechanisms import DriverLaw, PlacedLink, RandomCase
from tests.reference.random_text import file_text

WORST_NEARNESS = 1e-4  # smallest singular value at the drawing, as a share of the largest
CLOSE = 4e-3  # below it another assembly is likely to be near; wanted on purpose for some
STEPS = (1, 2, 3, 5, 7, 12, 12, 24, 24, 36, 60)


@dataclass(frozen=True)
class GeneralCase:
    seed: int
    text: str
    steps: int


@cache
def general_case(seed: int) -> GeneralCase:
    """The model file of a seed, and the number of steps in which its cycle is to be solved."""
    rng = np.random.default_rng([seed, 1_989])
    close = rng.random() < 0.25
    for _ in range(5000):
        d = Draft(rng)
        try:
            compose(d)
            text = _text(d, seed, close)
        except (Awkward, np.linalg.LinAlgError):
            continue
        steps = 360 if rng.random() < 0.04 else int(rng.choice(STEPS))
        return GeneralCase(seed, text, steps)
    raise RuntimeError(f"no mechanism for seed {seed}")


def _text(d: Draft, seed: int, close: bool) -> str:
    order = [name for name in d.links if name != FRAME]
    if not 1 <= len(order) <= 12 or (close and d.closed_form):
        raise Awkward
    d.rng.shuffle(order)
    links = {name: base.placed_link(d, name) for name in order}
    for link in links.values():
        if d.chance(0.7):
            base.give_mass(d, link)
    links[FRAME] = PlacedLink(FRAME, "coordinates", (0.0, 0.0, 0.0), dict(d.links[FRAME]), 0)
    system = base.system_of(d, links, order)
    start = np.array([links[name].pose for name in [FRAME, *order]])
    _check_regular(system, start, close)
    case = RandomCase(seed, "", system, start, links, base.constant_speeds(d, links), (0.0, 0.0), ())
    cycle, drivers, parameters = _cycle_and_laws(d, case.laws)
    if d.chance(0.75):
        case.loads = random_loads(d, links, order) | cyclic_loads(d, links, order, case.laws, cycle)
    return file_text(d, case, drivers=drivers, cycle=_cycle_line(cycle), parameters=parameters)


def _check_regular(system: Multibody, start: np.ndarray, close: bool) -> None:
    if system.rows != 3 * len(system.bodies):
        raise Awkward
    singular = np.linalg.svd(system.jacobian(start)[:, 3:], compute_uv=False)
    nearness = singular[-1] / singular[0]
    if nearness < WORST_NEARNESS or (close and nearness > CLOSE):
        raise Awkward


def _cycle_line(duration: float | None) -> str | None:
    return None if duration is None else f"cycle: {{duration: {duration!r} s}}"


def _cycle_and_laws(d: Draft, laws: list[DriverLaw]) -> tuple[float | None, list[str], dict[str, str]]:
    """Duration of the cycle (None: one turn of a lone turning driver), the drivers' laws, parameters."""
    lone_turn = len(laws) == 1 and laws[0].kind == "turn"
    if lone_turn and d.chance(0.45):
        return None, [_constant(laws[0])], {}
    duration = float(round(d.rng.uniform(0.3, 3.0), 3))
    parameters: dict[str, str] = {}
    return duration, [_law(d, law, duration, parameters) for law in laws], parameters


def _constant(law: DriverLaw) -> str:
    unit = "rad" if law.kind == "turn" else "m"
    return f"speed: {law.speed!r} {unit}/s, start: {law.start!r} {unit}"


def _law(d: Draft, law: DriverLaw, duration: float, parameters: dict[str, str]) -> str:
    unit = "rad" if law.kind == "turn" else "m"
    amplitude = angle_or_length(d.rng, law.kind)
    draw = d.rng.random()
    if draw < 0.2:
        speed = float(round(d.rng.choice([-1, 1]) * d.rng.uniform(0.2, 1.5) * amplitude / duration, 4))
        return _constant(DriverLaw(law.name, law.kind, law.joint, law.link, law.relative_to, law.start, speed))
    if draw < 0.6:
        return _oscillation(d, law, unit, amplitude, duration, parameters)
    if draw < 0.75:
        square = float(round(d.rng.uniform(-1, 1) * amplitude, 4))
        return f'position: "{law.start!r} {unit} + {square} {unit}*(t/({duration} s))^2"'
    return _table(d, law, unit, amplitude, duration)


def _oscillation(
    d: Draft, law: DriverLaw, unit: str, amplitude: float, duration: float, parameters: dict[str, str]
) -> str:
    phase = float(round(d.rng.uniform(-pi, pi), 4))
    start = law.start - (amplitude * float(np.sin(phase)) if d.chance(0.8) else 0.0)
    period = duration * float(d.rng.choice([1.0, 1.0, 0.5]))
    size = f"{amplitude!r} {unit}"
    if d.chance(0.3):
        parameters[f"swing{law.name}"], size = size, f"swing{law.name}"
    return f'position: "{start!r} {unit} + {size}*sin(2*pi*t/({period!r} s) + {phase} rad)"'


def _table(d: Draft, law: DriverLaw, unit: str, amplitude: float, duration: float) -> str:
    way = d.pick(["cubic", "linear", "periodic"])
    inner = np.sort(d.rng.uniform(0.1, 0.9, 3)) + np.array([-0.05, 0.0, 0.05])
    times = [0.0, *(float(round(x * duration, 4)) for x in inner), duration]
    moved = [0.0, *(float(round(x, 4)) for x in d.rng.uniform(-1, 1, 4) * amplitude)]
    if way == "periodic":
        turns = int(d.rng.choice([0, 0, 1, -1])) if law.kind == "turn" else 0
        moved[-1] = 2 * pi * turns
    positions = [f"{law.start + x!r} {unit}" for x in moved]
    rows = f"time: [{', '.join(f'{t!r} s' for t in times)}], position: [{', '.join(positions)}]"
    return f"table: {{{rows}, interpolation: {way}}}"

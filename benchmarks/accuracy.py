"""Results against an evaluation with 50 digits that goes another way: angles, loop equations, one linear system."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from benchmarks.cases import FOURBAR_OUTPUTS, SIXBAR_OUTPUTS, Floats, Work
from linkwright.formula.llvm_backend import compile_program
from linkwright.formula.numpy_backend import NumpyProgram

DIGITS = 50
Number = Any


def _mp() -> Any:
    import mpmath  # type: ignore[import-untyped, unused-ignore]

    mpmath.mp.dps = DIGITS
    return mpmath.mp


@dataclass(frozen=True)
class Body:
    """A pin that moves: place, velocity, acceleration as complex numbers."""

    place: Number
    velocity: Number
    acceleration: Number


def crank_end(turn: Number, length: Number, speed: Number) -> Body:
    """The crank's pin; ``turn`` = e^{iθ}."""
    arm = length * turn
    return Body(arm, 1j * speed * arm, -speed * speed * arm)


def dyad(p: Body, fixed: Number, first: Number, second: Number, side: float) -> tuple[Body, list[Number]]:
    """The inner pin by the law of cosines; the rates w1, w2, g1, g2 from the loop equation."""
    mp = _mp()
    ray = fixed - p.place
    distance = abs(ray)
    opening = mp.acos((first**2 + distance**2 - second**2) / (2 * first * distance))
    u = first * ray / distance * mp.expj(side * opening)
    w = p.place + u - fixed
    w1, w2 = _loop(u, w, -p.velocity)
    g1, g2 = _loop(u, w, -p.acceleration + w1**2 * u - w2**2 * w)
    body = Body(fixed + w, 1j * w2 * w, (1j * g2 - w2**2) * w)
    return body, [w1, w2, g1, g2]


def _loop(u: Number, w: Number, right: Number) -> tuple[Number, Number]:
    """x, y with i x u - i y w = right."""
    a, b = 1j * u, -1j * w
    determinant = a.real * b.imag - a.imag * b.real
    x = (right.real * b.imag - right.imag * b.real) / determinant
    y = (a.real * right.imag - a.imag * right.real) / determinant
    return x, y


def fourbar_row(cosine: Number, sine: Number, design: Sequence[float] | Floats) -> list[Number]:
    """The outputs of W2 at one position."""
    mp = _mp()
    crank, speed, ground, coupler, rocker, side, u, v = (mp.mpf(float(x)) for x in design)
    a = crank_end(mp.mpc(cosine, sine), crank, speed)
    b, (w1, w2, g1, g2) = dyad(a, mp.mpc(ground), coupler, rocker, float(side))
    arm = (b.place - a.place) / coupler * mp.mpc(u, v)
    p = Body(a.place + arm, a.velocity + 1j * w1 * arm, a.acceleration + (1j * g1 - w1**2) * arm)
    return [*_components([a, b, p]), w1, w2, g1, g2]


def _components(pins: list[Body]) -> list[Number]:
    kinds: list[Callable[[Body], Number]] = [lambda b: b.place, lambda b: b.velocity, lambda b: b.acceleration]
    return [part for kind in kinds for pin in pins for part in (kind(pin).real, kind(pin).imag)]


def sixbar_row(cosine: Number, sine: Number, design: Sequence[float] | Floats) -> list[Number]:
    """The outputs of W3 at one position."""
    mp = _mp()
    row = [mp.mpf(float(x)) for x in design]
    a = crank_end(mp.mpc(cosine, sine), row[0], row[1])
    o3, o5 = mp.mpc(row[2], row[3]), mp.mpc(row[7], row[8])
    b, first = dyad(a, o3, row[4], row[5], float(row[6]))
    c, second = dyad(b, o5, row[9], row[10], float(row[11]))
    rates = [*first[:2], *second[:2], *first[2:], *second[2:]]
    forces = _balance([a, b, c, Body(o3, 0, 0), Body(o5, 0, 0)], rates[4:], row[12:16], row[16:20], row[20])
    return [*_components([a, b, c]), *rates, *forces]


def _balance(
    pins: list[Body], turning: Sequence[Number], masses: Sequence[Number], inertias: Sequence[Number], gravity: Number
) -> list[Number]:
    """Newton and Euler for crank and four links in one system: O1, A, B, B (toggle), C, O3, O5, torque."""
    mp = _mp()
    a, b, c, o3, o5 = pins
    ends = [(a, b), (o3, b), (b, c), (o5, c)]
    centres = [mp.mpc(0)] + [(p.place + q.place) / 2 for p, q in ends]
    matrix, right = mp.zeros(15, 15), mp.zeros(15, 1)
    acting = [
        (0, 0, 1, mp.mpc(0)),
        (0, 1, -1, a.place),
        (1, 1, 1, a.place),
        (1, 2, 1, b.place),
        (2, 2, -1, b.place),
        (2, 3, -1, b.place),
        (2, 5, 1, o3.place),
        (3, 3, 1, b.place),
        (3, 4, 1, c.place),
        (4, 4, -1, c.place),
        (4, 6, 1, o5.place),
    ]
    for link, force, sign, place in acting:
        arm = place - centres[link]
        matrix[3 * link, 2 * force] += sign
        matrix[3 * link + 1, 2 * force + 1] += sign
        matrix[3 * link + 2, 2 * force] -= sign * arm.imag
        matrix[3 * link + 2, 2 * force + 1] += sign * arm.real
    matrix[2, 14] = 1
    for k, (p, q) in enumerate(ends):
        pull = masses[k] * ((p.acceleration + q.acceleration) / 2 + 1j * gravity)
        right[3 * k + 3], right[3 * k + 4], right[3 * k + 5] = pull.real, pull.imag, inertias[k] * turning[k]
    return list(mp.lu_solve(matrix, right))


def _largest_error(names: Sequence[str], ours: Floats, truth: list[list[Number]]) -> dict[str, float]:
    """Per quantity the largest error of the vector, as a share of the largest vector of the cycle."""
    mp = _mp()
    groups: dict[str, list[int]] = {}
    for place, name in enumerate(names):
        groups.setdefault(name.removesuffix(".x").removesuffix(".y"), []).append(place)
    found = {}
    for name, places in groups.items():
        errors = [mp.norm([mp.mpf(float(ours[p, i])) - row[p] for p in places]) for i, row in enumerate(truth)]
        found[name] = float(max(errors) / max(mp.norm([row[p] for p in places]) for row in truth))
    return found


def cycle(name: str, work: Work) -> Mapping[str, dict[str, float]]:
    """Relative errors of every output over the cycle, by route; the reference takes the exact sine and cosine."""
    mp = _mp()
    angles = next(iter(work.positions.coordinates.values()))[0]
    row = fourbar_row if name == "fourbar" else sixbar_row
    truth = [row(mp.cos(mp.mpf(float(t))), mp.sin(mp.mpf(float(t))), work.nominal()) for t in angles]
    names = FOURBAR_OUTPUTS if name == "fourbar" else SIXBAR_OUTPUTS
    return {route: _largest_error(names, values, truth) for route, values in _routes(work, work.nominal()).items()}


def _routes(work: Work, design: Floats, at: tuple[float, float] | None = None) -> dict[str, Floats]:
    program = work.program()
    numbers = work.table(program, design[None, :])[0]
    arrays = {key: work.positions.arrays[key] for key in program.positions}
    if at is not None:
        arrays = {"cos:driver": np.full(16, at[0]), "sin:driver": np.full(16, at[1])}
    routes = {"NumPy": np.asarray(NumpyProgram(program).run(numbers, arrays))}
    compiled = compile_program(program)
    if compiled is not None:
        routes["compiled"] = compiled.repeated(arrays)(numbers)
    return routes


@dataclass(frozen=True)
class Near:
    """Errors near a singular position, each as a multiple of the unit roundoff times a power of the condition number.

    ``condition`` κ of the dyad's velocity equations; ``position`` by u·κ; ``velocity`` and ``acceleration`` by u·κ².
    """

    gap: float
    condition: float
    errors: tuple[float, float, float]
    multiples: tuple[float, float, float]


def near_singular(work: Work, gaps: Sequence[float]) -> list[Near]:
    """The crank-rocker at θ = 180° with coupler and rocker longer than the distance to span by a share ``gap``."""
    found = []
    for gap in gaps:
        design = work.nominal()
        design[3] = (design[0] + design[2]) * (1.0 + gap) - design[4]
        found.append(_near(work, design, gap))
    return found


def _near(work: Work, design: Floats, gap: float) -> Near:
    mp = _mp()
    cosine, sine = np.cos(np.pi - 0.0), 0.0
    truth = fourbar_row(mp.mpf(float(cosine)), mp.mpf(sine), design)
    ours = list(_routes(work, design, (float(cosine), sine)).values())[-1][:, 0]
    u, w = (complex(truth[2] - truth[0], truth[3] - truth[1]), complex(truth[2] - design[2], truth[3]))
    jacobian = np.array([[-u.imag, w.imag], [u.real, -w.real]])
    condition = float(np.linalg.cond(jacobian))
    errors = []
    for first in (2, 8, 14):
        error = mp.norm([mp.mpf(float(ours[k])) - truth[k] for k in (first, first + 1)])
        errors.append(float(error / mp.norm([truth[first], truth[first + 1]])))
    roundoff = 0.5 * float(np.finfo(float).eps)
    powers = (condition, condition**2, condition**2)
    multiples = tuple(error / (roundoff * power) for error, power in zip(errors, powers, strict=True))
    return Near(gap, condition, (errors[0], errors[1], errors[2]), (multiples[0], multiples[1], multiples[2]))

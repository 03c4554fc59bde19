"""Random programs, and the same chain of operations over floats."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from linkwright.formula.program import Program
from linkwright.formula.trace import (
    Trace,
    absolute,
    acos,
    angle,
    asin,
    atan,
    cos,
    exp,
    floor,
    log,
    power,
    select,
    sign,
    sin,
    sqrt,
    tan,
)

PARAMETERS = ("a", "b", "c")
POSITIONS = ("x", "y")
FIELDS = ("f",)


class Formulas:
    """A random chain of operations that works on floats and on traced values alike."""

    def __init__(self, seed: int, length: int = 40) -> None:
        rng = np.random.default_rng(seed)
        self.steps = [
            (str(rng.choice(OPERATIONS)), *(int(k) for k in rng.integers(0, 1000, 4))) for _ in range(length)
        ]

    def __call__(self, values: list, level: int) -> tuple[list, list]:  # type: ignore[type-arg]
        values = list(values)
        truths = []
        for count, (op, i, j, k, m) in enumerate(self.steps):
            pool = values[:level] if count < 8 else values
            a, b, c, d = (pool[q % len(pool)] for q in (i, j, k, m))
            values.append(OPERATION[op](a, b, c, d))
            if count < 8:
                level += 1
            truths.append(less(a, b))
        return values, truths


def less(a, b):  # type: ignore[no-untyped-def]
    return a < b


def negated(truth):  # type: ignore[no-untyped-def]
    return not truth if isinstance(truth, bool) else ~truth


OPERATION: dict[str, Callable] = {  # type: ignore[type-arg]
    "add": lambda a, b, c, d: a + b,
    "sub": lambda a, b, c, d: a - b,
    "mul": lambda a, b, c, d: a * b,
    "div": lambda a, b, c, d: a / (1.5 + absolute(b)),
    "neg": lambda a, b, c, d: -a,
    "root": lambda a, b, c, d: sqrt(1.0 + a * a),
    "sine": lambda a, b, c, d: sin(a) + cos(b),
    "arcs": lambda a, b, c, d: angle(a, 2.0 + b * b) + atan(c) + asin(sin(a) * 0.9) * acos(cos(d) * 0.9),
    "powers": lambda a, b, c, d: power(1.0 + a * a, sin(b)) + exp(-c * c) + log(2.0 + absolute(d)),
    "steps": lambda a, b, c, d: a - 0.5 * floor(a * 2.0) + sign(b) + tan(0.5 * sin(c)),
    "constant": lambda a, b, c, d: 0.75 * a - 0.5,
    "select": lambda a, b, c, d: select(less(a, b), c, d),
    "both": lambda a, b, c, d: select(less(a, b) & negated(less(c, d)) | (b <= d), a, d),
}
OPERATIONS = list(OPERATION)


def random_program(seed: int, *, fields: bool = True) -> tuple[Program, Formulas]:
    formulas = Formulas(seed)
    t = Trace()
    inputs = [t.parameter(n) for n in PARAMETERS] + [t.position(n) for n in POSITIONS]
    inputs += [t.field_input(n) for n in FIELDS] if fields else [0.5]
    values, truths = formulas(inputs, len(PARAMETERS))
    outputs = outputs_of(values, truths, inputs)
    return Program.of(t, outputs), formulas


def outputs_of(values: list, truths: list, inputs: list) -> dict:  # type: ignore[type-arg]
    """The last values, a value per design, inputs themselves, truth values, all touching every input."""
    touched = sum(inputs[1:], inputs[0])
    outputs = {f"v{i}": v + touched for i, v in enumerate(values[-6:])}
    outputs |= {"design": values[8] * inputs[0], "x": inputs[3], "a": inputs[0], "constant": 2.5}
    outputs |= {"low": truths[-1], "valid": touched < 3.0, "again": outputs["v0"]}
    return outputs

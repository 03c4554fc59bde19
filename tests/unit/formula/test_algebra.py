"""What a trace writes, small matrices, vectors as complex numbers, places of values, each by its own arithmetic."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from itertools import chain
from itertools import product as pairs
from typing import Any

import numpy as np
import pytest
from tests.every import every
from tests.unit.formula.random_programs import random_program

from linkwright.formula import kernel, trace
from linkwright.formula import linear_algebra as linear
from linkwright.formula.linear_algebra import Vec, choose
from linkwright.formula.numpy_backend import NUMBER, ROW, TRUTH, NumpyProgram, Registers
from linkwright.formula.program import Lines, Program
from linkwright.formula.replay import Replay, across_designs
from linkwright.formula.trace import Scalar, Trace, Value

ONES = (0.0, 1.0, -1.0, 0.5, 2.5)


def written(t: Trace, value: Scalar) -> str:
    """A value as it is written down, by the trace's own lines."""
    if not isinstance(value, Value):
        return f"{value:g}"
    node = t.node(value.index)
    if node.op == "constant":
        return f"{node.constant:g}"
    args = [written(t, Value(t, i)) for i in node.args]
    return f"{node.op}({', '.join(args)})" if args else node.name


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        (lambda x, y: x + 0.0, "x"),
        (lambda x, y: 0.0 + x, "x"),
        (lambda x, y: 2.0 + x, "add(x, 2)"),
        (lambda x, y: x + (-y), "sub(x, y)"),
        (lambda x, y: (-y) + x, "sub(x, y)"),
        (lambda x, y: (-x) + (-y), "neg(add(x, y))"),
        (lambda x, y: x - 0.0, "x"),
        (lambda x, y: 0.0 - x, "neg(x)"),
        (lambda x, y: 2.0 - x, "sub(2, x)"),
        (lambda x, y: x - x, "0"),
        (lambda x, y: x - (-y), "add(x, y)"),
        (lambda x, y: (-x) - y, "neg(add(x, y))"),
        (lambda x, y: (-x) - (-y), "sub(y, x)"),
        (lambda x, y: x * 0.0, "0"),
        (lambda x, y: 1.0 * x, "x"),
        (lambda x, y: x * -1.0, "neg(x)"),
        (lambda x, y: (-x) * y, "neg(mul(x, y))"),
        (lambda x, y: x * (-y), "neg(mul(x, y))"),
        (lambda x, y: (-x) * (-y), "mul(x, y)"),
        (lambda x, y: y * x, "mul(x, y)"),
        (lambda x, y: 2.0 * x, "mul(x, 2)"),
        (lambda x, y: x / 1.0, "x"),
        (lambda x, y: x / 4.0, "mul(x, 0.25)"),
        (lambda x, y: 0.0 / x, "0"),
        (lambda x, y: x / x, "1"),
        (lambda x, y: x / y, "div(x, y)"),
        (lambda x, y: 1.0 / x, "div(1, x)"),
        (lambda x, y: -(x * -1.0), "x"),
        (lambda x, y: trace.power(x, 0), "1"),
        (lambda x, y: trace.power(x, 1), "x"),
        (lambda x, y: trace.power(x, 2), "mul(x, x)"),
        (lambda x, y: trace.power(x, 3), "mul(x, mul(x, x))"),
        (lambda x, y: trace.power(x, -2), "div(1, mul(x, x))"),
        (lambda x, y: trace.power(x, 0.5), "sqrt(x)"),
        (lambda x, y: trace.power(x, 8), "mul(mul(mul(x, x), mul(x, x)), mul(mul(x, x), mul(x, x)))"),
        (lambda x, y: trace.power(x, 9), "pow(x, 9)"),
        (lambda x, y: trace.power(x, 2.5), "pow(x, 2.5)"),
        (lambda x, y: trace.power(2.0, x), "pow(2, x)"),
        (lambda x, y: trace.lookup("way", x, 3), "way"),
        (lambda x, y: trace.lookup("way", x, 4), "0"),
        (lambda x, y: trace.select(x < y, y, x), "select(less(x, y), y, x)"),
        (trace.maximum, "select(less(x, y), y, x)"),
        (trace.minimum, "select(less(y, x), y, x)"),
        (lambda x, y: x >= y, "less_equal(y, x)"),
        (lambda x, y: x > y, "less(y, x)"),
        (lambda x, y: ~(x <= y), "not(less_equal(x, y))"),
        (lambda x, y: (y < x) & (x < y), "and(less(y, x), less(x, y))"),
        (lambda x, y: (x < y) | (y < x), "or(less(x, y), less(y, x))"),
    ],
)
def test_formulas_are_written_in_their_shortest_form(formula: Callable[[Scalar, Scalar], Any], expected: str) -> None:
    t = Trace()
    x, y = t.position("x"), t.position("y")
    found = formula(x, y)
    said = written(t, found)
    assert said == (expected if expected != "way" else "lookup(x)")
    before = len(t.lines)
    assert formula(x, y) == found and len(t.lines) == before


def test_a_line_varies_if_one_of_its_arguments_does() -> None:
    t = Trace()
    a, x, f = t.parameter("a"), t.position("x"), t.field_input("f")
    for value, varies in (
        (a + 1.0, False),
        (a + x, True),
        (x * a, True),
        (-a, False),
        (-x, True),
        (a * f, True),
        (t.select(a < 1.0, a, 2.0), False),
        (t.select(a < 1.0, a, x), True),
        (t.lookup("way", a), False),
        (t.lookup("way", x), True),
        (f, True),
    ):
        assert isinstance(value, Value)
        assert bool(t.node(value.index).varies) is varies


@pytest.mark.parametrize(("a", "b"), list(pairs(ONES, (*ONES, math.inf))))
def test_known_numbers_are_computed_at_once_as_unknown_ones_later(a: float, b: float) -> None:
    t = Trace()
    x, y = t.position("x"), t.position("y")
    rows: dict[str, tuple[Any, Any]] = {
        "sum": (t.add(a, b), x + y),
        "difference": (t.sub(a, b), x - y),
        "product": (t.mul(a, b), x * y),
        "least": (trace.minimum(a, b), trace.minimum(x, y)),
        "most": (trace.maximum(a, b), trace.maximum(x, y)),
        "sign": (trace.sign(a), trace.sign(x)),
        "size": (trace.absolute(a), trace.absolute(x)),
        "less": (t.compare("less", a, b), x < y),
        "equal": (t.compare("less_equal", a, b), x <= y),
        "mixed": (t.sub(a, b), a - y),
        "mixed too": (t.mul(a, b), x * b),
        "third": (t.add(a, b), x + b),
    }
    if b:
        rows |= {"quotient": (t.div(a, b), x / y), "share": (t.div(a, b), x / b), "part": (t.div(a, b), a / y)}
    with np.errstate(invalid="ignore"):
        program = Program.of(t, {name: value for name, (_, value) in rows.items()})
        later = NumpyProgram(program).run([], {"x": np.array([a]), "y": np.array([b])}, length=1)[:, 0]
    for (name, (known, _)), value in zip(rows.items(), later, strict=True):
        if name in ("product", "mixed too") and 0.0 in (a, b):
            assert known == 0.0  # a zero that is known stays one
        elif not math.isnan(value):
            assert float(known) == value, name


def test_angles_are_brought_next_to_each_other() -> None:
    for angle, reference in pairs((-9.0, 0.3, 3.0, 40.0), (-20.0, 0.0, 3.3, 100.0)):
        near = trace.nearest_turn(angle, reference)
        assert abs(near - reference) <= math.pi + 1e-12
        assert math.remainder(near - angle, math.tau) == pytest.approx(0.0, abs=1e-12)


MATRICES = [np.random.default_rng(k).uniform(-2.0, 2.0, (n, n)) for k, n in enumerate((1, 2, 3, 3, 4, 5))]
MATRICES += [np.array([[0.0, 2.0, 0.0], [0.0, 0.0, 3.0], [4.0, 0.0, 0.0]]), np.eye(4)[[2, 0, 3, 1]] * 3.0]
MATRICES += [np.array([[0.0, 1.0, 2.0, 0.0], [3.0, 0.0, 0.0, 1.0], [0.0, 4.0, 0.0, 1.0], [1.0, 0.0, 5.0, 2.0]])]


@pytest.mark.parametrize("matrix", MATRICES)
@pytest.mark.parametrize("traced", [False, True])
def test_small_matrices_are_inverted_as_numpy_inverts_them(matrix: Any, traced: bool) -> None:
    """As plain numbers, whose zeros are known, and as values of a design."""
    n = len(matrix)
    t = Trace()
    entries: list[list[Scalar]] = [
        [t.parameter(f"m{i}{j}") if traced else float(matrix[i, j]) for j in range(n)] for i in range(n)
    ]
    ways = {"inverse": linear.inverse(entries)}
    if n == 2:
        ways["by determinant"] = linear.inverse(entries, trace.reciprocal(linear.determinant(entries)))
    numbers = {f"m{i}{j}": float(matrix[i, j]) for i in range(n) for j in range(n)}
    for inverse in ways.values():
        product = [linear.product(inverse, column) for column in linear.transposed(entries)]
        found = computed(t, [*chain(*inverse), linear.determinant(entries), *chain(*product)], numbers)
        assert np.reshape(found[: n * n], (n, n)) == pytest.approx(np.linalg.inv(matrix), rel=1e-11, abs=1e-12)
        assert found[n * n] == pytest.approx(np.linalg.det(matrix), rel=1e-12)
        assert np.reshape(found[n * n + 1 :], (n, n)) == pytest.approx(np.eye(n), abs=1e-13)


def computed(t: Trace, values: Iterable[Scalar], numbers: Mapping[str, float]) -> list[float]:
    program = Program.of(t, {f"v{k}": value for k, value in enumerate(values)})
    given = [numbers[name] for name in program.parameters]
    return [float(row[0]) for row in NumpyProgram(program).run(given, {}, length=1)]


def test_a_matrix_without_rows_and_singular_ones() -> None:
    assert linear.inverse([]) == [] and linear.determinant([]) == 1.0
    assert linear.inverse([[0.0]]) == [[math.inf]]
    singular: list[list[Scalar]] = [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [1.0, 0.0, 1.0]]
    assert not np.isfinite(np.array(linear.inverse(singular), float)).all()


@pytest.mark.parametrize("traced", [False, True])
def test_vectors_are_complex_numbers(traced: bool) -> None:
    a, b, s = 3.0 - 2.0j, -1.5 + 0.5j, 0.7
    t = Trace()
    parts = {"ax": a.real, "ay": a.imag, "bx": b.real, "by": b.imag}
    ax, ay, bx, by = (t.parameter(name) if traced else value for name, value in parts.items())
    u, v = Vec(ax, ay), Vec(bx, by)
    real = Vec(ax, 0.0)
    expected: dict[str, tuple[Vec, complex]] = {
        "sum": (u + v, a + b),
        "difference": (u - v, a - b),
        "negative": (-u, -a),
        "multiple": (u * s, a * s),
        "times": (s * u, a * s),
        "perpendicular": (u.perp, 1j * a),
        "mirrored": (u.conjugate, a.conjugate()),
        "product": (u.turn(v), a * b),
        "quotient": (u.over(v), a / b),
        "by a real one": (v.over(real), b / a.real),
        "scalar": (Vec(u.dot(v), u.cross(v)), a.conjugate() * b),
        "square": (Vec(u.square, 0.0), abs(a) ** 2),
        "first": (choose(u.x > v.x, u, v), a),
        "second": (choose(u.x < v.x, u, v), b),
    }
    rows = [part for each, _ in expected.values() for part in (each.x, each.y)]
    found = np.reshape(computed(t, rows, parts), (-1, 2)) @ [1.0, 1j]
    assert found == pytest.approx([value for _, value in expected.values()], rel=1e-15)
    assert u.over(u) == Vec(1.0, 0.0)
    assert Vec(2.0, -3.0).over(Vec(0.0, 0.0)) == Vec(math.inf, -math.inf)


@pytest.mark.parametrize("seed", range(6))
def test_no_value_is_written_over_before_its_last_use(seed: int) -> None:
    """Every line is followed through the buffers that it is read from."""
    lines = Lines.of(random_program(seed)[0])
    registers = Registers.of(lines)
    held: dict[tuple[str, int], int] = {}
    working = [i for i, line in enumerate(lines.lines) if line.varies and line.is_operation]
    for index in every(working, least=5):
        line = lines.lines[index]
        for arg in line.args:
            assert arg not in registers.places or held[registers.places[arg]] == arg
        place = registers.places[index]
        if line.op == "select":  # its target is filled with the last argument first
            later = [registers.places.get(arg) for arg in line.args[:2] if arg != line.args[2]]
            assert place not in later
        held[place] = index
    rows = {number: index for index, (kind, number) in registers.places.items() if kind == ROW}
    rows |= dict(registers.copies)
    assert [rows[row] for row in range(len(lines.outputs))] == list(lines.outputs)
    for index in lines.outputs:
        assert index not in registers.places or held[registers.places[index]] == index
    for kind, count in ((NUMBER, registers.numbers), (TRUTH, registers.truths)):
        used = {number for name, number in registers.places.values() if name == kind}
        assert used == set(range(count))


def test_a_chain_of_sums_needs_one_buffer() -> None:
    t = Trace()
    x = t.position("x")
    value: Scalar = x
    for k in range(1, 30):
        value = value * x + float(k)
    registers = Registers.of(Lines.of(Program.of(t, {"value": value, "again": value, "x": x})))
    assert (registers.numbers, registers.truths) == (1, 0)
    assert [row for row, _ in registers.copies] == [1, 2]


def test_inputs_become_fields_and_parameters_positions() -> None:
    plain = random_program(3)[0]
    first, *rest = plain.parameters
    given = plain.with_inputs([first])
    assert given.parameters == tuple(rest) and {*given.fields} == {first, *plain.fields}
    assert first in plain.with_inputs([first], "position").positions
    lanes = across_designs(plain)
    assert lanes.parameters == () and set(plain.parameters) <= set(lanes.positions)
    again = Replay(plain)
    copy = Program.of(again.trace, again.outputs)
    assert (copy.counts(), copy.output_names) == (plain.counts(), plain.output_names)


def test_a_program_says_what_it_does() -> None:
    t = Trace()
    a, x = t.parameter("a"), t.position("x")
    program = Program.of(
        t, {"y": a * a + t.lookup("way", x, 2), "low": (x < a) & ~(a <= x), "s": t.field_input("s") - 1.5}
    )
    assert program.text().splitlines() == [
        "v0 = parameter a",
        "v1 = position x",
        "v2 = v0 * v0",
        "v3 = lookup[way, 2](v1)",
        "v4 = v2 + v3",
        "v5 = v1 < v0",
        "v6 = v0 <= v1",
        "v7 = not(v6)",
        "v8 = v5 & v7",
        "v9 = field s",
        "v10 = 1.5",
        "v11 = v9 - v10",
        "output y = v4",
        "output low = v8",
        "output s = v11",
    ]
    assert program.counts() == {
        "design": {"mul": 1},
        "position": {"add": 1, "and": 1, "less": 1, "less_equal": 1, "lookup": 1, "not": 1, "sub": 1},
    }
    part = program.only(["low"])
    assert (part.output_names, part.tables, part.fields) == (("low",), (), ())
    assert len(program.key) == 32 and program.key != part.key
    assert [program.yields_truth(i) for _, i in program.outputs] == [False, True, False]


REALS = (
    "load",
    "store",
    "invoke",
    "ramp",
    "spread",
    "total",
    "smallest",
    "minimum",
    "maximum",
    "root",
    "marked",
    "mark_of",
)
COMPLEX = ("fetch", "put", "inverse", "square", "choose")


@pytest.mark.parametrize("name", REALS + COMPLEX)
def test_functions_of_kernels_do_nothing_outside_of_one(name: str) -> None:
    function = getattr(kernel, name)
    with pytest.raises(NotImplementedError):
        function(*[None] * function.__code__.co_argcount)


def test_numbers_of_kernels_are_none_outside_of_one() -> None:
    for address in (kernel.Reals(), kernel.Wholes()):
        for use in (lambda a: a + 1, lambda a: a[0], lambda a: a.__setitem__(0, 1)):
            with pytest.raises(NotImplementedError):
                use(address)
    for number in (kernel.Vector(), kernel.Complex()):
        for combine in (lambda v: v + 1.0, lambda v: 2.0 * v, lambda v: -v):
            with pytest.raises(NotImplementedError):
                combine(number)

"""Expressions: values against Python's own arithmetic, derivatives against differences, refusals."""

import math

import numpy as np
import pytest
from tests.refusals import refused

from linkwright import units
from linkwright.core.expressions import parse, parse_any, parse_quantity
from linkwright.errors import QuantityError

LENGTH, TIME, NONE = units.DIMENSIONS["length"], units.DIMENSIONS["time"], units.NONE
KINDS = {"l2": LENGTH, "t": TIME, "k": NONE, "m": LENGTH, "g": units.DIMENSIONS["acceleration"]}
VALUES = {"l2": 1.25, "t": 0.7, "k": 3.0, "m": 2.0, "g": 9.81}


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("l2/2 + 3 mm", "length", 1.25 / 2 + 0.003),
        ("2*l2", "length", 2.5),
        ("-l2^2", "area", -(1.25**2)),
        ("2^3^2*l2", "length", 512 * 1.25),
        ("l2²", "area", 1.25**2),
        ("sqrt(l2^2 + (3 m)^2)", "length", math.hypot(1.25, 3)),
        ("30 deg*sin(2*pi*t/(2 s))", "angle", math.pi / 6 * math.sin(math.pi * 0.7)),
        ("40 mm*sin(4*pi*t/(1 s) + 20 deg)", "length", 0.04 * math.sin(4 * math.pi * 0.7 + math.pi / 9)),
        ("atan2(l2, 2 m)", "angle", math.atan2(1.25, 2)),
        ("max(l2, 2 m) - min(l2, 2 m)", "length", 0.75),
        ("5 m/s*t", "length", 3.5),
        ("100 N/m*l2", "force", 125.0),
        ("2 m / m", "dimensionless", 1.0),
        ("m/2", "length", 1.0),
        ("-g", "acceleration", -9.81),
        ("10 m - 4 m - 3 m", "length", 3.0),
        ("8 m/2/2", "length", 2.0),
        ("step(t - 1 s) + step(1 s - t)", "dimensionless", 1.0),
    ],
)
def test_an_expression_has_the_value_of_its_arithmetic(text: str, dimension: str, value: float) -> None:
    found = parse_quantity(text, dimension, KINDS)
    result = found if isinstance(found, float) else found.evaluate(VALUES)
    assert result == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "dimension", "column", "code", "values"),
    [
        ("2*(l2 + 1 m", "length", 2, "expression", {}),
        ("l2 +", "length", 4, "expression", {"token": ""}),
        ("l2 + 2", "length", 3, "wrong-dimension", {}),
        ("l3*2", "length", 0, "unknown-name", {"name": "l3", "offer": "l2"}),
        ("2 l2", "length", 2, "expression", {"token": "2", "name": "l2"}),
        ("sin(l2)*l2", "length", 0, "wrong-dimension", {"function": "sin"}),
        ("l2*sinn(30 deg)", "length", 3, "unknown-name", {"name": "sinn", "offer": "sin"}),
        ("l2 $ 2", "length", 3, "expression", {"text": "$"}),
        ("5 N*m", "torque", 4, "ambiguous", {"name": "m"}),
        ("pi/4", "angle", 0, "missing-unit", {"text": "pi/4"}),
        ("l2*l2", "length", 0, "wrong-dimension", {"text": "l2*l2", "example": "60.5 mm"}),
        ("max(l2)", "length", 0, "expression", {"name": "max", "needed": 2, "count": 1}),
    ],
)
def test_a_wrong_expression_is_refused_with_its_column(
    text: str, dimension: str, column: int, code: str, values: dict[str, object]
) -> None:
    with refused(code, QuantityError, **values) as caught:
        parse_quantity(text, dimension, KINDS)
    assert caught.value.column == column


D = units.DIMENSIONS
#: Parameters by name: what they are, and their values in SI.
PARAMETERS = {
    "r": ("length", 2.0),
    "phi": ("angle", 3.0),
    "w": ("angular_velocity", 5.0),
    "f": ("frequency", 7.0),
    "T": ("time", 11.0),
    "M": ("torque", 13.0),
    "k": ("torsional_stiffness", 17.0),
    "c": ("stiffness", 19.0),
    "mass": ("mass", 23.0),
    "v": ("velocity", 29.0),
    "G": ("pressure", 31.0),
    "J": ("second_moment_of_area", 37.0),
    "g": ("acceleration", 9.81),
    "n": ("dimensionless", 41.0),
    "t": ("time", 47.0),
    "h": ("time", 53.0),
}
TURN = 2 * math.pi


def read(text: str, dimension: str) -> float:
    found = parse_quantity(text, dimension, {name: D[kind] for name, (kind, _) in PARAMETERS.items()})
    if isinstance(found, float):
        return found
    return found.evaluate({name: value for name, (_, value) in PARAMETERS.items()})


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("3 kW/(90 rpm)", "torque", 3000 / (90 * TURN / 60)),
        ("1.5 rad*40 mm", "length", 0.06),
        ("84 GPa*1e-6 m^4/(1.5 m)", "torsional_stiffness", 56e3),
        ("G*J/r", "torsional_stiffness", 31 * 37 / 2),
        ("r*phi + 3 mm", "length", 6.003),
        ("k*phi + M", "torque", 64.0),
        ("v/r", "angular_velocity", 14.5),
        ("v/r + w", "angular_velocity", 19.5),
        ("sqrt(c/mass)", "angular_velocity", math.sqrt(19 / 23)),
        ("2*pi*f", "angular_velocity", TURN * 7),
        ("2*pi/T", "angular_velocity", TURN / 11),
        ("f*rev", "angular_velocity", TURN * 7),
        ("(10 Hz)*rev", "angular_velocity", TURN * 10),
        ("13 rad/s", "frequency", 13 / TURN),
        ("90 rpm", "frequency", 1.5),
        ("2*w", "frequency", 10 / TURN),
        ("sqrt(c/mass)*rad", "frequency", math.sqrt(19 / 23) / TURN),
        ("v/r*rev", "frequency", 14.5),
        ("1/T", "frequency", 1 / 11),
        ("2*f", "frequency", 14.0),
    ],
)
def test_a_radian_is_no_unit_of_a_product_and_cycles_are_turns(text: str, dimension: str, value: float) -> None:
    assert read(text, dimension) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "dimension", "code", "write"),
    [
        ("f", "angular_velocity", "ambiguous", "(f)*rev"),
        ("2*f", "angular_velocity", "ambiguous", "(2*f)*rev"),
        ("1/T", "angular_velocity", "ambiguous", "(1/T)*rad"),
        ("10 Hz", "angular_velocity", "wrong-dimension", "170 rpm"),
        ("sqrt(c/mass)", "frequency", "ambiguous", "(sqrt(c/mass))*rad"),
        ("2*pi*f", "frequency", "ambiguous", "(2*pi*f)*rev"),
        ("f + w", "angular_velocity", "wrong-dimension", ""),
        ("M", "torsional_stiffness", "wrong-dimension", "2.5 N·m/rad"),
        ("2*k", "torque", "wrong-dimension", "2.5 N·m"),
        ("k + M", "torque", "wrong-dimension", ""),
        ("5 N·m", "torsional_stiffness", "wrong-dimension", "2.5 N·m/rad"),
        ("5 N·m/rad", "torque", "wrong-dimension", "2.5 N·m"),
    ],
)
def test_where_a_radian_may_be_a_slip_the_text_has_to_say_it(
    text: str, dimension: str, code: str, write: str
) -> None:
    with refused(code, QuantityError) as caught:
        read(text, dimension)
    assert not write or f'"{write}"' in caught.value.remedy


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("pi/6 rad", "angle", math.pi / 6),
        ("-pi/2 rad", "angle", -math.pi / 2),
        ("2*pi rad", "angle", TURN),
        ("2*pi rad/s", "angular_velocity", TURN),
        ("sqrt(2) m", "length", math.sqrt(2)),
        ("(1 + sqrt(5))/2 mm", "length", (1 + math.sqrt(5)) / 2000),
        ("1/3 rad", "angle", 1 / 3),
        ("1/3 rad", "per_angle", 1 / 3),
        ("2/3 m", "length", 2 / 3),
        ("n/3 deg", "angle", math.radians(41 / 3)),
        ("2^3 mm", "length", 0.008),
        ("1/2 s", "time", 0.5),
        ("1/4 s", "frequency", 0.25),
    ],
)
def test_a_unit_behind_factors_is_that_of_all_where_it_fits(text: str, dimension: str, value: float) -> None:
    assert read(text, dimension) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize("text", ["1/2 m", "pi/6 rad", "n/3 s"])
def test_a_parameter_that_can_be_read_in_two_ways_is_refused_with_both(text: str) -> None:
    number, unit = text.split()
    first, last = number.split("/")
    with refused("ambiguous", QuantityError, quantity=f"({number})*{unit}", tight=f"{first}/({last} {unit})"):
        parse_any(text, {"n": NONE})


@pytest.mark.parametrize(
    ("text", "dimension", "name"),
    [("30 N/g", "mass", "g"), ("3 m/h", "velocity", "h"), ("2*30 N/g", "mass", "g"), ("3 t", "time", "t")],
)
def test_a_name_that_is_a_unit_and_a_parameter_is_not_guessed(text: str, dimension: str, name: str) -> None:
    with refused("ambiguous", QuantityError, name=name):
        read(text, dimension)


def test_a_unit_of_the_name_of_a_parameter_is_one_where_only_it_fits() -> None:
    """And in parentheses, or before an operator, the name is the parameter."""
    assert read("5 g", "mass") == 0.005
    assert read("30 N/(1 g)", "acceleration") == pytest.approx(30e3)
    assert read("30 N/(g)", "mass") == pytest.approx(30 / 9.81)
    assert read("t*3", "time") == 141.0
    assert read("3 t", "mass") == 3000.0


def test_the_text_of_an_error_has_a_caret_under_the_place() -> None:
    with pytest.raises(QuantityError) as caught:
        parse("2*(t + 1", ["t"])
    assert str(caught.value).splitlines()[1:] == ["  2*(t + 1", "    ^"]


@pytest.mark.parametrize(
    "text",
    [
        "(" * 5000,
        "-" * 900 + "t",
        "t" + "+t" * 499,
        "1" * 900,
        "__import__('os').system('ls')",
        "t.__class__",
        "lambda: 0",
        "[t for t in t]",
        "t if t else t",
        "'a'*9",
        "9^9^9^9^9*t/(1 s)",
    ],
)
def test_nothing_but_an_answer_or_a_clear_refusal_comes_of_any_text(text: str) -> None:
    try:
        result = parse(text, ["t"]).evaluate({"t": 0.5})
    except QuantityError:
        result = 0.0
    assert math.isfinite(result)


@pytest.mark.parametrize("value", ["1/k0", "sqrt(-k1)", "log(k0)", "exp(1000*k1)"])
def test_a_value_that_does_not_exist_is_refused(value: str) -> None:
    expression = parse(value, ["k0", "k1"])
    with refused("not-finite", QuantityError, text=value):
        expression.evaluate({"k0": 0.0, "k1": 1.0})


SMOOTH = [
    "sin(t)*t^2",
    "exp(-t)*cos(3*t)",
    "atan2(t, 2)",
    "sqrt(1 + t*t)",
    "t^t",
    "max(t, 0.3)*2 + min(t, 2*t)",
    "log(t)/t",
    "tan(t)",
    "asin(t/2) + acos(t/3) + atan(t)",
    "abs(-t)",
    "2^-t",
    "t^-2",
    "t^0.5",
    "sign(t) + step(t)",
    "-t^3",
]


@pytest.mark.parametrize("text", SMOOTH)
def test_derivatives_agree_with_differences(text: str) -> None:
    expression = parse(text, ["t"])
    h = 1e-5
    places = {"t": np.array([0.7 - h, 0.7, 0.7 + h])}
    first, second = expression.derivatives(places, "t", 2)
    for of, slope in ((expression.over(places), first), (first, second)):
        difference = (np.broadcast_to(of, 3)[2] - np.broadcast_to(of, 3)[0]) / (2 * h)
        assert slope[1] == pytest.approx(difference, rel=1e-7, abs=1e-9)


@pytest.mark.parametrize(
    ("text", "slope"),
    [
        ("abs(t)", 0.0),
        ("max(t, 2*t)", 1.0),
        ("max(2*t, t)", 2.0),
        ("min(t, 2*t)", 1.0),
        ("sign(t) + step(t)", 0.0),
        ("k", 0.0),
        ("3", 0.0),
        ("1/(t - t)", math.nan),
        ("sqrt(t)", math.inf),
        ("k^t", math.log(3.0)),
        ("t^k", 0.0),
    ],
)
def test_derivatives_at_kinks_and_where_there_is_none(text: str, slope: float) -> None:
    given = {"t": np.zeros((2, 1)), "k": 3.0}
    (found,) = parse(text, ["t", "k"]).derivatives(given, "t")
    assert found.shape == (2, 1)
    assert np.array_equal(found, np.full((2, 1), slope), equal_nan=True)


@pytest.mark.parametrize("text", SMOOTH)
def test_arrays_give_the_same_as_floats(text: str) -> None:
    expression = parse(text, ["t"])
    t = np.linspace(0.2, 0.9, 5)
    found = expression.over({"t": t})
    assert np.allclose(found, [expression.evaluate({"t": float(each)}) for each in t], rtol=1e-14, atol=0)

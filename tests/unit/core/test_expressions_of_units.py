"""Units with powers and quotients in expressions."""

import math

import pytest
from tests.refusals import refused

from linkwright import units
from linkwright.core.expressions import amount, parse_quantity
from linkwright.errors import QuantityError

LENGTH, FORCE, NONE = units.DIMENSIONS["length"], units.DIMENSIONS["force"], units.NONE


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("3 N/mm*k", "stiffness", 6000.0),
        ("k*3 N/mm", "stiffness", 6000.0),
        ("(3 N/mm)*x", "force", 1500.0),
        ("x*(3 N/mm) + 1 kN", "force", 2500.0),
        ("-(3 N/mm)*x", "force", -1500.0),
        ("2 mm²*k", "area", 4e-6),
        ("2 mm^2*k", "area", 4e-6),
        ("2 mm**2*k", "area", 4e-6),
        ("(2 mm)^2*k", "area", 8e-6),
        ("x^2", "area", 0.25),
        ("x²·k", "area", 0.5),
        ("k*2 kg·m²", "inertia", 8.0 / 2),
        ("k*2 kg*m^2", "inertia", 4.0),
        ("3 mm³/(1 mm)*k", "area", 6e-6),
        ("k*5 N·mm", "torque", 0.01),
        ("k*5 N·m/rad", "torsional_stiffness", 10.0),
        ("5 MPa*x^2", "force", 1.25e6),
        ("sqrt(4 mm²)*k", "length", 4e-3),
        ("k*3 m·s⁻²", "acceleration", 6.0),
        ("k*3 m/s^2", "acceleration", 6.0),
        ("k*60 rev/min", "angular_velocity", 4 * math.pi),
        ("k*60 r/min", "angular_velocity", 4 * math.pi),
    ],
)
def test_units_with_powers_and_quotients(text: str, dimension: str, value: float) -> None:
    found = parse_quantity(text, dimension, {"x": LENGTH, "k": NONE})
    assert not isinstance(found, float)
    assert found.evaluate({"x": 0.5, "k": 2.0}) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize("text", ["3 N/mm*x*x", "3 N/mm^2*x", "3 N*mm*x", "x^2*3 N/mm"])
def test_a_power_too_much_is_refused(text: str) -> None:
    with refused("wrong-dimension", QuantityError, text=text, example="2.5 N"):
        parse_quantity(text, "force", {"x": LENGTH})


@pytest.mark.parametrize(
    ("text", "value"),
    [("1e3 mm", 1.0), ("+2 m", 2.0), (".5m", 0.5), ("5.mm", 0.005), ("-2 m", -2.0), ("- 2 m", -2.0)],
)
def test_the_usual_form_is_read_with_its_sign(text: str, value: float) -> None:
    assert amount(text, "length") == pytest.approx(value, rel=1e-15)

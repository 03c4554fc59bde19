"""Units: values by their definitions (SI brochure, yard and pound), and what is refused."""

import math

import pytest

from linkwright import units
from linkwright.errors import QuantityError


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("460 rpm", "angular_velocity", 460 * 2 * math.pi / 60),
        ("460 r/min", "angular_velocity", 460 * 2 * math.pi / 60),
        ("2 rev/s", "angular_velocity", 4 * math.pi),
        ("1 in", "length", 0.0254),
        ("1 ft", "length", 0.3048),
        ("1 lb", "mass", 0.45359237),
        ("1 t", "mass", 1000.0),
        ("25.5 kg·m²", "inertia", 25.5),
        ("25.5 kg*m^2", "inertia", 25.5),
        ("25.5 kg⋅m**2", "inertia", 25.5),
        ("-9.81 m/s²", "acceleration", -9.81),
        ("−9.81 m·s⁻²", "acceleration", -9.81),
        ("30°", "angle", math.pi / 6),
        ("36 km/h", "velocity", 10.0),
        ("3 N/mm", "stiffness", 3000.0),
        ("2 N·m·s/rad", "torsional_damping", 2.0),
        ("1 bar", "pressure", 1e5),
        ("60mm", "length", 0.06),
        ("1\u00a0mm", "length", 0.001),
        (".5 m", "length", 0.5),
        ("1e3 mm", "length", 1.0),
        ("0", "length", 0.0),
        ("0.1", "dimensionless", 0.1),
    ],
)
def test_a_text_gives_its_si_value(text: str, dimension: str, value: float) -> None:
    assert units.parse(text, dimension) == pytest.approx(value, rel=1e-15, abs=0)


@pytest.mark.parametrize(
    ("units_", "dimension", "values"),
    [
        ("m mm cm dm km µm μm um", "length", [1.0, 1e-3, 1e-2, 0.1, 1e3, 1e-6, 1e-6, 1e-6]),
        ("s ms min h", "time", [1.0, 1e-3, 60.0, 3600.0]),
        ("kg g t lb", "mass", [1.0, 1e-3, 1e3, 0.45359237]),
        ("N mN kN MN lbf kg·m/s²", "force", [1.0, 1e-3, 1e3, 1e6, 0.45359237 * 9.80665, 1.0]),
        ("W kW J/s kJ/h", "power", [1.0, 1e3, 1.0, 1.0 / 3.6]),
        ("Pa kPa MPa GPa bar N/mm²", "pressure", [1.0, 1e3, 1e6, 1e9, 1e5, 1e6]),
        ("rad mrad deg ° rev", "angle", [1.0, 1e-3, math.pi / 180, math.pi / 180, 2 * math.pi]),
        ("J N·m kJ", "torque", [1.0, 1.0, 1e3]),
        ("Hz 1/s", "frequency", [1.0, 1.0]),
    ],
)
def test_every_unit_by_its_definition(units_: str, dimension: str, values: list[float]) -> None:
    found = [units.parse(f"2 {unit}", dimension) / 2 for unit in units_.split()]
    assert found == pytest.approx(values, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "dimension", "code", "words"),
    [
        ("60,5 mm", "length", "decimal-comma", '"60.5 mm"'),
        ("60", "length", "missing-unit", '"60 mm"'),
        ("60 kg", "length", "wrong-dimension", "a mass"),
        ("460 rmp", "angular_velocity", "unknown-unit", '"rpm"'),
        ("5 Nm", "torque", "unknown-unit", '"N·m"'),
        ("5 N-m", "torque", "unknown-unit", '"N·m"'),
        ("5 N.m", "torque", "unknown-unit", '"N·m"'),
        ("5 KN", "force", "unknown-unit", '"kN"'),
        ("5 kgm2", "inertia", "unknown-unit", '"kg·m²"'),
        ("5 N·m", "torsional_stiffness", "wrong-dimension", "N·m/rad"),
        ("5 Hz", "angular_velocity", "wrong-dimension", "rpm"),
        ("nan m", "length", "not-finite", "finite"),
        ("1e999 m", "length", "not-finite", "finite"),
        ("", "length", "quantity", "60.5 mm"),
        ("mm", "length", "quantity", "60.5 mm"),
        ("1 000 mm", "length", "quantity", '"1000 mm"'),
    ],
)
def test_what_is_not_a_quantity_is_refused_with_the_right_form(
    text: str, dimension: str, code: str, words: str
) -> None:
    with pytest.raises(QuantityError) as caught:
        units.parse(text, dimension)
    assert caught.value.code == code
    assert words in str(caught.value)


@pytest.mark.parametrize("dimension", sorted(units.DIMENSIONS))
@pytest.mark.parametrize("value", [0.1, -1 / 3, 1e-9, 123456.789])
def test_formatting_in_si_reads_back_to_the_last_bit(dimension: str, value: float) -> None:
    assert units.parse(units.format(value, dimension), dimension) == value


def test_formatting_in_a_chosen_unit() -> None:
    assert units.format(0.0605, "length", "mm") == "60.5 mm"
    with pytest.raises(QuantityError, match="mass"):
        units.format(1.0, "length", "kg")

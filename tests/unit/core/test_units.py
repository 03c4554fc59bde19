"""Units: values by their definitions (SI brochure, yard and pound), and what is refused."""

import math

import pytest
from tests.refusals import refused

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
        ("%", "dimensionless", [0.01]),
    ],
)
def test_every_unit_by_its_definition(units_: str, dimension: str, values: list[float]) -> None:
    found = [units.parse(f"2 {unit}", dimension) / 2 for unit in units_.split()]
    assert found == pytest.approx(values, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "dimension", "code", "values"),
    [
        ("60,5 mm", "length", "decimal-comma", {"right": "60.5 mm"}),
        ("60", "length", "missing-unit", {"right": "60 mm"}),
        ("60 kg", "length", "wrong-dimension", {"example": "60.5 mm"}),
        ("460 rmp", "angular_velocity", "unknown-unit", {"offer": "rpm"}),
        ("5 Nm", "torque", "unknown-unit", {"offer": "N·m"}),
        ("5 N-m", "torque", "unknown-unit", {"offer": "N·m"}),
        ("5 N.m", "torque", "unknown-unit", {"offer": "N·m"}),
        ("5 KN", "force", "unknown-unit", {"offer": "kN"}),
        ("5 kgm2", "inertia", "unknown-unit", {"offer": "kg·m²"}),
        ("5 N·m", "torsional_stiffness", "wrong-dimension", {"example": "2.5 N·m/rad"}),
        ("5 Hz", "angular_velocity", "wrong-dimension", {"example": "170 rpm"}),
        ("nan m", "length", "not-finite", {"example": "60.5 mm"}),
        ("1e999 m", "length", "not-finite", {"example": "60.5 mm"}),
        ("", "length", "quantity", {"example": "60.5 mm"}),
        ("mm", "length", "quantity", {"example": "60.5 mm"}),
        ("1 000 mm", "length", "quantity", {"digits": "1", "plain": "1 000 mm"}),
    ],
)
def test_what_is_not_a_quantity_is_refused_with_the_right_form(
    text: str, dimension: str, code: str, values: dict[str, str]
) -> None:
    with refused(code, QuantityError, **values):
        units.parse(text, dimension)


@pytest.mark.parametrize("dimension", sorted(units.DIMENSIONS))
@pytest.mark.parametrize("value", [0.1, -1 / 3, 1e-9, 123456.789])
def test_formatting_in_si_reads_back_to_the_last_bit(dimension: str, value: float) -> None:
    assert units.parse(units.format(value, dimension), dimension) == value


def test_formatting_in_a_chosen_unit() -> None:
    assert units.format(0.0605, "length", "mm") == "60.5 mm"
    with refused("wrong-dimension", QuantityError, text="kg", example="60.5 mm"):
        units.format(1.0, "length", "kg")


@pytest.mark.parametrize(
    ("text", "dimension", "column", "code", "values"),
    [
        ("5 N·mmx", "torque", 4, "unknown-unit", {"offer": "N·mm"}),
        ("2 km/hh", "velocity", 5, "unknown-unit", {"offer": "km/h"}),
        ("5 m s", "length", 4, "unknown-unit", {"offer": "ms"}),
        ("5 kg mm^2", "inertia", 5, "unknown-unit", {"offer": "kg·mm^2"}),
        ("5 r/h", "angular_velocity", 2, "unknown-unit", {"offer": "rev/h"}),
        ("5 kgm2/s", "inertia", 2, "unknown-unit", {"offer": "kg·m²/s"}),
        ("5 newton*metre", "torque", 2, "unknown-unit", {"offer": "N·m"}),
        ("5 kg·mm^2/sec2", "torque", 10, "unknown-unit", {"offer": "kg·mm^2/s^2"}),
        ("5 KN*mm", "torque", 2, "unknown-unit", {"offer": "kN·mm"}),
        ("5 U/min", "angular_velocity", 2, "unknown-unit", {"offer": "rpm"}),
        ("5 blob·in²", "inertia", 2, "unknown-unit", {"offer": "lbf·s²/in·in²"}),
        ("30 psi", "pressure", 3, "unknown-unit", {"offer": "lbf/in²"}),
        ("300 转/分", "angular_velocity", 4, "unknown-unit", {"offer": "rpm"}),
        ("5 牛·米", "torque", 2, "unknown-unit", {"offer": "N·m"}),
        ("100 lb", "force", 0, "wrong-dimension", {"right": "100 lbf"}),
        ("5 mm3", "volume", 4, "unknown-unit", {"offer": "mm³"}),
        ("5 m·", "length", 4, "unknown-unit", {"offer": "m"}),
        ("5 m//s", "velocity", 4, "unknown-unit", {"example": "2.5 m/s"}),
        ("5 qqqq·m", "torque", 2, "unknown-unit", {"example": "2.5 N·m"}),
        ("5 kg m", "mass", 5, "unknown-unit", {"offer": "kg"}),
        ("2 m^10", "area", 2, "quantity", {"digits": "10"}),
        ("2 m^-99999999999999999999999", "area", 2, "quantity", {"digits": "-9999999999999999999"}),
        ("60", "length", 0, "missing-unit", {"right": "60 mm"}),
        ("60", "torque", 0, "missing-unit", {"right": "60 N·m"}),
        ("3 mm", "dimensionless", 0, "wrong-dimension", {"example": "0.1"}),
        ("0 kg", "length", 0, "wrong-dimension", {"example": "60.5 mm"}),
        ("3 kg·m·rad", "time", 0, "wrong-dimension", {"example": "2.5 s"}),
        ("6, 5 mm", "length", 0, "decimal-comma", {"right": "6.5 mm"}),
        ("6 0 mm", "length", 0, "quantity", {"digits": "6", "plain": "6 0 mm"}),
        ("-.infinity", "mass", 0, "not-finite", {"example": "4.5 kg"}),
        ("infx", "angle", 0, "quantity", {"example": "30 deg"}),
    ],
)
def test_a_refusal_says_what_is_wrong_at_which_column_and_what_to_write(
    text: str, dimension: str, column: int, code: str, values: dict[str, str]
) -> None:
    with refused(code, QuantityError, **values) as caught:
        units.parse(text, dimension)
    assert caught.value.column == column
    assert not units.unit_fits(text, dimension)
    assert units.plain_quantity(text, dimension) is None


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("3 N/mm", "stiffness", 3000.0),
        ("-2.5e1 mm", "length", -0.025),
        ("2 1/rad", "per_angle", None),
        ("2 1/s", "frequency", None),
        ("60mm", "length", 0.06),
        ("2 mm", "mass", None),
        ("1e999 m", "length", None),
    ],
)
def test_a_plain_quantity_is_read_at_once_and_anything_else_looked_at_more_closely(
    text: str, dimension: str, value: float | None
) -> None:
    found = units.plain_quantity(text, dimension)
    assert found == (value if value is None else pytest.approx(value, rel=1e-15))
    assert units.unit_fits(text, dimension) == (text not in ("2 mm", "1e999 m"))


def test_largest_sizes_are_round_and_a_velocity_s_is_that_of_light() -> None:
    assert set(units.LARGEST) == set(units.DIMENSIONS)
    assert {name for name, value in units.LARGEST.items() if f"{value:.0e}"[0] != "1"} == {"velocity"}
    assert 299_792_458.0 <= units.LARGEST["velocity"] < 299_792_458.0 * 1.001
    assert units.LARGEST_OF_ALL == 1e24 and units.SMALLEST == 1e-12


@pytest.mark.parametrize(
    ("quantity", "factors"),
    [
        ("torque", "force length"),
        ("power", "force velocity"),
        ("area", "length length"),
        ("volume", "area length"),
        ("inertia", "mass area"),
        ("mass_moment", "mass length"),
        ("second_moment_of_area", "area area"),
        ("velocity", "length frequency"),
        ("acceleration", "velocity frequency"),
        ("force", "mass acceleration"),
        ("angular_velocity", "angle frequency"),
        ("angular_acceleration", "angular_velocity frequency"),
        ("length", "length_per_angle angle"),
        ("length_per_angle", "length_per_angle_squared angle"),
        ("dimensionless", "per_angle angle"),
        ("dimensionless", "time frequency"),
        ("force", "pressure area"),
        ("force", "stiffness length"),
        ("force", "damping velocity"),
        ("force", "line_load length"),
        ("torque", "torsional_stiffness angle"),
        ("torque", "torsional_damping angular_velocity"),
        ("mass", "density volume"),
        ("mass", "linear_density length"),
        ("power", "voltage current"),
        ("voltage", "resistance current"),
        ("torque", "torque_per_current current"),
    ],
)
def test_dimensions_multiply_as_their_definitions_say(quantity: str, factors: str) -> None:
    a, b = (units.DIMENSIONS[name] for name in factors.split())
    assert units.times(a, b) == units.DIMENSIONS[quantity]
    assert units.times(units.DIMENSIONS[quantity], b, -1) == a
    assert units.unit(units.SI_UNITS[factors.split(maxsplit=1)[0]] or "rad/rad") == (1.0, a)


@pytest.mark.parametrize(
    ("dimension", "symbol", "named"),
    [
        ((0.5, 0, 0, 0, 0), "m^0.5", False),
        ((1, 0, -1, 0, 1), "m·s^-1·rad", False),
        ((1, 1, 0, 0, 0), "kg·m", True),
        ((0, 0, 0, 0, 0), "", True),
    ],
)
def test_any_dimension_has_a_symbol_and_a_name(dimension: units.Dimension, symbol: str, named: bool) -> None:
    """What has no name of its own is named by its symbol."""
    name = units.name_of(dimension)
    assert units.si_symbol(dimension) == symbol
    assert name and name.endswith(f" {symbol}") is not named


def test_numbers_are_as_short_as_they_read_back_or_of_twelve_digits_in_a_chosen_unit() -> None:
    assert units.format(1 / 3e3, "length", "mm") == "0.333333333333 mm"
    assert [units.number(3.0), units.number(1e22), units.number(2 / 3, 3)] == ["3", "1e+22", "0.667"]
    assert units.format(2.0, "dimensionless") == "2"
    assert [units.exponent(text) for text in ("", "^2", "**-1", "⁻³", "^ 9", "^-9")] == [1, 2, -1, -3, 9, -9]


def test_a_unit_of_a_written_number_is_refused_from_its_own_first_column() -> None:
    with refused("unknown-unit", QuantityError, offer="mm") as caught:
        units.format(1.0, "length", "mm·")
    assert caught.value.column == 3
    assert units.unknown_unit("xyzzyq").column == 0

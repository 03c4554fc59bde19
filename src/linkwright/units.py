"""Units at the edge of the program: text to SI floats and back.

A unit is a factor to SI and a dimension, the exponents of (length, mass, time, current, angle); an angle is a
dimension of its own here, so that a torque (N·m) cannot pass for a torsional stiffness (N·m/rad).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from functools import cache, lru_cache

from linkwright.errors import QuantityError
from linkwright.registry import nearest
from linkwright.words import Message, _

Dimension = tuple[float, float, float, float, float]

NONE: Dimension = (0, 0, 0, 0, 0)
#: Dimensions by name: what a value of one is called, its powers, the SI unit, and a bound that no machine reaches, in
#: SI: beyond it is a mistake in a number or its unit, and squares of it stay finite.
_DIMENSIONS: Mapping[str, tuple[Message, Dimension, str, float]] = {
    "dimensionless": (_("a dimensionless number"), NONE, "", 1e12),
    "length": (_("a length"), (1, 0, 0, 0, 0), "m", 1e7),
    "angle": (_("an angle"), (0, 0, 0, 0, 1), "rad", 1e9),
    "time": (_("a time"), (0, 0, 1, 0, 0), "s", 1e10),
    "mass": (_("a mass"), (0, 1, 0, 0, 0), "kg", 1e12),
    "inertia": (_("an inertia"), (2, 1, 0, 0, 0), "kg·m²", 1e24),
    "velocity": (_("a velocity"), (1, 0, -1, 0, 0), "m/s", 3e8),
    "acceleration": (_("an acceleration"), (1, 0, -2, 0, 0), "m/s²", 1e12),
    "angular_velocity": (_("an angular velocity"), (0, 0, -1, 0, 1), "rad/s", 1e8),
    "angular_acceleration": (_("an angular acceleration"), (0, 0, -2, 0, 1), "rad/s²", 1e14),
    "frequency": (_("a frequency"), (0, 0, -1, 0, 0), "Hz", 1e9),
    "force": (_("a force"), (1, 1, -2, 0, 0), "N", 1e15),
    "torque": (_("a torque"), (2, 1, -2, 0, 0), "N·m", 1e18),
    "power": (_("a power"), (2, 1, -3, 0, 0), "W", 1e18),
    "pressure": (_("a pressure"), (-1, 1, -2, 0, 0), "Pa", 1e14),
    "area": (_("an area"), (2, 0, 0, 0, 0), "m²", 1e14),
    "volume": (_("a volume"), (3, 0, 0, 0, 0), "m³", 1e21),
    "density": (_("a density"), (-3, 1, 0, 0, 0), "kg/m³", 1e8),
    "stiffness": (_("a stiffness"), (0, 1, -2, 0, 0), "N/m", 1e18),
    "damping": (_("a damping"), (0, 1, -1, 0, 0), "N·s/m", 1e18),
    "torsional_stiffness": (_("a torsional stiffness"), (2, 1, -2, 0, -1), "N·m/rad", 1e21),
    "torsional_damping": (_("a torsional damping"), (2, 1, -1, 0, -1), "N·m·s/rad", 1e21),
    "second_moment_of_area": (_("a second moment of area"), (4, 0, 0, 0, 0), "m⁴", 1e12),
    "line_load": (_("a line load"), (0, 1, -2, 0, 0), "N/m", 1e15),
    "linear_density": (_("a linear density"), (-1, 1, 0, 0, 0), "kg/m", 1e12),
    "mass_moment": (_("a mass moment"), (1, 1, 0, 0, 0), "kg·m", 1e18),
    "length_per_angle": (_("a length per angle"), (1, 0, 0, 0, -1), "m/rad", 1e7),
    "length_per_angle_squared": (_("a length per angle squared"), (1, 0, 0, 0, -2), "m/rad²", 1e7),
    "current": (_("an electric current"), (0, 0, 0, 1, 0), "A", 1e9),
    "voltage": (_("a voltage"), (2, 1, -3, -1, 0), "V", 1e12),
    "resistance": (_("an electric resistance"), (2, 1, -3, -2, 0), "ohm", 1e12),
    "torque_per_current": (_("a torque per current"), (2, 1, -2, -1, 0), "N·m/A", 1e12),
    "per_angle": (_("a value per angle"), (0, 0, 0, 0, -1), "1/rad", 1e7),
}
NOUNS: Mapping[str, Message] = {name: each[0] for name, each in _DIMENSIONS.items()}
DIMENSIONS: Mapping[str, Dimension] = {name: each[1] for name, each in _DIMENSIONS.items()}
SI_UNITS: Mapping[str, str] = {name: each[2] for name, each in _DIMENSIONS.items()}
#: Dimensions of results that nobody gives, with their SI units.
FURTHER: Mapping[str, str] = {
    "energy": "J",
    "areal_velocity": "m²/s",
    "per_time": "1/s",
    "per_time_squared": "1/s²",
    "jerk": "m/s³",
    "angular_jerk": "rad/s³",
    "length_per_angle": "m/rad",
    "angle_per_length": "rad/m",
    "count": "",
}
#: Dimensions that only results of calculations have; empty for a plain number.
OF_CALCULATIONS: Mapping[str, str] = {
    "": "",
    "slope": "rad",
    "flexural_rigidity": "N·m²",
    "mass_radius": "kg·m",
    "section_area": "m²",
    "section_modulus": "m³",
    "power_of_drag": "kg/m",
    "length_per_angle_cubed": "m/rad³",
    "per_angle_squared": "1/rad²",
    "distance": "m",
}
_SI_OF_ALL: Mapping[str, str] = {**SI_UNITS, **FURTHER, **OF_CALCULATIONS}
LARGEST: Mapping[str, float] = {name: each[3] for name, each in _DIMENSIONS.items()}
#: For a quantity of any other dimension.
LARGEST_OF_ALL = max(LARGEST.values())
#: A size that must be above zero is not smaller in any machine, SI.
SMALLEST = 1e-12
USUAL_UNITS: Mapping[str, str] = {**SI_UNITS, "length": "mm", "angle": "deg", "angular_velocity": "rpm"}

#: Standard acceleration of free fall, m/s².
GRAVITY = 9.80665
#: Units by dimension, each with its factor to SI.
_UNIT_TABLE = """\
length: m 1, mm 1e-3, cm 1e-2, dm 1e-1, km 1e3, µm 1e-6, μm 1e-6, um 1e-6, in 0.0254, ft 0.3048
time: s 1, ms 1e-3, min 60, h 3600
mass: kg 1, g 1e-3, t 1e3, lb 0.45359237
force: N 1, mN 1e-3, kN 1e3, MN 1e6, lbf 4.4482216152605, kgf g0
torque: J 1, kJ 1e3
power: W 1, kW 1e3
pressure: Pa 1, kPa 1e3, MPa 1e6, GPa 1e9, bar 1e5
angle: rad 1, mrad 1e-3, deg π/180, ° π/180, rev 2π
angular_velocity: rpm 2π/60
frequency: Hz 1
dimensionless: % 1e-2
"""
_TURN = 2 * math.pi
_FACTORS = {"g0": GRAVITY, "π/180": math.pi / 180, "2π": _TURN, "2π/60": _TURN / 60}
#: Units of motors, which stand behind numbers only: elsewhere A and V are names of points, links and parameters.
_ELECTRICAL_TABLE = """\
current: A 1, mA 1e-3
voltage: V 1, mV 1e-3, kV 1e3
resistance: ohm 1, mohm 1e-3, kohm 1e3, Ω 1, mΩ 1e-3, kΩ 1e3
"""


def _factors(table: str) -> Mapping[str, tuple[float, Dimension]]:
    """Units of a table, each with its factor to SI and its dimension."""
    return {
        name: (_FACTORS.get(factor) or float(factor), DIMENSIONS[dimension])
        for dimension, _unused, row in (line.partition(": ") for line in table.splitlines())
        for name, factor in map(str.split, row.split(", "))
    }


UNITS = _factors(_UNIT_TABLE)
#: The units that a number may have.
BEHIND_NUMBERS: Mapping[str, tuple[float, Dimension]] = {**UNITS, **_factors(_ELECTRICAL_TABLE)}
#: Other spellings of units, behind the right one.
_SPELLING_TABLE = """\
N·m: Nm N-m N.m mN·m 牛米; kN·m: kNm; N·mm: Nmm; kg·m²: kgm² kgm2 kgm^2; m²: m2; s²: s2; m³: m3; mm²: mm2
mm³: mm3; m⁴: m4; mm⁴: mm4; s: sec second seconds 秒; min: minute minutes 分 分钟; h: hour hours
m: meter metre meters metres 米; mm: millimeter millimetre millimeters millimetres 毫米; in: inch inches "
ft: feet foot; deg: degree degrees grad 度; rad: radian radians rads 弧度; N: newton newtons 牛 牛顿
kg: kilogram kilograms kgs 千克 公斤; g: gram; t: tonne ton 吨; rev/s: rps; rev: r turn turns 转; %: percent ％
rpm: U/min u/min 转/分 转/分钟; lbf/in²: psi; lbf·s²/ft: slug slugs; lbf·s²/in: blob blobs; kgf: kp 公斤力
lb: lbs; MPa: Mpa 兆帕; Hz: hz; cm: 厘米; kN: 千牛; kW: 千瓦
V: volt volts 伏 伏特; A: amp amps ampere amperes 安 安培; ohm: ohms Ohm 欧 欧姆
"""
SPELLINGS: Mapping[str, str] = {
    spelling: unit
    for unit, _unused, row in (
        each.partition(": ") for line in _SPELLING_TABLE.splitlines() for each in line.split("; ")
    )
    for spelling in row.split()
}

_SPACES = re.compile(r"[\s\u00a0\u2009\u202f\ufeff]+")
NUMBER = re.compile(r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_QUANTITY = re.compile(r"^([+-]?)\s*((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)$")
_PLAIN = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?) ?([^\s\d*(),.+-][^\s*(),]*)")
#: The sense of a turn behind a quantity, and the dimensions that have one.
SENSE = re.compile(r"\b(c?cw|(counter|anti)?-?clockwise)\b|[顺逆]时针", re.IGNORECASE)
TURNING = ("angle", "angular_velocity", "angular_acceleration", "torque")
_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_FACTOR = re.compile(r"\s*((?:(?![⁰¹²³⁴⁵⁶⁷⁸⁹])[^\W\d_])+|[°%])\s*((?:\^|\*\*)\s*[-−]?\d+|⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+)?\s*")
_JOINT = re.compile(r"[*·⋅/]")


def tidy(text: str) -> str:
    """Plain spaces and a plain minus sign in place of their typographic relatives."""
    return _SPACES.sub(" ", text).replace("−", "-").strip()


def times(a: Dimension, b: Dimension, sign: float = 1) -> Dimension:
    """Dimension of a product (``sign`` 1), a quotient (-1), or of ``a`` times a power of ``b``."""
    return (a[0] + sign * b[0], a[1] + sign * b[1], a[2] + sign * b[2], a[3] + sign * b[3], a[4] + sign * b[4])


def nearly(a: Dimension, b: Dimension) -> bool:
    """Whether two dimensions are the same but for an angle, which counts for nothing in products; not those of
    angles and numbers."""
    return a[:4] == b[:4] != NONE[:4]


def exponent(text: str) -> int:
    """The integer of ``^2``, ``**-1``, ``²`` or ``⁻¹``; 1 of an empty text."""
    digits = text.translate(_SUPERSCRIPTS).lstrip("^* ").replace("−", "-").replace(" ", "")
    power = int(digits[:4]) if digits else 1
    if abs(power) > 9:
        raise QuantityError(
            _('the exponent "{digits}" is too large', digits=digits[:20]), _("units take exponents from -9 to 9")
        )
    return power


@lru_cache(1024)
def unit(text: str) -> tuple[float, Dimension]:
    """Factor to SI and dimension of a unit such as ``N·m/rad``, ``kg*m^2`` or ``1/rad``.

    Raises QuantityError for a unit that is not known, with the nearest known spelling.
    """
    found = _read(text)
    if isinstance(found, int):
        raise unknown_unit(text, found)
    return found


def _read(text: str) -> tuple[float, Dimension] | int:
    """Factor and dimension of a unit, or the column at which it is unknown."""
    factor, dimension, sign, at = 1.0, NONE, 1, 0
    if text.startswith("1/"):
        sign, at = -1, 2
    turning = re.match(r"r\s*/\s*(?=min|s)", text)
    if turning:
        factor, dimension, sign, at = _TURN, UNITS["rev"][1], -1, turning.end()
    while True:
        found = _FACTOR.match(text, at)
        if found is None or found.group(1) not in BEHIND_NUMBERS:
            return at
        size, kind = BEHIND_NUMBERS[found.group(1)]
        power = sign * exponent(found.group(2) or "")
        factor, dimension, at = factor * size**power, times(dimension, kind, power), found.end()
        if at == len(text):
            return factor, dimension
        if not _JOINT.match(text, at):
            return at
        sign, at = (-1 if text[at] == "/" else 1), at + 1


def unknown_unit(text: str, column: int = 0) -> QuantityError:
    """The error for a text that is not a unit, offering what was probably meant."""
    offer = suggestion(text)
    remedy = (
        _('did you mean "{offer}"?', offer=offer)
        if offer
        else _("write a unit such as mm, deg, kg, N, N·m, rpm, kg·m²")
    )
    return QuantityError(_('unknown unit "{text}"', text=text), remedy, column=column, code="unknown-unit")


def suggestion(text: str) -> str | None:
    """A known spelling near ``text``, each factor of a product taken by itself."""
    compact = text.replace(" ", "")
    if re.search(r"[^\x00-\u2fff]", compact):
        from unicodedata import normalize

        compact = normalize("NFKC", compact)
    if compact in SPELLINGS:
        return SPELLINGS[compact]
    parts = re.split(r"([*·⋅/.\-])", compact)
    offers = [part if index % 2 else _factor_suggestion(part) for index, part in enumerate(parts)]
    if any(offer is None for offer in offers):
        return nearest(compact, list(UNITS)) if len(parts) == 1 else None
    joined = "".join("·" if offer in (".", "-", "*") else str(offer) for offer in offers)
    try:
        return None if isinstance(_read(joined), int) else joined
    except QuantityError:
        return None


def _factor_suggestion(part: str) -> str | None:
    found = _FACTOR.fullmatch(part)
    if found and found.group(1) in BEHIND_NUMBERS:
        return part
    if part in SPELLINGS:
        return SPELLINGS[part]
    base = part.rstrip("0123456789^²³")
    offer, exponent = nearest(base, list(UNITS)), part[len(base) :]
    if exponent.lstrip("^") == "0":
        return None
    return offer and offer + ("^" + exponent if exponent.isascii() and exponent.isdigit() else exponent)


def _letters(text: str) -> str:
    return re.sub(r"\W", "", text.translate(_SUPERSCRIPTS)).casefold()


@cache
def example(dimension: str) -> str:
    """A right form of a quantity of this dimension, for remedies: ``60.5 mm``."""
    numbers = {"length": "60.5", "angle": "30", "angular_velocity": "170", "mass": "4.5", "dimensionless": "0.1"}
    return f"{numbers.get(dimension, '2.5')} {USUAL_UNITS[dimension]}".strip()


def parse(text: str, dimension: str) -> float:
    """SI value of a text such as ``"460 rpm"`` as a quantity of ``dimension`` (a name in DIMENSIONS).

    A bare 0 needs no unit; any other number does, unless the quantity is dimensionless.
    Raises QuantityError, which says what is wrong and shows the right form.
    """
    plain = tidy(text)
    found = _QUANTITY.match(plain)
    if found is None:
        raise not_a_number(plain, dimension)
    sign, digits, rest = found.groups()
    if re.match(r"[,，]\s?\d", rest):
        raise decimal_comma(plain)
    if "±" in rest:
        raise QuantityError(
            _('"{plain}" holds a tolerance', code="units.tolerance", plain=plain),
            _("write the value alone; tolerances stand in a file of their own (kind: tolerance)"),
            code="quantity",
        )
    if re.match(r"(?!1/)[_'’]?\d", rest):
        raise QuantityError(
            (
                _('"{plain}" has a space inside the number')
                if rest[0].isdigit()
                else _('"{plain}" has a separator inside the number')
            ).format(plain=plain),
            _('write "{digits}{rest}"', digits=digits, rest=rest.lstrip("_'’")),
            code="quantity",
        )
    value = float(sign + digits)
    if rest:
        factor, kind = _unit_of(rest, len(plain) - len(rest), dimension)
        value *= factor
    else:
        kind = NONE
    if not math.isfinite(value):
        raise QuantityError(
            _('"{text}" is not a finite number', text=plain),
            _('write a number such as "{example}"', example=example(dimension)),
            code="not-finite",
        )
    if not rest and value == 0:
        return 0.0
    if dimension == "frequency" and kind == DIMENSIONS["angular_velocity"]:
        return value / _TURN
    require(kind, dimension, plain, bare=not rest)
    return value


def plain_quantity(text: str, dimension: str) -> float | None:
    """SI value of a number with a right unit behind it; None for anything that needs a closer look."""
    found = _PLAIN.fullmatch(text)
    if found is None:
        return None
    try:
        factor, kind = unit(found[2])
    except QuantityError:
        return None
    value = float(found[1]) * factor
    return value if kind == DIMENSIONS[dimension] and math.isfinite(value) else None


def unit_fits(text: str, dimension: str) -> bool:
    """Whether a number with its unit is a quantity of ``dimension``."""
    try:
        parse(text, dimension)
    except QuantityError:
        return False
    return True


def _unit_of(text: str, column: int, dimension: str) -> tuple[float, Dimension]:
    try:
        return unit(text)
    except QuantityError as error:
        remedy = _fitting_remedy(text, dimension) if error.code == "unknown-unit" else error.remedy
        raise QuantityError(error.message, remedy, column=column + error.column, code=error.code) from None


def _fitting_remedy(text: str, dimension: str) -> Message:
    """What was probably meant by an unknown unit where a quantity of this dimension is needed."""
    if dimension in TURNING and SENSE.search(text):
        return _(
            "the sign says the sense: positive is counter-clockwise, negative (-120 rpm) clockwise",
            code="units.sense",
        )
    wanted, product = DIMENSIONS[dimension], "·".join(text.split())
    fits = suggestion(product) == product and unit(product)[1] == wanted
    offer = product if fits else suggestion(text)
    if not offer or (unit(offer)[1] != wanted and _letters(offer) != _letters(text)):
        offer = nearest(text, [name for name, (_unused, kind) in BEHIND_NUMBERS.items() if kind == wanted])
    if offer:
        return _('did you mean "{offer}"?', offer=offer)
    return _('write a number and a unit, such as "{example}"', example=example(dimension))


def decimal_comma(text: str) -> QuantityError:
    """The error for a decimal comma, with the same text written with a point, or without where it may mean
    thousands."""
    right = re.sub(r"(?<=\d)[,，]\s?(?=\d)", ".", text)
    remedy = _('write a point: "{right}"', code="units.point", right=right)
    if re.match(r"[+-]?[1-9]\d{0,2}([,，]\d{3})+(?!\d)", text):
        way = (
            _('write "{without_comma}"')
            if right.count(".") > 1
            else _('write a point: "{right}"; or "{without_comma}", if thousands are meant')
        )
        remedy = way.format(right=right, without_comma=re.sub("[,，]", "", text))
    return QuantityError(_('decimal comma in "{text}"', text=text), remedy, code="decimal-comma")


def not_a_number(text: str, dimension: str) -> QuantityError:
    """The error for a text without a number where a quantity is needed."""
    if re.match(r"^[+-]?\.?(inf|infinity|nan)\b", text, re.IGNORECASE):
        return QuantityError(
            _('"{text}" is not a finite number', text=text),
            _('write a number such as "{example}"', example=example(dimension)),
            code="not-finite",
        )
    return QuantityError(
        _('"{text}" is not a quantity', text=text),
        _('write a number and a unit, such as "{example}"', example=example(dimension)),
    )


def require(kind: Dimension, dimension: str, text: str, *, bare: bool = False) -> None:
    """Raise QuantityError unless ``kind`` is the dimension that is needed."""
    if kind == DIMENSIONS[dimension]:
        return
    noun = NOUNS[dimension]
    if bare:
        right = f"{text} {USUAL_UNITS[dimension]}".strip()
        raise QuantityError(
            _('"{text}" has no unit', text=text),
            _('{noun} is needed, such as "{right}"', noun=noun, right=right),
            code="missing-unit",
        )
    remedy = _of_weight(kind, dimension, text) or _('write it as in "{example}"', example=example(dimension))
    message = _('"{text}" is {wrong}, where {noun} is needed', text=text, wrong=name_of(kind), noun=noun)
    raise QuantityError(message, remedy, code="wrong-dimension")


def _of_weight(kind: Dimension, dimension: str, text: str) -> Message | None:
    """What to write where a mass is used for its weight, alone or in a product, or a weight for a mass."""
    acceleration, wanted = DIMENSIONS["acceleration"], DIMENSIONS[dimension]
    if dimension == "mass" and kind == UNITS["N"][1]:
        return _('a weight over 9.81 m/s² is a mass: write "({text})/(9.81 m/s^2)"', text=text)
    if wanted != times(kind, acceleration):
        return None
    if re.search(r"\blb\b", text):
        return _('lb is a unit of mass, lbf of force: write "{right}"', right=re.sub(r"\blb\b", "lbf", text))
    return _('a mass times 9.81 m/s² is a weight: write "({text})*(9.81 m/s^2)"', text=text) if kind[1] else None


def name_of(kind: Dimension) -> Message:
    """A dimension in words: ``a length``, or by its SI units where it has no name."""
    for name, dimension in DIMENSIONS.items():
        if dimension == kind:
            return NOUNS[name]
    return _("a quantity in {unit}", unit=si_symbol(kind))


def si_unit(dimension: str) -> str:
    """SI unit of a dimension; raises KeyError for one that is not known."""
    return _SI_OF_ALL[dimension]


def powers(dimension: str) -> Dimension:
    """Powers of metre, kilogram, second, ampere, radian in a dimension; raises KeyError for one that is not known."""
    if dimension in DIMENSIONS:
        return DIMENSIONS[dimension]
    return unit(si_unit(dimension))[1] if si_unit(dimension) else NONE


def most(kind: Dimension) -> tuple[float, str]:
    """What no machine reaches in a dimension, with its SI unit."""
    names = (name for name, each in DIMENSIONS.items() if each == kind)
    return next((LARGEST[name] for name in names), LARGEST_OF_ALL), si_symbol(kind)


def usual_symbol(kind: Dimension) -> str:
    """The unit in which a dimension is mostly written: ``mm``, ``deg``, ``N·m/rad``; empty for a number."""
    names = (name for name, dimension in DIMENSIONS.items() if dimension == kind)
    return next((USUAL_UNITS[name] for name in names), si_symbol(kind))


def si_symbol(kind: Dimension) -> str:
    """SI unit of any dimension, named where it has a name: ``N·m/rad``, ``m^0.5``; empty for a number."""
    for name, dimension in DIMENSIONS.items():
        if dimension == kind:
            return SI_UNITS[name]
    return "·".join(
        f"{symbol}^{power:g}" if power != 1 else symbol
        for symbol, power in zip(("m", "kg", "s", "A", "rad"), kind, strict=True)
        if power
    )


def format(value: float, dimension: str, unit: str | None = None) -> str:
    """Text of an SI value: ``format(0.0605, "length", "mm")`` is ``"60.5 mm"``.

    Without ``unit`` the SI unit of the dimension is used, and reading the text gives the same float back.
    """
    if unit is None:
        return f"{number(value)} {SI_UNITS[dimension]}".strip()
    factor, kind = _unit_of(unit, 0, dimension)
    require(kind, dimension, unit)
    return f"{number(value / factor, 12)} {unit}"


def number(value: float, digits: int | None = None) -> str:
    """Shortest text of a float, without a trailing ``.0``; ``digits`` limits the significant digits."""
    if digits is not None:
        return f"{value:.{digits}g}"
    return repr(float(value)).removesuffix(".0")

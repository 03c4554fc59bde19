"""Texts that are no quantities."""

WORDS = {
    "large_exponent": 'the exponent "{digits}" is too large',
    "exponents": "units take exponents from -9 to 9",
    "unknown": 'unknown unit "{text}"',
    "space": '"{plain}" has a space inside the number',
    "write_number": 'write "{digits}{rest}"',
    "not_finite": '"{text}" is not a finite number',
    "number_such_as": 'write a number such as "{example}"',
    "decimal_comma": 'decimal comma in "{text}"',
    "point": 'write a point: "{right}"',
    "not_quantity": '"{text}" is not a quantity',
    "number_and_unit": 'write a number and a unit, such as "{example}"',
    "no_unit": '"{text}" has no unit',
    "needed": '{noun} is needed, such as "{right}"',
    "wrong_dimension": '"{text}" is {wrong}, where {noun} is needed',
    "as_in": 'write it as in "{example}"',
    "write_unit": "write a unit such as mm, deg, kg, N, N·m, rpm, kg·m²",
}

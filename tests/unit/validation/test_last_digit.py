"""One unit of the last digit of a printed number."""

import pytest

from linkwright.validation.validate import last_digit


@pytest.mark.parametrize(("text", "digit"), [("3.14", 0.01), ("7.41e-7", 1e-9), ("500", 1.0), ("-0.20", 0.01)])
def test_last_digit(text: str, digit: float) -> None:
    assert last_digit(text) == pytest.approx(digit)

"""The design numbers that gallery files print: closed forms, and numbers of published reports."""

import pytest

import linkwright as lw
from linkwright import units
from linkwright.gallery import names
from linkwright.metrics import METRICS, metrics

PRINTED = [
    (name, metric.removesuffix("_min"), str(text))
    for name in names()
    for metric, text in lw.load(f"gallery:{name}").expected.get("metrics", {}).items()
]


@pytest.mark.parametrize(("name", "metric", "text"), PRINTED)
def test_printed_number(name: str, metric: str, text: str) -> None:
    table = metrics(lw.solve_motion(lw.load(f"gallery:{name}"), steps=90), metric)
    expected = units.parse(text, METRICS[metric].dimension)
    digits = text.split(maxsplit=1)[0].rsplit(".", maxsplit=1)[-1] if "." in text else ""
    last_digit = units.parse(" ".join([f"1e-{len(digits)}", *text.split()[1:]]), METRICS[metric].dimension)
    assert any(row.value == pytest.approx(expected, abs=0.51 * last_digit) for row in table)


def test_there_are_printed_numbers() -> None:
    assert len(PRINTED) >= 8

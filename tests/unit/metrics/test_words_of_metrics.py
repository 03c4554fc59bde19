"""Every registered design number has its unit and its words in both languages."""

import string

import pytest

from linkwright.metrics import METRICS
from linkwright.metrics.quantities import si_unit
from linkwright.words import catalogue


@pytest.mark.parametrize("name", METRICS)
def test_metric_says_what_it_is(name: str) -> None:
    metric = METRICS[name]()
    assert metric.name == name
    assert si_unit(metric.dimension) == metric.unit
    assert len(metric.source) > 10 and METRICS[name].__doc__
    for language in ("en", "zh"):
        words = catalogue("metrics", language)
        assert words[f"{name}.label"] and words[f"{name}.meaning"].endswith((".", "。"))
    assert metric.better in (None, "higher", "lower")


def test_both_languages_have_the_same_keys_and_names() -> None:
    en, zh = catalogue("metrics", "en"), catalogue("metrics", "zh")
    assert en.keys() == zh.keys()
    assert [k for k in en if sorted(_fields(en[k])) != sorted(_fields(zh[k]))] == []


def _fields(text: str) -> list[str]:
    return [name for _, name, _, _ in string.Formatter().parse(text) if name]

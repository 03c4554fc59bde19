"""Every registered metric has its unit and its words in both languages."""

import pytest

from linkwright.analysis import METRICS
from linkwright.units import si_unit


@pytest.mark.parametrize("name", METRICS)
def test_metric_says_what_it_is(name: str) -> None:
    metric = METRICS[name]()
    assert metric.name == name
    assert si_unit(metric.dimension) == metric.unit
    assert len(metric.source) > 10 and METRICS[name].__doc__
    for language in ("en", "zh"):
        assert metric.label_in(language)
        assert metric.meaning_in(language).endswith((".", "。"))
    assert metric.better in (None, "higher", "lower")

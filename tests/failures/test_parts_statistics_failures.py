"""Samples that cannot answer the question are refused with what they lack."""

import pytest
from tests.refusals import faulty, said

import linkwright as lw
from linkwright import parts

HEAD = "format: 1\nkind: statistics\nsamples:\n"
HEAD += "  a: [1 mm, 2 mm, 4 mm]\n  b: {unit: mm, values: [3]}\n  c: [5 N, 5 N, 5 N]\n"


@pytest.mark.parametrize(
    ("text", "key", "code", "values"),
    [
        ("fit: [normal]", "fit", "too_small", {"sample": "a", "count": 3, "what": "normal", "minimum": 8}),
        (
            "tests: {t: {kind: mean, of: [b], value: 2 mm}}",
            "tests.t",
            "too_small",
            {"sample": "b", "count": 1, "what": "mean"},
        ),
        ("tests: {t: {kind: mean, of: [c], value: 2 N}}", "tests.t", "constant", {"sample": "c"}),
        ("tests: {t: {kind: mean, of: [a], value: 2 N}}", "tests.t", "kinds_differ", {}),
        ("tests: {t: {kind: mean, of: [a]}}", "tests.t", "value_needed", {"what": "mean"}),
        ("tests: {t: {kind: mean, of: [d], value: 2 N}}", "tests.t.of", "no_sample", {"name": "d"}),
        (
            "tests: {t: {kind: two_means, of: [a]}}",
            "tests.t.of",
            "sample_count",
            {"what": "two_means", "wanted": 2, "count": 1},
        ),
        ("tests: {t: {kind: paired, of: [a, b]}}", "tests.t", "too_small", {"what": "paired"}),
        (
            "regressions: {r: {y: a, on: [a], degree: 2}}",
            "regressions.r",
            "too_small",
            {"what": "regression", "minimum": 4},
        ),
        ("regressions: {r: {y: a, on: [c]}}", "regressions.r.on", "dependent", {}),
        ("regressions: {r: {y: a, on: [b]}}", "regressions.r", "not_paired", {"counts": "1 : 3"}),
        ("capability: {a: {lower: 3 mm, upper: 2 mm}}", "capability.a", "limits_order", {}),
        ("capability: {a: {}}", "capability.a", "no_limits", {}),
        (
            "capability: {a: {lower: 1 mm, subgroup: 5}}",
            "capability.a",
            "too_small",
            {"what": "capability", "minimum": 10},
        ),
        ("confidence: 95", "confidence", "confidence", {}),
    ],
)
def test_too_small_or_unfit_samples(text: str, key: str, code: str, values: dict[str, object]) -> None:
    with pytest.raises(lw.ModelError) as caught:
        parts.loads(f"{HEAD}{text}\n", "s.yaml")
    found = said(caught.value.findings[:1], code, key, **values)
    assert found.where.startswith("s.yaml:7:")


def test_values_of_two_kinds() -> None:
    with faulty(
        "unit",
        "samples.a",
        message="the values differ in kind: {first} and {second}",
        first="a length",
        second="a force",
    ):
        parts.loads("format: 1\nkind: statistics\nsamples: {a: [1 mm, 2 N]}\n")

"""Samples that cannot answer the question are refused with what they lack."""

import pytest

import linkwright as lw
from linkwright import parts

HEAD = "format: 1\nkind: statistics\nsamples:\n"
HEAD += "  a: [1 mm, 2 mm, 4 mm]\n  b: {unit: mm, values: [3]}\n  c: [5 N, 5 N, 5 N]\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("fit: [normal]", "the sample a has 3 value(s), too few for normal; give at least 8"),
        ("tests: {t: {kind: mean, of: [b], value: 2 mm}}", "the sample b has 1 value(s), too few for mean"),
        ("tests: {t: {kind: mean, of: [c], value: 2 N}}", "all values of c are equal"),
        ("tests: {t: {kind: mean, of: [a], value: 2 N}}", "differ in kind"),
        ("tests: {t: {kind: mean, of: [a]}}", "needs a value to compare with"),
        ("tests: {t: {kind: mean, of: [d], value: 2 N}}", 'there is no sample "d"'),
        ("tests: {t: {kind: two_means, of: [a]}}", "two_means needs 2 sample(s); 1 are named"),
        ("tests: {t: {kind: paired, of: [a, b]}}", "too few for paired"),
        ("regressions: {r: {y: a, on: [a], degree: 2}}", "too few for regression; give at least 4"),
        ("regressions: {r: {y: a, on: [c]}}", "depend on each other or do not vary"),
        ("regressions: {r: {y: a, on: [b]}}", "different numbers (1 : 3)"),
        ("capability: {a: {lower: 3 mm, upper: 2 mm}}", "not above the lower one"),
        ("capability: {a: {}}", "there is no limit"),
        ("capability: {a: {lower: 1 mm, subgroup: 5}}", "too few for capability; give at least 10"),
        ("confidence: 95", "between 0 and 1"),
    ],
)
def test_too_small_or_unfit_samples(text: str, words: str) -> None:
    with pytest.raises(lw.ModelError) as error:
        parts.loads(f"{HEAD}{text}\n", "s.yaml")
    assert words in str(error.value) and "s.yaml:7:" in str(error.value)


def test_values_of_two_kinds() -> None:
    with pytest.raises(lw.ModelError, match="the values differ in kind"):
        parts.loads("format: 1\nkind: statistics\nsamples: {a: [1 mm, 2 N]}\n")

"""Every reference number of the package, to the digits given; which of them their sources print; the page of them."""

from dataclasses import replace

import pytest

from linkwright.cli import main
from linkwright.validation.published import Published, Reference, published
from linkwright.validation.validate import Validation, check, last_digit, line, validate

CASES = list(published())


@pytest.fixture(scope="module")
def everything() -> Validation:
    return validate(CASES)


def test_all_numbers_agree(everything: Validation) -> None:
    assert not everything.failed, everything.text()
    assert len(everything.checks) >= 1800 and len(everything.cases()) >= 60


def test_the_table_of_the_documentation_has_every_case(everything: Validation) -> None:
    table = everything.markdown()
    assert all(f"| {case} |" in table for case, _ in everything.cases())


def test_errata_are_shown_with_their_reasons(everything: Validation) -> None:
    shown = everything.text("en")
    assert "printed 0.269782 deg is wrong" in shown and "arc cosine, which cannot be negative" in shown
    assert "有误" in everything.text("zh")


def test_only_what_a_source_prints_is_called_printed(everything: Validation) -> None:
    """As the sources are: the lecture's beam is printed, its cantilever only posed; a report's table row by row."""
    lines = [line(each, "en") for each in everything.checks]
    shown = {each for each in lines if ": printed " in each}
    assert sum(each.reference.printed for each in everything.checks) == len(shown)
    beam = {each.split(": ", 1)[1].split(",")[0] for each in shown if each.startswith("Simple beam")}
    assert {"reactions.A F: printed 300 N", "reactions.B F: printed 700 N"} <= beam
    assert not any(each.startswith(("Cantilever", "Two heavy bars", "Four-bar for three")) for each in shown)
    conveyor = [each for each in shown if each.startswith("Swinging conveyor, six-bar 0 deg")]
    assert len(conveyor) == 4  # three angles and the slider's place; its rates are the corrected ones


@pytest.mark.parametrize(
    ("what", "text", "digits"),
    [
        ("mobility", "1", 0.0),
        ("mobility", "2", -1.0),
        ("mobility", "1.3", -3.0),
        ("mobilitat", "1", float("inf")),
    ],
)
def test_a_number_that_differs_is_found(what: str, text: str, digits: float) -> None:
    case = Published(
        "four-bar", "nobody", "structure", {"model": "crank_rocker"}, (Reference(what, text, printed=True),)
    )
    (found,) = check(case)
    assert found.digits == pytest.approx(digits) and found.ok is (digits == 0.0)
    assert Validation((found,)).ok is found.ok


def test_an_angle_is_compared_over_full_turns_and_in_its_unit() -> None:
    angles = (Reference("coupler.angle", text, printed=True) for text in ("347.053 deg", "-12.947 deg"))
    given = {"model": "swing_conveyor", "at": "0 deg"}
    case = Published("conveyor", "report", "machine", given, tuple(angles))
    assert all(each.ok for each in check(case))
    wrong = replace(case, numbers=(Reference("coupler.angle", "347.055 deg", printed=True),))
    assert check(wrong)[0].digits == pytest.approx(-2.0, abs=0.5)


@pytest.mark.parametrize(
    ("text", "digit"), [("3.14", 0.01), ("7.41e-7", 1e-9), ("500", 1.0), ("-0.20", 0.01)]
)
def test_last_digit(text: str, digit: float) -> None:
    assert last_digit(text) == pytest.approx(digit)


def test_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["validate", "--case", "KHK", "--every"]) == 0
    assert "6 of 6 numbers" in capsys.readouterr().out
    assert main(["validate", "--case", "no such source"]) == 2

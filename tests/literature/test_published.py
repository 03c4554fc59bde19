"""Every reference number of the package, to the digits given; which of them their sources print; the page of them."""

import json
from dataclasses import replace

import pytest
from tests.every import every

import linkwright as lw
from linkwright.cli import main
from linkwright.validation import Checked, Validation


@pytest.fixture(scope="module")
def everything() -> Validation:
    return lw.validate()


def test_all_numbers_agree(everything: Validation) -> None:
    assert not everything.failed, everything.text()
    assert len(everything.checks) >= 1800 and len(everything.cases()) >= 60


def test_the_table_of_the_documentation_has_every_case(everything: Validation) -> None:
    table = everything.markdown()
    assert all(f"| {case} |" in table for case, _ in everything.cases())


def test_errata_are_shown_with_their_reasons(everything: Validation) -> None:
    errata = [each for each in every(everything.data()["numbers"]) if each["right"]]
    (wrong,) = (each for each in errata if each["printed"] == "0.269782 deg")
    assert wrong["right"] == "-0.269782 deg" and all(each["why"] for each in every(errata))
    for language in ("en", "zh"):
        shown = everything.text(language)
        assert all(each["printed"] in shown and each["right"] in shown for each in errata if each["printed"])


def test_only_what_a_source_prints_is_called_printed(everything: Validation) -> None:
    """As the sources are: the lecture's beam is printed, its cantilever only posed; a report's table row by row."""
    printed = [each for each in every(everything.data()["numbers"]) if each["printed"]]
    assert sum(each.reference.printed for each in everything.checks) == len(printed)
    beam = {(each["what"], each["printed"]) for each in printed if each["case"].startswith("Simple beam")}
    assert {("reactions.A F", "300 N"), ("reactions.B F", "700 N")} <= beam
    unprinted = ("Cantilever", "Two heavy bars", "Four-bar for three")
    assert all(any(each.case.case.startswith(case) for each in everything.checks) for case in unprinted)
    assert not any(each["case"].startswith(unprinted) for each in printed)
    press = {each["what"]: each["printed"] for each in printed if each["source"].startswith("平臺印刷機主傳動")}
    wanted = {"P0": "1.164670", "stroke bed_guide": "795.2122 mm", "follower.angle": "213.0665 deg"}
    assert wanted.items() <= press.items() and "78.7127 deg" in press.values()
    conveyor = [each for each in printed if each["case"] == "Swinging conveyor, six-bar" and each["place"] == "0 deg"]
    assert len(conveyor) == 4  # three angles and the slider's place; its rates are the corrected ones


def of_case(checks: tuple[Checked, ...], model: str, what: str, at: str | None = None) -> Checked:
    """The check of a number of a gallery model."""
    return next(
        each
        for each in checks
        if (each.case.inputs.get("model"), each.reference.what) == (model, what)
        and at in (None, each.case.inputs.get("at", each.case.inputs.get("input")))
    )


def again(check: Checked, what: str, text: str) -> Checked:
    """The same case with one number, of which another text is printed."""
    reference = replace(check.reference, what=what, text=text, printed=True, right="", why="")
    (found,) = lw.validate([replace(check.case, numbers=(reference,))]).checks
    return found


@pytest.mark.parametrize(
    ("what", "text", "digits"),
    [("mobility", "1", 0.0), ("mobility", "2", -1.0), ("mobility", "1.3", -3.0), ("mobilitat", "1", float("inf"))],
)
def test_a_number_that_differs_is_found(everything: Validation, what: str, text: str, digits: float) -> None:
    found = again(of_case(everything.checks, "crank_rocker", "mobility"), what, text)
    assert found.digits == pytest.approx(digits) and found.ok is (digits == 0.0)
    assert Validation((found,)).ok is found.ok


def test_an_angle_is_compared_over_full_turns_and_in_its_unit(everything: Validation) -> None:
    case = of_case(everything.checks, "swing_conveyor", "coupler.angle", "0 deg")
    assert all(again(case, "coupler.angle", text).ok for text in ("347.053 deg", "-12.947 deg"))
    wrong = again(case, "coupler.angle", "347.055 deg")
    assert wrong.digits == pytest.approx(-2.0, abs=0.5) and not wrong.ok


def test_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["validate", "--case", "KHK", "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert [each["ok"] for each in shown["numbers"]] == [True] * 6
    assert main(["validate", "--case", "no such source"]) == 2

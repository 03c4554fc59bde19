"""Errors and findings are said in the reader's language from their key and values; their string is English."""

import copy
import pickle
import re

from linkwright.errors import Finding, LinkwrightError, ModelError, QuantityError, with_remedy
from linkwright.words import _
from linkwright.words.message import code_of, lines, values_of

STEEP = _(
    "the two slides are parallel (sine of the angle between them {sine})", code="outcome.rpp_parallel", sine="0"
)
REMEDY = _("assembled")
ABOUT = "{name}: {cause}"
CHINESE = re.compile("[一-鿿]")


def test_an_error_says_its_sentence_in_both_languages() -> None:
    error = LinkwrightError(STEEP)
    assert str(error) == error.translate() == STEEP
    assert error.translate("zh") == STEEP.translate("zh") and CHINESE.search(error.translate("zh"))


def test_an_error_is_a_value_of_another_sentence() -> None:
    outer = LinkwrightError(_(ABOUT, name="--at", cause=LinkwrightError(STEEP)))
    assert str(outer).endswith(STEEP) and outer.translate("zh").endswith(STEEP.translate("zh"))
    assert "--at" in str(outer) and "--at" in outer.translate("zh")
    again = pickle.loads(pickle.dumps(copy.deepcopy(outer)))
    assert again.translate("zh") == outer.translate("zh") and (again.code, again.values["sine"]) == (STEEP.code, "0")


def test_the_code_is_that_of_what_is_within() -> None:
    """However deep, in a list the first; of an error its own, which is not the key of its sentence."""
    quantity = QuantityError(STEEP, REMEDY, code="missing-unit")
    within = {
        "missing-unit": [_(ABOUT, name="--at", cause=quantity)],
        STEEP.code: [
            with_remedy(STEEP, REMEDY),
            lines([STEEP, REMEDY]),
            _(ABOUT, name="a", cause=_(ABOUT, name="b", cause=[STEEP, REMEDY])),
            LinkwrightError(STEEP),
        ],
        "": ["a text", [], _(ABOUT, name="a", cause="a text"), LinkwrightError("a text")],
    }
    for code, several in within.items():
        assert [code_of(each) for each in several] == [code] * len(several)


def test_values_are_those_of_what_is_within_too() -> None:
    inner = _(ABOUT, name="b", cause=LinkwrightError(STEEP))
    found = values_of(_(ABOUT, name="a", cause=[inner]))
    assert (found["name"], found["sine"]) == ("a", "0")


def test_lists_take_the_comma_of_the_language() -> None:
    sentence = _("group ({links}) at {where}", links=("a", "b"), where="30°")
    for language in ("en", "zh"):
        assert f"a{_(', ').translate(language)}b" in sentence.translate(language)


def test_a_finding_puts_place_and_remedy_together() -> None:
    finding = Finding("warning", "a.yaml:3:1", "links.crank", STEEP, REMEDY, "x")
    for language in ("en", "zh"):
        message, remedy = STEEP.translate(language), REMEDY.translate(language)
        body = _("{message}; {remedy}", message=message, remedy=remedy).translate(language)
        told = _("warning: {body}", body=body).translate(language)
        assert finding.translate(language) == f"a.yaml:3:1: links.crank: {told}"
    assert str(finding) == finding.translate("en") and finding.values == {"sine": "0"}
    assert str(Finding("error", "", "", "bare")) == "bare"
    assert ModelError([finding, finding]).translate("zh") == "\n".join([finding.translate("zh")] * 2)


def test_a_remedy_follows_its_message() -> None:
    error = QuantityError(STEEP, REMEDY)
    for language in ("en", "zh"):
        told = error.translate(language)
        assert told.startswith(STEEP.translate(language)) and told.endswith(REMEDY.translate(language))

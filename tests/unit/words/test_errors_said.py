"""Errors and findings are said in the reader's language from their key and values; their string is English."""

import copy
import pickle
import re

from linkwright.errors import Finding, LinkwrightError, ModelError, QuantityError
from linkwright.words import say
from linkwright.words.sentence import Sentence, code_of, values_of

STEEP = Sentence("outcome.rpp_parallel", sine="0")
REMEDY = Sentence("outcome.assembled")
CHINESE = re.compile("[一-鿿]")


def test_an_error_says_its_sentence_in_both_languages() -> None:
    error = LinkwrightError(STEEP)
    assert str(error) == error.say() == say(STEEP.code, sine="0")
    assert error.say("zh") == say(STEEP.code, "zh", sine="0") and CHINESE.search(error.say("zh"))


def test_an_error_is_a_value_of_another_sentence() -> None:
    outer = LinkwrightError("cli.about", name="--at", cause=LinkwrightError(STEEP))
    assert str(outer).endswith(STEEP) and outer.say("zh").endswith(STEEP.say("zh"))
    assert "--at" in str(outer) and "--at" in outer.say("zh")
    again = pickle.loads(pickle.dumps(copy.deepcopy(outer)))
    assert again.say("zh") == outer.say("zh") and (again.code, again.values["sine"]) == (STEEP.code, "0")


def test_the_code_is_that_of_what_is_within() -> None:
    """However deep, in a list the first; of an error its own, which is not the key of its sentence."""
    quantity = QuantityError(STEEP, REMEDY, code="missing-unit")
    within = {
        "missing-unit": [Sentence("cli.about", name="--at", cause=quantity)],
        STEEP.code: [
            Sentence("finding.with_remedy", message=STEEP, remedy=REMEDY),
            Sentence("finding.below", first=STEEP, second=REMEDY),
            Sentence("cli.about", name="a", cause=Sentence("cli.about", name="b", cause=[STEEP, REMEDY])),
            LinkwrightError(STEEP),
        ],
        "cli.about": [Sentence("cli.about", name="a", cause="a text")],
        "": ["a text", [], LinkwrightError("a text")],
    }
    for code, several in within.items():
        assert [code_of(each) for each in several] == [code] * len(several)


def test_values_are_those_of_what_is_within_too() -> None:
    inner = Sentence("cli.about", name="b", cause=LinkwrightError(STEEP))
    found = values_of(Sentence("cli.about", name="a", cause=[inner]))
    assert (found["name"], found["sine"]) == ("a", "0")


def test_lists_take_the_comma_of_the_language() -> None:
    sentence = Sentence("cycle.change", links=("a", "b"), where="30°")
    for language in ("en", "zh"):
        assert f"a{say('finding.comma', language)}b" in sentence.say(language)


def test_a_finding_puts_place_and_remedy_together() -> None:
    finding = Finding("warning", "a.yaml:3:1", "links.crank", STEEP, REMEDY, "x")
    for language in ("en", "zh"):
        message, remedy = STEEP.say(language), REMEDY.say(language)
        body = say("finding.with_remedy", language, message=message, remedy=remedy)
        told = say("finding.warning", language, body=body)
        assert finding.say(language) == f"a.yaml:3:1: links.crank: {told}"
    assert str(finding) == finding.say("en") and finding.values == {"sine": "0"}
    assert str(Finding("error", "", "", "bare")) == "bare"
    assert ModelError([finding, finding]).say("zh") == "\n".join([finding.say("zh")] * 2)


def test_a_remedy_follows_its_message() -> None:
    error = QuantityError(STEEP, REMEDY)
    for language in ("en", "zh"):
        told = error.say(language)
        assert told.startswith(STEEP.say(language)) and told.endswith(REMEDY.say(language))

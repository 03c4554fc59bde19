"""Forms of motors, brakes, stops and runs: every key in words, in both languages."""

from __future__ import annotations

import pytest

from linkwright.server.run_forms import forms


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_key_and_kind_has_a_name(language: str) -> None:
    found = forms(language)
    fields = [field for kind in found["kinds"] for field in kind["fields"]] + found["stops"]
    assert len(fields) > 60
    for label in [each["label"] for each in (*found["kinds"], *fields)]:
        assert label[0].isupper() or language == "zh"
        assert label.isascii() == (language == "en")


def test_keys_that_do_not_go_together_are_told() -> None:
    kinds = {each["kind"]: {field["key"]: field for field in each["fields"]} for each in forms("en")["kinds"]}
    assert kinds["dc"]["stall_torque"]["instead"] == ["constant", "current", "resistance", "voltage"]
    assert kinds["dc"]["on"]["instead"] == ["along", "between"]
    assert kinds["cylinder"]["force"]["instead"] == ["bore", "pressure", "rod", "rod_pressure"]
    assert kinds["dc"]["ratio"]["further"] and not kinds["dc"]["on"]["further"]
    assert kinds["cylinder"]["between"]["form"] == "points"

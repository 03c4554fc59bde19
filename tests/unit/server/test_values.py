"""Values written into a text by path: kept as typed, checked where they stand, taken out again."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests import store
from tests.refusals import refused
from tests.unit.server.drawing import FOURBAR, NEW, done

import linkwright as lw
from linkwright.server.files import Files
from linkwright.server.work import Work


def put(path: list[str], value: Any) -> dict[str, Any]:
    return {"do": "set", "path": path, "value": value}


def test_a_length_that_is_set_is_in_the_file_and_in_the_drawing() -> None:
    text = done(NEW, *FOURBAR).text
    now = done(text, put(["links", "crank", "length"], "60 mm"))
    assert "crank: {points: [O1, A], length: 60 mm}" in now.text
    assert math.hypot(*now.picture["points"]["A"]) == pytest.approx(0.06, abs=2e-5)
    assert now.picture["unmet"] == []
    assert math.dist(now.picture["points"]["A"], now.picture["points"]["B"]) == pytest.approx(0.1526, abs=2e-5)
    assert lw.loads(now.text).dimension("crank.length") == pytest.approx(0.06)
    far = done(text, put(["links", "crank", "length"], "900 mm"))
    assert "length: 900 mm" in far.text
    assert far.picture["unmet"] == ["crank"]
    assert far.picture["points"] == done(text).picture["points"]


def test_a_value_that_the_reader_refuses_is_not_written() -> None:
    text = done(NEW, *FOURBAR).text
    for path, value in (
        (["links", "crank", "length"], "60 kg"),
        (["links", "crank", "length"], "60"),
        (["links", "crank", "mass"], "-1 kg"),
        (["driver", "speed"], "fast"),
        (["joints", "x"], {"kind": "nothing"}),
        (["links", "crank", "colour of it"], "red"),
    ):
        with pytest.raises(lw.LinkwrightError) as error:
            done(text, put(path, value))
        assert str(error.value)
    unfinished = done(NEW, *FOURBAR[:4]).text  # no rocker, no drive: no machine yet
    assert "mass: 2 kg" in done(unfinished, put(["links", "coupler", "mass"], "2 kg")).text
    with refused("studio.bad_value", name="path"):
        done(text, {"do": "set", "path": [], "value": "1"})


def test_values_are_made_and_taken_out_where_they_belong() -> None:
    text = done(NEW, *FOURBAR).text
    more = done(text, put(["joints", "A", "kind"], "revolute"), put(["joints", "A", "pin_radius"], "5 mm"))
    assert yaml.safe_load(more.text)["joints"] == {"A": {"kind": "revolute", "pin_radius": "5 mm"}}
    gravity = done(text, put(["gravity"], ["0 m/s²", "-9.81 m/s²"]))
    assert lw.loads(gravity.text).gravity == (0, -9.81)
    turned = done(gravity.text, put(["gravity", "1"], "9,81 m/s²"))
    assert lw.loads(turned.text).gravity == (0, 9.81)
    assert done(gravity.text, {"do": "unset", "path": ["gravity"]}).text == text
    assert done(more.text, {"do": "unset", "path": ["joints", "A", "pin_radius"]}).text.count("pin_radius") == 0
    force = {"kind": "force", "on": "rocker", "at": "B", "direction": "-90 deg", "magnitude": "120 N"}
    loaded = done(text, *2 * ({"do": "add", "section": "loads", "stem": "force", "entry": force},))
    assert loaded.made == ["force1", "force2"]
    assert list(lw.loads(loaded.text).loads) == ["force1", "force2"]
    with pytest.raises(lw.LinkwrightError):
        done(text, {"do": "add", "section": "loads", "stem": "force", "entry": {**force, "magnitude": "3 kg"}})
    with pytest.raises(lw.LinkwrightError):
        done(text, {"do": "add", "section": "loads", "stem": "force", "entry": {**force, "at": "Z"}})


def test_a_machine_by_lengths_alone_gets_no_drawing_when_a_length_is_set() -> None:
    text = store.text("crank_rocker")
    places = {"A": [0.1, 0.0], "B": [0.2, 0.2]}
    now = done(text, {**put(["links", "coupler", "length"], "3.7 m"), "places": places})
    changed = [line for line, new in zip(text.splitlines(), now.text.splitlines(), strict=True) if line != new]
    assert changed == [next(each for each in text.splitlines() if each.startswith("  coupler: {points"))]


def test_dimensions_that_are_set_take_the_drawing_along(tmp_path: Path) -> None:
    """As sliders, sweeps and optimisations write them."""
    text = done(NEW, *FOURBAR).text
    changed = Work(Files(tmp_path)).answers["set"]({"text": text, "values": {"crank.length": 0.04}})["text"]
    picture = done(changed).picture
    assert math.hypot(*picture["points"]["A"]) == pytest.approx(0.04, abs=2e-5)
    assert picture["unmet"] == []
    whole = store.text("crank_rocker")
    one = Work(Files(tmp_path)).answers["set"]({"text": whole, "values": {"crank.length": 0.9}})["text"]
    assert len([1 for a, b in zip(whole.splitlines(), one.splitlines(), strict=True) if a != b]) == 1

"""Tasks of synthesis as forms of the page, and what a search gives back."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import pytest

from linkwright import loads, solve_motion
from linkwright.errors import LinkwrightError
from linkwright.server.background import Background
from linkwright.server.synthesis import HIDDEN, designed, task_forms
from linkwright.server.texts import TEXTS
from linkwright.synthesis.catalogue import TASKS


def _found(task: str, demands: dict[str, Any]) -> dict[str, Any]:
    background = Background()
    background.begin("synthesis", designed(task, demands), "en")
    for _ in range(600):
        found: dict[str, Any] = background.state()
        if not found["running"]:
            return found
        time.sleep(0.02)
    raise AssertionError("the search does not end")


@pytest.mark.parametrize("form", task_forms("en"), ids=lambda form: form["name"])
def test_every_task_and_demand_has_words(form: dict[str, Any]) -> None:
    assert {f"studio.dock.task.{form['name']}", f"studio.dock.task_help.{form['name']}"} <= set(TEXTS)
    for demand in form["demands"]:
        assert f"studio.dock.demand.{demand['key']}" in TEXTS
        assert demand["form"] != "word" or demand["words"]


def test_forms_are_those_of_all_tasks() -> None:
    asked = {form["name"]: {each["key"] for each in form["demands"]} for form in task_forms("zh")}
    assert asked == {name: set(task.demands) - set(HIDDEN) for name, task in TASKS.items()}


def test_a_slider_crank_has_the_stroke_and_the_time_ratio_that_were_typed() -> None:
    demands = {"stroke": "120 mm", "quick_return_ratio": "1.2", "offset": "30 mm"}
    found = _found("slider_crank", demands)
    assert found["sentence"] == ""
    (candidate,) = found["candidates"]
    motion = solve_motion(loads(candidate["text"], "found.yaml"), steps=7200)
    places = motion.point("B").position[:, 0]
    # Lengths are written to the micrometre.
    assert np.ptp(places) == pytest.approx(0.12, abs=2e-6)
    # The crank turns steadily: times of both strokes are shares of the turn.
    out = (int(np.argmin(places)) - int(np.argmax(places))) % len(places)
    assert max(out, len(places) - out) / min(out, len(places) - out) == pytest.approx(1.2, abs=2e-3)


def test_the_drawing_of_a_candidate_is_its_linkage() -> None:
    candidate = _found("motion", {"poses": [[0, 0, 0], [50, 20, 30], [90, 60, 70]]})["candidates"][0]
    drawing = candidate["drawing"]
    assert set(drawing["fixed"]) | {name for points in drawing["links"].values() for name in points} == set(
        drawing["points"]
    )
    assert drawing["points"]["P"] == pytest.approx([0.0, 0.0], abs=1e-9)


def test_what_cannot_be_met_gives_the_nearest_with_its_sentence() -> None:
    found = _found("crank_rocker", {"swing_angle": "60 deg", "quick_return_ratio": "5", "frame": "200 mm"})
    assert found["sentence"]
    assert found["candidates"]


@pytest.mark.parametrize("demands", [{"stroke": "fast"}, {"stroke": "10 mm", "file": "x.csv"}, {"stroke": "1 kg"}])
def test_wrong_demands_are_refused_before_the_search(demands: dict[str, Any]) -> None:
    with pytest.raises(LinkwrightError):
        designed("slider_crank", demands)

"""The dock of the workbench in a hand: curves of what was drawn, scrubbing, synthesis, optimisation."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import Hand, hand

import linkwright as lw

pytestmark = needs_chromium
#: Pivots and joints of a crank-rocker on the grid, m.
O1, O2, A, B = (0.0, 0.0), (0.16, -0.02), (0.04, 0.03), (0.14, 0.1)


def four_bar(drawn: Hand) -> None:
    """A crank-rocker that is driven, with a heavy coupler."""
    for name, place in (("O1", O1), ("O2", O2)):
        action = {"do": "point", "name": name, "at": place, "fixed": True}
        drawn.tab.evaluate("action => desk.act([action])", action)
    drawn.settle()
    drawn.rail("link")
    drawn.click(O1, A, B, O2)
    drawn.settle()
    drawn.key("Escape", "Escape")
    drawn.take("drive")
    drawn.click(drawn.middle("O1", "A"))
    drawn.settle()
    coupler = next(name for name, link in drawn.entries["links"].items() if set(link["points"]) == {"A", "B"})
    drawn.tab.evaluate("name => desk.act([{ do: 'mass', link: name, mass: '2 kg' }])", coupler)
    drawn.settle()


def crank_is_where_the_field_says(drawn: Hand) -> float:
    """The input's angle as it is written, after a look whether the crank stands there; rad."""
    text: str = drawn.tab.locator("input.at").input_value()
    angle = math.radians(float(text.replace("−", "-").rstrip("°")))
    length = math.dist(O1, A)
    # What is written has one decimal.
    assert drawn.point("A") == pytest.approx((length * math.cos(angle), length * math.sin(angle)), abs=1e-3 * length)
    return angle


def shown(drawn: Hand, sort: str) -> float:
    """What is written at the cursor of the curve of a sort."""
    text: str = drawn.tab.locator(f'[data-curve^="{sort}"] output').inner_text()
    return float(text.replace("−", "-").split()[0])


def test_a_drawn_four_bar_has_its_torque_and_is_scrubbed(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path) as drawn:
        four_bar(drawn)
        drawn.button("studio.dock.add_curve").wait_for()
        if not drawn.tab.locator('[data-curve^="effort:"]').count():
            drawn.tab.locator(".plot .away").first.click(force=True)
            drawn.button("studio.dock.add_curve").click()
            drawn.tab.keyboard.type("torque")
            drawn.tab.keyboard.press("Enter")
        field = drawn.tab.locator("input.at")
        field.fill("100")
        field.press("Enter")
        drawn.frame()
        assert crank_is_where_the_field_says(drawn) == pytest.approx(math.radians(100.0))
        # Without gravity the driver gives what the kinetic energy gains.
        forces = lw.solve_forces(lw.solve_motion(lw.loads(drawn.text), steps=3600))
        turn = np.degrees(next(iter(forces.motion.inputs.values())))
        torque = np.interp(100.0, np.mod(turn, 360.0), forces.input_torque_from_power, period=360.0)
        assert shown(drawn, "effort:") == pytest.approx(
            torque, abs=0.006 * np.abs(forces.input_torque_from_power).max()
        )
        box = drawn.tab.locator(".scrub[role=slider]").bounding_box()
        drawn.tab.mouse.move(box["x"] + box["width"] / 4, box["y"] + 22)
        drawn.tab.mouse.down()
        drawn.tab.mouse.move(box["x"] + box["width"] / 2, box["y"] + 22, steps=3)
        drawn.tab.mouse.up()
        drawn.frame()
        half = crank_is_where_the_field_says(drawn)
        drawn.key("Home")
        drawn.frame()
        assert half - crank_is_where_the_field_says(drawn) == pytest.approx(math.pi, abs=0.02)


@pytest.mark.rotating
def test_a_slider_crank_of_a_typed_stroke_and_time_ratio_is_taken(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path) as drawn:
        drawn.tab.get_by_role("tab", name=drawn.translate("studio.dock.synthesis")).click()
        drawn.tab.locator(".task-choice select").select_option("slider_crank")
        for key, value in (("stroke", "120"), ("quick_return_ratio", "1.2"), ("offset", "30")):
            drawn.tab.locator(".task-field", has_text=drawn.translate(f"studio.dock.demand.{key}")).last.locator(
                "input"
            ).fill(value)
        drawn.button("studio.dock.find_linkages").click()
        drawn.tab.locator(".candidate").first.click()
        drawn.settle()
        places = lw.solve_motion(lw.loads(drawn.text), steps=3600).point("B").position[:, 0]
        assert np.ptp(places) == pytest.approx(0.12, rel=1e-5)
        assert drawn.tab.locator(".candidate").first.get_attribute("aria-pressed") == "true"
        drawn.key("Control+z")
        drawn.settle()
        assert "links" not in drawn.entries


def test_a_design_of_the_optimisation_is_written_into_the_file(chromium: Any, tmp_path: Path) -> None:
    (tmp_path / "bar.yaml").write_text(lw.read_document("gallery:crank_rocker").text, encoding="utf-8")
    with hand(chromium, tmp_path, "bar.yaml") as drawn:
        before = drawn.text
        drawn.tab.get_by_role("tab", name=drawn.translate("studio.dock.optimise")).click()
        drawn.labelled("studio.add_dimension").select_option("coupler.length")
        drawn.button("studio.dock.add_goal").click()
        drawn.labelled("studio.dock.goals").select_option("maximize")
        drawn.labelled("studio.number_name").select_option("transmission_angle")
        drawn.button("studio.dock.begin").click()
        drawn.tab.get_by_role("button", name=drawn.translate("studio.take_design")).first.click()
        drawn.settle()
        drawn.tab.wait_for_function("before => !desk.sought.value.running && desk.text.value !== before", arg=before)
        drawn.settle()
        lengths = [
            {name: drawn.metres(link["length"]) for name, link in yaml.safe_load(text)["links"].items()}
            for text in (before, drawn.text)
        ]
        assert lengths[1] != lengths[0]
        assert smallest_transmission_angle(lengths[1]) > smallest_transmission_angle(lengths[0]) + math.radians(1)


def smallest_transmission_angle(lengths: dict[str, float]) -> float:
    """That of a crank-rocker with a frame of 4 m: where the crank is in line with it, by the law of cosines; rad."""
    crank, coupler, rocker = (lengths[name] for name in ("crank", "coupler", "rocker"))
    found = []
    for far in (4.0 - crank, 4.0 + crank):
        angle = math.acos((coupler**2 + rocker**2 - far**2) / (2 * coupler * rocker))
        found.append(min(angle, math.pi - angle))
    return min(found)

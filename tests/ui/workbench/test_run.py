"""Motion under forces in the studio: a motor by its form, a run, what happened, and the way back."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import hand

import linkwright as lw

pytestmark = needs_chromium
ROTOR = """format: 1
name: Rotor
frame: {points: {O: [0 m, 0 m]}}
links: {wheel: {points: [O, A], length: 0.2 m, mass: 1 kg, inertia: 1.99 kg·m², mass_centre: [0 m, 0 m]}}
driver: {turn: wheel, about: O, speed: 10 rad/s}
"""


def test_a_rotor_is_run_up_by_a_motor_of_the_form(chromium: Any, tmp_path: Path) -> None:
    """J ω = M t: 4 N·m take a wheel of 1.99 kg·m² in 2 s to 4.02 rad/s, with which it goes on."""
    (tmp_path / "rotor.yaml").write_text(ROTOR, encoding="utf-8")
    with hand(chromium, tmp_path, "rotor.yaml") as drawn:
        drawn.tab.get_by_role("tab", name=drawn.translate("studio.dock.run")).click()
        drawn.labelled("studio.dock.add_actuator").select_option("constant")
        drawn.tab.locator(".running label", has_text="Torque").locator("input").fill("4 N·m")
        drawn.tab.locator(".run-further summary").click()
        drawn.tab.locator(".running label", has_text="Acts until").locator("input").fill("2 s")
        drawn.button("studio.dock.add").click()
        drawn.settle()
        assert "constant1: {kind: constant, on: wheel, torque: 4 N·m, until: 2 s}" in drawn.text
        field = drawn.tab.locator(".running label", has_text="Runs for").locator("input")
        field.fill("3 s")
        field.press("Tab")
        drawn.settle()
        assert drawn.entries["run"] == {"for": "3 s"}
        drawn.button("studio.dock.begin_run").click()
        drawn.tab.wait_for_function("() => desk.running.value")
        course = drawn.tab.locator(".run-course")
        assert "3 s" in course.inner_text()
        assert drawn.tab.locator(".timeline .segment").count() == 0
        moment = drawn.tab.locator(".timeline input.at")
        moment.fill("1.5 s")
        moment.press("Enter")
        assert moment.input_value() == "1.50 s"
        assert drawn.tab.evaluate("() => linkwright.phase.value") == pytest.approx(0.5)
        assert drawn.tab.evaluate("() => bench.session.value.model.axis.kind") == "time"
        course.locator("li button").last.click()
        assert moment.input_value() == "2.00 s"
        speed = drawn.tab.evaluate("() => bench.session.value.model.main.row('w:wheel').at(-1)")
        assert speed == pytest.approx(4.0 * 2.0 / 1.99, rel=1e-9)
        assert lw.run(lw.loads(drawn.text)).end_state["driver"][1] == pytest.approx(speed, rel=1e-12)
        drawn.button("studio.dock.back_to_driver").click()
        drawn.tab.wait_for_function("() => !desk.running.value")
        steady = drawn.tab.evaluate("() => bench.session.value.model.main.row('w:wheel').at(-1)")
        assert steady == pytest.approx(10.0)

"""Against which link a driver turns its link: said where it is not the frame."""

import re
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.refusals import findings, said

import linkwright as lw
from linkwright.cli import main

LED_AT_ITS_COUPLER = """
format: 1
name: Led at its coupler
frame: {points: {A: [0 m, 0 m], D: [0.9 m, 0 m]}}
links:
  crank: {points: [A, B], length: 0.45 m}
  coupler: {points: [B, C], length: 1.1 m}
  rocker: {points: [D, C], length: 0.75 m}
drawing: {B: [0.27 m, 0.36 m], C: [1.1287 m, 0.7143 m]}
driver: {turn: coupler, about: B, speed: 30 rpm, start: -31 deg}
cycle: {from: -31 deg, to: -29 deg}
"""


def test_the_driver_sets_the_angle_between_the_two_links_of_its_pin() -> None:
    motion = lw.solve_motion(lw.loads(LED_AT_ITS_COUPLER), steps=4)
    between = motion.link("coupler").angle - motion.link("crank").angle
    assert between == pytest.approx(np.radians([-31.0, -30.5, -30.0, -29.5, -29.0]))


@pytest.mark.parametrize(
    ("driver", "severity", "values"),
    [
        ("turn: coupler, about: B,", "note", {"link": "coupler", "pin": "B", "other": "crank"}),
        ("turn: crank, about: B,", "warning", {"link": "crank", "pin": "B", "other": "coupler"}),
    ],
)
def test_check_says_against_which_link(driver: str, severity: str, values: dict[str, object]) -> None:
    text = LED_AT_ITS_COUPLER.replace("turn: coupler, about: B,", driver)
    assert said(findings(text), "doubtful", "driver.about", **values).severity == severity
    other = "crank" if severity == "note" else "coupler"
    clear = text.replace("about: B,", f"about: B, relative_to: {other},")
    assert not [each for each in findings(clear) if each.key == "driver.about"]


def test_structure_and_solve_say_against_which_link(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "led.yaml"
    file.write_text(LED_AT_ITS_COUPLER, encoding="utf-8")
    told = re.compile(r"coupler.* B .*crank")
    for words in (["structure"], ["solve", "--steps", "4"]):
        assert main([words[0], str(file), *words[1:]]) == 0
        assert any(told.search(line) for line in capsys.readouterr().out.splitlines())
    structure = lw.structure(lw.loads(LED_AT_ITS_COUPLER))
    turned = {"driver": {"link": "coupler", "about": "B", "relative_to": "crank"}}
    assert structure.data()["turned"] == turned
    plain = lw.structure(store.machine("crank_rocker"))
    assert plain.data()["turned"]["driver"]["relative_to"] == "frame"
    assert not re.search(r"crank.* O1 .*frame", plain.text())

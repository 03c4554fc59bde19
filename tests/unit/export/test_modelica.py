"""The Modelica model, run by a Modelica compiler, moves as the mechanism does; its equations hold exactly."""

import re

import numpy as np
import pytest

import linkwright as lw
from linkwright.drivers.program import ProgramLaw
from linkwright.errors import LinkwrightError
from linkwright.export.base import FORMATS
from linkwright.export.modelica.laws import LawText
from linkwright.export.modelica.names import Names, quoted
from linkwright.export.results import Results


def text_of(name: str, form: str) -> str:
    results = Results.of(lw.load(f"gallery:{name}"), 72)
    return str(FORMATS["modelica"].content(results, name="Machine", form=form).decode())


@pytest.mark.parametrize(
    "name", ["swing_conveyor", "jaw_crusher_sixbar", "excavator", "shaper_quick_return", "triad", "dyad_prp"]
)
def test_a_cycle_agrees(name: str) -> None:
    rumoca = pytest.importorskip("rumoca")
    text = text_of(name, "positions")
    begin, end = (float(re.findall(rf"{word}=([^,]+),", text)[0]) for word in ("StartTime", "StopTime"))
    model = rumoca.Session().loads(text, model="Machine")
    result = model.simulate(
        (begin, end), dt=(end - begin) / 180, config=rumoca.SimConfig(rtol=1e-9, atol=1e-11)
    )
    motion = lw.solve_motion(lw.load(f"gallery:{name}"), times=np.clip(result.time, begin, end))
    for link in motion.mechanism.links:
        found = motion.link(link)
        assert np.asarray(result[f"{link}_phi"]) == pytest.approx(found.angle, abs=2e-9)
        speed, bend = found.angular_velocity, found.angular_acceleration
        assert np.asarray(result[f"{link}_w"]) == pytest.approx(speed, abs=1e-8 * (1 + np.abs(speed).max()))
        assert np.asarray(result[f"{link}_a"]) == pytest.approx(bend, abs=1e-7 * (1 + np.abs(bend).max()))
    for pin in (each for each in motion.mechanism.joints if f"{each}_x" in result.names):
        places = np.stack([result[f"{pin}_x"], result[f"{pin}_y"]], axis=1)
        assert places == pytest.approx(motion.point(pin).position, abs=2e-9)


def test_rates_keep_the_assembly_where_positions_may_lose_it() -> None:
    rumoca = pytest.importorskip("rumoca")
    motion = lw.solve_motion(lw.load("gallery:press_double_crank"), steps=180, endpoint=True)
    model = rumoca.Session().loads(text_of("press_double_crank", "rates"), model="Machine")
    config = rumoca.SimConfig(rtol=1e-9, atol=1e-11)
    result = model.simulate((0.0, float(motion.time[-1])), dt=float(motion.time[1]), config=config)
    motion = lw.solve_motion(motion.mechanism, times=np.asarray(result.time))
    for link in motion.mechanism.links:
        assert np.asarray(result[f"{link}_phi"]) == pytest.approx(motion.link(link).angle, abs=1e-6)


def test_an_unknown_form_is_refused() -> None:
    with pytest.raises(LinkwrightError, match='not of "forces"'):
        text_of("crank_rocker", "forces")


def test_expressions_keep_their_meaning() -> None:
    text = lw.dump(lw.load("gallery:double_slider"))
    assert "position:" in text
    law = 'position: "min(abs(0.2 m*sin(t/(1 s))), 0.1 m) + step(t - 1 s)*0.1 m"'
    mechanism = lw.loads(re.sub(r"position: .*?(?=[,}\n])", law, text, count=1))
    (driver,) = mechanism.drivers.values()
    found = driver.law.modelica(LawText(0.0, 2.0))
    assert "if " in found and "abs(" not in found and "time" in found


def test_an_unknown_law_is_refused() -> None:
    program = lw.MotionProgram([lw.Segment(1.0, rise=0.1, law="polynomial_345")], period=1.0, closed=False)
    law = ProgramLaw(program)
    with pytest.raises(LinkwrightError, match="'program' cannot be written"):
        law.modelica(LawText(0.0, 1.0))


def test_names_are_distinct_identifiers() -> None:
    names = Names()
    found = [
        names.of("link", "a-b"),
        names.of("pin", "a_b"),
        names.of("guide", "a_b"),
        names.of("link", "曲柄"),
    ]
    assert len(set(found)) == 4 and all(re.fullmatch(r"[A-Za-z]\w*", each, re.ASCII) for each in found)
    assert names.of("link", "a-b") == found[0]


def test_texts_cannot_end_early() -> None:
    assert quoted('a "b" \\ \n c') == '"a \\"b\\" \\\\ c"'

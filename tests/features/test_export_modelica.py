"""The Modelica model, run by a Modelica compiler, moves as the mechanism does; its equations hold exactly."""

import re
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright.errors import RequestError


def text_of(mechanism: lw.Mechanism, form: str = "positions") -> str:
    with TemporaryDirectory() as folder:
        path = lw.export(mechanism, Path(folder, "a.mo"), steps=72, name="Machine", form=form)
        return path.read_text("utf-8")


@pytest.mark.parametrize(
    "name", ["swing_conveyor", "jaw_crusher_sixbar", "excavator", "shaper_quick_return", "triad", "dyad_prp"]
)
def test_a_cycle_agrees(name: str) -> None:
    rumoca = pytest.importorskip("rumoca")
    text = text_of(store.machine(name))
    begin, end = (float(re.findall(rf"{word}=([^,]+),", text)[0]) for word in ("StartTime", "StopTime"))
    model = rumoca.Session().loads(text, model="Machine")
    result = model.simulate((begin, end), dt=(end - begin) / 180, config=rumoca.SimConfig(rtol=1e-9, atol=1e-11))
    motion = lw.solve_motion(store.machine(name), times=np.clip(result.time, begin, end))
    for link in every(motion.mechanism.links):
        found = motion.link(link)
        assert np.asarray(result[f"{link}_phi"]) == pytest.approx(found.angle, abs=2e-9)
        speed, bend = found.angular_velocity, found.angular_acceleration
        assert np.asarray(result[f"{link}_w"]) == pytest.approx(speed, abs=1e-8 * (1 + np.abs(speed).max()))
        assert np.asarray(result[f"{link}_a"]) == pytest.approx(bend, abs=1e-7 * (1 + np.abs(bend).max()))
    for pin in every(each for each in motion.mechanism.joints if f"{each}_x" in result.names):
        places = np.stack([result[f"{pin}_x"], result[f"{pin}_y"]], axis=1)
        assert places == pytest.approx(motion.point(pin).position, abs=2e-9)


def test_rates_keep_the_assembly_where_positions_may_lose_it() -> None:
    rumoca = pytest.importorskip("rumoca")
    motion = lw.solve_motion(store.machine("press_double_crank"), steps=180, endpoint=True)
    model = rumoca.Session().loads(text_of(motion.mechanism, "rates"), model="Machine")
    config = rumoca.SimConfig(rtol=1e-9, atol=1e-11)
    result = model.simulate((0.0, float(motion.time[-1])), dt=float(motion.time[1]), config=config)
    motion = lw.solve_motion(motion.mechanism, times=np.asarray(result.time))
    for link in every(motion.mechanism.links):
        assert np.asarray(result[f"{link}_phi"]) == pytest.approx(motion.link(link).angle, abs=1e-6)


def test_an_unknown_form_is_refused() -> None:
    with refused("export.bad_form", RequestError, form="forces"):
        text_of(store.machine("crank_rocker"), "forces")


def test_expressions_keep_their_meaning() -> None:
    text = lw.dump(store.machine("double_slider"))
    assert "position:" in text
    law = 'position: "min(abs(0.2 m*sin(t/(1 s))), 0.1 m) + step(t - 1 s)*0.1 m"'
    mechanism = lw.loads(re.sub(r"position: .*?(?=[,}\n])", law, text, count=1))
    found = text_of(mechanism)
    (line,) = [line for line in found.splitlines() if "if " in line and "0.2" in line]
    assert "abs(" not in found and "time" in line


def test_an_unknown_law_is_refused() -> None:
    text = lw.dump(store.machine("crank_rocker"))
    program = "program: [{rise: 360 deg, over: 1 s, law: polynomial_5}]"
    driven = lw.loads(re.sub(r"speed: [^,}\n]*", program, text, count=1))
    with refused("export.no_law", law="program"):
        text_of(driven)

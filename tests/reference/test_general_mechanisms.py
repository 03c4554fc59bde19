"""125 random mechanisms without reserve, judged by the independently followed branch; and the judge itself.

`python -m tests.random_mechanisms` judges as many as wanted.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.random_mechanisms import judge_seed
from tests.reference import judge
from tests.reference.adapter import driver_values, reference_system, starting_position
from tests.reference.branch import Follower
from tests.reference.general_case import general_case
from tests.reference.judge import AGREES, GOOD, LIMIT, UNSURE, judged
from tests.reference.laws import kinks

import linkwright as lw

#: Mechanisms of every run of the tests; ``python -m tests.random_mechanisms`` judges as many as wanted.
COUNT, BATCH = 125, 25


@pytest.mark.rotating
@pytest.mark.parametrize("batch", range(COUNT // BATCH))
def test_no_wrong_number_no_jump_no_unjustified_refusal(batch: int) -> None:
    results = [judge_seed(seed) for seed in range(batch * BATCH, (batch + 1) * BATCH)]
    wrong = [r for r in results if r.kind not in (*GOOD, UNSURE)]
    assert not wrong, "\n".join(f"{r.seed} at {r.steps} steps: {r.kind}: {r.lines[:2]}" for r in wrong)
    assert sum(r.kind == UNSURE for r in results) <= 2
    assert sum(r.notes.get("ok", 0) for r in results) > 100


@pytest.mark.parametrize(("name", "steps"), [("before", 1), ("before", 60), ("beside", 7)])
def test_a_torsion_spring_is_wound_as_at_the_beginning_up_to_a_limit(name: str, steps: int) -> None:
    """The rest of the cycle is out of reach, so no whole turn of the spring can be read from it."""
    text = Path(__file__).with_name("faults").joinpath(f"spring_{name}_a_limit.yaml").read_text("utf-8")
    verdict = judged(text, steps)
    assert verdict.kind == (LIMIT if steps > 1 else AGREES), verdict.lines


@pytest.mark.parametrize(
    ("name", "steps", "kind"), [("other_way_round", 12, LIMIT), ("guides_nearly_parallel", 24, AGREES)]
)
def test_ways_that_are_not_the_usual_ones(name: str, steps: int, kind: str) -> None:
    """A turning driver that reaches the first position only the other way round; a block 500 sizes away."""
    text = Path(__file__).with_name("faults").joinpath(f"{name}.yaml").read_text("utf-8")
    verdict = judged(text, steps)
    assert verdict.kind == kind, verdict.lines
    assert verdict.notes["ok"] >= 4


def test_a_first_position_more_than_half_a_turn_away_is_reached_the_long_way() -> None:
    """The law begins 4.03 rad behind the drawing: 2.25 rad before it is the same place, but that way is barred."""
    text = Path(__file__).with_name("faults").joinpath("other_way_round.yaml").read_text("utf-8")
    swing = "2.7071989975245137 rad*sin(2*pi*t/(2.458 s) + 0.9846 rad)"
    behind = 2.7071989975245137 - 2 * np.pi / np.sin(0.9846)
    assert text.count(swing) == 1
    verdict = judged(text.replace(swing, f"({behind} rad)*sin(2*pi*t/(2.458 s) + 0.9846 rad)"), 1)
    assert verdict.kind == AGREES and verdict.notes["ok"] == 1, verdict.lines


@pytest.mark.long
def test_everything_comes_up() -> None:
    texts = [general_case(seed).text for seed in range(300)]
    models = [lw.loads(text) for text in texts]
    drivers = Counter(len(m.drivers) for m in models)
    assert min(drivers[n] for n in (1, 2, 3)) >= 20
    laws = Counter(type(d.law).__name__ for m in models for d in m.drivers.values())
    assert min(laws[name] for name in ("ConstantSpeed", "ExpressionLaw", "TableLaw")) >= 50
    inner = [d for m in models for d in m.drivers.values() if "frame" not in (d.link, d.relative_to)]
    assert {m.joints[d.joint].kind for m in models for d in m.drivers.values() if d in inner} == {
        "revolute",
        "prismatic",
    }
    loads = {load.kind for m in models for load in m.loads.values()}
    assert loads == {"force", "torque", "spring", "damper", "torsion_spring", "torsion_damper", "pressure"}
    for words in ("interpolation: linear", "interpolation: periodic", "swingd0", "kind: weld", "moving:", "input:"):
        assert sum(words in text for text in texts) >= 3, words
    sizes = Counter(len(group.links) for m in models for group in lw.structure(m).groups)
    assert sizes[4] >= 20 and sum(n for size, n in sizes.items() if size > 4) >= 10


def test_the_same_seed_gives_the_same_text() -> None:
    again = general_case.__wrapped__
    assert general_case(5).text == again(5).text != again(6).text


@pytest.mark.rotating
@pytest.mark.parametrize("seed", range(12))
def test_the_branch_keeps_its_sign_and_its_smoothness(seed: int) -> None:
    """Positions fulfil the constraints; a branch followed with a fifth of the step ends in the same positions."""
    mechanism: Any = lw.loads(general_case(seed).text)
    if any(kinks(d.law) for d in mechanism.drivers.values()):
        return
    system = reference_system(mechanism)
    start, u0 = starting_position(mechanism, system, driver_values(mechanism, np.zeros(1))[0][0])
    u = driver_values(mechanism, np.zeros(1))[0][0]

    def law(t: float) -> tuple[Any, Any, Any]:
        f, d, dd = driver_values(mechanism, np.array([t]))
        return f[0] - u + u0, d[0], dd[0]

    times = np.linspace(0.0, 0.3, 5)
    coarse, fine = (Follower(system, law, care).follow(start, 0.0, times, 0.3) for care in (1.0, 5.0))
    assert len(coarse.q) == len(fine.q) >= 1
    signs = {float(np.linalg.slogdet(system.jacobian(q)[:, 3:])[0]) for q in coarse.q}
    assert len(signs) == 1
    for a, b, t in zip(coarse.q, fine.q, times, strict=False):
        assert np.abs(system.residual(a, law(float(t))[0])).max() < 1e-10
        assert a == pytest.approx(b, abs=1e-8)


SLIDER_CRANK = """
format: 1
name: slider-crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.2 m, mass: 1 kg}
  rod: {points: [A, B], length: 0.7 m, mass: 2 kg}
  piston: {points: [B], mass: 3 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
drawing: {A: [0.2 m, 0 m], B: [0.9 m, 0 m]}
driver: {turn: crank, about: O, speed: 3 rad/s}
"""
TOO_SHORT = SLIDER_CRANK.replace("0.7 m", "0.15 m").replace("0.9 m", "0.35 m")

BEYOND_A_GAP = (  # drawn with the crank at 180°, moved about 0°; between them the rod is too short
    SLIDER_CRANK.replace("0.2 m, mass", "0.8 m, mass")
    .replace("A: [0.2 m, 0 m], B: [0.9 m", "A: [-0.8 m, 0 m], B: [-0.1 m")
    .replace("speed: 3 rad/s}", "position: 0.3 rad * sin(2*pi*t/(1 s))}\ncycle: {duration: 1 s}")
)


@pytest.mark.long
def test_a_dyad_is_judged_beyond_a_gap(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its mode is that of the drawing, although no way leads there; the other mode is told."""
    assert judged(BEYOND_A_GAP, 12).kind == AGREES
    other = lw.loads(BEYOND_A_GAP.replace("B: [-0.1 m", "B: [-1.5 m"))
    solve = lw.solve_motion
    monkeypatch.setattr(lw, "solve_motion", lambda _, **given: solve(other, **given))
    assert judged(BEYOND_A_GAP, 12).kind == "beyond a limit"


@pytest.mark.long
def test_the_judge_knows_right_from_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    """A right result agrees; the other assembly, a refused position, an invented one, a wrong rate do not."""
    assert judged(SLIDER_CRANK, 12).kind == AGREES
    assert judged(TOO_SHORT, 12).kind == LIMIT
    solve = lw.solve_motion

    def from_another(text: str) -> None:
        other = lw.loads(text)
        monkeypatch.setattr(lw, "solve_motion", lambda _, **given: solve(other, **given))

    from_another(SLIDER_CRANK.replace("B: [0.9 m", "B: [-0.5 m"))
    assert judged(SLIDER_CRANK, 12).kind == "other branch"
    from_another(TOO_SHORT)
    assert judged(SLIDER_CRANK, 12).kind in ("refused", "other branch")
    from_another(SLIDER_CRANK)
    assert judged(TOO_SHORT, 12).kind in ("beyond a limit", "other branch")
    from_another(SLIDER_CRANK.replace("0.7 m,", "0.7000001 m,"))
    assert judged(SLIDER_CRANK, 12).kind == "wrong number"
    monkeypatch.undo()
    assert judged(SLIDER_CRANK.replace("3 rad/s", "3 rad"), 12).kind == "not read"
    monkeypatch.setattr(judge, "_allowed", lambda condition: 0.0 * condition)
    assert judged(SLIDER_CRANK, 12).kind == "wrong number"
